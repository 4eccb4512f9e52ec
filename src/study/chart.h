#ifndef GB_STUDY_CHART_H
#define GB_STUDY_CHART_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* One cell pressed with one set of numerical choices: a measurement of `greenbody chart`.
 * No files, no printing. */

enum { GB_CHART_PRESSURES = 4 };

/* The numbers that a chart compares.  Those that a scene has no use for are NaN (count:
 * never; relaxer: "verlet" in dynamic scenes). */
struct gb_chart_setting {
    char relaxer[24];
    int64_t count;
    double strain_step, tolerance; /* quasi-static; strain_step: relaxed at once */
    double cutoff;                 /* d */
    bool single;                   /* precision */
    double time_step;              /* T; NaN in dynamic scenes: by step_error */
    double step_error;
};

/* What params choose, "auto" resolved as a run would.  Errors: as of gb_model_init. */
bool gb_chart_setting_of(struct gb_chart_setting *choice, const struct gb_params *params,
                         struct gb_error *err);
/* Params with these choices; another count takes the shape of the cell along. */
void gb_chart_apply(struct gb_params *params, const struct gb_chart_setting *choice);
bool gb_chart_same(const struct gb_chart_setting *a, const struct gb_chart_setting *b);
/* "fire, step 0.1 %, tolerance 0.02, cutoff 1.37 d, single precision, 1000 particles".
 * Returns buffer. */
char *gb_chart_describe(const struct gb_chart_setting *choice, char *buffer, size_t size);

/* 32 or 64: of a number in its precision, as tables have it. */
static inline double gb_chart_bits(const struct gb_chart_setting *choice)
{
    return choice->single ? 32.0 : 64.0;
}

struct gb_chart_run {
    struct gb_chart_setting choice;
    uint64_t seed;
    bool failed;        /* stopped by a guard */
    double evaluations; /* of the forces while it was pressed */
    double cpu_s;       /* of the same, without the initial structure */
    double
        density[GB_CHART_PRESSURES]; /* where the pressure is first reached; NaN: not */
    double coordination[GB_CHART_PRESSURES];
};

/* Presses one cell without unloading, on one thread, to the highest of the pressures (Pa;
 * or to the density that ends the preset).  Polls cancelled (NULL is fine) with data and
 * the CPU seconds spent so far.
 * Errors: GB_ERR_CANCELLED, those of the engine; a guard is no error, it sets failed. */
bool gb_chart_press(struct gb_chart_run *run, const struct gb_params *scene,
                    const double *pressure_pa, int pressures,
                    bool (*cancelled)(void *data, double cpu_s), void *data,
                    struct gb_error *err);

/* CPU time of this thread. */
double gb_chart_cpu_s(void);

#endif
