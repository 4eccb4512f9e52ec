#ifndef GB_STUDY_CARD_CARD_PROBE_H
#define GB_STUDY_CARD_CARD_PROBE_H

#include <glib.h>
#include <stdbool.h>

#include "study/card/card_cell.h"

/* Probes of a compact by strain: each copy is strained in one direction from inside the
 * yield surface, with p_x and p_y alike on average over the cells.  Strains, unlike
 * stresses, can be prescribed beyond the strength, too. */
struct gb_card_probe {
    double direction; /* aimed at, rad in (p, q) */
    GArray *state;    /* of struct gb_compact_state, from the inside state on */
};

/* Strains along the direction of stress that K and G (Pa) translate; goes to
 * options->strain_most, or until `enough` plastic strain is there.  gb_card_probe_finish is
 * due.  A guard that stops it is no error: the states up to there count. */
bool gb_card_probe_run(struct gb_card_probe *probe, struct gb_compact *inside,
                       double direction, double bulk, double shear_modulus,
                       const struct gb_card_options *options,
                       const struct gb_pool_callbacks *callbacks, struct gb_error *err);
void gb_card_probe_finish(struct gb_card_probe *probe); /* zeroed is fine */

/* K and G of the first steps of probes, least squares through their beginnings, Pa. */
void gb_card_probe_moduli(const struct gb_card_probe *probe, int count, double *bulk,
                          double *shear_modulus);

/* Where the plastic strain, total less elastic, first reaches the offset: the larger of
 * |volume| and |shear|, linear between the states.  The flow is what it grows by from half
 * of the offset on.  False: it is not reached. */
bool gb_card_probe_point(const struct gb_card_probe *probe, double bulk,
                         double shear_modulus, double offset,
                         struct gb_yield_point *point);

#endif
