/* The mode `quasistatic`: a periodic cell strained in steps, each relaxed to equilibrium,
 * in the order of solve/loading/quasistatic.h. */
#include <math.h>
#include <stdio.h>

#include "base/portable.h"
#include "pack/cell/world.h"
#include "pack/cell/world_record.h"
#include "scene/tolerances.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"
#include "solve/loading/quasistatic.h"
#include "solve/loading/strain_step.h"

struct quasistatic_loading {
    struct gb_loading base;
    struct gb_strain_step step;
    /* Where the unloading branch began: all that the loading branch depends on. */
    struct gb_record branch_start;
    struct gb_quasistatic schedule;
};

static struct quasistatic_loading *own(struct gb_loading *loading)
{
    return (struct quasistatic_loading *)(void *)loading;
}

static const struct quasistatic_loading *view(const struct gb_loading *loading)
{
    return (const struct quasistatic_loading *)(const void *)loading;
}

/* The first relaxation is that of the packing as it was placed. */
static void begin(struct quasistatic_loading *run)
{
    gb_quasistatic_init(&run->schedule, run->base.model);
    gb_strain_step_begin_first(&run->step, run->base.world);
}

/* The relaxer comes first: an unknown name is an error before the packing is grown. */
static bool build(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    if (!gb_strain_step_init(&own(loading)->step, loading->model, err) ||
        !gb_loading_cell_grow(loading, cancelled, data, err)) {
        return false;
    }
    begin(own(loading));
    return true;
}

static bool build_from(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    if (!gb_strain_step_init(&own(loading)->step, loading->model, err) ||
        !gb_loading_cell_load(loading, record, err)) {
        return false;
    }
    begin(own(loading));
    return true;
}

static void finish(struct gb_loading *loading)
{
    struct quasistatic_loading *run = own(loading);
    gb_record_finish(&run->branch_start);
    gb_strain_step_finish(&run->step);
}

/* The strain step in equal parts. */
static void strain(struct quasistatic_loading *run)
{
    const int parts = run->base.model->numerics.parts;
    double factor[3];
    for (int k = 0; k < 3; k++) {
        factor[k] = parts > 1 ? gb_portable_pow(run->base.factor[k], 1.0 / parts)
                              : run->base.factor[k];
    }
    const struct gb_deformation part = gb_deformation_scaling(factor);
    gb_strain_step_begin(&run->step, &part, parts);
    run->base.strain_due = false;
}

static enum gb_step_outcome advance(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    struct quasistatic_loading *run = own(loading);
    if (run->base.strain_due) {
        strain(run);
    }
    enum gb_strain_step_outcome outcome =
        gb_strain_step_advance(&run->step, max_evaluations, events, err);
    if (outcome == GB_STRAIN_STEP_RELAXED) {
        outcome = gb_strain_step_check_jumps(&run->step, events, err);
    }
    switch (outcome) {
    case GB_STRAIN_STEP_MORE:
        break;
    case GB_STRAIN_STEP_RELAXED:
        return GB_STEP_POINT;
    case GB_STRAIN_STEP_RETRY: /* half the strain step from the last good state on */
        gb_quasistatic_halve(&run->schedule, run->base.factor);
        run->base.strain_due = true;
        break;
    case GB_STRAIN_STEP_STOPPED:
        return GB_STEP_STOPPED;
    }
    return GB_STEP_MORE;
}

static double pressure_mpa(const struct quasistatic_loading *run,
                           const double pressure[3])
{
    return 1e-6 * (gb_quasistatic_pressure(&run->schedule, pressure) *
                   run->base.model->pascal_per_stress);
}

static void add_unload_event(const struct quasistatic_loading *run,
                             const double pressure[3], struct gb_event_queue *events)
{
    char text[GB_EVENT_TEXT];
    snprintf(text, sizeof text, "unloading from %.6g MPa (target %.6g MPa)",
             pressure_mpa(run, pressure),
             1e-6 * run->base.params->unload_from_pa[run->schedule.branch - 1]);
    gb_event_queue_add(events, text);
}

static void add_restore_event(const struct quasistatic_loading *run,
                              const double pressure[3], struct gb_event_queue *events)
{
    char text[GB_EVENT_TEXT];
    if (!run->schedule.endless) {
        gb_event_queue_add(events, "unloaded; loading continues from the saved state");
        return;
    }
    snprintf(text, sizeof text,
             "guard: the cell has grown by half and still carries %.3g MPa; unloading is "
             "given up, loading continues from the saved state",
             pressure_mpa(run, pressure));
    gb_event_queue_add(events, text);
}

/* Packing, relaxer and strain step into a record or out of it. */
static bool record_branch_start(struct quasistatic_loading *run, struct gb_record *record,
                                struct gb_error *err)
{
    return gb_record_array(record, "load/step", GB_RECORD_DOUBLE, 1, 1, "1",
                           &run->schedule.step, err) &&
           gb_world_record(run->base.world, record, err) &&
           gb_relax_record(run->step.relax, run->base.model->count, record, err);
}

static bool save_branch_start(struct quasistatic_loading *run, struct gb_error *err)
{
    gb_record_clear(&run->branch_start);
    const bool done = record_branch_start(run, &run->branch_start, err);
    if (run->base.model->numerics.single) {
        gb_record_remove(&run->branch_start, "world/pair_force"); /* for pictures only */
    }
    return done;
}

/* Back to where the unloading branch began, as a resumed run goes back to its checkpoint:
 * loading continues to the same bits as without the branch. */
