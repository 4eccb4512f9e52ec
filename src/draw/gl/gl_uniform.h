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

#endif
