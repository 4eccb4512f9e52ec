/* Contexts of EGL without a surface. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/gl/gl_context.h"
#include "draw/gl/gl_symbols.h"

enum { DEVICES = 16 };

/* The functions of the library; those of an extension may be missing. */
struct egl {
    PFNEGLGETPROCADDRESSPROC function;
    PFNEGLQUERYSTRINGPROC text;
    PFNEGLGETPLATFORMDISPLAYPROC display;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLBINDAPIPROC bind;
    PFNEGLCREATECONTEXTPROC create;
    PFNEGLMAKECURRENTPROC use;
    PFNEGLDESTROYCONTEXTPROC destroy;
    PFNEGLGETERRORPROC error;
};

struct own {
    struct egl egl;
    EGLDisplay display;
    EGLContext context;
};

static bool load(struct egl *egl, struct gb_error *err)
{
    static const char *const files[] = {"libEGL.so.1", NULL};
    const struct gb_gl_symbol symbols[] = {{"eglGetProcAddress", &egl->function},
                                           {"eglQueryString", &egl->text},
                                           {"eglGetPlatformDisplay", &egl->display},
                                           {"eglInitialize", &egl->initialize},
                                           {"eglBindAPI", &egl->bind},
                                           {"eglCreateContext", &egl->create},
                                           {"eglMakeCurrent", &egl->use},
                                           {"eglDestroyContext", &egl->destroy},
                                           {"eglGetError", &egl->error},
                                           {NULL, NULL}};
    return gb_gl_symbols_load(files, symbols, "EGL 1.5", err);
}

/* The software renderer among the devices: the same pixels with any graphics card. */
static EGLDisplay software(const struct egl *egl)
{
    EGLDeviceEXT device[DEVICES];
    EGLint count = 0;
    const PFNEGLQUERYDEVICESEXTPROC devices =
        (PFNEGLQUERYDEVICESEXTPROC)egl->function("eglQueryDevicesEXT");
    const PFNEGLQUERYDEVICESTRINGEXTPROC text =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->function("eglQueryDeviceStringEXT");
    if (devices == NULL || text == NULL || !devices(DEVICES, device, &count)) {
        return EGL_NO_DISPLAY;
    }
    for (EGLint i = 0; i < count; i++) {
        const char *extensions = text(device[i], EGL_EXTENSIONS);
        if (extensions != NULL && strstr(extensions, "EGL_MESA_device_software")) {
            return egl->display(EGL_PLATFORM_DEVICE_EXT, device[i], NULL);
        }
    }
    return EGL_NO_DISPLAY;
}

/* The display stays initialised: other contexts of the process may have it too. */
static bool open_display(struct own *own, struct gb_error *err)
{
    const struct egl *egl = &own->egl;
    own->display = software(egl);
    if (own->display != EGL_NO_DISPLAY && egl->initialize(own->display, NULL, NULL)) {
        return true;
    }
    own->display = egl->display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    return (own->display != EGL_NO_DISPLAY &&
            egl->initialize(own->display, NULL, NULL)) ||
           gb_error_set(err, GB_ERR_MACHINE,
                        "EGL: no display without a window system (error 0x%x)",
                        (unsigned)egl->error());
}

static bool open_context(struct own *own, struct gb_error *err)
{
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
    const struct egl *egl = &own->egl;
    if (egl->bind(EGL_OPENGL_API)) {
        own->context =
            egl->create(own->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    }
    return own->context != EGL_NO_CONTEXT ||
           gb_error_set(err, GB_ERR_MACHINE, "EGL has no OpenGL 3.3 (error 0x%x)",
                        (unsigned)egl->error());
}

static void destroy(void *context)
{
    struct own *own = context;
    if (own->context != EGL_NO_CONTEXT) {
        own->egl.use(own->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        own->egl.destroy(own->display, own->context);
    }
    gb_alloc_free(own);
}

static void *create(struct gb_error *err)
{
    struct own *own = gb_alloc_array(1, sizeof *own, err);
    if (own == NULL) {
        return NULL;
    }
    if (!load(&own->egl, err) || !open_display(own, err) || !open_context(own, err)) {
        destroy(own);
        return NULL;
    }
    return own;
}

static bool use(void *context, struct gb_error *err)
{
    const struct own *own = context;
    return own->egl.use(own->display, EGL_NO_SURFACE, EGL_NO_SURFACE, own->context) ||
           gb_error_set(err, GB_ERR_MACHINE, "EGL cannot use its context (error 0x%x)",
                        (unsigned)own->egl.error());
}

static void (*function(const void *context, const char *name))(void)
{
    const struct own *own = context;
    return own->egl.function(name);
}

const struct gb_gl_library gb_gl_egl_library = {"egl", create, use, function, destroy};
