#ifndef GB_STUDY_CHART_H
#define GB_STUDY_CHART_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

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

/* The settings of a chart, in the order of their simulation. */
struct gb_chart_plan {
    struct gb_params params;          /* the scene */
    struct gb_chart_setting *setting; /* [0] is the reference, [1] the preset's own */
    size_t settings;
    double pressure_pa[GB_CHART_PRESSURES]; /* ascending */
    int pressures;
    int seeds; /* params.seed, params.seed + 1, ... */
};

/* Plans the chart of a scene.
 *
 * vary       NULL-terminated "group.key=a,b,c" (loading.step, without parts;
 * numerics.relaxer, tolerance, cutoff, time_step, step_error, particles.count): all
 * combinations, other keys as in the preset.  NULL: a plan by kind of scene: strain steps x
 * tolerances of each fast relaxer, a few cutoffs and cell sizes, P1's relaxer twice.
 * reference  NULL-terminated "group.key=value" that replace values of the reference
 * pressures  "100 MPa; 1 GPa", or NULL: those of unloading, and the final one
 * Errors: GB_ERR_INPUT. */
bool gb_chart_plan_init(struct gb_chart_plan *plan, const struct gb_params *params,
                        const char *const *vary, const char *const *reference,
                        const char *pressures, int seeds, struct gb_error *err);

void gb_chart_plan_finish(struct gb_chart_plan *plan); /* zeroed is fine */

/* Rough relative cost of a run, by which the settings are sorted. */
double gb_chart_effort(const struct gb_chart_setting *setting);

/* The directory of a chart: preset.ini (the scene), runs.csv (one row per simulated
 * cell, so that an interrupted chart can be continued) and chart.csv. */
struct gb_chart_log {
    char *directory;
    GArray *runs; /* of struct gb_chart_run */
    const struct gb_chart_plan *plan;
    int lock;
};

/* Makes the directory, or continues the chart in it.  The plan must outlive the log.
 * Errors: GB_ERR_INPUT for the chart of another scene or other pressures, for a directory
 * with other files, and for a chart under way; GB_ERR_MACHINE. */
bool gb_chart_open(struct gb_chart_log *log, const char *directory,
                   const struct gb_chart_plan *plan, struct gb_error *err);
void gb_chart_close(struct gb_chart_log *log); /* zeroed is fine */

/* The result of a cell, or NULL. */
const struct gb_chart_run *gb_chart_find(const struct gb_chart_log *log,
                                         const struct gb_chart_setting *setting,
                                         uint64_t seed);

/* Adds a cell and writes runs.csv. */
bool gb_chart_add(struct gb_chart_log *log, const struct gb_chart_run *run,
                  struct gb_error *err);

/* Writes text as a file of the directory. */
bool gb_chart_keep(const struct gb_chart_log *log, const char *name, const GString *text,
                   struct gb_error *err);

#endif
