#include "draw/gl/gl_context.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"

struct gb_gl_context {
    const struct gb_gl_library *library;
    void *own;
    struct gb_gl gl;
};

/* In the order in which they are tried. */
static const struct gb_gl_library *const libraries[] = {
#if GB_WITH_OSMESA
    &gb_gl_osmesa_library,
#endif
#if GB_WITH_EGL
    &gb_gl_egl_library,
#endif
};

/* REASON: room for the words of one library. */
enum { LIBRARIES = sizeof libraries / sizeof libraries[0], REASON = 100 };

static const struct {
    const char *name;
    size_t offset;
} functions[] = {
#define GB_GL_ROW(type, name) {"gl" #name, offsetof(struct gb_gl, name)},
    GB_GL_FUNCTIONS(GB_GL_ROW)
#undef GB_GL_ROW
};

static bool find_functions(struct gb_gl_context *context, struct gb_error *err)
{
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        void (*function)(void) =
            context->library->function(context->own, functions[i].name);
        if (function == NULL) {
            return gb_error_set(err, GB_ERR_MACHINE, "%s has no %s",
                                context->library->name, functions[i].name);
        }
        memcpy((char *)&context->gl + functions[i].offset, &function, sizeof function);
    }
    return true;
}

static bool open_one(struct gb_gl_context *context, const struct gb_gl_library *library,
                     struct gb_error *err)
{
    context->library = library;
    context->own = library->create(err);
    if (context->own == NULL) {
        return false;
    }
    if (library->use(context->own, err) && find_functions(context, err)) {
        return true;
    }
    library->destroy(context->own);
    context->own = NULL;
    return false;
}

static bool open_first(struct gb_gl_context *context, const char *name,
                       struct gb_error *err)
{
    char reason[LIBRARIES * REASON] = "";
    bool known = name == NULL;
    for (size_t i = 0; i < LIBRARIES; i++) {
        struct gb_error one = {0};
        if (name != NULL && strcmp(name, libraries[i]->name) != 0) {
            continue;
        }
        known = true;
        if (open_one(context, libraries[i], &one)) {
            return true;
        }
        if (one.code == GB_ERR_MEMORY) {
            *err = one;
            return false;
        }
        const size_t used = strlen(reason);
        snprintf(reason + used, sizeof reason - used, "%s%.90s", used > 0 ? "; " : "",
                 one.text);
    }
    return known
               ? gb_error_set(err, GB_ERR_MACHINE, "no OpenGL 3.3, no pictures: %s",
                              reason)
               : gb_error_set(err, GB_ERR_INPUT,
                              "GB_GL = %.40s: must be one of%s%s of this build", name,
                              GB_WITH_OSMESA ? " osmesa" : "", GB_WITH_EGL ? " egl" : "");
}

bool gb_gl_context_open(struct gb_gl_context **out, struct gb_error *err)
{
    *out = NULL;
    struct gb_gl_context *context = gb_alloc_array(1, sizeof *context, err);
    if (context == NULL) {
        return false;
    }
    if (!open_first(context, getenv("GB_GL"), err)) {
        gb_alloc_free(context);
        return false;
    }
    *out = context;
    return true;
}

bool gb_gl_context_use(struct gb_gl_context *context, struct gb_error *err)
{
    return context->library->use(context->own, err);
}

const struct gb_gl *gb_gl_context_functions(const struct gb_gl_context *context)
{
    return &context->gl;
}

const char *gb_gl_context_name(const struct gb_gl_context *context)
{
    return context->library->name;
}

void gb_gl_context_close(struct gb_gl_context *context)
{
    if (context != NULL) {
        context->library->destroy(context->own);
        gb_alloc_free(context);
    }
}
