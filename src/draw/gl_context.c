/* OpenGL contexts without a window.  Two libraries have them: OSMesa, Mesa's software renderer
 * without a window system (until Mesa 25.0), and EGL with its software device.  Both are
 * loaded at run time, and so are the functions of OpenGL. */
#include "draw/gl_context.h" /* types of the functions, before the header of OSMesa */

#if GB_WITH_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#endif
#if GB_WITH_OSMESA
#include <GL/osmesa.h>
#endif
#include <dlfcn.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"

/* A library that has such contexts.  Memory of a context is the library's own. */
struct library {
    const char *name;
    void *(*create)(struct gb_error *err); /* NULL: error set */
    bool (*use)(void *context, struct gb_error *err);
    void (*(*function)(const void *context, const char *name))(void); /* NULL: none */
    void (*destroy)(void *context);
};

/* Functions of a shared library that is loaded when they are asked for.  A renderer brings a
 * compiler with it, whose loading takes longer than all else a program does as it starts. */
struct symbol {
    const char *name;
    void *at; /* address of the pointer to the function */
};

/* Of the first of the files (the last is NULL) that is there; it stays loaded.  The symbols:
 * the last has no name.  library: its name and version in messages.  Errors: GB_ERR_MACHINE,
 * no such file (the first is named), no such function. */
static bool load_symbols(const char *const *files, const struct symbol *symbols,
                         const char *library, struct gb_error *err)
{
    void *handle = NULL;
    for (const char *const *file = files; handle == NULL && *file != NULL; file++) {
        handle = dlopen(*file, RTLD_NOW | RTLD_LOCAL);
    }
    if (handle == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: the library %s cannot be loaded",
                            library, files[0]);
    }
    for (const struct symbol *symbol = symbols; symbol->name != NULL; symbol++) {
        void *found = dlsym(handle, symbol->name);
        if (found == NULL) {
            return gb_error_set(err, GB_ERR_MACHINE, "%s: no %s in %s", library,
                                symbol->name, files[0]);
        }
        memcpy(symbol->at, &found, sizeof found);
    }
    return true;
}

#if GB_WITH_OSMESA

enum { CANVAS = 16 }; /* side of OSMesa's own buffer, which is not drawn to */

struct osmesa {
    OSMESAproc (*function)(const char *name);
    OSMesaContext (*create)(const int *attributes, OSMesaContext shared);
    GLboolean (*use)(OSMesaContext context, void *buffer, GLenum type, GLsizei width,
                     GLsizei height);
    void (*destroy)(OSMesaContext context);
};

struct own_osmesa {
    struct osmesa osmesa;
    OSMesaContext context;
    uint8_t canvas[CANVAS * CANVAS * 4];
};

static bool osmesa_load(struct osmesa *osmesa, struct gb_error *err)
{
    static const char *const files[] = {"libOSMesa.so.8", GB_OSMESA_DIR "/libOSMesa.so.8",
                                        NULL};
    const struct symbol symbols[] = {{"OSMesaGetProcAddress", &osmesa->function},
                                     {"OSMesaCreateContextAttribs", &osmesa->create},
                                     {"OSMesaMakeCurrent", &osmesa->use},
                                     {"OSMesaDestroyContext", &osmesa->destroy},
                                     {NULL, NULL}};
    return load_symbols(files, symbols, "OSMesa 11.2", err);
}

static void osmesa_destroy(void *context)
{
    struct own_osmesa *own = context;
    if (own->context != NULL) {
        own->osmesa.destroy(own->context);
    }
    gb_alloc_free(own);
}

static void *osmesa_create(struct gb_error *err)
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
    struct own_osmesa *own = gb_alloc_array(1, sizeof *own, err);
    if (own == NULL) {
        return NULL;
    }
    if (!osmesa_load(&own->osmesa, err)) {
        osmesa_destroy(own);
        return NULL;
    }
    own->context = own->osmesa.create(wanted, NULL);
    if (own->context == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "OSMesa has no OpenGL 3.3");
        osmesa_destroy(own);
        return NULL;
    }
    return own;
}

