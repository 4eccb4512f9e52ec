/* Translucent walls over the shaded samples. */
#include <math.h>

#include "draw/gl/gl_pass.h"
#include "draw/gl/gl_uniform.h"

enum { NUMBERS = GB_SCENE_WALL_NUMBERS / 3 };

/* Linear light of the walls, steel: on a light ground, on a dark one. */
static const float steel[2][3] = {{0.16F, 0.20F, 0.25F}, {0.45F, 0.52F, 0.60F}};

static void bind(const struct gb_gl_pass *pass)
{
    static const GLint size[3] = {3, 3, 1};
    const GLsizei stride = NUMBERS * (GLsizei)sizeof(float);
    const GLsizeiptr bytes = (GLsizeiptr)(3 * pass->scene->walls) * stride;
    pass->gl->BindVertexArray(pass->array[GB_GL_ARRAY_WALLS]);
    pass->gl->BindBuffer(GL_ARRAY_BUFFER, pass->buffer[GB_GL_BUFFER_WALLS]);
    pass->gl->BufferData(GL_ARRAY_BUFFER, bytes, pass->scene->wall, GL_STREAM_DRAW);
    for (GLuint k = 0, first = 0; k < 3; first += (GLuint)size[k++]) {
        pass->gl->VertexAttribPointer(k, size[k], GL_FLOAT, GL_FALSE, stride,
                                      (const void *)(first * sizeof(float)));
        pass->gl->EnableVertexAttribArray(k);
    }
}

void gb_gl_walls_draw(struct gb_gl_pass *pass, int width, int height)
{
    const GLuint program = pass->program[GB_GL_PROGRAM_WALL];
    const bool dark = pass->scene->background == GB_BACKGROUND_DARK;
    if (pass->scene->walls == 0) {
        return;
    }
    pass->gl->BindFramebuffer(GL_FRAMEBUFFER, pass->frame[2]);
    pass->gl->UseProgram(program);
    gb_gl_uniform_camera(pass->gl, program, &pass->eye, width, height);
    gb_gl_uniform_cuts(pass->gl, program, pass->scene, &pass->eye);
    gb_gl_uniform_sampler(pass->gl, program, "depths", GB_GL_TEXTURE_DEPTH);
    gb_gl_uniform_vector(pass->gl, program, "tint", steel[dark ? 1 : 0]);
    bind(pass);
    pass->gl->Enable(GL_BLEND);
    pass->gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    pass->gl->DrawArrays(GL_TRIANGLES, 0, 3 * (GLsizei)pass->scene->walls);
    pass->gl->Disable(GL_BLEND);
}
