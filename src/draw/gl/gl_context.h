#ifndef GB_DRAW_GL_GL_CONTEXT_H
#define GB_DRAW_GL_GL_CONTEXT_H

#include <stdbool.h>

#include "draw/gl/gl_functions.h"
#include "greenbody/status.h"

/* An OpenGL 3.3 context without a window.  The environment variable GB_GL, osmesa or egl,
 * names the library; else the first that works is taken: OSMesa, then EGL. */
struct gb_gl_context;

/* A library that has such contexts.  Memory of a context is the library's own. */
struct gb_gl_library {
    const char *name;
    void *(*create)(struct gb_error *err); /* NULL: error set */
    bool (*use)(void *context, struct gb_error *err);
    void (*(*function)(const void *context, const char *name))(void); /* NULL: none */
    void (*destroy)(void *context);
};

extern const struct gb_gl_library gb_gl_osmesa_library, gb_gl_egl_library;

/* The new context is the thread's current one.  Errors: GB_ERR_MACHINE, with the reason of
 * each library; GB_ERR_INPUT: GB_GL is something else. */
bool gb_gl_context_open(struct gb_gl_context **out, struct gb_error *err);

/* Makes it the thread's current one. */
bool gb_gl_context_use(struct gb_gl_context *context, struct gb_error *err);

const struct gb_gl *gb_gl_context_functions(const struct gb_gl_context *context);
const char *gb_gl_context_name(const struct gb_gl_context *context);

void gb_gl_context_close(struct gb_gl_context *context); /* NULL is fine */

#endif
