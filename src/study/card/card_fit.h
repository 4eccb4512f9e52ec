#ifndef GB_STUDY_CARD_CARD_FIT_H
#define GB_STUDY_CARD_CARD_FIT_H

#include "study/card/card_study.h"

/* From cells to a card. */

/* Means over the cells but `without` (-1: all): a point per level and direction that half of
 * them reached.  Standard errors of p and q; replica 0.  Returns their number. */
size_t gb_card_fit_points(const struct gb_card_cell *cells, int count, int without,
                          const struct gb_card_options *options,
                          struct gb_yield_point *points);

/* The card of the cells but `without`.  points: of gb_card_fit_points. */
bool gb_card_fit_values(struct gb_card_values *card, const struct gb_card_cell *cells,
                        int count, int without, const struct gb_card_options *options,
                        const struct gb_yield_point *points, size_t size,
                        struct gb_error *err);

/* p_x/p_z and p_z (Pa) of pressing the unloaded first compact along a path, at densities
 * that ascend; NaN below its start. */
bool gb_card_fit_predict(const struct gb_card_values *card, int levels, double transition,
                         enum gb_card_path path, const double *density, size_t size,
                         double *ratio, double *pz, struct gb_error *err);

/* The card as a material.  rows: room for GB_CARD_LEVELS_MAX. */
struct gb_cap_material gb_card_fit_material(const struct gb_card_values *card, int levels,
                                            double transition, struct gb_cap_row *rows);

#endif
