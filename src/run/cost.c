/* How long runs take.
 *
 * The pace of a run under way gives its rate, its remaining time and the next slice of work.
 * Before a run, its cost is estimated from the steps of a dynamic compression, from a copy that
 * runs for a moment, or from the quick cell: a small and coarse twin of the scene. */
#include "run/cost.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/units.h"
#include "greenbody/params.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "scene/derived.h"
#include "scene/lattice.h"
#include "scene/loading_kind.h"

/* Bounds of a slice, s: shorter slices spend noticeable time between them, longer ones
 * delay a key press noticeably. */
static const double slice_short_s = 0.005;
static const double slice_long_s = 0.02;
static const int64_t slice_most = 1 << 16;

/* Window of the rate, s. */
static const double window_s = 3.0;

/* Least work (s) and progress before a remaining time is estimated. */
static const double left_known_s = 0.5;
static const double left_known_progress = 1e-3;

void gb_cost_pace_init(struct gb_pace *pace)
{
    memset(pace, 0, sizeof *pace);
    pace->slice = 1;
}

/* Late steps of loading cost more than early ones.  The rate of progress is an exponential
 * mean whose memory is a third of the time so far. */
static void add_progress(struct gb_pace *pace, double seconds, double progress)
{
    if (!isfinite(progress) || !pace->begun) {
        pace->begun = isfinite(progress);
        pace->progress = pace->begun ? progress : 0.0;
        pace->progress_at = pace->progress_from = seconds;
        return;
    }
    const double dt = seconds - pace->progress_at;
    if (!(dt > 0.0) || !(progress >= pace->progress)) {
        return;
    }
    const double rate = (progress - pace->progress) / dt;
    double weight = 3.0 * dt / (seconds - pace->progress_from);
    if (weight > 1.0) {
        weight = 1.0;
    }
    pace->progress_rate += weight * (rate - pace->progress_rate);
    pace->progress = progress;
    pace->progress_at = seconds;
}

void gb_cost_pace_add(struct gb_pace *pace, double seconds, int64_t evaluations,
                      double progress)
{
    pace->seconds[pace->next] = seconds;
    pace->evaluations[pace->next] = (double)evaluations;
    pace->next = (pace->next + 1) % GB_PACE_WINDOW;
    if (pace->filled < GB_PACE_WINDOW) {
        pace->filled++;
    }
    add_progress(pace, seconds, progress);
}

/* Slot of the report `age` reports ago. */
static int slot_of(const struct gb_pace *pace, int age)
{
    return (pace->next - 1 - age + 2 * GB_PACE_WINDOW) % GB_PACE_WINDOW;
}

double gb_cost_pace_rate(const struct gb_pace *pace)
{
    if (pace->filled < 2) {
        return 0.0;
    }
    const int newest = slot_of(pace, 0);
    int oldest = newest;
    for (int age = 1; age < pace->filled; age++) {
        const int slot = slot_of(pace, age);
        if (pace->seconds[newest] - pace->seconds[slot] > window_s && age > 1) {
            break;
        }
        oldest = slot;
    }
    const double dt = pace->seconds[newest] - pace->seconds[oldest];
    return dt > 0.0 ? (pace->evaluations[newest] - pace->evaluations[oldest]) / dt : 0.0;
}

double gb_cost_pace_left(const struct gb_pace *pace)
{
    if (pace->progress >= 1.0) {
        return 0.0;
    }
    if (pace->progress_at - pace->progress_from < left_known_s ||
        pace->progress < left_known_progress || !(pace->progress_rate > 0.0)) {
        return -1.0;
    }
    return (1.0 - pace->progress) / pace->progress_rate;
}

int64_t gb_cost_pace_slice(const struct gb_pace *pace)
{
    return pace->slice;
}

void gb_cost_pace_sliced(struct gb_pace *pace, double seconds, bool full)
{
    if (seconds > slice_long_s && pace->slice > 1) {
        pace->slice /= 2;
    } else if (seconds < slice_short_s && full && pace->slice < slice_most) {
        pace->slice *= 2;
    }
}

