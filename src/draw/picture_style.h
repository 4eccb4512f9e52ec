#ifndef GB_DRAW_PICTURE_STYLE_H
#define GB_DRAW_PICTURE_STYLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/image.h"
#include "greenbody/status.h"
#include "io/state.h"

/* Style of a picture of a packing: visible particles, their colours, and the forces between
 * them as rods. */
enum gb_picture_style_show {
    GB_PICTURE_STYLE_PARTICLES,
    GB_PICTURE_STYLE_FORCES,
    GB_PICTURE_STYLE_BOTH
};

struct gb_picture_colours_row;

/* What the user chooses. */
struct gb_picture_style_request {
    const struct gb_picture_colours_row *particles; /* quantity that colours particles */
    const struct gb_picture_colours_row *forces;    /* quantity that colours forces */
    enum gb_picture_style_show show;
    int slice_axis;     /* slab normal to axis 0, 1 or 2; -1: none */
    double slice_at;    /* middle of the slab, fraction of the edge */
    double slice_width; /* d */
    int cut_axis;       /* what is beyond cut_at of this edge is cut away; -1: none */
    double cut_at;      /* fraction of the edge */
    bool cut_corner;    /* cuts away the octant nearest to the viewer */
    const struct gb_state *since; /* origin of displacements */
    double low, high; /* ends of the colour scale in its unit; equal: see the next */
    bool ranged;      /* ends of the colour scale are given; else from the state */
    double range_si[2];
    const struct gb_image_map *map; /* colours of values; NULL: viridis */
    bool log;                       /* logarithmic scale */
    double max_force_n;             /* force of the thickest rod, N; 0: from the state */
};

/* All particles, coloured by coordination number. */
void gb_picture_style_init(struct gb_picture_style_request *request);

/* Scale of the colour bar. */
struct gb_picture_style_scale {
    const char *title; /* with its unit; NULL: no bar */
    bool whole;        /* one cell for each of low, low + 1, ..., high */
    double low, high;  /* values at the ends; equal: all particles have this value */
    bool log;          /* low and high are above 0 */
    bool below, above; /* values exist beyond the ends */
    const struct gb_image_map *map;
};

/* Legend entry of a class of forces. */
struct gb_picture_style_legend {
    const char *name;
    uint8_t rgb[3];
};

/* A particle behind the plane of a cut that reaches through it is drawn, its forces are not. */
enum gb_picture_style_hidden {
    GB_PICTURE_STYLE_SHOWN,
    GB_PICTURE_STYLE_HIDDEN,
    GB_PICTURE_STYLE_CUT
};

/* The style of one state. */
struct gb_picture_style {
    size_t count;       /* particles of the state */
    uint8_t *colour;    /* count x 3, sRGB */
    uint8_t *hidden;    /* count; enum gb_picture_style_hidden */
    int cuts;           /* half-spaces n x > c, whose common part is cut away */
    double cut[3][4];   /* n in cell axes, of length 1, and c; d */
    float radius_scale; /* drawn radius over particle radius */
    struct gb_picture_style_scale scale;
    size_t rods;         /* a contact across a periodic wall has two */
    float *rod;          /* rods x 7: both ends in cell axes, radius; d */
    uint8_t *rod_colour; /* rods x 3 */
    struct gb_picture_style_legend legend[2];
    int legend_count;
    double max_force_n; /* force of the thickest rod, N */
    bool forces_above;  /* larger forces exist */
};

/* Errors: GB_ERR_INPUT (displacements from a state of another run), GB_ERR_MEMORY. */
bool gb_picture_style_create(struct gb_picture_style **out, const struct gb_state *state,
                             const struct gb_picture_style_request *request,
                             struct gb_error *err);
void gb_picture_style_destroy(struct gb_picture_style *style); /* NULL is fine */

/* "coordination", "pressure", ... into colour or force; "particles", "forces", "both";
 * "z=0.5" or "z=0.5:3 d"; "corner" or "y=0.5".  Errors: GB_ERR_INPUT with what is
 * accepted. */
bool gb_picture_style_parse_colour(struct gb_picture_style_request *request,
                                   const char *text, struct gb_error *err);

bool gb_picture_style_parse_show(struct gb_picture_style_request *request,
                                 const char *text, struct gb_error *err);

bool gb_picture_style_parse_slice(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err);

/* "0:200MPa" of the quantity that colours particles, with its unit, or "0:50nN" of forces:
 * of the thickest rod.  After the colour. */
bool gb_picture_style_parse_range(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err);

bool gb_picture_style_parse_colormap(struct gb_picture_style_request *request,
                                     const char *text, struct gb_error *err);

/* Names of the scales of colours, separated by commas; g_free. */
char *gb_picture_style_parse_colormaps(void);

bool gb_picture_style_parse_cut(struct gb_picture_style_request *request,
                                const char *text, struct gb_error *err);

/* Radius of a rod, d, of a force over that of the thickest one. */
double gb_picture_style_rod_radius(double ratio);

#endif
