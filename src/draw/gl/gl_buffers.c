/* Framebuffers, textures and vertex arrays of a rendering. */
#include "draw/gl/gl_pass.h"

static void new_texture(struct gb_gl_pass *pass, enum gb_gl_texture unit, GLint internal,
                        GLenum format, GLenum type, int width, int height)
{
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, pass->texture[unit]);
    glTexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, type, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void attach(GLuint frame, GLenum attachment, GLuint texture)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
}

void gb_gl_buffers_make_targets(struct gb_gl_pass *pass)
{
    const int width = GB_GL_SAMPLES * pass->most_width + 2 * pass->margin;
    const int height = GB_GL_SAMPLES * pass->most_height + 2 * pass->margin;
    glGenTextures(GB_GL_TEXTURES, pass->texture);
    glGenFramebuffers(4, pass->frame);
    new_texture(pass, GB_GL_TEXTURE_SEEN, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                width, height);
    new_texture(pass, GB_GL_TEXTURE_DEPTH, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT,
                GL_FLOAT, width, height);
    new_texture(pass, GB_GL_TEXTURE_SHADOW, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT,
                GL_FLOAT, GB_GL_SHADOW, GB_GL_SHADOW);
    new_texture(pass, GB_GL_TEXTURE_SAMPLES, GL_RGBA16F, GL_RGBA, GL_FLOAT, width,
                height);
    attach(pass->frame[0], GL_COLOR_ATTACHMENT0, pass->texture[GB_GL_TEXTURE_SEEN]);
    attach(pass->frame[0], GL_DEPTH_ATTACHMENT, pass->texture[GB_GL_TEXTURE_DEPTH]);
    attach(pass->frame[1], GL_DEPTH_ATTACHMENT, pass->texture[GB_GL_TEXTURE_SHADOW]);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    attach(pass->frame[2], GL_COLOR_ATTACHMENT0, pass->texture[GB_GL_TEXTURE_SAMPLES]);
    glGenRenderbuffers(1, &pass->pixels);
    glBindRenderbuffer(GL_RENDERBUFFER, pass->pixels);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, pass->most_width, pass->most_height);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              pass->pixels);
}

static void make_table(struct gb_gl_pass *pass, int which, enum gb_gl_texture unit,
                       GLenum format, const void *data, size_t size)
{
    glBindBuffer(GL_TEXTURE_BUFFER, pass->buffer[which]);
    glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_BUFFER, pass->texture[unit]);
    glTexBuffer(GL_TEXTURE_BUFFER, format, pass->buffer[which]);
}

/* One number per instance. */
static void bind_indices(const struct gb_gl_pass *pass, enum gb_gl_array array,
                         enum gb_gl_buffer buffer)
{
    glBindVertexArray(pass->array[array]);
    glBindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    glVertexAttribIPointer(0, 1, GL_UNSIGNED_INT, 0, NULL);
    glVertexAttribDivisor(0, 1);
    glEnableVertexAttribArray(0);
}

/* One position per vertex. */
static void bind_positions(const struct gb_gl_pass *pass, enum gb_gl_array array,
                           enum gb_gl_buffer buffer)
{
    glBindVertexArray(pass->array[array]);
    glBindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(0);
}

void gb_gl_buffers_make_inputs(struct gb_gl_pass *pass)
{
    const struct gb_scene *scene = pass->scene;
    const size_t parts = scene->count + scene->rods + scene->facets;
    glGenBuffers(GB_GL_BUFFERS, pass->buffer);
    glGenVertexArrays(GB_GL_ARRAYS, pass->array);
    make_table(pass, GB_GL_BUFFER_SPHERES, GB_GL_TEXTURE_SPHERES, GL_RGBA32F,
               scene->sphere, 16 * (scene->count + 1));
    make_table(pass, GB_GL_BUFFER_COLOURS, GB_GL_TEXTURE_COLOURS, GL_RGBA8, scene->colour,
               4 * (parts + 1));
    make_table(pass, GB_GL_BUFFER_RODS, GB_GL_TEXTURE_RODS, GL_RGBA32F, scene->rod,
               32 * (scene->rods + 1));
    make_table(pass, GB_GL_BUFFER_FACETS, GB_GL_TEXTURE_FACETS, GL_RGB32F, scene->facet,
               36 * (scene->facets + 1));
    bind_indices(pass, GB_GL_ARRAY_SPHERES, GB_GL_BUFFER_INDICES);
    bind_indices(pass, GB_GL_ARRAY_RODS, GB_GL_BUFFER_ROD_INDICES);
    bind_positions(pass, GB_GL_ARRAY_RIBBONS, GB_GL_BUFFER_RIBBONS);
    bind_positions(pass, GB_GL_ARRAY_FACETS, GB_GL_BUFFER_FACETS);
}

void gb_gl_buffers_free(struct gb_gl_pass *pass)
{
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteVertexArrays(GB_GL_ARRAYS, pass->array);
    glDeleteBuffers(GB_GL_BUFFERS, pass->buffer);
    glDeleteRenderbuffers(1, &pass->pixels);
    glDeleteFramebuffers(4, pass->frame);
    glDeleteTextures(GB_GL_TEXTURES, pass->texture);
}
