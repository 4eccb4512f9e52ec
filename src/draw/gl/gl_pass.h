#ifndef GB_DRAW_GL_GL_PASS_H
#define GB_DRAW_GL_GL_PASS_H

/* One rendering of a scene with OpenGL; private to renderer.c and gl_*.c, the only files
 * that call GL. */

#include <stdint.h>

#include "draw/gl/camera.h"
#include "draw/gl/gl_functions.h"
#include "draw/image/image.h"
#include "draw/scene.h"

enum {
    GB_GL_SAMPLES = 2,   /* a side, of one pixel */
    GB_GL_SHADOW = 1024, /* side of the shadow map */
    GB_GL_TEXTURES = 8,
    GB_GL_PROGRAMS = 7,
    GB_GL_BUFFERS = 8,
    GB_GL_ARRAYS = 5
};

/* Range of the ambient occlusion, mean diameters. */
#define GB_GL_OCCLUSION_REACH 3.0F

enum gb_gl_program {
    GB_GL_PROGRAM_SPHERE,
    GB_GL_PROGRAM_ROD,
    GB_GL_PROGRAM_FACET,
    GB_GL_PROGRAM_EDGE,
    GB_GL_PROGRAM_SHADE,
    GB_GL_PROGRAM_RESOLVE,
    GB_GL_PROGRAM_WALL
};
enum gb_gl_texture {
    GB_GL_TEXTURE_SEEN,
    GB_GL_TEXTURE_DEPTH,
    GB_GL_TEXTURE_SHADOW,
    GB_GL_TEXTURE_SPHERES,
    GB_GL_TEXTURE_COLOURS,
    GB_GL_TEXTURE_SAMPLES,
    GB_GL_TEXTURE_RODS,
    GB_GL_TEXTURE_FACETS
};
enum gb_gl_buffer {
    GB_GL_BUFFER_SPHERES,
    GB_GL_BUFFER_COLOURS,
    GB_GL_BUFFER_INDICES,
    GB_GL_BUFFER_RIBBONS,
    GB_GL_BUFFER_RODS,
    GB_GL_BUFFER_ROD_INDICES,
    GB_GL_BUFFER_FACETS,
    GB_GL_BUFFER_WALLS
};
enum gb_gl_array {
    GB_GL_ARRAY_SPHERES,
    GB_GL_ARRAY_RIBBONS,
    GB_GL_ARRAY_RODS,
    GB_GL_ARRAY_FACETS,
    GB_GL_ARRAY_WALLS
};

/* Names of the GL objects, and the tile being rendered. */
struct gb_gl_pass {
    const struct gb_gl *gl;
    const GLuint *program; /* GB_GL_PROGRAMS */
    const struct gb_scene *scene;
    const struct gb_image *image;
    GLuint texture[GB_GL_TEXTURES];
    GLuint buffer[GB_GL_BUFFERS];
    GLuint frame[4]; /* seen, shadow, samples, pixels */
    GLuint pixels, array[GB_GL_ARRAYS];
    uint32_t *index;
    uint8_t *hidden; /* not visible to the viewer: spheres, then rods */
    uint8_t *unlit;  /* not reached by the light */
    struct gb_camera eye, light;
    int margin;              /* of a tile, samples */
    int x, y, width, height; /* tile, pixels */
    int most_width, most_height;
};

static inline float gb_gl_pass_dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Cameras of the viewer, for the tile, and of the light, for the whole scene. */
void gb_gl_cameras_set_eye(struct gb_gl_pass *pass);
void gb_gl_cameras_set_light(struct gb_gl_pass *pass);

/* Framebuffers of a tile; buffers with the particles of the scene; free releases both. */
void gb_gl_buffers_make_targets(struct gb_gl_pass *pass);
void gb_gl_buffers_make_inputs(struct gb_gl_pass *pass);
void gb_gl_buffers_free(struct gb_gl_pass *pass);

/* Depths seen from the light; indices and depths seen by the viewer.  width, height: of
 * the target, samples */
void gb_gl_parts_draw_shadow(struct gb_gl_pass *pass);
void gb_gl_parts_draw_visible(struct gb_gl_pass *pass, int width, int height);

/* Translucent walls over the colours of the samples. */
void gb_gl_walls_draw(struct gb_gl_pass *pass, int width, int height);

/* Colours of the samples; then the pixels of the tile into the image. */
void gb_gl_shading_draw(struct gb_gl_pass *pass, int width, int height);
void gb_gl_shading_read_pixels(struct gb_gl_pass *pass);

#endif
