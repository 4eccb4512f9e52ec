#ifndef GREENBODY_VIEW_SAMPLE_H
#define GREENBODY_VIEW_SAMPLE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GB_VIEW_SAMPLE_POINTS = 4096, GB_VIEW_SAMPLE_RDF = 160 };

/* Quantities of each particle. */
enum gb_view_value {
    GB_VIEW_VALUE_CONTACTS,     /* coordination number */
    GB_VIEW_VALUE_PRESSURE,     /* mean particle stress, MPa */
    GB_VIEW_VALUE_DISPLACEMENT, /* in d.  Cell: nonaffine.  Die: since pressing began, or
                                   before that since the last sample */
    GB_VIEW_VALUES
};

/* Walls of a die, in d.  The axis is x = window[0]/2, y = 0; the floor is z = 0. */
struct gb_view_die {
    bool shown; /* false: a periodic cell */
    double radius;
    double top; /* of the block with the bore; endless block: above the powder */
    bool gone;  /* the block is removed */
    bool funnel;
    double outlet;       /* radius of the opening of the funnel, at `top` */
    double funnel_slope; /* increase of the radius per height */
    bool punch;
    double punch_height;
};

/* Particles near the front of the cell, and g(r), for the screen: plain data, sampled
 * less often than the snapshot.  Lengths are in mean particle diameters. */
struct gb_view_sample {
    bool valid;
    int dimension;
    double density;
    double edge[3];   /* of the whole cell */
    double window[3]; /* the part that is shown; its front is y = 0 */
    struct gb_view_die die;
    bool whole; /* die: all particles, including the half in front of the axis */
    int count;
    float position[GB_VIEW_SAMPLE_POINTS][3];
    float radius[GB_VIEW_SAMPLE_POINTS];
    float value[GB_VIEW_VALUES][GB_VIEW_SAMPLE_POINTS];
    double rdf_reach;               /* largest r of g(r); 0: no g(r) */
    double rdf[GB_VIEW_SAMPLE_RDF]; /* bin k: [k, k+1) rdf_reach / GB_VIEW_SAMPLE_RDF */
};

#ifdef __cplusplus
}
#endif

#endif
