#ifndef GB_TUI_PLOT_DIE_OUTLINE_H
#define GB_TUI_PLOT_DIE_OUTLINE_H

#include "greenbody/snapshot.h"

/* Camera of the view of a packing, and the walls of a die as lines. */
struct gb_die_outline_camera {
    double centre[3];          /* the view turns around it */
    double azimuth, elevation; /* of the viewer, rad */
    int rows, cols;
    double scale;       /* dots per diameter */
    double left, top;   /* dot of the centre */
    double front, back; /* depths of the box, d */
};

/* In the axes of the viewer, from the centre: right, depth, up.  Returns the depth behind the
 * plane through the axis that faces the viewer, whatever the elevation. */
double gb_die_outline_see(const struct gb_die_outline_camera *camera,
                          const double point[3], double seen[3]);
/* The same at azimuth 0: of what is round about the axis. */
void gb_die_outline_round(const struct gb_die_outline_camera *camera,
                          const double point[3], double seen[3]);

/* Side, floor, funnel and punch over the dots (sphere_shading.h). */
void gb_die_outline_draw(const struct gb_die_outline_camera *camera,
                         const struct gb_view_sample *sample, float *shade);

#endif
