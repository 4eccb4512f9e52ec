/* A run in a background thread, for the screen.  The engine thread computes a run of
 * its own; the follow thread reads the directory of a run that another process
 * computes.  Both pass snapshots and view samples to the screen without a lock
 * (publish.h) and read commands from a ring.  A paused engine sleeps on a condition
 * variable. */
#include "runner/runner.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "api/simulation_private.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/mat.h"
#include "base/team.h"
#include "greenbody/snapshot.h"
#include "io/curve_csv.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "io/state_forces.h"
#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "run/change.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "runner/publish.h"
#include "scene/field/changes.h"
#include "scene/loading_kind.h"

/* Largest distance of g(r), diameters: P1 finds no order beyond. */
static const double rdf_reach = 5.0;

/* Share of the array that is planned for, because the front may be denser than the mean. */
static const double filling = 0.9;

/* A slab less deep than this, measured from its front, would look full of holes. */
static const double depth_least = 2.5;

/* The part of the cell that is shown: all of its front, as deep as fits; of a very large
 * cell a corner of the front.  2D: the same in the plane. */
static void choose_window(const struct gb_state *state, double window[3])
{
    const double *edge = state->cell;
    const double part = fmin(1.0, filling * GB_VIEW_SAMPLE_POINTS / (double)state->count);
    memcpy(window, edge, 3 * sizeof *window);
    double share = part;
    if (state->dimension == 3) {
        window[1] = fmin(edge[1], fmax(depth_least, part * edge[1]));
        share = fmin(1.0, part * edge[1] / window[1]);
    }
    window[0] = sqrt(share) * edge[0];
    window[2] = sqrt(share) * edge[2];
}

/* The walls.  While the powder falls out of its funnel, the box keeps the size that it had at
 * first, so that the picture does not grow. */
static void describe_die(const struct gb_state *state, struct gb_view_start *start,
                         struct gb_view_sample *sample)
{
    const bool funnel = state->funnel_height > 0.0;
    const bool ends = isfinite(state->die_top);
    sample->die = (struct gb_view_die){
        .shown = true,
        .radius = state->die_radius,
        .top = funnel                         ? state->funnel_height
               : ends && state->die_top > 0.0 ? state->die_top
                                              : sample->window[2],
        .gone = ends && state->die_top <= 0.0,
        .funnel = funnel,
        .outlet = state->funnel_outlet,
        .funnel_slope = state->funnel_slope,
        .punch = isfinite(state->punch_height),
        .punch_height = isfinite(state->punch_height) ? state->punch_height : 0.0,
    };
    if (funnel) {
        start->half_width = fmax(start->half_width, 0.5 * sample->window[0]);
        start->height = fmax(start->height, sample->window[2]);
        sample->window[0] = 2.0 * start->half_width;
        sample->window[2] = start->height;
    }
}

/* Distance from where the particle was; in a cell without its affine motion. */
static double displacement(const struct gb_state *state, const struct gb_cell *cell,
                           const struct gb_view_start *start, int64_t i)
{
    const double *now = state->position + 3 * i, *then = start->position + 3 * i;
    const double *edge = start->cell.edge;
    double moved[3];
    if (start->count != state->count) {
        return 0.0;
    }
    if (gb_cell_tilted(cell) || gb_cell_tilted(&start->cell)) {
        const struct gb_deformation motion = gb_cell_motion(&start->cell, cell);
        gb_mat_apply(motion.f, then, moved);
        for (int c = 0; c < 3; c++) {
            moved[c] = now[c] - moved[c];
        }
        gb_cell_nearest(cell, moved);
        return gb_vec_length(moved);
    }
    for (int c = 0; c < 3; c++) {
        const double scale = state->die_radius > 0.0 ? 1.0 : cell->edge[c] / edge[c];
        const double middle =
            state->die_radius > 0.0 && c < 2 ? 0.5 * (cell->edge[c] - edge[c]) : 0.0;
        moved[c] = now[c] - middle - scale * then[c];
    }
    if (!(state->die_radius > 0.0)) {
        gb_cell_nearest(cell, moved);
    }
    return gb_vec_length(moved);
}

/* The image of a particle in the upright box of the edges, which holds one image of every
 * particle whatever the tilts. */
static void put_upright(const struct gb_cell *cell, double x[3])
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    for (int k = 2; k >= 0; k--) {
        const double whole = cell->periodic[k] ? floor(x[k] / cell->edge[k]) : 0.0;
        for (int c = 0; c <= k; c++) {
            x[c] -= whole * matrix[c][k];
        }
    }
}

