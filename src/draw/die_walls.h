#ifndef GB_DRAW_DIE_WALLS_H
#define GB_DRAW_DIE_WALLS_H

#include "draw/scene.h"

/* Bore, floor, funnel and upper punch of a die: translucent surfaces and their edges.  The
 * bore ends a little above the powder where it has no end there.  With a viewpoint of an
 * extent the view includes the punch above that box.  Errors: GB_ERR_MEMORY. */
bool gb_die_walls_set(struct gb_scene *scene, const struct gb_state *state,
                      const struct gb_viewpoint *viewpoint, struct gb_error *err);

/* Top of the punch that is drawn on a bed of a height, d. */
double gb_die_walls_punch_top(double radius, double height);

#endif
