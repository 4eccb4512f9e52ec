#ifndef GB_STUDY_STRENGTH_STRENGTH_CELL_H
#define GB_STUDY_STRENGTH_STRENGTH_CELL_H

#include <glib.h>

#include "many/pool.h"
#include "study/strength/strength_options.h"

/* What one cell says in one test. */
struct gb_strength_broken {
    double density;          /* without stress */
    double strength, strain; /* largest stress, Pa, and where it is */
    double at_peak, at_end;  /* share of the bridges that are broken */
};

/* A test without points, and one point more of it. */
struct gb_strength_broken gb_strength_cell_unbroken(void);
void gb_strength_cell_break(struct gb_strength_broken *test, double strain,
                            double stress_pa, double density, double broken);

/* Presses a compact of params to a mark, takes its stresses away and breaks copies.
 *
 * rows  NULL, or receives a header and a row per recorded point, as PATH.csv below
 * Errors: those of gb_compact_press and gb_compact_unload. */
bool gb_strength_cell_measure(struct gb_strength_broken test[GB_STRENGTH_TESTS],
                              const struct gb_params *params,
                              const struct gb_keep_point *mark,
                              const struct gb_strength_options *options, GString *rows,
                              const struct gb_pool_callbacks *callbacks,
                              struct gb_error *err);

/* One compact of one cell, as the work of a pool: pressed, all stresses taken away, and
 * broken in each test on a copy.
 *
 * path  of the cell without ending: PATH.ini is the question, PATH.csv receives a row per
 *       recorded point of each test: test, strain, stress in Pa, density of the compact,
 *       share of its bridges that are broken */
gb_pool_work gb_strength_cell_work;

#endif
