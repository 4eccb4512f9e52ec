/* The mode `die`: powder poured into a die and pressed, solve/loading/die/die_stages.h. */
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "pack/die/filling.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_measure.h"
#include "solve/loading/die/die_stages.h"
#include "solve/loading/loading.h"

struct die_loading {
    struct gb_loading base;
    struct gb_die_stages *stages;
    bool not_quasistatic; /* forces on floor and punch differed at the last point */
    double highest;       /* pressure that the powder has carried on loading, E, and */
    double last;          /* at the last point of it */
};

static struct die_loading *own(struct gb_loading *loading)
{
    return (struct die_loading *)(void *)loading;
}

static struct gb_die_stages_report stages_report(const struct gb_loading *loading)
{
    const struct die_loading *die = (const struct die_loading *)(const void *)loading;
    return gb_die_stages_report(die->stages, loading->bed);
}

static bool create_stages(struct gb_loading *loading, struct gb_error *err)
{
    const struct gb_bed_law law = gb_filling_compaction_law(loading->params);
    return gb_die_stages_create(&own(loading)->stages, &loading->model->die, &law, err);
}

static bool build(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    return create_stages(loading, err) &&
           gb_filling_create(&loading->bed, loading->params, loading->model, cancelled,
                             data, err);
}

/* Points are recorded from the start of pressing on: the bed has the law of pressing. */
static bool build_from(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    const struct gb_bed_law law = gb_filling_compaction_law(loading->params);
    (void)record;
    if (!create_stages(loading, err) ||
        !gb_filling_allocate(&loading->bed, loading->params, loading->model, err)) {
        return false;
    }
    gb_bed_set_law(loading->bed, &law);
    return true;
}

static void finish(struct gb_loading *loading)
{
    gb_die_stages_destroy(own(loading)->stages);
}

static enum gb_step_outcome advance(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_step_outcome outcome = gb_die_stages_advance(
        own(loading)->stages, loading->bed, max_evaluations, text, sizeof text, err);
    gb_event_queue_add(events, text);
    return outcome;
}

/* What a point counts as. */
static enum gb_loading_stage loading_stage(const struct gb_die_stages_report *now)
{
    switch (now->stage) {
    case GB_DIE_STAGES_PRESS:
    case GB_DIE_STAGES_OVER:
        return now->pressed > 0.0 ? GB_LOADING_LOAD : GB_LOADING_RELAX;
    case GB_DIE_STAGES_UNLOAD:
        return GB_LOADING_UNLOAD;
    case GB_DIE_STAGES_WITHDRAW:
    case GB_DIE_STAGES_CONFINED:
        return GB_LOADING_CONFINED;
    case GB_DIE_STAGES_EJECT:
        return GB_LOADING_EJECT;
    case GB_DIE_STAGES_FREE:
        return GB_LOADING_EJECTED;
    default:
        return GB_LOADING_RELAX;
    }
}

/* A punch that has to press and touches nothing is not in equilibrium either. */
static bool is_not_quasistatic(const struct gb_die_stages_report *now)
{
    return isfinite(now->floor_over_punch)
               ? fabs(now->floor_over_punch - 1.0) > GB_FLOOR_OVER_PUNCH_TOLERANCE
               : now->wanted > 0.0;
}

/* Equal forces are no equilibrium where a punch is braked or accelerated. */
static bool carries_the_load(const struct gb_die_stages_report *now)
{
    return fabs(now->carried - now->wanted) <= GB_DIE_GOAL_TOLERANCE * now->wanted;
}

/* One line when the point just recorded is the first that is out of equilibrium, or in
 * equilibrium again. */
static enum gb_step_outcome after_point(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const struct gb_die_stages_report now = stages_report(loading);
    const bool not_quasistatic =
        is_not_quasistatic(&now) ||
        (own(loading)->not_quasistatic && !carries_the_load(&now));
    (void)err;
    if (loading_stage(&now) != GB_LOADING_LOAD) {
        return GB_STEP_MORE;
    }
    if (not_quasistatic != own(loading)->not_quasistatic) {
        char ratio[32] = "none, no force on the punch";
        if (isfinite(now.floor_over_punch)) {
            snprintf(ratio, sizeof ratio, "%.3g", now.floor_over_punch);
        }
        snprintf(text, sizeof text,
                 not_quasistatic
                     ? "not quasi-static at %.4g MPa: floor-to-punch force ratio %s"
                     : "quasi-static again from %.4g MPa: floor-to-punch force ratio %s",
                 1e-6 * (now.carried * loading->model->pascal_per_stress), ratio);
        gb_event_queue_add(events, text);
    }
    own(loading)->not_quasistatic = not_quasistatic;
    own(loading)->highest = fmax(own(loading)->highest, now.carried);
    own(loading)->last = now.carried;
    return GB_STEP_MORE;
}

