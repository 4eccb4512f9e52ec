#ifndef GB_DRAW_GL_GL_UNIFORM_H
#define GB_DRAW_GL_GL_UNIFORM_H

/* Uniform variables of a GL program, by name. */

#include "draw/gl/gl_pass.h"

static inline void gb_gl_uniform_float(const struct gb_gl *gl, GLuint program,
                                       const char *name, float x)
{
    gl->Uniform1f(gl->GetUniformLocation(program, name), x);
}

static inline void gb_gl_uniform_vector(const struct gb_gl *gl, GLuint program,
                                        const char *name, const float *x)
{
    gl->Uniform3fv(gl->GetUniformLocation(program, name), 1, x);
}

static inline void gb_gl_uniform_sampler(const struct gb_gl *gl, GLuint program,
                                         const char *name, enum gb_gl_texture unit)
{
    gl->Uniform1i(gl->GetUniformLocation(program, name), (GLint)unit);
}

static inline void gb_gl_uniform_camera(const struct gb_gl *gl, GLuint program,
                                        const struct gb_camera *camera, int width,
                                        int height)
{
    gl->Uniform4fv(gl->GetUniformLocation(program, "projection"), 1, camera->projection);
    gl->Uniform2fv(gl->GetUniformLocation(program, "depth_range"), 1,
                   camera->depth_range);
    gl->UniformMatrix3fv(gl->GetUniformLocation(program, "rotation"), 1, GL_FALSE,
                         camera->rotation);
    gb_gl_uniform_vector(gl, program, "translation", camera->translation);
    gl->Uniform2f(gl->GetUniformLocation(program, "size"), (float)width, (float)height);
}

/* The planes of the cut in the coordinates of a camera. */
static inline void gb_gl_uniform_cuts(const struct gb_gl *gl, GLuint program,
                                      const struct gb_scene *scene,
                                      const struct gb_camera *camera)
{
    const float *m = camera->rotation;
    const float *t = camera->translation;
    float cut[3][4] = {{0.0F}};
    for (int i = 0; i < scene->cuts; i++) {
        const float *n = scene->cut[i];
        for (int k = 0; k < 3; k++) {
            cut[i][k] = m[k] * n[0] + m[3 + k] * n[1] + m[6 + k] * n[2];
        }
        cut[i][3] = n[3] + gb_gl_pass_dot(cut[i], t);
    }
    gl->Uniform1i(gl->GetUniformLocation(program, "cuts"), scene->cuts);
    gl->Uniform4fv(gl->GetUniformLocation(program, "cut"), 3, &cut[0][0]);
}

#endif
