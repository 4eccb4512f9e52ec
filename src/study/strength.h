#ifndef GB_STUDY_STRENGTH_H
#define GB_STUDY_STRENGTH_H

#include <glib.h>
#include <stdbool.h>

#include "base/listing.h"
#include "greenbody/params.h"
#include "many/pool.h"
#include "measure/average.h"
#include "measure/distribution.h"
#include "scene/field/keep_points.h"
#include "study/cells.h"

/* Tests of a compact without stress on it. */
enum gb_strength_test {
    GB_STRENGTH_TENSION,     /* z is stretched, p_x = p_y = 0 */
    GB_STRENGTH_COMPRESSION, /* z is compressed, p_x = p_y = 0 */
    GB_STRENGTH_SHEAR,       /* simple shear xz, p_z = 0 */
    GB_STRENGTH_TESTS
};

struct gb_strength_test_row {
    const char *name;
    const char *leg; /* with the largest strain in per cent */
    double sense;    /* of the stress that is the strength */
    int component;   /* of strain: zz or xz, in the order of struct gb_point */
};

extern const struct gb_strength_test_row gb_strength_tests[GB_STRENGTH_TESTS];

struct gb_strength_options {
    struct gb_keep_points marks; /* pressing pressures or densities */
    int replicas;
    double step;        /* strain step of a test */
    double strain_most; /* at which a test ends */
    double
        fall; /* a test has passed its peak when the stress is below this share of it */
    double tolerance; /* numerics.tolerance of unloading and tests */
};

void gb_strength_options_init(struct gb_strength_options *options);

/* What one cell says in one test. */
struct gb_strength_broken {
    double density;          /* without stress */
    double strength, strain; /* largest stress, Pa, and where it is */
    double at_peak, at_end;  /* share of the bridges that are broken */
};

/* Presses a compact of params to a mark, takes its stresses away and breaks copies.
 *
 * rows  NULL, or an empty listing that receives columns and a row per recorded point, as PATH.csv below
 * Errors: those of gb_compact_press and gb_compact_unload. */
bool gb_strength_measure(struct gb_strength_broken test[GB_STRENGTH_TESTS],
                         const struct gb_params *params, const struct gb_keep_point *mark,
                         const struct gb_strength_options *options,
                         struct gb_listing *rows,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err);

/* What one test says of the compacts of one mark; standard errors over the cells. */
struct gb_strength_result {
    struct gb_keep_point mark;
    enum gb_strength_test test;
    int cells;
    double density;                        /* without stress */
    double strength_pa, strength_error_pa; /* largest stress */
    double strain, strain_error;           /* at it */
    double broken_at_peak, broken_at_end;  /* fraction of the bridges; NaN without any */
    double broken_at_peak_error, broken_at_end_error;
    struct gb_weibull weibull; /* of the strengths, Pa; NaN: fewer than 3 */
};

struct gb_strength_study {
    struct gb_strength_options options;
    GArray *result;            /* of struct gb_strength_result: marks x tests */
    struct gb_listing *curves; /* all stress-strain curves */
    size_t failed;             /* cells without an answer; `why` says it of the first */
    struct gb_error why;
};

/* As gb_yield_run, for strengths. */
bool gb_strength_run(struct gb_strength_study *study, const struct gb_params *preset,
                     const struct gb_strength_options *options, const char *directory,
                     int jobs, const struct gb_cells_callbacks *callbacks,
                     struct gb_error *err);
void gb_strength_finish(struct gb_strength_study *study); /* zeroed is fine */

/* The tables strength.csv, strength_curves.csv, and a page beside them. */
bool gb_strength_write(const struct gb_strength_study *study, const char *directory,
                       const char *title, const char *command, struct gb_error *err);

#endif
