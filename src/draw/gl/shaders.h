#ifndef GB_DRAW_GL_SHADERS_H
#define GB_DRAW_GL_SHADERS_H

/* GLSL of the pictures, in three passes: visibility (index and depth of spheres, rods,
 * facets and box edges, once from the eye and once from the light), shading of every
 * sample from these with translucent walls over it, mean of the samples of each pixel. */
struct gb_shaders_text {
    const char *vertex, *fragment;
    const char *more; /* second part of the fragment shader; "": none */
};

/* projection: pixel of the axis, focal length in samples, 1 when orthographic.
 * depth_range: depth of 0 and of 1 in the depth buffer, which is linear. */
#define GB_SHADERS_CAMERA "uniform vec4 projection;\nuniform vec2 depth_range;\n"
/* Half-spaces n p > c: normal and c. */
#define GB_SHADERS_CUTS "uniform int cuts;\nuniform vec4 cut[3];\n"

extern const struct gb_shaders_text gb_shaders_sphere;
extern const struct gb_shaders_text gb_shaders_rod;
extern const struct gb_shaders_text gb_shaders_facet;
extern const struct gb_shaders_text gb_shaders_edge;
extern const struct gb_shaders_text gb_shaders_shade;
extern const struct gb_shaders_text gb_shaders_resolve;
extern const struct gb_shaders_text gb_shaders_wall;

#endif