static bool osmesa_use(void *context, struct gb_error *err)
{
    struct own_osmesa *own = context;
    return own->osmesa.use(own->context, own->canvas, GL_UNSIGNED_BYTE, CANVAS, CANVAS) !=
               0 ||
           gb_error_set(err, GB_ERR_MACHINE, "OSMesa cannot use its context");
}

static void (*osmesa_function(const void *context, const char *name))(void)
{
    const struct own_osmesa *own = context;
    return own->osmesa.function(name);
}

static const struct library osmesa_library = {"osmesa", osmesa_create, osmesa_use,
                                              osmesa_function, osmesa_destroy};

#endif

#if GB_WITH_EGL

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

struct own_egl {
    struct egl egl;
    EGLDisplay display;
    EGLContext context;
};

static bool egl_load(struct egl *egl, struct gb_error *err)
{
    static const char *const files[] = {"libEGL.so.1", NULL};
    const struct symbol symbols[] = {{"eglGetProcAddress", &egl->function},
                                     {"eglQueryString", &egl->text},
                                     {"eglGetPlatformDisplay", &egl->display},
                                     {"eglInitialize", &egl->initialize},
                                     {"eglBindAPI", &egl->bind},
                                     {"eglCreateContext", &egl->create},
                                     {"eglMakeCurrent", &egl->use},
                                     {"eglDestroyContext", &egl->destroy},
                                     {"eglGetError", &egl->error},
                                     {NULL, NULL}};
    return load_symbols(files, symbols, "EGL 1.5", err);
}

/* The software renderer among the devices: the same pixels with any graphics card. */
static EGLDisplay egl_software(const struct egl *egl)
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
static bool egl_open_display(struct own_egl *own, struct gb_error *err)
{
    const struct egl *egl = &own->egl;
    own->display = egl_software(egl);
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

static bool egl_open_context(struct own_egl *own, struct gb_error *err)
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

static void egl_destroy(void *context)
{
    struct own_egl *own = context;
    if (own->context != EGL_NO_CONTEXT) {
        own->egl.use(own->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        own->egl.destroy(own->display, own->context);
    }
    gb_alloc_free(own);
}

static void *egl_create(struct gb_error *err)
{
    struct own_egl *own = gb_alloc_array(1, sizeof *own, err);
    if (own == NULL) {
        return NULL;
    }
    if (!egl_load(&own->egl, err) || !egl_open_display(own, err) ||
        !egl_open_context(own, err)) {
        egl_destroy(own);
        return NULL;
    }
    return own;
}

static bool egl_use(void *context, struct gb_error *err)
{
    const struct own_egl *own = context;
    return own->egl.use(own->display, EGL_NO_SURFACE, EGL_NO_SURFACE, own->context) ||
           gb_error_set(err, GB_ERR_MACHINE, "EGL cannot use its context (error 0x%x)",
                        (unsigned)own->egl.error());
}

static void (*egl_function(const void *context, const char *name))(void)
{
    const struct own_egl *own = context;
    return own->egl.function(name);
}

static const struct library egl_library = {"egl", egl_create, egl_use, egl_function,
                                           egl_destroy};

#endif

struct gb_gl_context {
    const struct library *library;
    void *own;
    struct gb_gl gl;
};

/* In the order in which they are tried. */
static const struct library *const libraries[] = {
#if GB_WITH_OSMESA
    &osmesa_library,
#endif
#if GB_WITH_EGL
    &egl_library,
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

static bool open_one(struct gb_gl_context *context, const struct library *library,
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

void gb_gl_context_close(struct gb_gl_context *context)
{
    if (context != NULL) {
        context->library->destroy(context->own);
        gb_alloc_free(context);
    }
}
