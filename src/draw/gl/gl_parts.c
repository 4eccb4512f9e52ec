/* Rasterisation of spheres, rods, facets and box edges. */
#include <math.h>
#include <string.h>

#include "draw/gl/gl_pass.h"
#include "draw/gl/gl_uniform.h"

enum { RIBBON = 6 }; /* vertices of a box edge */

/* Width of box edges as a share of the shorter side of the image. */
static const float edge_width = 0.0014F;

/* True if a sphere may cover a sample of the target; the factor 1.5 allows for the
 * elongation by perspective. */
static bool in_target(const struct gb_camera *camera, const float *ball, int width,
                      int height)
{
    const float scale = camera->projection[3] != 0.0F ? camera->projection[2]
                                                      : camera->projection[2] / ball[2];
    const float x = camera->projection[0] + scale * ball[0];
    const float y = camera->projection[1] - scale * ball[1];
    const float r = 1.5F * scale * ball[3] + 2.0F;
    return x + r >= 0.0F && y + r >= 0.0F && x - r <= (float)width &&
           y - r <= (float)height;
}

/* Whether a part within a ball needs to be drawn: spheres come first, then rods.  The
 * target of the light is the whole scene, that of the eye a tile. */
static bool shows(const struct gb_gl_pass *pass, const struct gb_camera *camera,
                  size_t part, const float *ball, int width, int height)
{
    return camera == &pass->light
               ? pass->unlit[part] == 0
               : pass->hidden[part] == 0 && in_target(camera, ball, width, height);
}

static void draw_spheres(struct gb_gl_pass *pass, const struct gb_camera *camera,
                         int width, int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_SPHERE];
    GLsizei count = 0;
    for (size_t i = 0; i < pass->scene->count; i++) {
        if (shows(pass, camera, i, &pass->scene->sphere[4 * i], width, height)) {
            pass->index[count++] = (uint32_t)i;
        }
    }
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, camera, width, height);
    gb_gl_uniform_cuts(pass->gl, program, pass->scene, camera);
    gb_gl_uniform_sampler(pass->gl, program, "spheres", GB_GL_TEXTURE_SPHERES);
    pass->gl->BindVertexArray(pass->array[GB_GL_ARRAY_SPHERES]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[GB_GL_BUFFER_INDICES]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)count * 4, pass->index,
                         GL_STREAM_DRAW);
    pass->gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

static void set_first(const struct gb_gl_pass *pass, GLuint program, size_t first)
{
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first"), (GLuint)first);
}

/* Bounding ball of a rod around its first end. */
static void rod_ball(const float *rod, float ball[4])
{
    memcpy(ball, rod, 3 * sizeof *ball);
    ball[3] = rod[3] + hypotf(hypotf(rod[4] - rod[0], rod[5] - rod[1]), rod[6] - rod[2]);
}

static void draw_rods(struct gb_gl_pass *pass, const struct gb_camera *camera, int width,
                      int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_ROD];
    const struct gb_scene *scene = pass->scene;
    GLsizei count = 0;
    for (size_t i = 0; i < scene->rods; i++) {
        float ball[4];
        rod_ball(&scene->rod[8 * i], ball);
        if (shows(pass, camera, scene->count + i, ball, width, height)) {
            pass->index[count++] = (uint32_t)i;
        }
    }
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, camera, width, height);
    gb_gl_uniform_sampler(pass->gl, program, "rods", GB_GL_TEXTURE_RODS);
    set_first(pass, program, scene->count);
    pass->gl->BindVertexArray(pass->array[GB_GL_ARRAY_RODS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[GB_GL_BUFFER_ROD_INDICES]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)count * 4, pass->index,
                         GL_STREAM_DRAW);
    pass->gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

static void draw_facets(const struct gb_gl_pass *pass, const struct gb_camera *camera,
                        int width, int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_FACET];
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, camera, width, height);
    set_first(pass, program, pass->scene->count + pass->scene->rods);
    pass->gl->BindVertexArray(pass->array[GB_GL_ARRAY_FACETS]);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3 * (GLsizei)pass->scene->facets);
}

/* Spheres, rods and facets. */
static void draw_parts(struct gb_gl_pass *pass, const struct gb_camera *camera, int width,
                       int height)
{
    if (pass->scene->count > 0) {
        draw_spheres(pass, camera, width, height);
    }
    if (pass->scene->rods > 0) {
        draw_rods(pass, camera, width, height);
    }
    if (pass->scene->facets > 0) {
        draw_facets(pass, camera, width, height);
    }
}

/* Two triangles along an edge, in samples of the tile. */
static void ribbon(const struct gb_camera *camera, const float edge[6], float width,
                   float *out)
{
    static const int corner[RIBBON] = {0, 1, 2, 2, 1, 3};
    float end[2][3];
    for (int k = 0; k < 2; k++) {
        const float *p = &edge[3 * k];
        const bool flat = camera->projection[3] != 0.0F;
        const float scale = flat ? camera->projection[2] : camera->projection[2] / p[2];
        end[k][0] = camera->projection[0] + scale * p[0];
        end[k][1] = camera->projection[1] - scale * p[1];
        end[k][2] = flat ? p[2] : 1.0F / p[2];
    }
    const float dx = end[1][0] - end[0][0];
    const float dy = end[1][1] - end[0][1];
    const float half = 0.5F * width / fmaxf(hypotf(dx, dy), 1e-3F);
    for (int k = 0; k < RIBBON; k++) {
        const float *from = end[corner[k] >> 1];
        const float side = (corner[k] & 1) != 0 ? half : -half;
        const float past = corner[k] >> 1 != 0 ? half : -half; /* corners meet */
        out[3 * k] = from[0] - side * dy + past * dx;
        out[3 * k + 1] = from[1] + side * dx + past * dy;
        out[3 * k + 2] = from[2];
    }
}

static void draw_edges(struct gb_gl_pass *pass, int width, int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_EDGE];
    const int side = pass->image->width < pass->image->height ? pass->image->width
                                                              : pass->image->height;
    const float thick = GB_GL_SAMPLES * fmaxf(edge_width * (float)side, 0.8F);
    float vertices[GB_SCENE_EDGES][3 * RIBBON];
    for (int k = 0; k < pass->scene->edge_count; k++) {
        ribbon(&pass->eye, pass->scene->edge[k], thick, vertices[k]);
    }
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, &pass->eye, width, height);
    pass->gl->BindVertexArray(pass->array[GB_GL_ARRAY_RIBBONS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[GB_GL_BUFFER_RIBBONS]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STREAM_DRAW);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, RIBBON * pass->scene->edge_count);
}

void gb_gl_parts_draw_shadow(struct gb_gl_pass *pass)
{
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[1]);
    pass->gl->Viewport(0, 0, GB_GL_SHADOW, GB_GL_SHADOW);
    pass->gl->Enable(GL_DEPTH_TEST);
    pass->gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_parts(pass, &pass->light, GB_GL_SHADOW, GB_GL_SHADOW);
}

void gb_gl_parts_draw_visible(struct gb_gl_pass *pass, int width, int height)
{
    static const GLuint no_particle[4] = {0xffffffffU, 0, 0, 0};
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[0]);
    pass->gl->Viewport(0, 0, width, height);
    pass->gl->Enable(GL_DEPTH_TEST);
    pass->gl->ClearBufferuiv(GL_COLOR, 0, no_particle);
    pass->gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw_parts(pass, &pass->eye, width, height);
    draw_edges(pass, width, height);
}
