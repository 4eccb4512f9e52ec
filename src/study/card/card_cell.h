#ifndef GB_STUDY_CARD_CARD_CELL_H
#define GB_STUDY_CARD_CARD_CELL_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "many/pool.h"
#include "measure/yield_point.h"
#include "study/card/card_options.h"
#include "study/compact/compact.h"

/* What one cell (replica) gives a card: compacts pressed to a list of densities, the yield
 * points of each, their elastic constants, and the curves of pressing the same powder along
 * each path. */

/* The compact of one density. */
struct gb_card_level {
    double density;
    double p_pa, q_pa;          /* at which it was pressed */
    double inside_pa;           /* mean pressure at which its probes begin */
    double bulk, shear_modulus; /* K and G there, Pa */
};

struct gb_card_pressed {
    double density, px_pa, pz_pa; /* px: mean of x and y */
};

struct gb_card_cell {
    struct gb_card_level level[GB_CARD_LEVELS_MAX];
    GArray *point; /* of struct gb_yield_point: density as in the options */
    GArray *curve[GB_CARD_PATHS]; /* of struct gb_card_pressed, density ascending */
};

/* gb_card_cell_finish is due, also after an error.  A probe that a guard stops, or that does
 * not reach the offset, leaves no point.  Errors: GB_ERR_GUARD when pressing ends early. */
bool gb_card_cell_measure(struct gb_card_cell *cell, const struct gb_params *preset,
                          int replica, const struct gb_card_options *options,
                          const struct gb_pool_callbacks *callbacks,
                          struct gb_error *err);
void gb_card_cell_finish(struct gb_card_cell *cell); /* zeroed is fine */

/* Fills densities, evenly spaced between those at 1/20 of and at pressure_pa, from the
 * pressing of the first cell. */
bool gb_card_cell_scout(struct gb_card_options *options, const struct gb_params *preset,
                        int levels, const struct gb_pool_callbacks *callbacks,
                        struct gb_error *err);

#endif