/* Particles of the window.  A periodic cell is cut at y = 0; a die through its middle, unless
 * all of its particles fit. */
static void copy_front(const struct gb_state *state, const struct gb_view_start *start,
                       const double *stress, struct gb_view_sample *sample)
{
    const double cut = sample->die.shown ? 0.5 * state->cell[1] : 0.0;
    const double shift =
        sample->die.shown ? 0.5 * (sample->window[0] - state->cell[0]) : 0.0;
    const struct gb_cell cell = gb_state_cell(state);
    const bool tilted = gb_cell_tilted(&cell);
    sample->whole = sample->die.shown && state->count <= GB_VIEW_SAMPLE_POINTS;
    for (int64_t i = 0; i < state->count && sample->count < GB_VIEW_SAMPLE_POINTS; i++) {
        const double *at = state->position + 3 * i;
        double position[3] = {at[0] + shift, at[1] - cut, at[2]};
        if (tilted) {
            put_upright(&cell, position);
        }
        bool inside = position[1] >= 0.0;
        for (int c = 0; c < 3; c++) {
            inside = inside && position[c] <= sample->window[c];
        }
        if (inside || sample->whole) {
            const int k = sample->count++;
            for (int c = 0; c < 3; c++) {
                sample->position[k][c] = (float)position[c];
            }
            sample->radius[k] = (float)state->radius[i];
            sample->value[GB_VIEW_VALUE_CONTACTS][k] = (float)state->contacts[i];
            sample->value[GB_VIEW_VALUE_PRESSURE][k] =
                stress != NULL ? (float)(1e-6 * stress[i]) : NAN;
            sample->value[GB_VIEW_VALUE_DISPLACEMENT][k] =
                (float)displacement(state, &cell, start, i);
        }
    }
}

/* g(r), in periodic cells only: layers at walls would distort it. */
static void measure_distances(const struct gb_state *state, struct gb_view_sample *sample)
{
    const struct gb_cell cell = gb_state_cell(state);
    const double reach = fmin(rdf_reach, 0.499 * gb_cell_shortest(&cell));
    if (gb_structure_rdf(&cell, state->count, state->position, reach, GB_VIEW_SAMPLE_RDF,
                         sample->rdf, NULL)) {
        sample->rdf_reach = reach;
    }
}

void gb_runner_view_start_finish(struct gb_view_start *start)
{
    gb_alloc_free(start->position);
    *start = (struct gb_view_start){.count = 0};
}

/* At the first sample, and again when pressing has begun. */
static void note_start(const struct gb_state *state, bool pressed,
                       struct gb_view_start *start)
{
    const size_t bytes = 3 * (size_t)state->count * sizeof *start->position;
    if (start->count == state->count && start->pressed == pressed) {
        return;
    }
    if (start->position == NULL) {
        start->position =
            gb_alloc_array((size_t)state->count, 3 * sizeof *start->position, NULL);
    }
    if (start->position != NULL) {
        memcpy(start->position, state->position, bytes);
        start->cell = gb_state_cell(state);
        start->count = state->count;
        start->pressed = pressed;
    }
}

void gb_runner_view_of_state(const struct gb_state *state, bool pressed,
                             struct gb_view_start *start, struct gb_view_sample *sample)
{
    const bool in_die = state->die_radius > 0.0;
    sample->dimension = state->dimension;
    sample->density = state->point.density;
    sample->count = 0;
    sample->rdf_reach = 0.0;
    sample->die.shown = false;
    memcpy(sample->edge, state->cell, sizeof sample->edge);
    choose_window(state, sample->window);
    if (in_die) {
        memcpy(sample->window, state->cell, sizeof sample->window);
        describe_die(state, start, sample);
    }
    note_start(state, pressed, start);
    struct gb_state_gaps gaps = {0};
    double *stress = gb_state_forces_gaps_init(&gaps, state, NULL)
                         ? gb_alloc_array((size_t)state->count, sizeof *stress, NULL)
                         : NULL;
    if (stress != NULL) {
        gb_state_forces_stress_mean(state, &gaps, stress);
    }
    gb_state_forces_gaps_finish(&gaps);
    copy_front(state, start, stress, sample);
    gb_alloc_free(stress);
    if (!in_die) {
        measure_distances(state, sample);
    }
    sample->valid = true;
}

/* What the screen's views of a packing need, taken between two slices: the particles
 * nearest to the front (y = 0), as many as fit, and g(r).  Costs a pass over all
 * particles and their near neighbours; without memory a part of it is missing. */
