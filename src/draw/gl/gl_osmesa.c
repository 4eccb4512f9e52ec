/* Contexts of OSMesa, Mesa's software renderer without a window system (until Mesa 25.0). */
#include "draw/gl/gl_context.h" /* types of the functions, before those of OSMesa */

#include <GL/osmesa.h>

#include "base/alloc.h"

enum { CANVAS = 16 }; /* side of OSMesa's own buffer, which is not drawn to */

struct own {
    OSMesaContext context;
    uint8_t canvas[CANVAS * CANVAS * 4];
};

static void destroy(void *context)
{
    struct own *own = context;
    if (own->context != NULL) {
        OSMesaDestroyContext(own->context);
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
    own->context = OSMesaCreateContextAttribs(wanted, NULL);
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
    return OSMesaMakeCurrent(own->context, own->canvas, GL_UNSIGNED_BYTE, CANVAS,
                             CANVAS) != 0 ||
           gb_error_set(err, GB_ERR_MACHINE, "OSMesa cannot use its context");
}

const struct gb_gl_library gb_gl_osmesa_library = {"osmesa", create, use,
                                                   OSMesaGetProcAddress, destroy};
