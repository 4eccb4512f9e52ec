#ifndef GB_DRAW_GL_GL_UNIFORM_H
#define GB_DRAW_GL_GL_UNIFORM_H

/* Uniform variables of a GL program, by name. */

#include "draw/gl/gl_pass.h"

static inline void gb_gl_uniform_float(GLuint program, const char *name, float x)
{
    glUniform1f(glGetUniformLocation(program, name), x);
}

static inline void gb_gl_uniform_vector(GLuint program, const char *name, const float *x)
{
    glUniform3fv(glGetUniformLocation(program, name), 1, x);
}

static inline void gb_gl_uniform_sampler(GLuint program, const char *name,
                                         enum gb_gl_texture unit)
{
    glUniform1i(glGetUniformLocation(program, name), (GLint)unit);
}

static inline void gb_gl_uniform_camera(GLuint program, const struct gb_camera *camera,
                                        int width, int height)
{
    glUniform4fv(glGetUniformLocation(program, "projection"), 1, camera->projection);
    glUniform2fv(glGetUniformLocation(program, "depth_range"), 1, camera->depth_range);
    glUniformMatrix3fv(glGetUniformLocation(program, "rotation"), 1, GL_FALSE,
                       camera->rotation);
    gb_gl_uniform_vector(program, "translation", camera->translation);
    glUniform2f(glGetUniformLocation(program, "size"), (float)width, (float)height);
}

#endif
