#ifndef GB_STUDY_YIELD_YIELD_OPTIONS_H
#define GB_STUDY_YIELD_YIELD_OPTIONS_H

#include <glib.h>
#include <stdbool.h>

#include "measure/yield_point.h"
#include "scene/field/keep_points.h"

/* Offsets at which points are reported, in units of the chosen one. */
enum { GB_YIELD_OFFSETS = 3, GB_YIELD_OFFSET_CHOSEN = 1 };
extern const double gb_yield_options_offset[GB_YIELD_OFFSETS];

enum { GB_YIELD_DIRECTIONS_MAX = 72, GB_YIELD_REPLICAS_MAX = 1000 };

struct gb_yield_options {
    struct gb_keep_points marks; /* the compacts: densities or pressing pressures */
    int replicas;                /* cells, from structure.seed on */
    int directions;              /* evenly spaced from +p on; a multiple of 4 */
    double inside;      /* pressure at which probes begin, over that of the compact */
    double offset;      /* of plastic strain */
    double step;        /* strain step of a probe */
    double strain_most; /* at which a probe is given up */
    double tolerance;   /* numerics.tolerance of unloading and probes */
};

void gb_yield_options_init(struct gb_yield_options *options);
/* Errors: GB_ERR_INPUT naming the option and what is accepted. */
bool gb_yield_options_check(const struct gb_yield_options *options, struct gb_error *err);
double gb_yield_options_direction(const struct gb_yield_options *options, int index);

/* For the question of a cell (study/compact/cells.h) and back. */
void gb_yield_options_write(const struct gb_yield_options *options,
                            const struct gb_keep_point *mark, GString *text);
void gb_yield_options_read(struct gb_yield_options *options, struct gb_keep_point *mark,
                           GKeyFile *question);

#endif
