#ifndef GB_DRAW_GL_GL_SYMBOLS_H
#define GB_DRAW_GL_GL_SYMBOLS_H

#include <stddef.h>

#include "greenbody/status.h"

/* Functions of a shared library that is loaded when they are asked for.  A renderer brings a
 * compiler with it, whose loading takes longer than all else a program does as it starts. */
struct gb_gl_symbol {
    const char *name;
    void *at; /* address of the pointer to the function */
};

/* Of the first of the files (the last is NULL) that is there; it stays loaded.  The symbols:
 * the last has no name.  library: its name and version in messages.  Errors: GB_ERR_MACHINE,
 * no such file (the first is named), no such function. */
bool gb_gl_symbols_load(const char *const *files, const struct gb_gl_symbol *symbols,
                        const char *library, struct gb_error *err);

#endif