static void view_sampling_take(const struct gb_experiment *experiment,
                               struct gb_view_start *start, struct gb_view_sample *sample)
{
    struct gb_state *state = NULL;
    sample->valid = false;
    if (gb_experiment_state(experiment, &state, NULL)) {
        const bool pressed = gb_experiment_bed(experiment) == NULL ||
                             gb_experiment_point(experiment)->height_m > 0.0;
        gb_runner_view_of_state(state, pressed, start, sample);
        gb_state_destroy(state);
    }
}

enum { EVENTS = 256 }; /* the last ones are kept */

struct gb_runner {
    /* const once the thread runs */
    struct gb_params params;
    struct gb_simulation *simulation; /* used by the thread, except for the curve */
    char *directory;                  /* NULL: not recorded */
    bool resumed;                     /* continues the run in its directory */
    pthread_t thread;
    bool joined; /* the thread was joined; used by the screen */

    /* shared without a lock: see publish.h */
    struct gb_publish publish;
    struct gb_publish_slots view_slots; /* for the view samples */
    struct gb_view_sample view[3];
    struct gb_view_start view_start; /* used by the thread only */
    struct gb_command_ring ring;

    /* guarded by the mutex: a paused engine sleeps on wake */
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool quit;
    int64_t stored;          /* number of GB_COMMAND_STORE done */
    bool forked;             /* record holds the requested state */
    size_t forked_points;    /* points of the curve at that state */
    struct gb_record record; /* used by the engine until forked, then by the screen */
    int64_t events;          /* number of events so far */
    char event[EVENTS][GB_EVENT_TEXT];

    /* used by the thread only */
    bool paused, stop;
    bool yielded;      /* sleeps while another engine computes */
    bool view_wanted;  /* view samples are taken */
    bool store_wanted; /* write state.h5 after the present slice */
    bool fork_wanted;  /* hand over the state of the next loading point */
    double published_s, publish_cost_s; /* clock reading; time to fill it, s */
    double sampled_s, sample_cost_s;    /* the same for the view sample */
};

/* The run loop of the simulation. */
static struct gb_run_loop *loop_of(const struct gb_runner *runner)
{
    return &runner->simulation->loop;
}

/* --- what the threads publish ------------------------------------------------------- */

/* Shortest interval between snapshots (s), and their largest fraction of the engine's
 * time.  The screen draws at most ten frames per second, and each snapshot costs a
 * sweep over the contacts. */
static const double publish_every_s = 0.05, publish_share = 0.1;

/* The same for view samples, which change slowly and cost more. */
static const double view_every_s = 0.25, view_share = 0.03;

/* Counts a GB_COMMAND_STORE as done. */
static void publish_stored(struct gb_runner *runner)
{
    runner->store_wanted = false;
    pthread_mutex_lock(&runner->mutex);
    runner->stored++;
    pthread_mutex_unlock(&runner->mutex);
}

/* Adds to the list of events that the screen reads. */
static void publish_event(struct gb_runner *runner, const char *text)
{
    pthread_mutex_lock(&runner->mutex);
    g_strlcpy(runner->event[runner->events % EVENTS], text, GB_EVENT_TEXT);
    runner->events++;
    pthread_mutex_unlock(&runner->mutex);
}

/* Publishes a snapshot with the events of the runner.  These include pauses and disk
 * errors, which events.log lacks, but none from before a resume. */
static void publish_snapshot(struct gb_runner *runner)
{
    struct gb_snapshot *shown = gb_publish_back(&runner->publish);
    *shown = loop_of(runner)->snapshot;
    pthread_mutex_lock(&runner->mutex);
    shown->events = runner->events;
    if (runner->events > 0) {
        memcpy(shown->event, runner->event[(runner->events - 1) % EVENTS], GB_EVENT_TEXT);
    }
    pthread_mutex_unlock(&runner->mutex);
    gb_publish_swap(&runner->publish);
    runner->published_s = gb_clock_s();
}

static void observe(struct gb_runner *runner, enum gb_run_state state)
{
    const double before = gb_clock_s();
    gb_run_loop_observe(loop_of(runner), state);
    runner->publish_cost_s = gb_clock_s() - before;
    publish_snapshot(runner);
}