/* What auto is taken to choose, in T: ten times P2's own step.  An assumption, since only
 * the run itself finds its step. */
static const double step_of_auto = 0.4;

/* Particle-steps per second and core, discs or spheres with friction and bridges: the low
 * end of the measurements, so that the estimate is rather too long. */
static const double rate_of_core = 8e6;

/* Particles that keep one thread busy: a smaller scene is swept by fewer threads. */
static const double particles_of_thread = 2000.0;

/* A force sweep over one particle of a quasi-static run takes one core this long, s. */
static const double sweep_s = 0.18e-6;

/* Length of a row of curve.csv with the columns of a dynamic run. */
static const double row_bytes = 250.0;

/* Runs estimated to take longer need a confirmation, s. */
static const double limit_s = 3600.0;

static bool has_given_rate(const struct gb_loading_kind *kind)
{
    return kind->given_rate;
}

static bool check(const struct gb_params *params, double rate, struct gb_error *err)
{
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    if (!kind->given_rate) {
        char names[80];
        return gb_error_set(err, GB_ERR_INPUT,
                            "scene.kind = %s: the cost can be estimated with "
                            "scene.kind = %s only",
                            kind->name,
                            gb_loading_kind_names(has_given_rate, names, sizeof names));
    }
    if (!(rate > 0.0 && isfinite(rate))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%g particle-steps per second: expected above 0", rate);
    }
    return gb_params_check(params, err);
}

/* A stage has no more points than steps, and its last state is one. */
static double points_of(double intervals, double steps)
{
    return steps > 0.0 ? fmin(ceil(intervals), steps) : 0.0;
}

bool gb_cost_estimate(const struct gb_params *params, double particle_steps_per_s,
                      struct gb_cost *out, struct gb_error *err)
{
    if (!check(params, particle_steps_per_s, err)) {
        return false;
    }
    const double given = gb_derived_time_step_s(params);
    const double step =
        isnan(given) ? step_of_auto * gb_derived_unit_time_s(params) : given;
    /* d rho/dt = v rho */
    const double growth =
        log(params->until_density / gb_derived_structure_density(params));
    struct gb_cost cost = {
        .time_step_s = step,
        .step_assumed = isnan(given),
        .relax_steps = ceil(params->relax_s / step),
        .compress_steps = ceil(growth / params->rate_per_s / step),
        .hold_steps = ceil(params->hold_s / step),
        .particle_steps_per_s = particle_steps_per_s,
    };
    cost.steps = cost.relax_steps + cost.compress_steps + cost.hold_steps;
    cost.particle_steps = cost.steps * (double)params->count;
    cost.seconds = cost.particle_steps / particle_steps_per_s;
    cost.points = 1.0 +
                  points_of(params->relax_s / params->record_time_s, cost.relax_steps) +
                  points_of(growth / log1p(params->record_density), cost.compress_steps) +
                  points_of(params->hold_s / params->record_time_s, cost.hold_steps);
    cost.curve_bytes = row_bytes * cost.points;
    *out = cost;
    return true;
}

/* Threads that a scene keeps busy here. */
static double threads_of(const struct gb_params *params)
{
    const double cores = (double)g_get_num_processors();
    const double useful = fmax(floor((double)params->count / particles_of_thread), 1.0);
    return fmin(params->threads > 0 ? (double)params->threads : useful, cores);
}

double gb_cost_rate_assumed(const struct gb_params *params)
{
    return rate_of_core * threads_of(params);
}

/* Force sweeps over those of the quick cell, which is pressed with fidelity fast.  Set
 * II, 1000 particles, to 1 GPa: fast took 4.8 thousand in steps of 0.3 % and of 0.1 %,
 * balanced 9.9 and 10.0, reference 174; unloading twice adds 5 %. */
