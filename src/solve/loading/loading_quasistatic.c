/* The mode `quasistatic`: a periodic cell strained in steps, each relaxed to equilibrium.  First the
 * schedule: loading, unloading branches, and the goals that end it.  Then the mode.
 *
 * A step: advance() strains the cell if a strain is due, relaxes it in slices, checks for jumps
 * and reports a point.  after_point() decides the next strain and saves the way back. */
#include "solve/loading/loading_quasistatic.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/portable.h"
#include "base/record.h"
#include "base/units.h"
#include "pack/cell/world.h"
#include "pack/cell/world_record.h"
#include "scene/model.h"
#include "scene/tolerances.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"
#include "solve/loading/strain_step.h"

void gb_loading_quasistatic_init(struct gb_quasistatic *load,
                                 const struct gb_model *model)
{
    *load = (struct gb_quasistatic){
        .step = model->strain_step,
        .step_most = model->strain_step,
        .until_pressure = model->until_pressure,
        .until_density = model->until_density,
        .unload_count = model->unload_count,
        .branch = -1,
    };
    for (int i = 0; i < model->unload_count; i++) {
        load->unload_from[i] = model->unload_from[i];
    }
    load->axes = gb_loading_cell_of(model);
}

/* The state of the schedule out of a record or into it; before loading, gb_loading_quasistatic_init
 * with the same model.  Errors: GB_ERR_INPUT naming the member. */
static bool quasistatic_record(struct gb_quasistatic *load, struct gb_record *record,
                               struct gb_error *err)
{
#define AT(member) offsetof(struct gb_quasistatic, member)
    static const struct gb_record_member members[] = {
        {"load/step", GB_RECORD_DOUBLE, 1, AT(step), "1"},
        {"load/next_unload", GB_RECORD_INT32, 1, AT(next_unload), "1"},
        {"load/branch", GB_RECORD_INT32, 1, AT(branch), "1"},
        {"load/top_pressure", GB_RECORD_DOUBLE, 1, AT(top_pressure), "E"},
        {"load/last_pressure", GB_RECORD_DOUBLE, 1, AT(last_pressure), "E"},
        {"load/last_expansion", GB_RECORD_DOUBLE, 1, AT(last_expansion), "1"},
        {"load/expansions", GB_RECORD_INT32, 1, AT(expansions), "1"},
        {"load/exceeded", GB_RECORD_DOUBLE, 1, AT(exceeded), "E"},
        {"load/exceeded_by", GB_RECORD_DOUBLE, 1, AT(exceeded_by), "1"},
    };
#undef AT
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], load,
                           err)) {
        return false;
    }
    if (load->next_unload < 0 || load->next_unload > load->unload_count ||
        load->branch < -1 || load->branch > load->next_unload) {
        return gb_error_set(err, GB_ERR_INPUT, "load/branch: is out of range");
    }
    return true;
}

double gb_loading_quasistatic_pressure(const struct gb_quasistatic *load,
                                       const double pressure[3])
{
    return gb_loading_cell_mean(&load->axes, pressure);
}

/* One strain step of compression, shortened to end at until_density. */
static enum gb_quasistatic_order compress(const struct gb_quasistatic *load,
                                          double density, double factor[3])
{
    const double full = 1.0 - load->step;
    const double to_end =
        gb_portable_pow(density / load->until_density, 1.0 / load->axes.count);
    gb_loading_cell_scale(&load->axes, fmax(full, to_end), factor);
    return GB_QUASISTATIC_STRAIN;
}

/* An unloading step: the inverse of a compression step; the last one is shortened to the
 * strain at which the pressure extrapolates to zero. */