static void publish_view(struct gb_runner *runner)
{
    const double before = gb_clock_s();
    if (loop_of(runner)->experiment == NULL || !runner->view_wanted) {
        return;
    }
    view_sampling_take(loop_of(runner)->experiment, &runner->view_start,
                       &runner->view[runner->view_slots.back]);
    gb_publish_slots_swap(&runner->view_slots);
    runner->sampled_s = gb_clock_s();
    runner->sample_cost_s = runner->sampled_s - before;
}

/* Publishes a view sample of a state from a file. */
static void publish_view_of(struct gb_runner *runner, const struct gb_state *state)
{
    gb_runner_view_of_state(state, true, &runner->view_start,
                            &runner->view[runner->view_slots.back]);
    gb_publish_slots_swap(&runner->view_slots);
}

/* Observes the run and publishes it.  The view sample goes first, so that both show the
 * same state. */
static void publish_state(struct gb_runner *runner, enum gb_run_state state)
{
    publish_view(runner);
    observe(runner, state);
}

static void publish_view_if_due(struct gb_runner *runner)
{
    const double every = fmax(view_every_s, runner->sample_cost_s / view_share);
    if (gb_clock_s() - runner->sampled_s >= every) {
        publish_view(runner);
    }
}

static void publish_if_due(struct gb_runner *runner, enum gb_run_state state)
{
    const double every = fmax(publish_every_s, runner->publish_cost_s / publish_share);
    if (gb_clock_s() - runner->published_s >= every) {
        observe(runner, state);
    }
}

/* --- the engine thread -------------------------------------------------------------- */

/* Reason given for GB_COMMAND_STOP. */
static const char stopped[] = "stopped on request";

static void obey(struct gb_runner *runner, struct gb_command command)
{
    switch (command.kind) {
    case GB_COMMAND_PAUSE:
        runner->paused = true;
        break;
    case GB_COMMAND_RESUME:
        runner->paused = false;
        break;
    case GB_COMMAND_STOP:
        runner->stop = true;
        break;
    case GB_COMMAND_WATCH:
        runner->view_wanted = true;
        break;
    case GB_COMMAND_FORK:
        runner->fork_wanted = true;
        break;
    case GB_COMMAND_YIELD:
        runner->yielded = true;
        break;
    case GB_COMMAND_CONTINUE:
        runner->yielded = false;
        break;
    case GB_COMMAND_STORE:
        runner->store_wanted = true;
        break;
    }
}

/* Handles all commands in the ring. */
static void drain(struct gb_runner *runner)
{
    struct gb_command command;
    while (gb_command_ring_pop(&runner->ring, &command)) {
        obey(runner, command);
    }
    pthread_mutex_lock(&runner->mutex);
    runner->stop = runner->stop || runner->quit;
    pthread_mutex_unlock(&runner->mutex);
}

/* Is a state to be stored?  A run without a recorded point has none yet. */
static bool store_is_due(const struct gb_runner *runner)
{
    const struct gb_run_recorder *recorder = loop_of(runner)->recorder;
    return runner->store_wanted &&
           (recorder == NULL || gb_run_recorder_points(recorder) > 0);
}

static void store_if_due(struct gb_runner *runner)
{
    if (store_is_due(runner)) {
        gb_run_loop_store(loop_of(runner));
        publish_stored(runner);
    }
}

/* Sleeps until a command clears the reason.  The time is excluded from the run's time. */
static void sleep_while(struct gb_runner *runner, const bool *reason)
{
    const double from = gb_clock_s();
    pthread_mutex_lock(&runner->mutex);
    while (*reason && !runner->stop) {
        struct gb_command command;
        if (runner->quit) {
            runner->stop = true;
        } else if (store_is_due(runner)) {
            pthread_mutex_unlock(&runner->mutex);
            store_if_due(runner);
            pthread_mutex_lock(&runner->mutex);
        } else if (gb_command_ring_pop(&runner->ring, &command)) {
            obey(runner, command);
        } else {
            pthread_cond_wait(&runner->wake, &runner->mutex);
        }
    }
    pthread_mutex_unlock(&runner->mutex);
    gb_run_loop_exclude(loop_of(runner), gb_clock_s() - from);
}

static void sleep_paused(struct gb_runner *runner)
{
    publish_event(runner, "paused");
    publish_state(runner, GB_RUN_PAUSED);
    gb_run_loop_save(loop_of(runner));
    sleep_while(runner, &runner->paused);
    if (!runner->stop) {
        publish_event(runner, "resumed");
        publish_state(runner, GB_RUN_RUNNING);
    }
}

static void cancel_if_stopped(struct gb_runner *runner)
{
    if (runner->stop) {
        gb_simulation_cancel(runner->simulation, stopped);
    }
}

