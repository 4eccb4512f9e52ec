#ifndef GB_DRAW_PICTURE_STYLE_H
#define GB_DRAW_PICTURE_STYLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "io/state.h"

/* What a picture of a packing shows: which particles, in which colours, and the forces
 * between them. */
enum gb_picture_style_colour {
    GB_PICTURE_STYLE_COORDINATION,
    GB_PICTURE_STYLE_PRESSURE, /* of the contacts of each particle */
    GB_PICTURE_STYLE_BRIDGES,  /* how many each particle has */
    GB_PICTURE_STYLE_SIZE,
    GB_PICTURE_STYLE_DISPLACEMENT, /* since a state, without the strain of the cell */
    GB_PICTURE_STYLE_SIGN,         /* forces only: pressed or pulled */
    GB_PICTURE_STYLE_BRIDGED,      /* forces only: over a bridge or not */
};

enum gb_picture_style_show {
    GB_PICTURE_STYLE_PARTICLES,
    GB_PICTURE_STYLE_FORCES,
    GB_PICTURE_STYLE_BOTH
};

struct gb_picture_style_request {
    enum gb_picture_style_colour colour; /* of particles */
    enum gb_picture_style_colour force;  /* of forces: sign or bridged */
    enum gb_picture_style_show show;
    int slice_axis; /* 0, 1, 2: a slab of slice_width about slice_at of the edge; -1 */
    double slice_at, slice_width; /* share of the edge; d */
    int cut_axis; /* what lies beyond cut_at of this edge is left out; -1 */
    double cut_at;
    bool cut_corner;              /* the octant nearest to the usual viewer is left out */
    const struct gb_state *since; /* for the displacement */
    double low, high;             /* of the colours; equal: those of the state */
    double thickest_n;            /* force of the thickest rod; 0: that of the state */
};

/* All of the packing, coloured by coordination number. */
void gb_picture_style_init(struct gb_picture_style_request *request);

/* What a colour means, for the bar beside the picture. */
struct gb_picture_style_scale {
    const char *title; /* with its unit; NULL: no bar */
    bool whole;        /* numbers 0, 1, ..., high with a cell each */
    double low, high;  /* at the ends of the colours */
    bool below, above; /* there are values beyond the ends */
};

/* One kind of force: its name and colour. */
struct gb_picture_style_swatch {
    const char *name;
    uint8_t rgb[3];
};

struct gb_picture_style {
    size_t count;    /* particles of the state */
    uint8_t *colour; /* count x 3, sRGB */
    uint8_t *hidden; /* count; 1: not drawn */
    float shrink;    /* share of the radius that is drawn */
    struct gb_picture_style_scale scale;
    size_t rods;         /* halves of forces */
    float *rod;          /* rods x 7: both ends in cell axes, radius; d */
    uint8_t *rod_colour; /* rods x 3 */
    struct gb_picture_style_swatch swatch[2];
    int swatches;
    double thickest_n; /* force of the thickest rod, N */
};

/* Errors: GB_ERR_INPUT (a state of other particles to measure displacements from),
 * GB_ERR_MEMORY. */
bool gb_picture_style_create(struct gb_picture_style **out, const struct gb_state *state,
                             const struct gb_picture_style_request *request,
                             struct gb_error *err);
void gb_picture_style_destroy(struct gb_picture_style *dress); /* NULL is fine */

/* Mean pressure in each particle's share of the cell from its contacts, in Pa: the trace
 * of P1 (16), half of each contact to either particle.  Shares are as the particles'
 * volumes; weighed by them the values average to the pressure of the contacts. */
void gb_picture_style_pressure(const struct gb_state *state, double *pressure);

#endif