static bool record_stages(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err)
{
    static const struct gb_record_member members[] = {
        {"die/unsteady", GB_RECORD_BOOL, 1, offsetof(struct die_loading, not_quasistatic),
         "1"},
        {"die/highest", GB_RECORD_DOUBLE, 1, offsetof(struct die_loading, highest), "E"},
        {"die/last", GB_RECORD_DOUBLE, 1, offsetof(struct die_loading, last), "E"},
    };
    return gb_record_members(record, members, sizeof members / sizeof members[0], loading,
                             err) &&
           gb_die_stages_record(own(loading)->stages, loading->bed, record, err);
}

static struct gb_loading_report report(const struct gb_loading *loading)
{
    const struct gb_die_stages_report now = stages_report(loading);
    struct gb_loading_report report = gb_loading_empty_report();
    report.stage = loading_stage(&now);
    report.iterations = report.evaluations = now.steps;
    report.residual = now.residual;
    report.time_step = now.time_step;
    report.time = now.time;
    report.pressure[0] = now.side[0];
    report.pressure[1] = now.side[1];
    report.pressure[2] = now.carried;
    report.target_pressure = now.wanted;
    report.height = now.height;
    report.height0 = now.height0;
    report.floor_over_punch = now.floor_over_punch;
    report.floor = now.floor;
    report.drag = now.drag;
    report.contact = now.contact;
    report.work = now.work;
    report.axial = now.axial;
    report.radial = now.radial;
    report.welded = now.welded;
    return report;
}

static double progress(const struct gb_loading *loading, double pressure, double density)
{
    (void)pressure;
    (void)density;
    return stages_report(loading).progress;
}

/* The ramp of the punch ends by time, whatever the powder carries: never enough, or once,
 * under a punch that bounces; or more, under one that does not stop. */
static bool missed(const struct gb_loading *loading, char *text, size_t size)
{
    const struct die_loading *die = (const struct die_loading *)(const void *)loading;
    char until[64], carried[64];
    const double wanted = loading->params->until_pressure_pa,
                 scale = loading->model->pascal_per_stress,
                 highest = scale * die->highest, last = scale * die->last,
                 enough = wanted * (1.0 - GB_DIE_GOAL_TOLERANCE);
    const bool never =
        highest<enough, exceeded = highest> wanted * (1.0 + GB_DIE_GOAL_TOLERANCE);
    gb_units_format_short(wanted, GB_DIM_PRESSURE, 6, until, sizeof until);
    gb_units_format_short(never || exceeded ? highest : last, GB_DIM_PRESSURE, 4, carried,
                          sizeof carried);
    snprintf(
        text, size,
        "%s: loading.until = %s; the powder %s %s (a longer loading.time%s is nearer "
        "to equilibrium)",
        exceeded ? "exceeded" : "not reached", until,
        exceeded ? "carried up to"
        : never  ? "carries at most"
                 : "carries",
        carried, exceeded ? " or a lighter punch" : "");
    return never || exceeded || last < enough;
}

static void stage(const struct gb_loading *loading, struct gb_stage_report *report)
{
    const struct die_loading *die = (const struct die_loading *)(const void *)loading;
    const struct gb_model *model = loading->model;
    const double scale[GB_STAGE_MEASURES] = {
        [GB_STAGE_MEASURE_TRAVEL] = model->metre_per_length,
        [GB_STAGE_MEASURE_PRESSURE] = model->pascal_per_stress,
        [GB_STAGE_MEASURE_TIME] = model->die.second_per_time};
    gb_die_measure_stage(die->stages, loading->bed, report);
    if (scale[report->measure] > 0.0) {
        report->value *= scale[report->measure];
        report->goal *= scale[report->measure];
    }
    const struct gb_die_stages_report now = stages_report(loading);
    report->time_s = now.time * model->die.second_per_time;
    report->height_m = now.height * model->metre_per_length;
    report->kinetic_j = gb_bed_kinetic_energy(loading->bed).translational *
                        model->newton_per_force * model->metre_per_length;
}

const struct gb_loading_mode gb_loading_die = {
    .size = sizeof(struct die_loading),
    .build = build,
    .build_from = build_from,
    .finish = finish,
    .advance = advance,
    .after_point = after_point,
    .record = record_stages,
    .report = report,
    .progress = progress,
    .missed = missed,
    .stage = stage,
};