static void between_slices(void *data)
{
    struct gb_runner *runner = data;
    drain(runner);
    store_if_due(runner);
    if (runner->yielded && !runner->stop) {
        sleep_while(runner, &runner->yielded);
    }
    if (runner->paused && !runner->stop) {
        sleep_paused(runner);
    }
    cancel_if_stopped(runner);
}

static void on_event(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text)
{
    (void)simulation;
    (void)step;
    publish_event(data, text);
}

static bool is_unloading(const struct gb_record *record)
{
    const struct gb_record_item *branch = gb_record_find(record, "load/branch");
    return branch != NULL && *(const int32_t *)branch->data > 0;
}

/* Hands over the state at a point of the loading branch if it was requested and the
 * previous one has been taken. */
static void hand_over(struct gb_runner *runner, const struct gb_point *point)
{
    struct gb_error err = {0};
    pthread_mutex_lock(&runner->mutex);
    const bool forked = runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (!runner->fork_wanted || point->branch > 0 || forked) {
        return;
    }
    if (!gb_checkpoint_take(loop_of(runner)->experiment, &runner->record, &err)) {
        runner->fork_wanted = false;
        publish_event(runner, err.text);
        return;
    }
    if (is_unloading(&runner->record)) {
        return; /* an unloading begins here: wait for the next point */
    }
    runner->fork_wanted = false;
    pthread_mutex_lock(&runner->mutex);
    runner->forked = true;
    runner->forked_points = gb_simulation_points(runner->simulation);
    pthread_mutex_unlock(&runner->mutex);
}

static void on_point(void *data, struct gb_simulation *simulation,
                     const struct gb_point *point)
{
    (void)simulation;
    hand_over(data, point);
}

/* Also called while the packing is built. */
static void on_progress(void *data, struct gb_simulation *simulation, double share)
{
    struct gb_runner *runner = data;
    (void)share;
    if (simulation->loop.experiment == NULL) {
        drain(runner);
        publish_if_due(runner, GB_RUN_PACKING);
        cancel_if_stopped(runner);
        return;
    }
    publish_view_if_due(runner);
    publish_if_due(runner, GB_RUN_RUNNING);
}

/* Publishes the end when the last files are written, so that pictures, reports and
 * measurements of the run work at once. */
static void on_end(void *data)
{
    publish_view(data); /* before the state, so that both are available together */
}

/* In the workbench a run continues without its directory. */
static bool on_record_error(void *data, const struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    snprintf(text, sizeof text, "no longer recorded: %s", err->text);
    publish_event(data, text);
    return true;
}

/* Creates the recorder of a new run in its directory; without a directory nothing is
 * recorded. */
static void create_recorder(struct gb_runner *runner)
{
    char text[GB_EVENT_TEXT];
    struct gb_error err = {0};
    if (runner->directory == NULL) {
        return;
    }
    if (gb_simulation_start_record(runner->simulation, runner->directory, GB_RUNDIR_KEEP,
                                   &err)) {
        snprintf(text, sizeof text, "recorded in %s", runner->directory);
    } else {
        snprintf(text, sizeof text, "not recorded: %s", err.text);
    }
    publish_event(runner, text);
    gb_run_loop_inherit(loop_of(runner), gb_runner_curve(runner));
}

/* Waits for the lock.  The engine that holds it has been asked to stop. */
static bool wait_for_lock(struct gb_runner *runner, struct gb_error *err)
{
    while (gb_rundir_busy(runner->directory)) {
        drain(runner);
        publish_if_due(runner, GB_RUN_PACKING);
        if (runner->stop) {
            return gb_error_set(err, GB_ERR_CANCELLED, "%s", stopped);
        }
        g_usleep(50000);
    }
    return true;
}

static bool begin(struct gb_runner *runner, struct gb_error *err)
{
    if (runner->resumed) {
        return wait_for_lock(runner, err) &&
               gb_simulation_open(runner->simulation, runner->directory,
                                  GB_RUN_RECORDER_LAST, err) &&
               gb_simulation_build(runner->simulation, err);
    }
    if (!gb_simulation_build(runner->simulation, err)) {
        return false;
    }
    create_recorder(runner);
    return true;
}

static void fail_to_begin(struct gb_runner *runner, const struct gb_error *err)
{
    struct gb_run_loop *loop = loop_of(runner);
    gb_simulation_release(runner->simulation);
    gb_run_loop_observe(loop, gb_run_loop_state(gb_run_loop_outcome(err)));
    loop->snapshot.error = *err;
    publish_snapshot(runner);
}

