#include "study/chart/chart_advice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "measure/fit/average.h"
#include "measure/structure.h"
#include "pack/cell/particles.h"
#include "pack/structure/initial_structure.h"
#include "scene/model.h"

/* A g(r) whose ripple is below this counts as 1.  At density 0.24 the ripple is 0.02 from
 * 2.6 to 3.6 d, and 0.004 from 3.5 to 4.5 d, which is mostly noise. */
static const double flat = 0.01;
static const double bin_width = 0.05;
enum { STRUCTURES = 8 };

/* Adds g(r) up to half the shortest edge of one initial structure. */
static bool add_g(const struct gb_model *model, double half, int bins, double *sum,
                  struct gb_error *err)
{
    struct gb_cell cell;
    gb_particles_cell(model, &cell);
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    double *g = gb_alloc_array((size_t)bins, sizeof *g, err);
    const bool done = position && g &&
                      gb_initial_structure_fill(model, NULL, NULL, position, err) &&
                      gb_structure_rdf(&cell, model->count, position, half, bins, g, err);
    for (int k = 0; k < bins && done; k++) {
        sum[k] += g[k];
    }
    gb_alloc_free(position);
    gb_alloc_free(g);
    return done;
}

/* Mean g(r) over the first initial structures. */
static bool measure_g(struct gb_chart_size *size, const struct gb_chart_plan *plan,
                      const struct gb_chart_setting *setting, struct gb_error *err)
{
    struct gb_params params = plan->params;
    struct gb_model model;
    struct gb_cell cell;
    gb_chart_apply(&params, setting);
    if (!gb_model_init(&model, &params, err)) {
        return false;
    }
    gb_particles_cell(&model, &cell);
    size->half_edge = 0.5 * gb_cell_shortest(&cell);
    const int bins = (int)ceil(size->half_edge / bin_width);
    const int seeds = plan->seeds < STRUCTURES ? plan->seeds : STRUCTURES;
    double *g = gb_alloc_array((size_t)bins, sizeof *g, err);
    bool done = g != NULL;
    for (int s = 0; s < seeds && done; s++) {
        model.seed.value = plan->params.seed + (uint64_t)s;
        done = add_g(&model, size->half_edge, bins, g, err);
    }
    for (int k = 0; k < bins && done; k++) {
        g[k] /= seeds;
    }
    if (done) {
        size->g_end = gb_structure_rdf_end(model.dimension, size->half_edge, bins, g,
                                           &size->ripple);
        size->large_enough = size->ripple < flat;
    }
    gb_alloc_free(g);
    return done;
}

/* The standard error decreases with the square root of the number of cells. */
static double cells_for(const struct gb_chart_size *size, int pressures,
                        double standard_error)
{
    double most = 0.0;
    for (int k = 0; k < pressures; k++) {
        const double ratio = size->scatter[k] / standard_error;
        most = isfinite(ratio) ? fmax(most, ceil(ratio * ratio)) : most;
    }
    return most > 0.0 ? most : (double)NAN;
}

static bool differs_in_size_only(const struct gb_chart_setting *a,
                                 const struct gb_chart_setting *b)
{
    struct gb_chart_setting same = *a;
    same.count = b->count;
    return gb_chart_same(&same, b);
}

static int by_count(const void *a, const void *b)
{
    const struct gb_chart_size *x = a, *y = b;
    return (x->count > y->count) - (x->count < y->count);
}

bool gb_chart_advice_init(struct gb_chart_advice *advice,
                          const struct gb_chart_table *table,
                          const struct gb_chart_plan *plan, double standard_error,
                          struct gb_error *err)
{
    *advice = (struct gb_chart_advice){.standard_error = standard_error};
    const struct gb_chart_setting *own = &plan->setting[1];
    for (size_t i = 1; i < table->rows && advice->sizes < GB_CHART_SIZES; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->seeds < 2 || !differs_in_size_only(&row->setting, own)) {
            continue;
        }
        struct gb_chart_size *size = &advice->size[advice->sizes++];
        *size = (struct gb_chart_size){.count = row->setting.count, .cpu_s = row->cpu_s};
        /* pooled over many rows for the preset's size, from one row for another */
        memcpy(size->scatter, i == 1 ? table->scatter : row->scatter,
               sizeof size->scatter);
        size->cells = cells_for(size, plan->pressures, standard_error);
        if (!measure_g(size, plan, &row->setting, err)) {
            return false;
        }
    }
    qsort(advice->size, (size_t)advice->sizes, sizeof advice->size[0], by_count);
    return true;
}
