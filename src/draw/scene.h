#ifndef GB_DRAW_SCENE_H
#define GB_DRAW_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/picture_style.h"
#include "draw/view.h"
#include "greenbody/status.h"
#include "io/state.h"

enum gb_background { GB_BACKGROUND_WHITE, GB_BACKGROUND_DARK, GB_BACKGROUND_TRANSPARENT };

/* A box has 12 edges; the outline of a die is up to four rings of chords and six lines. */
enum { GB_SCENE_RING = 48, GB_SCENE_EDGES = 4 * GB_SCENE_RING + 6 };
/* Numbers of a triangle of a wall: position, normal and opacity of its corners. */
enum { GB_SCENE_WALL_NUMBERS = 21, GB_SCENE_ARROWS = 2 };

/* Geometry and colours of a picture, in eye coordinates; no GL, no files. */
struct gb_scene {
    struct gb_view view;
    size_t count;
    float *sphere; /* count x 4: x, y, depth, radius */
    size_t rods;
    float *rod; /* rods x 8: one end and radius, other end and 0 */
    size_t facets;
    float *facet;    /* facets x 9: the corners of a closed surface's triangles */
    uint8_t *colour; /* of spheres, rods, facets x 4: sRGB and 255 */
    int edge_count;
    float edge[GB_SCENE_EDGES][6]; /* both ends of the edges of box or die */
    size_t walls;
    float
        *wall; /* walls x GB_SCENE_WALL_NUMBERS: translucent triangles, far ones first */
    int arrows, frame_arrows;
    float arrow[GB_SCENE_ARROWS][6];       /* of pressing: tail and tip */
    float frame_arrow[GB_SCENE_ARROWS][6]; /* those that the frame has room for */
    int cuts;        /* half-spaces n p > c, whose common part of spheres is cut away */
    float cut[3][4]; /* n and c, eye coordinates */
    float diameter;  /* 1 d: length of occlusion and shadows */
    float light[3];  /* towards the key light, eye coordinates */
    enum gb_background background;
    float depth_cue;    /* share of the background colour in the farthest edges */
    float shadow_share; /* 0: no shadows */
};

/* Scene of a packing in its periodic box or in its die, in a style.  What is drawn fills
 * the frame, or the box of the viewpoint's extent does.  2D packings are always seen along y without perspective.  style NULL:
 * all particles by coordination number. */
bool gb_scene_create(struct gb_scene **out, const struct gb_state *state,
                     const struct gb_picture_style *style,
                     const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                     enum gb_background background, struct gb_error *err);

/* An empty scene of a box: camera and light are set, and there is room for parts[0]
 * spheres, parts[1] rods and parts[2] facets. */
bool gb_scene_begin(struct gb_scene **out, const double cell[3], double margin,
                    const size_t parts[3], const struct gb_viewpoint *viewpoint,
                    const struct gb_frame *frame, enum gb_background background,
                    struct gb_error *err);
void gb_scene_destroy(struct gb_scene *scene); /* NULL is fine */

/* sRGB of the background, and of text and lines on it. */
void gb_scene_background(enum gb_background background, uint8_t rgb[3]);
void gb_scene_foreground(enum gb_background background, uint8_t rgb[3]);

void gb_scene_include_arrows(struct gb_scene *scene);

#endif
