#include "run/die_run.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "measure/observe_die.h"
#include "pack/die/bed_record.h"
#include "pack/die/filling.h"
#include "scene/tolerances.h"

static bool make(struct gb_die_run **out, const struct gb_params *params,
                 const struct gb_model *model, struct gb_error *err)
{
    const struct gb_bed_law law = gb_filling_pressing_law(params);
    struct gb_die_run *run = gb_alloc_array(1, sizeof *run, err);
    if (!run) {
        return false;
    }
    run->params = params;
    run->model = model;
    if (!gb_die_stages_create(&run->programme, &model->die, &law, err)) {
        gb_die_run_destroy(run);
        return false;
    }
    *out = run;
    return true;
}

bool gb_die_run_create(struct gb_die_run **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err)
{
    struct gb_die_run *run = NULL;
    if (!make(&run, params, model, err)) {
        return false;
    }
    if (!gb_filling_create(&run->bed, params, model, cancelled, data, err)) {
        gb_die_run_destroy(run);
        return false;
    }
    *out = run;
    return true;
}

bool gb_die_run_bare(struct gb_die_run **out, const struct gb_params *params,
                     const struct gb_model *model, struct gb_error *err)
{
    const struct gb_bed_law law = gb_filling_pressing_law(params);
    struct gb_die_run *run = NULL;
    if (!make(&run, params, model, err)) {
        return false;
    }
    if (!gb_filling_allocate(&run->bed, params, model, err)) {
        gb_die_run_destroy(run);
        return false;
    }
    gb_bed_set_law(run->bed, &law);
    *out = run;
    return true;
}

bool gb_die_run_record(struct gb_die_run *run, struct gb_record *record,
                       struct gb_error *err)
{
    static const struct gb_record_member members[] = {
        {"die/unsteady", GB_RECORD_BOOL, 1, offsetof(struct gb_die_run, unsteady), "1"},
    };
    return gb_record_members(record, members, 1, run, err) &&
           gb_die_stages_record(run->programme, record, err) &&
           gb_bed_record(run->bed, record, err);
}

void gb_die_run_destroy(struct gb_die_run *run)
{
    if (!run) {
        return;
    }
    gb_bed_destroy(run->bed);
    gb_die_stages_destroy(run->programme);
    gb_alloc_free(run);
}

void gb_die_run_measure(const struct gb_die_run *run, struct gb_point *point)
{
    const struct gb_model *model = run->model;
    const struct gb_die_stages_report report =
        gb_die_stages_report(run->programme, run->bed);
    const double pascal = model->pascal_per_stress;
    const bool pressing = report.stage >= GB_DIE_STAGES_PRESS && report.pressed > 0.0;
    struct gb_contact_counts counts;
    gb_observe_die_contacts(run->bed, &counts, NULL, 0, NULL);
    *point = (struct gb_point){
        .branch = pressing ? GB_BRANCH_LOAD : GB_BRANCH_RELAX,
        .density = gb_observe_die_density(run->bed, report.height),
        .px_pa = report.side[0] * pascal,
        .py_pa = report.side[1] * pascal,
        .pz_pa = report.carried * pascal,
        .p_pa = report.carried * pascal,
        .coordination = counts.coordination,
        .bridged = NAN,
        .rattlers = (double)counts.rattlers / (double)model->count,
        .residual = report.residual,
        .iterations = report.steps,
        .evaluations = report.steps,
        .time_s = report.time * model->die.second_per_time,
        .kinetic = NAN,
        .work = NAN,
        .elastic = NAN,
        .dissipated = NAN,
        .energy_residual = NAN,
        .central = gb_observe_die_central(run->bed, report.height, model->die.central_radius),
        .height_m = report.height * model->metre_per_length,
        .height_change = report.height0 > 0.0
                             ? (report.height - report.height0) / report.height0
                             : (double)NAN,
        .target_pa = report.wanted * pascal,
        .floor_over_punch = report.floor_over_punch,
    };
}

static bool is_unsteady(const struct gb_point *point)
{
    return isfinite(point->floor_over_punch) &&
           fabs(point->floor_over_punch - 1.0) > GB_FLOOR_OVER_PUNCH_TOLERANCE;
}

void gb_die_run_judge(struct gb_die_run *run, const struct gb_point *point, char *text,
                      size_t size)
{
    const bool unsteady = is_unsteady(point);
    text[0] = '\0';
    if (unsteady != run->unsteady) {
        snprintf(text, size,
                 unsteady ? "not quasi-static at %.4g MPa: the floor bears %.3g of the "
                            "punch's force"
                          : "quasi-static again from %.4g MPa: the floor bears %.3g of "
                            "the punch's force",
                 1e-6 * point->p_pa, point->floor_over_punch);
    }
    run->unsteady = unsteady;
}

void gb_die_run_observe(const struct gb_die_run *run, struct gb_snapshot *snapshot)
{
    const struct gb_die_stages_report report =
        gb_die_stages_report(run->programme, run->bed);
    struct gb_contact_counts counts;
    gb_observe_die_contacts(run->bed, &counts, snapshot->histogram, GB_SNAPSHOT_HISTOGRAM,
                            NULL);
    gb_observe_die_rose(run->bed, GB_SNAPSHOT_ROSE, snapshot->rose);
    snapshot->evaluations = run->bed->evaluations;
    snapshot->live_residual = report.residual;
    snapshot->progress = report.progress;
    snapshot->time_step_s = report.time_step * run->model->die.second_per_time;
}

static void copy_pairs(const struct gb_bed *bed, struct gb_state *state)
{
    int64_t line = 0;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (bed->pairs.contacts.normal[slot] < 0.0) {
            continue;
        }
        double unit[3];
        gb_observe_die_force(bed, slot, unit, state->pair_force + 3 * line);
        state->pair[2 * line] = bed->pairs.first[slot];
        state->pair[2 * line + 1] = bed->pairs.other[slot];
        state->pair_normal[line++] = bed->pairs.contacts.normal[slot];
    }
}

/* Of the box around the die, or around the powder that is still in the funnel. */
static double half_width(const struct gb_bed *bed)
{
    double half = bed->die.radius;
    for (int64_t i = 0; i < bed->count && bed->die.funnel; i++) {
        const double *x = bed->position[i];
        half = fmax(half, fmax(fabs(x[0]), fabs(x[1])) + x[3]);
    }
    return half;
}

bool gb_die_run_state(const struct gb_die_run *run, struct gb_state **out,
                      struct gb_error *err)
{
    const struct gb_bed *bed = run->bed;
    const double radius = half_width(bed);
    struct gb_contact_counts counts;
    gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
    if (!gb_state_create(out, bed->count, counts.contacts, err)) {
        return false;
    }
    struct gb_state *state = *out;
    const double top = fmax(gb_bed_top(bed), bed->die.punch ? bed->die.punch_position : 0.0);
    state->die_radius = bed->die.radius;
    state->cell[0] = state->cell[1] = 2.0 * radius;
    state->cell[2] = top;
    gb_observe_die_contacts(bed, &counts, NULL, 0, state->contacts);
    for (int64_t i = 0; i < bed->count; i++) {
        const double position[3] = {bed->position[i][0] + radius, bed->position[i][1] + radius,
                                 bed->position[i][2]};
        memcpy(state->position + 3 * i, position, sizeof position);
        state->radius[i] = bed->position[i][3];
    }
    copy_pairs(bed, state);
    gb_die_run_measure(run, &state->point);
    return true;
}
