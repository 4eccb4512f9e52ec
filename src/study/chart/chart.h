#ifndef GB_STUDY_CHART_CHART_H
#define GB_STUDY_CHART_CHART_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* One cell simulated with one setting of the numerics: a measurement of `greenbody chart`.
 */

enum { GB_CHART_PRESSURES = 4 };

/* The numerical parameters that a chart compares; NaN for those that a scene does not use.
 * The relaxer of dynamic scenes is "verlet". */
struct gb_chart_setting {
    char relaxer[24];
    int64_t count;
    double strain_step, tolerance; /* quasi-static; strain_step: without parts */
    double cutoff;                 /* d */
    bool single;                   /* precision */
    double time_step;              /* T; NaN in dynamic scenes: by step_error */
    double step_error;
};

/* The setting of params, with "auto" resolved as in a run.  Errors: as of gb_model_init.
 */
bool gb_chart_setting_of(struct gb_chart_setting *setting, const struct gb_params *params,
                         struct gb_error *err);
/* Gives params the setting; with another count the cell keeps its shape. */
void gb_chart_apply(struct gb_params *params, const struct gb_chart_setting *setting);
bool gb_chart_same(const struct gb_chart_setting *a, const struct gb_chart_setting *b);
/* "fire, step 0.1 %, tolerance 0.02, cutoff 1.37 d, single precision, 1000 particles".
 * Returns buffer. */
char *gb_chart_describe(const struct gb_chart_setting *setting, char *buffer,
                        size_t size);

/* Bits of a number, 32 or 64, as in the tables. */
static inline double gb_chart_bits(const struct gb_chart_setting *setting)
{
    return setting->single ? 32.0 : 64.0;
}

struct gb_chart_run {
    struct gb_chart_setting setting;
    uint64_t seed;
    bool failed;        /* stopped by a guard */
    double evaluations; /* of the forces during loading */
    double cpu_s;       /* of the same, without the initial structure */
    double
        density[GB_CHART_PRESSURES]; /* where the pressure is first reached; NaN: never */
    double coordination[GB_CHART_PRESSURES];
};

/* Loads one cell without unloading, on one thread, to the highest of the pressures (Pa; or
 * to the density that ends the preset).  Polls cancelled (NULL is fine) with data and the
 * CPU seconds spent so far.
 * Errors: GB_ERR_CANCELLED, those of the engine; a guard is no error, it sets failed. */
bool gb_chart_press(struct gb_chart_run *run, const struct gb_params *scene,
                    const double *pressure_pa, int pressures,
                    bool (*cancelled)(void *data, double cpu_s), void *data,
                    struct gb_error *err);

/* CPU time of this thread. */
double gb_chart_cpu_s(void);

#endif
