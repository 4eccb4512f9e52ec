#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "runner/runner_private.h"
#include "runner/view_sampling.h"

/* The screen draws at most ten frames per second, and each snapshot costs a sweep over
 * the contacts: the shortest interval (s), and the largest share of the engine's time. */
static const double publish_every_s = 0.05, publish_share = 0.1;

/* The same for view samples, which change slowly and cost more. */
static const double view_every_s = 0.25, view_share = 0.03;

void gb_runner_publish_stored(struct gb_runner *runner)
{
    runner->store_wanted = false;
    pthread_mutex_lock(&runner->mutex);
    runner->stored++;
    pthread_mutex_unlock(&runner->mutex);
}

void gb_runner_publish_event(struct gb_runner *runner, const char *text)
{
    pthread_mutex_lock(&runner->mutex);
    g_strlcpy(runner->event[runner->events % GB_RUNNER_EVENTS], text, GB_EVENT_TEXT);
    runner->events++;
    pthread_mutex_unlock(&runner->mutex);
}

/* The screen shows the list of events of the runner, which has more than events.log
 * (pauses, disk errors), and none from before a resume. */
void gb_runner_publish_snapshot(struct gb_runner *runner)
{
    struct gb_snapshot *shown = gb_publish_back(&runner->publish);
    *shown = gb_runner_loop(runner)->snapshot;
    pthread_mutex_lock(&runner->mutex);
    shown->events = runner->events;
    if (runner->events > 0) {
        memcpy(shown->event, runner->event[(runner->events - 1) % GB_RUNNER_EVENTS],
               GB_EVENT_TEXT);
    }
    pthread_mutex_unlock(&runner->mutex);
    gb_publish_swap(&runner->publish);
    runner->published_s = gb_clock_s();
}

static void observe(struct gb_runner *runner, enum gb_run_state state)
{
    const double before = gb_clock_s();
    gb_run_loop_observe(gb_runner_loop(runner), state);
    runner->publish_cost_s = gb_clock_s() - before;
    gb_runner_publish_snapshot(runner);
}

void gb_runner_publish_view(struct gb_runner *runner)
{
    const double before = gb_clock_s();
    if (gb_runner_loop(runner)->experiment == NULL || !runner->view_wanted) {
        return;
    }
    gb_view_sampling_take(gb_runner_loop(runner)->experiment, &runner->view_start,
                        &runner->view[runner->view_slots.back]);
    gb_publish_slots_swap(&runner->view_slots);
    runner->sampled_s = gb_clock_s();
    runner->sample_cost_s = runner->sampled_s - before;
}

void gb_runner_publish_view_of(struct gb_runner *runner, const struct gb_state *state)
{
    gb_view_sampling_take_state(state, true, &runner->view_start,
                                &runner->view[runner->view_slots.back]);
    gb_publish_slots_swap(&runner->view_slots);
}

void gb_runner_publish_state(struct gb_runner *runner, enum gb_run_state state)
{
    gb_runner_publish_view(runner);
    observe(runner, state);
}

void gb_runner_publish_view_if_due(struct gb_runner *runner)
{
    const double every = fmax(view_every_s, runner->sample_cost_s / view_share);
    if (gb_clock_s() - runner->sampled_s >= every) {
        gb_runner_publish_view(runner);
    }
}

void gb_runner_publish_if_due(struct gb_runner *runner, enum gb_run_state state)
{
    const double every = fmax(publish_every_s, runner->publish_cost_s / publish_share);
    if (gb_clock_s() - runner->published_s >= every) {
        observe(runner, state);
    }
}
