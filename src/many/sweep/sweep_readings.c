#include "many/sweep/sweep_readings.h"

#include <math.h>

typedef bool read_figures(const struct gb_table *curve, double pressure_pa,
                          double values[GB_READING_QUANTITIES]);

static const struct branch {
    const char *name;
    read_figures *read;
} branches[GB_SWEEP_BRANCHES] = {{"load", gb_reading_loaded},
                                 {"unload", gb_reading_unloaded}};

const char *gb_sweep_readings_branch(size_t branch)
{
    return branches[branch].name;
}

static double *cell(const struct gb_sweep_readings *readings, size_t branch,
                    size_t pressure, size_t quantity)
{
    const size_t row = (branch * readings->pressures + pressure) * GB_READING_QUANTITIES;
    return readings->value + (row + quantity) * readings->runs;
}

static void read_run(const struct gb_sweep_readings *readings, size_t column,
                     struct gb_ensemble_run *run,
                     const struct gb_sweep_table_pressures *at)
{
    struct gb_table *curve = NULL;
    const bool good = run->ended && run->error.code == GB_OK &&
                      gb_reading_open(&curve, run->directory, &run->error);
    for (size_t b = 0; b < GB_SWEEP_BRANCHES; b++) {
        for (size_t p = 0; p < at->count; p++) {
            double values[GB_READING_QUANTITIES];
            const bool there = good && branches[b].read(curve, at->pa[p], values);
            for (size_t q = 0; q < GB_READING_QUANTITIES; q++) {
                cell(readings, b, p, q)[column] = there ? values[q] : (double)NAN;
            }
        }
    }
    gb_table_destroy(curve);
}

void gb_sweep_readings_init(struct gb_sweep_readings *readings,
                            struct gb_ensemble *ensemble, size_t point,
                            const struct gb_sweep_table_pressures *at)
{
    *readings = (struct gb_sweep_readings){.pressures = at->count};
    readings->runs = gb_ensemble_used(ensemble, point);
    readings->value = g_new(double, GB_SWEEP_BRANCHES * at->count *
                                        GB_READING_QUANTITIES * readings->runs);
    for (size_t r = 0; r < readings->runs; r++) {
        read_run(readings, r, gb_ensemble_at(ensemble, point, r), at);
    }
}

void gb_sweep_readings_finish(struct gb_sweep_readings *readings)
{
    g_free(readings->value);
    *readings = (struct gb_sweep_readings){0};
}

const double *gb_sweep_readings_at(const struct gb_sweep_readings *readings,
                                   size_t branch, size_t pressure, size_t quantity)
{
    return cell(readings, branch, pressure, quantity);
}
