/* Shading of the samples, and their mean as pixels. */
#include <glib.h>
#include <math.h>

#include "draw/gl/gl_pass.h"
#include "draw/gl/gl_uniform.h"

/* sRGB byte to linear light. */
static float linear(uint8_t byte)
{
    const float x = (float)byte / 255.0F;
    return x <= 0.04045F ? x / 12.92F : powf((x + 0.055F) / 1.055F, 2.4F);
}

static void linear_colour(const uint8_t rgb[3], float out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = linear(rgb[k]);
    }
}

static void set_shade(const struct gb_gl_pass *pass, GLuint program,
                      const float background[3])
{
    const struct gb_scene *scene = pass->scene;
    uint8_t rgb[3];
    float ink[3];
    float light[3];
    gb_scene_foreground(scene->background, rgb);
    linear_colour(rgb, ink);
    const float size = sqrtf(gb_gl_pass_dot(scene->light, scene->light));
    for (int k = 0; k < 3; k++) {
        light[k] = scene->light[k] / size;
    }
    const float sky[3] = {(float)scene->view.right[2], (float)scene->view.up[2],
                          (float)scene->view.away[2]};
    gb_gl_uniform_vector(pass->gl, program, "background", background);
    gb_gl_uniform_vector(pass->gl, program, "foreground", ink);
    gb_gl_uniform_vector(pass->gl, program, "light", light);
    gb_gl_uniform_vector(pass->gl, program, "sky", sky);
    gb_gl_uniform_float(pass->gl, program, "reach",
                        GB_GL_OCCLUSION_REACH * scene->diameter);
    gb_gl_uniform_float(pass->gl, program, "reach_limit", (float)pass->margin);
    gb_gl_uniform_float(pass->gl, program, "cue", scene->depth_cue);
    gb_gl_uniform_float(pass->gl, program, "shadow_share", scene->shadow_share);
    gb_gl_uniform_float(pass->gl, program, "detail", scene->diameter);
    pass->gl->UniformMatrix3fv(pass->gl->GetUniformLocation(program, "light_rotation"), 1,
                               GL_FALSE, pass->light.rotation);
    gb_gl_uniform_vector(pass->gl, program, "light_translation", pass->light.translation);
    pass->gl->Uniform4fv(pass->gl->GetUniformLocation(program, "light_projection"), 1,
                         pass->light.projection);
    pass->gl->Uniform2fv(pass->gl->GetUniformLocation(program, "light_depth_range"), 1,
                         pass->light.depth_range);
}

void gb_gl_shading_draw(struct gb_gl_pass *pass, int width, int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_SHADE];
    uint8_t rgb[3];
    float background[4];
    gb_scene_background(pass->scene->background, rgb);
    linear_colour(rgb, background);
    background[3] = 1.0F;
    static const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[2]);
    pass->gl->Disable(GL_DEPTH_TEST);
    pass->gl->ClearBufferfv(
        GL_COLOR, 0,
        pass->scene->background == GB_BACKGROUND_TRANSPARENT ? nothing : background);
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, &pass->eye, width, height);
    gb_gl_uniform_cuts(pass->gl, program, pass->scene, &pass->eye);
    gb_gl_uniform_sampler(pass->gl, program, "seen", GB_GL_TEXTURE_SEEN);
    gb_gl_uniform_sampler(pass->gl, program, "depths", GB_GL_TEXTURE_DEPTH);
    gb_gl_uniform_sampler(pass->gl, program, "shadows", GB_GL_TEXTURE_SHADOW);
    gb_gl_uniform_sampler(pass->gl, program, "spheres", GB_GL_TEXTURE_SPHERES);
    gb_gl_uniform_sampler(pass->gl, program, "rods", GB_GL_TEXTURE_RODS);
    gb_gl_uniform_sampler(pass->gl, program, "facets", GB_GL_TEXTURE_FACETS);
    gb_gl_uniform_sampler(pass->gl, program, "colours", GB_GL_TEXTURE_COLOURS);
    const size_t first_facet = pass->scene->count + pass->scene->rods;
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first_rod"),
                         (GLuint)pass->scene->count);
    pass->gl->Uniform1ui(pass->gl->GetUniformLocation(program, "first_facet"),
                         (GLuint)first_facet);
    set_shade(pass, program, background);
    /* the margin is read by the occlusion and not shaded */
    const int inset = pass->margin - GB_GL_SAMPLES;
    pass->gl->Enable(GL_SCISSOR_TEST);
    pass->gl->Scissor(MAX(inset, 0), MAX(inset, 0), width - 2 * MAX(inset, 0),
                      height - 2 * MAX(inset, 0));
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3);
    pass->gl->Disable(GL_SCISSOR_TEST);
}

void gb_gl_shading_read_pixels(struct gb_gl_pass *pass)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_RESOLVE];
    const struct gb_image *image = pass->image;
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    pass->gl->Viewport(0, 0, pass->width, pass->height);
    pass->gl->UseProgram(program);
    gb_gl_uniform_sampler(pass->gl, program, "samples", GB_GL_TEXTURE_SAMPLES);
    pass->gl->Uniform2i(pass->gl->GetUniformLocation(program, "inset"), pass->margin,
                        pass->margin);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3);
    pass->gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    pass->gl->PixelStorei(GL_PACK_ROW_LENGTH, image->width);
    pass->gl->ReadPixels(
        0, 0, pass->width, pass->height, GL_RGBA, GL_UNSIGNED_BYTE,
        &image->rgba[4 * ((size_t)pass->y * (size_t)image->width + (size_t)pass->x)]);
}
