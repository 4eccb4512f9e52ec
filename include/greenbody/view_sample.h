#ifndef GREENBODY_VIEW_SAMPLE_H
#define GREENBODY_VIEW_SAMPLE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GB_VIEW_SAMPLE_POINTS = 4096, GB_VIEW_SAMPLE_RDF = 160 };

/* Quantities of each particle. */
enum gb_view_value {
    GB_VIEW_VALUE_CONTACTS, /* coordination number */
    GB_VIEW_VALUE_PRESSURE, /* mean particle stress, MPa */
    GB_VIEW_VALUE_DISPLACEMENT, /* beside the affine one of a cell; in a die since pressing
                                   began, before that since the last sample; d */
    GB_VIEW_VALUES
};

/* Walls of a die; the axis is x = window[0]/2, y = 0, the floor z = 0.  d. */
struct gb_view_die {
    bool shown; /* false: a periodic cell */
    double radius;
    double top; /* of the block with the bore; of an endless one above the powder */
    bool gone;  /* the block is drawn off */
    bool funnel;
    double outlet;       /* radius of the funnel's opening, at `top` */
    double funnel_slope; /* radius gained per height above */
    bool punch;
    double punch_height;
};

/* Particles near the front of the cell and g(r), for the screen: plain data, taken less
 * often than the snapshot.  Lengths in mean particle diameters. */
struct gb_view_sample {
    bool valid;
    int dimension;
    double density;
    double edge[3];   /* of the whole cell */
    double window[3]; /* the part that is shown; its front is y = 0 */
    struct gb_view_die die;
    bool whole; /* of a die all particles are there, also those in front of the axis */
    int count;
    float position[GB_VIEW_SAMPLE_POINTS][3];
    float radius[GB_VIEW_SAMPLE_POINTS];
    float value[GB_VIEW_VALUES][GB_VIEW_SAMPLE_POINTS];
    double rdf_reach;               /* g(r) ends there; 0: it is missing */
    double rdf[GB_VIEW_SAMPLE_RDF]; /* bin k: [k, k+1) rdf_reach / GB_VIEW_SAMPLE_RDF */
};

#ifdef __cplusplus
}
#endif

#endif