static double sweeps_over_quick(const struct gb_params *full)
{
    const double unloading = 1.0 + 0.025 * (double)full->unload_count;
    switch (full->fidelity) {
    case GB_FIDELITY_FAST:
        return unloading;
    case GB_FIDELITY_REFERENCE:
        return 36.0 * unloading;
    default:
        return 2.1 * unloading;
    }
}

double gb_cost_from_quick(const struct gb_params *full, const struct gb_params *quick,
                          double quick_s)
{
    if (gb_loading_kind_of(full)->follows_time) {
        return NAN;
    }
    const double particles = (double)full->count / (double)quick->count;
    return quick_s * particles * sweeps_over_quick(full) * threads_of(quick) /
           threads_of(full);
}

/* Density of an average powder at a pressure: P1's four at 100 MPa within 0.06, at 1 GPa
 * within 0.1. */
static double density_assumed(const struct gb_params *params)
{
    return isnan(params->until_pressure_pa)
               ? params->until_density
               : 0.27 + 0.09 * log10(params->until_pressure_pa / 1e6);
}

/* Sweeps of the quick cell to 1 GPa, which goes from 0.24 to 0.54 here. */
static double quasistatic_s(const struct gb_params *params)
{
    static const double quick_sweeps = 4.8e3, quick_growth = 0.81;
    const double growth =
        log(density_assumed(params) / gb_derived_structure_density(params));
    return quick_sweeps * sweeps_over_quick(params) * growth / quick_growth *
           (double)params->count * sweep_s / threads_of(params);
}

double gb_cost_assumed_s(const struct gb_params *params)
{
    struct gb_cost cost;
    double seconds = NAN;
    if (!gb_loading_kind_of(params)->follows_time) {
        seconds = quasistatic_s(params);
    } else if (gb_loading_kind_of(params)->given_rate &&
               gb_cost_estimate(params, gb_cost_rate_assumed(params), &cost, NULL)) {
        seconds = cost.seconds;
    }
    return seconds > 0.0 ? seconds : (double)NAN;
}

bool gb_cost_within_limit(double seconds)
{
    return !(seconds > limit_s);
}

static double time_copy(struct gb_experiment *copy, double seconds, bool *ended)
{
    struct gb_pace pace;
    struct gb_error ignored;
    const int64_t before = gb_experiment_evaluations(copy);
    const double start = gb_clock_s();
    double now = start;
    gb_cost_pace_init(&pace);
    while (!gb_experiment_over(copy) && now - start < seconds) {
        const double from = now;
        const enum gb_step_outcome how =
            gb_experiment_advance(copy, gb_cost_pace_slice(&pace), &ignored);
        now = gb_clock_s();
        gb_cost_pace_sliced(&pace, now - from, how == GB_STEP_MORE);
    }
    *ended = gb_experiment_over(copy);
    const double steps = (double)(gb_experiment_evaluations(copy) - before);
    return now > start ? steps * (double)gb_experiment_params(copy)->count / (now - start)
                       : 0.0;
}

bool gb_cost_rate_try(struct gb_experiment *experiment, double seconds,
                      double *particle_steps_per_s, bool *ended, struct gb_error *err)
{
    struct gb_experiment *copy = NULL;
    struct gb_record *record = gb_alloc_array(1, sizeof *record, err);
    const bool good =
        record && gb_checkpoint_take(experiment, record, err) &&
        gb_experiment_resume(&copy, gb_experiment_params(experiment), record, err);
    if (good) {
        *particle_steps_per_s = time_copy(copy, seconds, ended);
    }
    gb_experiment_destroy(copy);
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    return good;
}

char *gb_cost_duration(double seconds, char *buffer, size_t size)
{
    const double minutes = ceil(seconds / 60.0), hours = floor(minutes / 60.0);
    if (seconds < 60.0) {
        snprintf(buffer, size, "%.0f s", ceil(seconds));
    } else if (minutes < 60.0) {
        snprintf(buffer, size, "%.0f min", minutes);
    } else if (hours < 72.0) {
        snprintf(buffer, size, "%.0f h %02.0f min", hours, minutes - 60.0 * hours);
    } else {
        snprintf(buffer, size, "%.0f days", round(hours / 24.0));
    }
    return buffer;
}

