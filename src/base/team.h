#ifndef GB_BASE_TEAM_H
#define GB_BASE_TEAM_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Finds the best number of threads by trial.  Between searches `active` threads work.
 * A search measures one time window with this number and one with each neighbouring
 * number.  If a neighbour is faster, the search continues from it; otherwise it ends.
 * While nothing changes, searches become rarer, so that their cost stays at a few per
 * cent. */
struct gb_team_pace {
    int most;      /* threads available */
    int active;    /* threads between searches */
    int candidate; /* threads of the candidate */
    enum gb_team_pace_phase {
        GB_TEAM_PACE_REST,
        GB_TEAM_PACE_BASE,     /* measures `active` threads */
        GB_TEAM_PACE_CANDIDATE /* measures `candidate` threads */
    } phase;
    int last;       /* number known to be worse: last candidate or previous active; 0 */
    int next;       /* index of the next neighbour to try */
    int failed;     /* neighbours that were not better in this search */
    double rest_s;  /* until the next search */
    double spent_s; /* in this phase */
    int64_t rounds; /* in this phase */
    double base_s;  /* per round, by `active` threads */
};

void gb_team_pace_init(struct gb_team_pace *pace, int most);

/* Number of threads for the next round. */
int gb_team_pace_threads(const struct gb_team_pace *pace);

/* Records that a round of work took `seconds` of elapsed time. */
void gb_team_pace_add(struct gb_team_pace *pace, double seconds);

/* A team of threads that share the items of one piece of work after another.  Every
 * thread takes the items of its own share in order, then items of other shares that
 * have not been started.  A thread that loses its core therefore delays little more
 * than its current item.  The last item of a share is left to its own thread for the
 * duration of one item.  It is undefined which thread computes an item, so results must
 * not depend on it.
 *
 * A team of one thread is NULL: every function accepts it, and the caller does the
 * work.  A team serves one caller at a time; items must not use the team. */
struct gb_team;

typedef void gb_team_item(void *data, int64_t item);
typedef void gb_team_range(void *data, int64_t begin, int64_t end);

/* Creates a team of at most `threads` threads, including the caller.  They start with
 * the first work of more than one item.  If the system refuses a thread, those that
 * started do the work.
 *
 * Errors: GB_ERR_MEMORY. */
bool gb_team_create(struct gb_team **out, int threads, struct gb_error *err);

/* In a process that inherited the team by fork and has none of its threads, this only
 * frees the memory. */
void gb_team_destroy(struct gb_team *team);

/* Largest number of threads; 1 without a team. */
int gb_team_size(const struct gb_team *team);

/* Number of threads for the next work: gb_team_size, or fewer after
 * gb_team_measured_end. */
int gb_team_active(const struct gb_team *team);

/* Calls work(data, item) once for each item 0 .. items - 1 (at most 2^31) and returns
 * after the last one.  What the items wrote is visible to the caller. */
void gb_team_run(struct gb_team *team, int64_t items, gb_team_item *work, void *data);

/* The same for items of unequal cost. cost[i] is the cost of all items before i: items
 * + 1 ascending numbers in any unit.  Every thread starts with a share of about the
 * same cost. */
void gb_team_run_costs(struct gb_team *team, int64_t items, const int64_t *cost,
                       gb_team_item *work, void *data);

/* Calls work(data, begin, end) for ranges that cover 0 .. count - 1.  Ranges have at
 * least `grain` items unless there is only one.  They depend on the number of threads. */
void gb_team_run_ranges(struct gb_team *team, int64_t count, int64_t grain,
                        gb_team_range *work, void *data);

/* To be called around work of constant cost.  From its elapsed times the team finds how
 * many threads pay off, also while other processes start and end. */
void gb_team_measured_begin(struct gb_team *team);
void gb_team_measured_end(struct gb_team *team);

/* Starts a thread with all signals blocked, so that the first thread of the program
 * handles them. pthread_join must be called.
 *
 * what   name of the thread in the message, as in "the engine thread"
 * Errors: GB_ERR_MACHINE. */
bool gb_team_start_thread(pthread_t *thread, void *(*work)(void *data), void *data,
                          const char *what, struct gb_error *err);

#endif