static void listen(struct gb_runner *runner)
{
    struct gb_simulation *simulation = runner->simulation;
    gb_simulation_on_event(simulation, on_event, runner);
    gb_simulation_on_point(simulation, on_point, runner);
    gb_simulation_on_progress(simulation, on_progress, runner, 0.0);
    gb_simulation_set_hooks(
        simulation, &(struct gb_simulation_hooks){.between_slices = between_slices,
                                                  .on_end = on_end,
                                                  .on_record_error = on_record_error,
                                                  .data = runner});
}

static void *engine_thread(void *data)
{
    struct gb_runner *runner = data;
    struct gb_error err = {0};
    listen(runner);
    if (!begin(runner, &err)) {
        fail_to_begin(runner, &err);
        return NULL;
    }
    publish_state(runner, GB_RUN_RUNNING);
    (void)gb_simulation_advance(runner->simulation, INT64_MAX,
                                &err); /* the snapshot has the error */
    publish_snapshot(runner);
    gb_simulation_release(runner->simulation);
    return NULL;
}

/* --- the follow thread -------------------------------------------------------------- */

/* Interval between two reads of the directory, s. */
static const double follow_every_s = 0.4;
/* Age of an unchanged status at which the lock is tested for a living engine, s. */
static const double silence_s = 5.0;

/* Largest fraction of the time spent on reading states; reading a million particles
 * takes seconds. */
static const double state_share = 0.1;

/* What the follow thread has seen so far. */
struct seen {
    double changed_s;      /* clock at the last change of the status */
    GStatBuf state;        /* the last state.h5 */
    double read_s, cost_s; /* clock when it was read, and the time it took; 0: none */
};

/* Reads the directory into the snapshot and the curve.  True: the engine has ended. */
static bool read_run(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &loop_of(runner)->snapshot;
    const int64_t events = shown->events;
    struct gb_follow_engine engine = {0};
    struct gb_error err = {0};
    if (!gb_follow_status(runner->directory, shown, &engine, &err) ||
        !gb_curve_csv_read(runner->directory, &runner->params, runner->simulation->curve,
                           &err)) {
        if (shown->error.code == GB_OK) {
            publish_event(runner, err.text);
        }
        shown->error = err;
    }
    const size_t points = gb_curve_count(runner->simulation->curve);
    shown->now_valid = points > 0;
    if (points > 0) {
        shown->now = *gb_curve_at(runner->simulation->curve, points - 1);
    }
    if (shown->events > events && shown->event[0] != '\0') {
        publish_event(runner, shown->event);
    }
    return gb_follow_engine_gone(&engine);
}

static void lose_directory(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &loop_of(runner)->snapshot;
    gb_error_set(&shown->error, GB_ERR_MACHINE,
                 "%s: was moved or removed while it was shown", runner->directory);
    publish_event(runner, shown->error.text);
    shown->state = GB_RUN_FAILED;
}

/* Reports an engine that ended without a final status.  If its files cannot be read,
 * that was reported already. */
static void tell_end(struct gb_runner *runner)
{
    struct gb_snapshot *shown = &loop_of(runner)->snapshot;
    const enum gb_status told = shown->error.code;
    if (told == GB_OK || told == GB_ERR_CANCELLED) { /* none, or one from status.json */
        gb_error_set(&shown->error, GB_ERR_CANCELLED,
                     "its engine has ended without a final status: t here or `greenbody "
                     "resume %s` continues the run",
                     runner->directory);
        publish_event(runner, shown->error.text);
    }
}

/* Reads the directory.  False if no engine works there any more. */
static bool refresh(struct gb_runner *runner, struct seen *seen)
{
    struct gb_snapshot *shown = &loop_of(runner)->snapshot;
    const double seconds = shown->seconds;
    const enum gb_run_state state = shown->state;
    if (!g_file_test(runner->directory, G_FILE_TEST_IS_DIR)) {
        lose_directory(runner);
        return false;
    }
    /* read again: the last status may have been written after the first read */
    const bool gone =
        read_run(runner) && shown->state <= GB_RUN_PAUSED && read_run(runner);
    if (shown->seconds != seconds || shown->state != state) {
        seen->changed_s = gb_clock_s();
    }
    if (shown->state <= GB_RUN_PAUSED &&
        (gone || gb_clock_s() - seen->changed_s > silence_s) &&
        !gb_rundir_busy(runner->directory)) {
        tell_end(runner);
        shown->state = GB_RUN_STOPPED;
    }
    return shown->state <= GB_RUN_PAUSED;
}