char *gb_cost_line(const struct gb_cost *cost, char *buffer, size_t size)
{
    char step[48], duration[48];
    gb_units_format_short(cost->time_step_s, GB_DIM_TIME, 4, step, sizeof step);
    snprintf(buffer, size,
             "estimate: %.3g steps of %s%s (relax %.3g, compress %.3g, hold %.3g), %.3g "
             "particle-steps, %s at %.3gM/s; %.0f points, %.2g MB of curve.csv",
             cost->steps, step, cost->step_assumed ? " (assumed)" : "", cost->relax_steps,
             cost->compress_steps, cost->hold_steps, cost->particle_steps,
             gb_cost_duration(cost->seconds, duration, sizeof duration),
             cost->particle_steps_per_s / 1e6, cost->points, cost->curve_bytes / 1e6);
    return buffer;
}

bool gb_cost_check_limit(const struct gb_cost *cost, struct gb_error *err)
{
    char duration[48];
    return gb_cost_within_limit(cost->seconds) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "the run will take about %s: %.3g particle-steps at %.3gM/s; "
                        "repeat with --yes to start it",
                        gb_cost_duration(cost->seconds, duration, sizeof duration),
                        cost->particle_steps, cost->particle_steps_per_s / 1e6);
}

/* Strain of a quick step: three times the default.  Smaller steps would take longer than
 * two seconds; the error of larger ones would exceed the scatter between cells. */
static const double quick_step = 0.003;
/* Longest time of a quick dynamic run, s, and the fewest discs that give a curve. */
static const double dynamic_s = 1.5;
static const double count_least = 200.0;

static bool shrink_dynamic(struct gb_params *quick)
{
    struct gb_cost cost;
    quick->relax_s = 0.0;
    quick->hold_s = 0.0;
    if (!gb_cost_estimate(quick, gb_cost_rate_assumed(quick), &cost, NULL)) {
        return false;
    }
    if (cost.seconds > dynamic_s) {
        const double count = floor((double)quick->count * dynamic_s / cost.seconds);
        if (count < count_least) {
            return false;
        }
        quick->count = (int64_t)count;
    }
    return true;
}

bool gb_cost_quick(const struct gb_params *full, struct gb_params *quick)
{
    *quick = *full;
    const struct gb_lattice *lattice = gb_lattice_of(full->structure);
    if (quick->count > GB_QUICK_COUNT) {
        quick->count =
            lattice ? gb_lattice_count_below(lattice, GB_QUICK_COUNT) : GB_QUICK_COUNT;
        /* the base of a larger cell would make this one too flat */
        quick->base = (struct gb_relative){0.0, true};
    }
    quick->strain_step = fmax(quick->strain_step, quick_step);
    quick->unload_count = 0;
    quick->changes[0] = '\0'; /* they refer to other steps */
    quick->fidelity = GB_FIDELITY_FAST;
    quick->tolerance = NAN;
    quick->tolerance_scale = GB_TOLERANCE_CONTACT;
    quick->strain_part = NAN;
    quick->precision = GB_PRECISION_AUTO;
    snprintf(quick->relaxer, sizeof quick->relaxer, "auto");
    const struct gb_loading_kind *kind = gb_loading_kind_of(full);
    if (kind->follows_time && !(kind->given_rate && shrink_dynamic(quick))) {
        return false;
    }
    return gb_params_check(quick, NULL);
}

/* The reference takes the work of a small cell 36 times (run/cost.c). */
bool gb_cost_is_quick(const struct gb_params *full)
{
    struct gb_params quick;
    const bool slow = full->fidelity == GB_FIDELITY_REFERENCE &&
                      !gb_loading_kind_of(full)->follows_time;
    return gb_cost_quick(full, &quick) && full->count <= quick.count && !slow;
}
