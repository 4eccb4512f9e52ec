#include "draw/gl/gl_symbols.h"

#include <dlfcn.h>
#include <string.h>

bool gb_gl_symbols_load(const char *const *files, const struct gb_gl_symbol *symbols,
                        const char *library, struct gb_error *err)
{
    void *handle = NULL;
    for (const char *const *file = files; handle == NULL && *file != NULL; file++) {
        handle = dlopen(*file, RTLD_NOW | RTLD_LOCAL);
    }
    if (handle == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: no %s here", library, files[0]);
    }
    for (const struct gb_gl_symbol *symbol = symbols; symbol->name != NULL; symbol++) {
        void *found = dlsym(handle, symbol->name);
        if (found == NULL) {
            return gb_error_set(err, GB_ERR_MACHINE, "%s: no %s in %s", library,
                                symbol->name, files[0]);
        }
        memcpy(symbol->at, &found, sizeof found);
    }
    return true;
}