/* Is it the same file?  A replaced file has another inode, time or size. */
static bool is_same(const GStatBuf *a, const GStatBuf *b)
{
    return a->st_ino == b->st_ino && a->st_mtime == b->st_mtime &&
           a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_size == b->st_size;
}

/* Publishes the packing of a new state.h5.  If it cannot be read, publishes one event. */
static void show_state(struct gb_runner *runner, struct seen *seen)
{
    const double from_s = gb_clock_s();
    const double wait_s = seen->cost_s / state_share;
    char *path = g_build_filename(runner->directory, "state.h5", NULL);
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    GStatBuf now;
    if ((seen->cost_s > 0.0 && from_s - seen->read_s < wait_s) ||
        g_stat(path, &now) != 0 || is_same(&now, &seen->state)) {
        g_free(path);
        return;
    }
    if (gb_state_read(&state, path, &err)) {
        publish_view_of(runner, state);
    } else {
        publish_event(runner, err.text);
    }
    gb_state_destroy(state);
    g_free(path);
    seen->state = now;
    seen->read_s = gb_clock_s();
    seen->cost_s = seen->read_s - from_s;
}

static void wait_for_next(struct gb_runner *runner)
{
    const double until = gb_clock_s() + follow_every_s;
    while (!runner->stop && gb_clock_s() < until) {
        drain(runner);
        if (runner->store_wanted) {
            publish_stored(runner);
        }
        g_usleep(100000);
    }
}

static void *follow_thread(void *data)
{
    struct gb_runner *runner = data;
    struct seen seen = {.changed_s = gb_clock_s()};
    bool more = true;
    while (more && !runner->stop) {
        more = refresh(runner, &seen);
        seen.cost_s = more ? seen.cost_s : 0.0; /* always show the last state */
        show_state(runner, &seen);
        publish_snapshot(runner);
        if (more) {
            wait_for_next(runner);
        }
    }
    return NULL;
}

/* --- calls of the screen ------------------------------------------------------------ */

static void free_runner(struct gb_runner *runner)
{
    gb_record_finish(&runner->record);
    gb_runner_view_start_finish(&runner->view_start);
    gb_simulation_destroy(runner->simulation);
    g_free(runner->directory);
    gb_alloc_free(runner);
}

/* Creates a runner, which takes ownership of the simulation.  On error it destroys the
 * simulation. */
static struct gb_runner *wrap(struct gb_simulation *simulation, const char *directory,
                              struct gb_error *err)
{
    struct gb_runner *runner = gb_alloc_array(1, sizeof *runner, err);
    if (runner == NULL) {
        gb_simulation_destroy(simulation);
        return NULL;
    }
    runner->simulation = simulation;
    runner->params = simulation->params;
    runner->directory = g_strdup(directory);
    gb_publish_init(&runner->publish);
    gb_publish_slots_init(&runner->view_slots);
    gb_command_ring_init(&runner->ring);
    return runner;
}

static struct gb_runner *create(const struct gb_params *params, const char *directory,
                                struct gb_error *err)
{
    struct gb_simulation *simulation = NULL;
    return gb_simulation_create_from(&simulation, params, err)
               ? wrap(simulation, directory, err)
               : NULL;
}

static bool launch(struct gb_runner **out, struct gb_runner *runner,
                   void *(*work)(void *data), struct gb_error *err)
{
    pthread_mutex_init(&runner->mutex, NULL);
    pthread_cond_init(&runner->wake, NULL);
    publish_state(runner, GB_RUN_PACKING);
    if (!gb_team_start_thread(&runner->thread, work, runner, "the engine thread", err)) {
        pthread_cond_destroy(&runner->wake);
        pthread_mutex_destroy(&runner->mutex);
        free_runner(runner);
        return false;
    }
    *out = runner;
    return true;
}

bool gb_runner_create(struct gb_runner **out, const struct gb_params *params,
                      struct gb_error *err)
{
    return gb_runner_create_in(out, params, NULL, err);
}

bool gb_runner_forked(struct gb_runner *runner, int64_t *step)
{
    pthread_mutex_lock(&runner->mutex);
    const bool forked = runner->forked;
    pthread_mutex_unlock(&runner->mutex);
    if (forked && step != NULL) {
        *step = gb_checkpoint_step(&runner->record) - 1;
    }
    return forked;
}