static double expansion(struct gb_quasistatic *load, double pressure)
{
    const double full = 1.0 / (1.0 - load->step);
    double share = 1.0;
    const double drop = load->last_pressure - pressure;
    if (load->expansions > 0 && drop > 0.0) {
        const double predicted = pressure / drop * (load->last_expansion / (full - 1.0));
        share = fmin(1.0, fmax(predicted, GB_UNLOADING_SHARE_MIN));
    }
    load->last_expansion = share * (full - 1.0);
    load->last_pressure = pressure;
    load->expansions++;
    return 1.0 + load->last_expansion;
}

static bool unloaded(struct gb_quasistatic *load, double pressure)
{
    const double grown = gb_portable_pow(1.0 / (1.0 - load->step), load->expansions);
    const bool done = pressure <= GB_UNLOADED_FRACTION * load->top_pressure;
    load->endless = !done && grown > GB_UNLOADING_GROWTH_MAX;
    return done || load->endless;
}

/* False where there is no target: infinite. */
static bool exceeds(double target, double pressure)
{
    return pressure - target > fmax(GB_TARGET_EXCESS * target, GB_TARGET_EXCESS_STRESS);
}

/* An unloading branch begins at this pressure. */
static void begin_unloading(struct gb_quasistatic *load, double pressure)
{
    const double target = load->unload_from[load->next_unload];
    const double excess = pressure / target - 1.0;
    if (exceeds(target, pressure) && excess > load->exceeded_by) {
        load->exceeded = target;
        load->exceeded_by = excess;
    }
    load->branch = ++load->next_unload;
    load->top_pressure = pressure;
    load->expansions = 0;
}

enum gb_quasistatic_order gb_loading_quasistatic_next(struct gb_quasistatic *load,
                                                      const double pressure[3],
                                                      double density, double factor[3])
{
    const double p = gb_loading_quasistatic_pressure(load, pressure);
    if (load->branch > 0) {
        if (unloaded(load, p)) {
            load->branch = 0;
            return GB_QUASISTATIC_RESTORE;
        }
        gb_loading_cell_scale(&load->axes, expansion(load, p), factor);
        return GB_QUASISTATIC_STRAIN;
    }
    load->branch = 0;
    if (load->next_unload < load->unload_count &&
        p >= load->unload_from[load->next_unload]) {
        begin_unloading(load, p);
        gb_loading_cell_scale(&load->axes, expansion(load, p), factor);
        return GB_QUASISTATIC_UNLOAD;
    }
    if (p >= load->until_pressure ||
        density >= load->until_density * (1.0 - GB_DENSITY_END_TOLERANCE)) {
        return GB_QUASISTATIC_END;
    }
    return compress(load, density, factor);
}

void gb_loading_quasistatic_halve(struct gb_quasistatic *load, double factor[3])
{
    load->step *= 0.5;
    for (int k = 0; k < 3; k++) {
        factor[k] = sqrt(factor[k]);
    }
}

void gb_loading_quasistatic_recover(struct gb_quasistatic *load)
{
    load->step = fmin(2.0 * load->step, load->step_most);
}

/* Appends "loading.unload_from = 100 MPa; 1 GPa", of those pressures not reached. */
static void name_unloadings(const struct gb_quasistatic *load,
                            const struct gb_params *params, char *text, size_t size)
{
    const char *before = "loading.unload_from = ";
    for (int k = load->next_unload; k < load->unload_count; k++) {
        char pressure[64];
        const size_t used = strlen(text);
        gb_units_format_short(params->unload_from_pa[k], GB_DIM_PRESSURE, 6, pressure,
                              sizeof pressure);
        snprintf(text + used, size - used, "%s%s", before, pressure);
        before = "; ";
    }
}

static void add_excess(const char *key, double target_pa, double excess, char *text,
                       size_t size)
{
    char target[64];
    const size_t used = strlen(text);
    gb_units_format_short(target_pa, GB_DIM_PRESSURE, 6, target, sizeof target);
    snprintf(text + used, size - used, "%s%s = %s by %.3g %%", used > 0 ? ", " : "", key,
             target, 100.0 * excess);
}

