#include "bench.h"

#include <math.h>
#include <stdio.h>

#include <glib.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "measure/observe.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/hilbert.h"
#include "scene/loading_kind.h"

/* --- figures ------------------------------------------------------------------------- */

struct figure figure_of(double round[ROUNDS])
{
    for (int i = 0; i < ROUNDS; i++) {
        if (!isfinite(round[i])) {
            return (struct figure){NAN, NAN};
        }
    }
    gsl_sort(round, 1, ROUNDS);
    return (struct figure){gsl_stats_median_from_sorted_data(round, 1, ROUNDS),
                           0.5 * (round[ROUNDS - 1] - round[0])};
}

void print_figure(const char *name, struct figure figure, double scale, const char *unit)
{
    if (isfinite(figure.value)) {
        printf("%-42s %10.4g +- %-8.1g %s\n", name, scale * figure.value,
               scale * figure.spread, unit);
        fflush(stdout);
    }
}

void print_fact(const char *name, double value, const char *unit)
{
    printf("%-42s %10.4g %11s %s\n", name, value, "", unit);
    fflush(stdout);
}

bool make_scene(struct gb_params *params, char **assignment, struct gb_error *err)
{
    gb_params_init(params);
    params->diameter_m = 9.7e-9;
    params->fidelity = GB_FIDELITY_FAST;
    for (; *assignment; assignment++) {
        if (!gb_params_assign(params, *assignment, err)) {
            return false;
        }
    }
    return gb_params_check(params, err) &&
           gb_loading_kind_check_cell(params, "this benchmark", err);
}

int finish(bool good, const struct gb_error *err)
{
    if (!good) {
        fprintf(stderr, "%s: %s\n", g_get_prgname(), err->text);
    }
    return good ? 0 : 2;
}

double now_s(int threads)
{
    return threads == 1 ? gb_clock_process_s() : gb_clock_s();
}

/* --- packings ------------------------------------------------------------------------ */

/* Strain steps of pressing and of a batch, evaluations of a batch. */
static const double press_step = 0.01, batch_step = 0.001, enough_contacts = 6.0;
enum { PRESS_MOST = 200, BATCH = 24 };

static bool grow(struct packing *packing, struct gb_error *err)
{
    const struct gb_model *model = &packing->model;
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    const struct gb_chain_growth order = gb_chain_growth_from_model(model);
    const double start = gb_clock_s();
    bool good = gb_chain_growth_run(&order, position, err);
    packing->grow_s = gb_clock_s() - start;
    good = good && gb_hilbert_sort(model, position, err) &&
           gb_world_create(&packing->world, model, position, err);
    gb_alloc_free(position);
    return good;
}

static void squeeze(struct gb_world *world, struct gb_relax *relax, double step)
{
    const double factor[3] = {1.0, 1.0, 1.0 - step};
    gb_world_strain(world, factor);
    gb_relax_start(relax, world);
}

static bool press(struct packing *packing, struct gb_relax *relax, struct gb_error *err)
{
    struct gb_world *world = packing->world;
    gb_relax_start(relax, world);
    for (int step = 0; step < PRESS_MOST; step++) {
        struct gb_contact_counts counts;
        if (gb_relax_advance(relax, world, relax->max_evaluations, err) ==
            GB_RELAX_FAILED) {
            return false;
        }
        gb_observe_contacts(world, &counts, NULL, 0, NULL);
        packing->coordination = counts.coordination;
        if (counts.coordination >= enough_contacts) {
            return true;
        }
        squeeze(world, relax, press_step);
    }
    return gb_error_set(err, GB_ERR_GUARD, "coordination %g: not reached",
                        enough_contacts);
}

bool packing_press(struct packing *packing, const struct gb_params *params,
                   struct gb_error *err)
{
    struct gb_relax *relax = NULL;
    const size_t before = gb_alloc_bytes();
    *packing = (struct packing){0};
    const bool good = gb_model_init(&packing->model, params, err) && grow(packing, err) &&
                      gb_relax_create(&relax, &packing->model, err) &&
                      press(packing, relax, err) &&
                      gb_world_copy_save(packing->world, &packing->copy, err);
    packing->bytes = gb_alloc_bytes() - before;
    gb_relax_destroy(relax);
    return good;
}

void packing_finish(struct packing *packing)
{
    gb_world_copy_destroy(packing->copy);
    gb_world_destroy(packing->world);
}

bool packing_time(struct gb_world *world, struct gb_relax *relax, int batches,
                  double *median, struct gb_error *err)
{
    const int threads = gb_world_model(world)->numerics.threads;
    double seconds[BATCHES_MOST];
    relax->tolerance = 0.0; /* never reached: every batch has its full length */
    for (int batch = 0; batch < batches; batch++) {
        squeeze(world, relax, batch_step);
        const double start = now_s(threads);
        if (gb_relax_advance(relax, world, BATCH, err) == GB_RELAX_FAILED) {
            return false;
        }
        seconds[batch] = (now_s(threads) - start) / BATCH;
    }
    *median = gsl_stats_median(seconds, 1, (size_t)batches);
    return true;
}
