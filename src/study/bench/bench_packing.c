/* A packing pressed to a coordination number, and the time of its evaluations. */
#include "study/bench/bench_packing.h"

#include <gsl/gsl_statistics.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "measure/observe.h"
#include "pack/structure/chain_growth.h"
#include "pack/structure/hilbert.h"
#include "scene/loading_kind.h"

/* Evaluations of a batch: the median of the batches counts, because other work on the
 * machine varies. */
enum { BATCH = 24 };

/* Strain steps up to the requested coordination number and in a batch; limit of the former. */
static const double press_step = 0.01, bench_step = 0.001;
enum { PRESS_MOST = 200 };

/* On one core processor time counts, which other work on the machine does not lengthen; on
 * several the wall clock. */
static double now(const struct gb_world *world)
{
    return gb_world_model(world)->numerics.threads == 1 ? gb_clock_process_s()
                                                        : gb_clock_s();
}

static bool grow(struct gb_world **world, const struct gb_model *model, double *seconds,
                 struct gb_error *err)
{
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    if (!position) {
        return false;
    }
    const struct gb_chain_growth order = gb_chain_growth_from_model(model);
    const double start = gb_clock_s();
    const bool done = gb_chain_growth_run(&order, position, err);
    *seconds = gb_clock_s() - start;
    const bool made = done && gb_hilbert_sort(model, position, err) &&
                      gb_world_create(world, model, position, err);
    gb_alloc_free(position);
    return made;
}

static void squeeze(struct gb_world *world, struct gb_relax *relax, double step)
{
    const double factor[3] = {1.0, 1.0, 1.0 - step};
    gb_world_strain(world, factor);
    gb_relax_start(relax, world);
}

static bool press(struct gb_world *world, struct gb_relax *relax, double coordination,
                  struct gb_error *err)
{
    for (int step = 0; step < PRESS_MOST; step++) {
        if (gb_relax_advance(relax, world, relax->max_evaluations, err) ==
            GB_RELAX_FAILED) {
            return false;
        }
        struct gb_contact_counts counts;
        gb_observe_contacts(world, &counts, NULL, 0, NULL);
        if (counts.coordination >= coordination) {
            return true;
        }
        squeeze(world, relax, press_step);
    }
    return gb_error_set(err, GB_ERR_GUARD, "coordination %g: not reached", coordination);
}

/* The tolerance is out of reach, so that every batch has its full length. */
bool gb_bench_packing_time(struct gb_world *world, struct gb_relax *relax, int batches,
                           double *median, struct gb_error *err)
{
    double seconds[GB_BENCH_PACKING_BATCHES];
    relax->tolerance = 0.0;
    for (int batch = 0; batch < batches; batch++) {
        squeeze(world, relax, bench_step);
        const double start = now(world);
        if (gb_relax_advance(relax, world, BATCH, err) == GB_RELAX_FAILED) {
            return false;
        }
        seconds[batch] = (now(world) - start) / BATCH;
    }
    *median = gsl_stats_median(seconds, 1, (size_t)batches);
    return true;
}

bool gb_bench_packing_press(struct gb_bench_packing *pressed,
                            const struct gb_params *params, double coordination,
                            struct gb_error *err)
{
    struct gb_relax *relax = NULL;
    struct gb_contact_counts counts;
    const size_t before = gb_alloc_bytes();
    *pressed = (struct gb_bench_packing){0};
    const bool done =
        gb_loading_kind_check_cell(params, "the benchmark of one preset", err) &&
        gb_model_init(&pressed->model, params, err) &&
        grow(&pressed->world, &pressed->model, &pressed->grow_s, err) &&
        gb_relax_create(&relax, &pressed->model, err) &&
        (gb_relax_start(relax, pressed->world), true) &&
        press(pressed->world, relax, coordination, err) &&
        gb_world_copy_save(pressed->world, &pressed->copy, err);
    if (done) {
        gb_observe_contacts(pressed->world, &counts, NULL, 0, NULL);
        pressed->coordination = counts.coordination;
        pressed->bytes = gb_alloc_bytes() - before;
    }
    gb_relax_destroy(relax);
    return done;
}

void gb_bench_packing_finish(struct gb_bench_packing *pressed)
{
    gb_world_copy_destroy(pressed->copy);
    gb_world_destroy(pressed->world);
}