/* The goals of params that a schedule which has ended, at this pressure (E) and density,
 * never reached or has exceeded by more than its tolerance: loading.until, pressures of
 * loading.unload_from.  One line into text; false: none. */
static bool quasistatic_missed(const struct gb_quasistatic *load,
                               const struct gb_params *params, double pascal_per_stress,
                               double pressure, double density, char *text, size_t size)
{
    char unreached[256] = "", exceeded[256] = "", at[64];
    const double until_pa = params->until_pressure_pa; /* NaN: until a density */
    const double pressure_pa = pressure * pascal_per_stress;
    const bool until = until_pa > pressure_pa;
    if (until) {
        gb_units_format_short(until_pa, GB_DIM_PRESSURE, 6, at, sizeof at);
        snprintf(unreached, sizeof unreached, "loading.until = %s%s", at,
                 load->next_unload < load->unload_count ? ", " : "");
    }
    name_unloadings(load, params, unreached, sizeof unreached);
    if (exceeds(load->until_pressure, pressure)) {
        add_excess("loading.until", until_pa, pressure_pa / until_pa - 1.0, exceeded,
                   sizeof exceeded);
    }
    if (load->exceeded_by > 0.0) {
        add_excess("loading.unload_from", load->exceeded * pascal_per_stress,
                   load->exceeded_by, exceeded, sizeof exceeded);
    }
    text[0] = '\0';
    if (unreached[0] == '\0' && exceeded[0] == '\0') {
        return false;
    }
    gb_units_format_short(pressure_pa, GB_DIM_PRESSURE, 4, at, sizeof at);
    snprintf(text, size, "%s%s%s%s%s; ended at %s, density %.4f%s%s",
             unreached[0] != '\0' ? "not reached: " : "", unreached,
             unreached[0] != '\0' && exceeded[0] != '\0' ? "; " : "",
             exceeded[0] != '\0' ? "exceeded: " : "", exceeded, at, density,
             until ? " (all space is filled)" : "",
             exceeded[0] != '\0' ? " (a smaller loading.step comes nearer)" : "");
    return true;
}

/* Share of the schedule that is done, 0..1, by the logarithm of density towards
 * until_density, or of the pressure (loading branch only). */
static double quasistatic_progress(const struct gb_quasistatic *load, double pressure,
                                   double density, double start_density)
{
    /* time goes with the number of strain steps, that is with the logarithm of density */
    const double end =
        load->until_density < 1.0 ? load->until_density : GB_PROGRESS_END_DENSITY;
    const double by_density =
        gb_portable_log(density / start_density) / gb_portable_log(end / start_density);
    const double by_pressure =
        isfinite(load->until_pressure) ? pressure / load->until_pressure : 0.0;
    return fmin(1.0, fmax(0.0, fmax(fmin(by_density, GB_PROGRESS_MAX),
                                    by_pressure * by_pressure)));
}

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
    gb_loading_quasistatic_init(&run->schedule, run->base.model);
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
        gb_loading_quasistatic_halve(&run->schedule, run->base.factor);
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
    return 1e-6 * (gb_loading_quasistatic_pressure(&run->schedule, pressure) *
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
        switch (gb_loading_quasistatic_next(&run->schedule, pressure, density,
                                            run->base.factor)) {
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
    gb_loading_quasistatic_recover(&run->schedule);
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
    switch (gb_loading_quasistatic_next(&run->schedule, pressure, density,
                                        run->base.factor)) {
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
    return quasistatic_record(&run->schedule, record, err) &&
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
    return quasistatic_progress(&view(loading)->schedule, pressure, density,
                                loading->model->start_density);
}

static bool missed(const struct gb_loading *loading, char *text, size_t size)
{
    double pressure[3];
    gb_world_normal_pressures(loading->world, pressure);
    return quasistatic_missed(
        &view(loading)->schedule, loading->params, loading->model->pascal_per_stress,
        gb_loading_quasistatic_pressure(&view(loading)->schedule, pressure),
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