bool gb_runner_create_fork(struct gb_runner **out, const char *changes,
                           struct gb_runner *parent, const char *directory,
                           struct gb_error *err)
{
    struct gb_params changed = parent->params;
    int64_t step = 0;
    if (!gb_runner_forked(parent, &step)) {
        return gb_error_set(err, GB_ERR_INPUT, "the run has not handed over its state");
    }
    if (!gb_changes_add(&changed, step, changes, err) ||
        !gb_change_allowed(&parent->params, &changed, step, err)) {
        return false;
    }
    struct gb_simulation *simulation = NULL;
    if (!gb_simulation_create_fork(&simulation, &changed, &parent->record,
                                   gb_runner_curve(parent), parent->forked_points, err)) {
        return false;
    }
    pthread_mutex_lock(&parent->mutex);
    parent->forked = false;
    pthread_mutex_unlock(&parent->mutex);
    struct gb_runner *runner = wrap(simulation, directory, err);
    return runner != NULL && launch(out, runner, engine_thread, err);
}

bool gb_runner_create_in(struct gb_runner **out, const struct gb_params *params,
                         const char *directory, struct gb_error *err)
{
    struct gb_runner *runner = create(params, directory, err);
    return runner != NULL && launch(out, runner, engine_thread, err);
}

bool gb_runner_resume(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner = NULL;
    if (!gb_follow_params(directory, &params, err) ||
        (gb_rundir_busy(directory) && !gb_follow_request_stop(directory, err))) {
        return false;
    }
    runner = create(&params, directory, err);
    if (runner == NULL) {
        return false;
    }
    runner->resumed = true;
    return launch(out, runner, engine_thread, err);
}

bool gb_runner_follow(struct gb_runner **out, const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_runner *runner = gb_follow_params(directory, &params, err)
                                   ? create(&params, directory, err)
                                   : NULL;
    return runner != NULL && launch(out, runner, follow_thread, err);
}

const char *gb_runner_directory(const struct gb_runner *runner)
{
    return runner->directory;
}

void gb_runner_stop(struct gb_runner *runner)
{
    if (runner->joined) {
        return;
    }
    pthread_mutex_lock(&runner->mutex);
    runner->quit = true;
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    pthread_join(runner->thread, NULL);
    runner->joined = true;
}

void gb_runner_destroy(struct gb_runner *runner)
{
    if (runner == NULL) {
        return;
    }
    gb_runner_stop(runner);
    pthread_cond_destroy(&runner->wake);
    pthread_mutex_destroy(&runner->mutex);
    free_runner(runner);
}

bool gb_runner_send(struct gb_runner *runner, enum gb_command_kind kind)
{
    if (!gb_command_ring_push(&runner->ring, (struct gb_command){kind})) {
        return false;
    }
    /* under the mutex, so that the engine cannot miss it between its test and its wait */
    pthread_mutex_lock(&runner->mutex);
    pthread_cond_signal(&runner->wake);
    pthread_mutex_unlock(&runner->mutex);
    return true;
}

int64_t gb_runner_stored(struct gb_runner *runner)
{
    pthread_mutex_lock(&runner->mutex);
    const int64_t stored = runner->stored;
    pthread_mutex_unlock(&runner->mutex);
    return stored;
}

const struct gb_snapshot *gb_runner_snapshot(struct gb_runner *runner, bool *changed)
{
    const bool fresh = gb_publish_take(&runner->publish);
    if (changed != NULL) {
        *changed = fresh;
    }
    return gb_publish_front(&runner->publish);
}

const struct gb_view_sample *gb_runner_view_sample(struct gb_runner *runner,
                                                   bool *changed)
{
    const bool fresh = gb_publish_slots_take(&runner->view_slots);
    if (changed != NULL) {
        *changed = fresh;
    }
    return &runner->view[runner->view_slots.front];
}

const struct gb_curve *gb_runner_curve(const struct gb_runner *runner)
{
    return runner->simulation->curve;
}

const struct gb_params *gb_runner_params(const struct gb_runner *runner)
{
    return &runner->params;
}

bool gb_runner_event(struct gb_runner *runner, int64_t index, char *text, size_t size)
{
    pthread_mutex_lock(&runner->mutex);
    const bool kept =
        index >= 0 && index < runner->events && runner->events - index <= EVENTS;
    if (kept) {
        snprintf(text, size, "%s", runner->event[index % EVENTS]);
    }
    pthread_mutex_unlock(&runner->mutex);
    return kept;
}
