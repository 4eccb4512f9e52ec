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
    gb_gl_uniform_vector(program, "background", background);
    gb_gl_uniform_vector(program, "foreground", ink);
    gb_gl_uniform_vector(program, "light", light);
    gb_gl_uniform_vector(program, "sky", sky);
    gb_gl_uniform_float(program, "reach", GB_GL_OCCLUSION_REACH * scene->diameter);
    gb_gl_uniform_float(program, "reach_limit", (float)pass->margin);
    gb_gl_uniform_float(program, "cue", scene->depth_cue);
    gb_gl_uniform_float(program, "shadow_share", scene->shadow_share);
    gb_gl_uniform_float(program, "detail", scene->diameter);
    glUniformMatrix3fv(glGetUniformLocation(program, "light_rotation"), 1, GL_FALSE,
                       pass->light.rotation);
    gb_gl_uniform_vector(program, "light_translation", pass->light.translation);
    glUniform4fv(glGetUniformLocation(program, "light_projection"), 1,
                 pass->light.projection);
    glUniform2fv(glGetUniformLocation(program, "light_depth_range"), 1,
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
    glBindFramebuffer(GL_FRAMEBUFFER, pass->frame[2]);
    glDisable(GL_DEPTH_TEST);
    glClearBufferfv(GL_COLOR, 0,
                    pass->scene->background == GB_BACKGROUND_TRANSPARENT ? nothing
                                                                         : background);
    glUseProgram(program);
    gb_gl_uniform_camera(program, &pass->eye, width, height);
    gb_gl_uniform_sampler(program, "seen", GB_GL_TEXTURE_SEEN);
    gb_gl_uniform_sampler(program, "depths", GB_GL_TEXTURE_DEPTH);
    gb_gl_uniform_sampler(program, "shadows", GB_GL_TEXTURE_SHADOW);
    gb_gl_uniform_sampler(program, "spheres", GB_GL_TEXTURE_SPHERES);
    gb_gl_uniform_sampler(program, "rods", GB_GL_TEXTURE_RODS);
    gb_gl_uniform_sampler(program, "facets", GB_GL_TEXTURE_FACETS);
    gb_gl_uniform_sampler(program, "colours", GB_GL_TEXTURE_COLOURS);
    const size_t first_facet = pass->scene->count + pass->scene->rods;
    glUniform1ui(glGetUniformLocation(program, "first_rod"), (GLuint)pass->scene->count);
    glUniform1ui(glGetUniformLocation(program, "first_facet"), (GLuint)first_facet);
    set_shade(pass, program, background);
    /* the margin is read by the occlusion and not shaded */
    const int inset = pass->margin - GB_GL_SAMPLES;
    glEnable(GL_SCISSOR_TEST);
    glScissor(MAX(inset, 0), MAX(inset, 0), width - 2 * MAX(inset, 0),
              height - 2 * MAX(inset, 0));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

void gb_gl_shading_read_pixels(struct gb_gl_pass *pass)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_RESOLVE];
    const struct gb_image *image = pass->image;
    glBindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    glViewport(0, 0, pass->width, pass->height);
    glUseProgram(program);
    gb_gl_uniform_sampler(program, "samples", GB_GL_TEXTURE_SAMPLES);
    glUniform2i(glGetUniformLocation(program, "inset"), pass->margin, pass->margin);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, image->width);
    glReadPixels(
        0, 0, pass->width, pass->height, GL_RGBA, GL_UNSIGNED_BYTE,
        &image->rgba[4 * ((size_t)pass->y * (size_t)image->width + (size_t)pass->x)]);
}
