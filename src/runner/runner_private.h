#ifndef GB_RUNNER_PRIVATE_H
#define GB_RUNNER_PRIVATE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

#include "api/simulation_private.h"
#include "runner/publish.h"
#include "runner/runner.h"
#include "runner/view_sampling.h"

/* Members of gb_runner, for runner.c (creation, calls of the screen's thread),
 * engine_thread.c and follow_thread.c (the two threads) and runner_publish.c (what the
 * threads publish). */

enum { GB_RUNNER_EVENTS = 256 }; /* the last ones are kept */

struct gb_runner {
    /* const once the thread runs */
    struct gb_params params;
    struct gb_simulation *simulation; /* of the thread, except for the curve */
    char *directory;                  /* NULL: not recorded */
    bool resumed;                     /* continues the run in its directory */
    pthread_t thread;
    bool joined; /* the thread has ended; of the screen */

    /* shared without a lock: see publish.h */
    struct gb_publish publish;
    struct gb_publish_slots view_slots; /* of the view samples */
    struct gb_view_sample view[3];
    struct gb_view_start view_start; /* of the thread alone */
    struct gb_command_ring ring;

    /* guarded by the mutex: a paused engine sleeps on wake */
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool quit;
    int64_t stored;          /* GB_COMMAND_STORE done so far */
    bool forked;             /* record holds the requested state */
    size_t forked_points;    /* of the curve, at that state */
    struct gb_record record; /* of the engine until forked, then of the screen */
    int64_t events;          /* number of all so far */
    char event[GB_RUNNER_EVENTS][GB_EVENT_TEXT];

    /* of the thread alone */
    bool paused, stop;
    bool yielded;      /* sleeps while another engine computes */
    bool view_wanted;  /* view samples are taken */
    bool store_wanted; /* state.h5 is written between two slices */
    bool fork_wanted;  /* the state of the next loading point is handed over */
    double published_s, publish_cost_s; /* clock reading; seconds that filling took */
    double sampled_s, sample_cost_s;    /* the same of the view sample */
};

/* The threads' work, for gb_thread_start; data is the runner. */
void *gb_engine_thread(void *data);
void *gb_follow_thread(void *data);

/* What the simulation keeps of the run. */
struct gb_run_loop *gb_runner_loop(const struct gb_runner *runner);

/* Takes all commands from the ring. */
void gb_engine_thread_drain(struct gb_runner *runner);

/* GB_COMMAND_STORE is done. */
void gb_runner_publish_stored(struct gb_runner *runner);
/* Adds to the list of events that the screen reads. */
void gb_runner_publish_event(struct gb_runner *runner, const char *text);
/* Hands the loop's snapshot to the screen as it is. */
void gb_runner_publish_snapshot(struct gb_runner *runner);
/* Observes the run and publishes; before that a view sample, so that both show the same
 * state. */
void gb_runner_publish_state(struct gb_runner *runner, enum gb_run_state state);
void gb_runner_publish_view(struct gb_runner *runner);
/* A view sample of a state of a file. */
void gb_runner_publish_view_of(struct gb_runner *runner, const struct gb_state *state);
/* gb_runner_publish_state and gb_runner_publish_view when the last one is old enough. */
void gb_runner_publish_if_due(struct gb_runner *runner, enum gb_run_state state);
void gb_runner_publish_view_if_due(struct gb_runner *runner);

#endif
