#ifndef GB_STUDY_STRENGTH_STRENGTH_STUDY_H
#define GB_STUDY_STRENGTH_STRENGTH_STUDY_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/params.h"
#include "measure/fit/average.h"
#include "measure/fit/weibull.h"
#include "study/compact/cells.h"
#include "study/strength/strength_options.h"

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
    GArray *result;  /* of struct gb_strength_result: marks x tests */
    GString *curves; /* CSV of all stress-strain curves */
    size_t failed;   /* cells without an answer; `why` says it of the first */
    struct gb_error why;
};

/* As gb_yield_study_run, for strengths. */
bool gb_strength_study_run(struct gb_strength_study *study,
                           const struct gb_params *preset,
                           const struct gb_strength_options *options,
                           const char *directory, int jobs,
                           const struct gb_cells_callbacks *callbacks,
                           struct gb_error *err);
void gb_strength_study_finish(struct gb_strength_study *study); /* zeroed is fine */

/* The tables strength.csv, strength_curves.csv, and a page beside them. */
bool gb_strength_study_write(const struct gb_strength_study *study, const char *directory,
                             const char *title, const char *command,
                             struct gb_error *err);

#endif
