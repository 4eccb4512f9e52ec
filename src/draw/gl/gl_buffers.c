/* Framebuffers, textures and vertex arrays of a rendering. */
#include "draw/gl/gl_pass.h"

static void new_texture(struct gb_gl_pass *pass, enum gb_gl_texture unit, GLint internal,
                        GLenum format, GLenum type, int width, int height)
{
    pass->gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    pass->gl->BindTexture(GL_TEXTURE_2D, pass->texture[unit]);
    pass->gl->TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, type,
                         NULL);
    pass->gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    pass->gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void attach(const struct gb_gl_pass *pass, GLuint frame, GLenum attachment,
                   GLuint texture)
{
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
    pass->gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
}

void gb_gl_buffers_make_targets(struct gb_gl_pass *pass)
{
    const int width = GB_GL_SAMPLES * pass->most_width + 2 * pass->margin;
    const int height = GB_GL_SAMPLES * pass->most_height + 2 * pass->margin;
    pass->gl->GenTextures(GB_GL_TEXTURES, pass->texture);
    pass->gl->GenFramebuffers(4, pass->frame);
    new_texture(pass, GB_GL_TEXTURE_SEEN, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                width, height);
    new_texture(pass, GB_GL_TEXTURE_DEPTH, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT,
                GL_FLOAT, width, height);
    new_texture(pass, GB_GL_TEXTURE_SHADOW, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT,
                GL_FLOAT, GB_GL_SHADOW, GB_GL_SHADOW);
    new_texture(pass, GB_GL_TEXTURE_SAMPLES, GL_RGBA16F, GL_RGBA, GL_FLOAT, width,
                height);
    attach(pass, pass->frame[0], GL_COLOR_ATTACHMENT0, pass->texture[GB_GL_TEXTURE_SEEN]);
    attach(pass, pass->frame[0], GL_DEPTH_ATTACHMENT, pass->texture[GB_GL_TEXTURE_DEPTH]);
    attach(pass, pass->frame[1], GL_DEPTH_ATTACHMENT,
           pass->texture[GB_GL_TEXTURE_SHADOW]);
    pass->gl->DrawBuffer(GL_NONE);
    pass->gl->ReadBuffer(GL_NONE);
    attach(pass, pass->frame[2], GL_COLOR_ATTACHMENT0,
           pass->texture[GB_GL_TEXTURE_SAMPLES]);
    pass->gl->GenRenderbuffers(1, &pass->pixels);
    pass->gl->BindRenderbuffer(GL_RENDERBUFFER, pass->pixels);
    pass->gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, pass->most_width,
                                  pass->most_height);
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[3]);
    pass->gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                      GL_RENDERBUFFER, pass->pixels);
}

static void make_table(struct gb_gl_pass *pass, int which, enum gb_gl_texture unit,
                       GLenum format, const void *data, size_t size)
{
    pass->gl->BindBuffer(GL_TEXTURE_BUFFER, pass->buffer[which]);
    pass->gl->BufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    pass->gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    pass->gl->BindTexture(GL_TEXTURE_BUFFER, pass->texture[unit]);
    pass->gl->TexBuffer(GL_TEXTURE_BUFFER, format, pass->buffer[which]);
}

/* One number per instance. */
static void bind_indices(const struct gb_gl_pass *pass, enum gb_gl_array array,
                         enum gb_gl_buffer buffer)
{
    pass->gl->BindVertexArray(pass->array[array]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    pass->gl->VertexAttribIPointer(0, 1, GL_UNSIGNED_INT, 0, NULL);
    pass->gl->VertexAttribDivisor(0, 1);
    pass->gl->EnableVertexAttribArray(0);
}

/* One position per vertex. */
static void bind_positions(const struct gb_gl_pass *pass, enum gb_gl_array array,
                           enum gb_gl_buffer buffer)
{
    pass->gl->BindVertexArray(pass->array[array]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[buffer]);
    pass->gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    pass->gl->EnableVertexAttribArray(0);
}

void gb_gl_buffers_make_inputs(struct gb_gl_pass *pass)
{
    const struct gb_scene *scene = pass->scene;
    const size_t parts = scene->count + scene->rods + scene->facets;
    pass->gl->GenBuffers(GB_GL_BUFFERS, pass->buffer);
    pass->gl->GenVertexArrays(GB_GL_ARRAYS, pass->array);
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
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    pass->gl->DeleteVertexArrays(GB_GL_ARRAYS, pass->array);
    pass->gl->DeleteBuffers(GB_GL_BUFFERS, pass->buffer);
    pass->gl->DeleteRenderbuffers(1, &pass->pixels);
    pass->gl->DeleteFramebuffers(4, pass->frame);
    pass->gl->DeleteTextures(GB_GL_TEXTURES, pass->texture);
}
