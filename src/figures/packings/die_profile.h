#ifndef GB_FIGURES_PACKINGS_DIE_PROFILE_H
#define GB_FIGURES_PACKINGS_DIE_PROFILE_H

#include "io/state/state.h"
#include "measure/density_map.h"

/* Measures of a state in a die over height and radius. */

/* Errors: GB_ERR_INPUT unless the state is of a die. */
bool gb_die_profile_check(const struct gb_state *state, const char *figure,
                          struct gb_error *err);

/* Density over rings of the bore and bands of the height of the powder, or of what the
 * punch leaves; values as of gb_density_map_fill. */
struct gb_density_map gb_die_profile_density(const struct gb_state *state, int rings,
                                             int bands, double *density);

/* Mean radial pressure on the wall in bands of the powder's height, MPa; NaN where the
 * open end of the bore lies below.  False when the state has no contacts with walls. */
bool gb_die_profile_wall(const struct gb_state *state, int bands, double *pressure);

#endif