static bool restore_branch_start(struct quasistatic_loading *run, struct gb_error *err)
{
    struct gb_world *world = run->base.world;
    const int64_t evaluations = gb_world_evaluations(world);
    run->base.restored = true;
    run->branch_start.loading = true;
    const bool done = record_branch_start(run, &run->branch_start, err);
    gb_world_set_evaluations(world, evaluations);
    return done;
}

static enum gb_step_outcome save_good(struct quasistatic_loading *run,
                                      struct gb_error *err)
{
    run->base.strain_due = gb_strain_step_save(&run->step, err);
    return run->base.strain_due ? GB_STEP_MORE : GB_STEP_STOPPED;
}

/* The next step of the schedule after a recorded state. */
static enum gb_step_outcome decide_next(struct quasistatic_loading *run,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    double pressure[3];
    for (;;) {
        gb_world_normal_pressures(run->base.world, pressure);
        const double density = gb_world_density(run->base.world);
        switch (
            gb_quasistatic_next(&run->schedule, pressure, density, run->base.factor)) {
        case GB_QUASISTATIC_RESTORE:
            add_restore_event(run, pressure, events);
            if (!restore_branch_start(run, err)) {
                return GB_STEP_STOPPED;
            }
            continue;
        case GB_QUASISTATIC_END:
            return GB_STEP_DONE;
        case GB_QUASISTATIC_UNLOAD:
            add_unload_event(run, pressure, events);
            if (!save_branch_start(run, err)) {
                return GB_STEP_STOPPED;
            }
            break;
        case GB_QUASISTATIC_STRAIN:
            break;
        }
        return save_good(run, err);
    }
}

static enum gb_step_outcome after_point(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    struct quasistatic_loading *run = own(loading);
    loading->restored = false;
    gb_strain_step_clear_spent(&run->step);
    gb_quasistatic_recover(&run->schedule);
    return decide_next(run, events, err);
}

/* An unloading branch under way is completed as planned. */
static enum gb_step_outcome decide_again(struct gb_loading *loading, struct gb_error *err)
{
    struct quasistatic_loading *run = own(loading);
    double pressure[3];
    if (run->schedule.branch > 0) {
        return GB_STEP_MORE;
    }
    gb_world_normal_pressures(loading->world, pressure);
    const double density = gb_world_density(loading->world);
    switch (gb_quasistatic_next(&run->schedule, pressure, density, run->base.factor)) {
    case GB_QUASISTATIC_UNLOAD:
        return save_branch_start(run, err) ? GB_STEP_MORE : GB_STEP_STOPPED;
    case GB_QUASISTATIC_END:
        run->base.strain_due = false;
        return GB_STEP_DONE;
    case GB_QUASISTATIC_STRAIN:
    case GB_QUASISTATIC_RESTORE:
        break;
    }
    return GB_STEP_MORE;
}

static bool check_loaded(struct quasistatic_loading *run, struct gb_error *err)
{
    for (int k = 0; k < 3; k++) {
        if (run->base.strain_due && !(run->base.factor[k] > GB_STRAIN_FACTOR_MIN &&
                                      run->base.factor[k] < GB_STRAIN_FACTOR_MAX)) {
            return gb_error_set(err, GB_ERR_INPUT, "run/factor: is out of range");
        }
    }
    return !run->base.strain_due || gb_strain_step_save(&run->step, err);
}

static bool record_schedule(struct gb_loading *loading, struct gb_record *record,
                            struct gb_error *err)
{
    struct quasistatic_loading *run = own(loading);
    return gb_quasistatic_record(&run->schedule, record, err) &&
           gb_relax_record(run->step.relax, loading->model->count, record, err) &&
           (run->schedule.branch <= 0 ||
            gb_record_nest(record, "branch_", &run->branch_start, err)) &&
           (!record->loading || check_loaded(run, err));
}

static struct gb_loading_report report(const struct gb_loading *loading)
{
    const struct quasistatic_loading *run = view(loading);
    struct gb_loading_report report = gb_loading_empty_report();
    report.stage = run->schedule.branch < 0 ? GB_LOADING_RELAX : GB_LOADING_LOAD;
    report.unloading = run->schedule.branch > 0 ? run->schedule.branch : 0;
    report.iterations = gb_strain_step_iterations(&run->step);
    report.evaluations = gb_strain_step_evaluations(&run->step);
    report.residual = gb_world_residual(loading->world);
    report.unrelaxed = run->step.unrelaxed;
    return report;
}

static double progress(const struct gb_loading *loading, double pressure, double density)
{
    return gb_quasistatic_progress(&view(loading)->schedule, pressure, density,
                                   loading->model->start_density);
}

static bool missed(const struct gb_loading *loading, char *text, size_t size)
{
    double pressure[3];
    gb_world_normal_pressures(loading->world, pressure);
    return gb_quasistatic_missed(
        &view(loading)->schedule, loading->params, loading->model->pascal_per_stress,
        gb_quasistatic_pressure(&view(loading)->schedule, pressure),
        gb_world_density(loading->world), text, size);
}

const struct gb_loading_mode gb_loading_quasistatic = {
    .size = sizeof(struct quasistatic_loading),
    .by_path = &gb_loading_path,
    .build = build,
    .build_from = build_from,
    .finish = finish,
    .advance = advance,
    .after_point = after_point,
    .decide_again = decide_again,
    .record = record_schedule,
    .report = report,
    .progress = progress,
    .missed = missed,
};
