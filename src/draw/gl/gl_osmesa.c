/* Contexts of OSMesa, Mesa's software renderer without a window system (until Mesa 25.0). */
#include "draw/gl/gl_context.h" /* types of the functions, before those of OSMesa */

#include <GL/osmesa.h>

#include "base/alloc.h"
#include "draw/gl/gl_symbols.h"

enum { CANVAS = 16 }; /* side of OSMesa's own buffer, which is not drawn to */

struct osmesa {
    OSMESAproc (*function)(const char *name);
    OSMesaContext (*create)(const int *attributes, OSMesaContext shared);
    GLboolean (*use)(OSMesaContext context, void *buffer, GLenum type, GLsizei width,
                     GLsizei height);
    void (*destroy)(OSMesaContext context);
};

struct own {
    struct osmesa osmesa;
    OSMesaContext context;
    uint8_t canvas[CANVAS * CANVAS * 4];
};

static bool load(struct osmesa *osmesa, struct gb_error *err)
{
    static const char *const files[] = {"libOSMesa.so.8", GB_OSMESA_DIR "/libOSMesa.so.8",
                                        NULL};
    const struct gb_gl_symbol symbols[] = {
        {"OSMesaGetProcAddress", &osmesa->function},
        {"OSMesaCreateContextAttribs", &osmesa->create},
        {"OSMesaMakeCurrent", &osmesa->use},
        {"OSMesaDestroyContext", &osmesa->destroy},
        {NULL, NULL}};
    return gb_gl_symbols_load(files, symbols, "OSMesa 11.2", err);
}

static void destroy(void *context)
{
    struct own *own = context;
    if (own->context != NULL) {
        own->osmesa.destroy(own->context);
    }
    gb_alloc_free(own);
}

static void *create(struct gb_error *err)
{
    static const int wanted[] = {OSMESA_FORMAT,
                                 OSMESA_RGBA,
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 3,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 3,
                                 0};
    struct own *own = gb_alloc_array(1, sizeof *own, err);
    if (own == NULL) {
        return NULL;
    }
    if (!load(&own->osmesa, err)) {
        destroy(own);
        return NULL;
    }
    own->context = own->osmesa.create(wanted, NULL);
    if (own->context == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "OSMesa has no OpenGL 3.3");
        destroy(own);
        return NULL;
    }
    return own;
}

static bool use(void *context, struct gb_error *err)
{
    struct own *own = context;
    return own->osmesa.use(own->context, own->canvas, GL_UNSIGNED_BYTE, CANVAS, CANVAS) !=
               0 ||
           gb_error_set(err, GB_ERR_MACHINE, "OSMesa cannot use its context");
}

static void (*function(const void *context, const char *name))(void)
{
    const struct own *own = context;
    return own->osmesa.function(name);
}

const struct gb_gl_library gb_gl_osmesa_library = {"osmesa", create, use, function,
                                                   destroy};
