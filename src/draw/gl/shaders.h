#ifndef GB_DRAW_GL_SHADERS_H
#define GB_DRAW_GL_SHADERS_H

/* GLSL of the pictures, in three passes: visibility (index and depth of spheres, rods,
 * facets and box edges, once from the eye and once from the light), shading of every
 * sample from these, mean of the samples of each pixel. */
struct gb_shaders_text {
    const char *vertex, *fragment;
    const char *more; /* second part of the fragment shader; "": none */
};

extern const struct gb_shaders_text gb_shaders_sphere;
extern const struct gb_shaders_text gb_shaders_rod;
extern const struct gb_shaders_text gb_shaders_facet;
extern const struct gb_shaders_text gb_shaders_edge;
extern const struct gb_shaders_text gb_shaders_shade;
extern const struct gb_shaders_text gb_shaders_resolve;

#endif
