#include "draw/gl/renderer.h"

#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "draw/gl/gl_context.h"
#include "draw/gl/gl_pass.h"
#include "draw/gl/hidden.h"
#include "draw/gl/shaders.h"

enum {
    TILE_WIDTH = 2048,   /* widest tile, pixels */
    TILE_AREA = 1 << 20, /* largest tile, pixels: bounds the memory */
    REACH_LIMIT = 192, /* longest range of the occlusion, and margin of a tile, samples */
};

struct gb_renderer {
    struct gb_gl_context *context;
    GLuint program[GB_GL_PROGRAMS];
    GLint most_spheres;
};

static bool compile(const struct gb_gl *gl, GLuint program, GLenum stage,
                    const char *text, const char *more, struct gb_error *err)
{
    const char *const both[2] = {text, more};
    GLint done = 0;
    const GLuint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, 2, both, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == 0) {
        char log[200] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        gb_error_set(err, GB_ERR_MACHINE, "OpenGL refuses a shader: %s", log);
    }
    gl->AttachShader(program, shader);
    gl->DeleteShader(shader);
    return done != 0;
}

static bool build(const struct gb_gl *gl, GLuint *program,
                  const struct gb_shaders_text *text, struct gb_error *err)
{
    GLint done = 0;
    *program = gl->CreateProgram();
    if (!compile(gl, *program, GL_VERTEX_SHADER, text->vertex, "", err) ||
        !compile(gl, *program, GL_FRAGMENT_SHADER, text->fragment, text->more, err)) {
        return false;
    }
    gl->LinkProgram(*program);
    gl->GetProgramiv(*program, GL_LINK_STATUS, &done);
    return done != 0 || gb_error_set(err, GB_ERR_MACHINE, "OpenGL cannot link a shader");
}

bool gb_renderer_open(struct gb_renderer **out, struct gb_error *err)
{
    static const struct gb_shaders_text *const text[GB_GL_PROGRAMS] = {
        &gb_shaders_sphere, &gb_shaders_rod,   &gb_shaders_facet,
        &gb_shaders_edge,   &gb_shaders_shade, &gb_shaders_resolve,
        &gb_shaders_wall};
    *out = NULL;
    struct gb_renderer *renderer = gb_alloc_array(1, sizeof *renderer, err);
    if (renderer == NULL) {
        return false;
    }
    if (!gb_gl_context_open(&renderer->context, err)) {
        goto fail;
    }
    const struct gb_gl *gl = gb_gl_context_functions(renderer->context);
    for (int k = 0; k < GB_GL_PROGRAMS; k++) {
        if (!build(gl, &renderer->program[k], text[k], err)) {
            goto fail;
        }
    }
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &renderer->most_spheres);
    *out = renderer;
    return true;
fail:
    gb_renderer_close(renderer);
    return false;
}

void gb_renderer_close(struct gb_renderer *renderer)
{
    if (renderer != NULL) {
        gb_gl_context_close(renderer->context);
        gb_alloc_free(renderer);
    }
}

static void paint_tile(struct gb_gl_pass *pass)
{
    const int width = GB_GL_SAMPLES * pass->width + 2 * pass->margin;
    const int height = GB_GL_SAMPLES * pass->height + 2 * pass->margin;
    gb_gl_cameras_set_eye(pass);
    gb_gl_parts_draw_visible(pass, width, height);
    gb_gl_shading_draw(pass, width, height);
    gb_gl_walls_draw(pass, width, height);
    gb_gl_shading_read_pixels(pass);
}

/* Samples around a tile that its occlusion reads; even, as pixels are 2 x 2. */
static int tile_margin(const struct gb_scene *scene)
{
    const double near = scene->view.orthographic ? 1.0 : scene->view.near;
    const double reach =
        GB_GL_SAMPLES * scene->view.focal / near * (double)GB_GL_OCCLUSION_REACH;
    return 2 * (int)ceil(0.5 * fmin(reach, REACH_LIMIT));
}

static bool gl_failed(const struct gb_gl *gl, struct gb_error *err)
{
    const GLenum code = gl->GetError();
    if (code == GL_NO_ERROR) {
        return false;
    }
    gb_error_set(err, code == GL_OUT_OF_MEMORY ? GB_ERR_MEMORY : GB_ERR_MACHINE,
                 "OpenGL cannot paint the picture (error 0x%x)", code);
    return true;
}

/* Length of equal pieces of at most `most` that cover a side. */
static int tile_size(int side, int most)
{
    const int tiles = (side + most - 1) / most;
    return (side + tiles - 1) / tiles;
}

static void free_lists(struct gb_gl_pass *pass)
{
    gb_alloc_free(pass->index);
    gb_alloc_free(pass->hidden);
    gb_alloc_free(pass->unlit);
}

/* Scratch of draw lists, and the particles that no draw list needs. */
static bool make_lists(struct gb_gl_pass *pass, struct gb_error *err)
{
    const struct gb_scene *scene = pass->scene;
    const size_t parts = scene->count + scene->rods;
    const int width = GB_GL_SAMPLES * pass->image->width;
    const int height = GB_GL_SAMPLES * pass->image->height;
    pass->index =
        gb_alloc_array(MAX(scene->count, scene->rods) + 1, sizeof *pass->index, err);
    pass->hidden = gb_alloc_array(parts + 1, 1, err);
    pass->unlit = gb_alloc_array(parts + 1, 1, err);
    if (pass->index == NULL || pass->hidden == NULL || pass->unlit == NULL) {
        return false;
    }
    gb_gl_cameras_set_eye(pass); /* of the whole image: no tile and no margin yet */
    gb_gl_cameras_set_light(pass);
    return gb_hidden_find(scene, &pass->eye, width, height, pass->hidden, err) &&
           gb_hidden_find(scene, &pass->light, GB_GL_SHADOW, GB_GL_SHADOW, pass->unlit,
                          err);
}

bool gb_renderer_render(struct gb_renderer *renderer, const struct gb_scene *scene,
                        struct gb_image *image, struct gb_error *err)
{
    struct gb_gl_pass pass = {.gl = gb_gl_context_functions(renderer->context),
                              .program = renderer->program,
                              .scene = scene,
                              .image = image};
    const size_t parts = scene->count + 2 * scene->rods + 3 * scene->facets;
    if (parts > (size_t)renderer->most_spheres) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "a picture of %zu particles and %zu forces: at most %d of "
                            "both",
                            scene->count, scene->rods / 2, renderer->most_spheres);
    }
    if (!gb_gl_context_use(renderer->context, err)) {
        return false;
    }
    if (!make_lists(&pass, err)) {
        free_lists(&pass);
        return false;
    }
    pass.margin = tile_margin(scene);
    pass.most_width = tile_size(image->width, TILE_WIDTH);
    pass.most_height = tile_size(image->height, TILE_AREA / pass.most_width);
    gb_gl_buffers_make_targets(&pass);
    gb_gl_buffers_make_inputs(&pass);
    bool failed = gl_failed(pass.gl, err);
    if (!failed) {
        gb_gl_parts_draw_shadow(&pass);
    }
    for (pass.y = 0; pass.y < image->height && !failed; pass.y += pass.most_height) {
        pass.height = MIN(pass.most_height, image->height - pass.y);
        for (pass.x = 0; pass.x < image->width && !failed; pass.x += pass.most_width) {
            pass.width = MIN(pass.most_width, image->width - pass.x);
            paint_tile(&pass);
            failed = gl_failed(pass.gl, err);
        }
    }
    gb_gl_buffers_free(&pass);
    free_lists(&pass);
    return !failed;
}
