#ifndef GB_BASE_TEAM_H
#define GB_BASE_TEAM_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* How many threads pay: a search by candidate.  Between searches `active` threads work.  A
 * search times a window with them and one with each neighbouring number; it starts again
 * from a number that is better, and ends where none is.  Searches grow rarer while nothing
 * changes, so that their cost stays below some percent. */
struct gb_team_pace {
    int most;      /* threads available */
    int active;    /* threads between searches */
    int candidate; /* threads of the candidate */
    enum gb_team_pace_phase {
        GB_TEAM_PACE_REST,
        GB_TEAM_PACE_BASE,     /* window of `active` threads */
        GB_TEAM_PACE_CANDIDATE /* window of `candidate` threads */
    } phase;
    int last;   /* threads of the last candidate, if in vain, or of those before it; 0 */
    int next;   /* neighbour of the next candidate */
    int failed; /* neighbours tried in vain in this search */
    double rest_s;  /* until the next search */
    double spent_s; /* in this phase */
    int64_t rounds; /* in this phase */
    double base_s;  /* per round, by `active` threads */
};

void gb_team_pace_init(struct gb_team_pace *pace, int most);

/* Threads of the next round. */
int gb_team_pace_threads(const struct gb_team_pace *pace);

/* A round of work took `seconds` of elapsed time. */
void gb_team_pace_add(struct gb_team_pace *pace, double seconds);

/* Threads that share the items of one piece of work after another.  Every thread takes
 * the items of its own share in order, then those that others have not begun: a thread
 * without a core delays little more than the item that it holds.  The last item of a share is
 * left to its thread for as long as an item lasts.  Which thread computes an
 * item is undefined, so an item's result must not depend on it.
 *
 * A team of one thread is NULL: every function accepts it, and the caller does the work.
 * A team serves one caller at a time; items must not use the team. */
struct gb_team;

typedef void gb_team_item(void *data, int64_t item);
typedef void gb_team_range(void *data, int64_t begin, int64_t end);

/* At most `threads` threads, the caller's included; they start with the first work that
 * has more than one item.  Where the machine refuses a thread, those that started do the
 * work.
 *
 * Errors: GB_ERR_MEMORY. */
bool gb_team_create(struct gb_team **out, int threads, struct gb_error *err);

/* In a process that inherited the team by fork, which has none of its threads, only frees
 * the memory. */
void gb_team_destroy(struct gb_team *team);

/* Threads at most; 1 without a team. */
int gb_team_size(const struct gb_team *team);

/* Threads of the next work: gb_team_size, or fewer after gb_team_measured_end. */
int gb_team_active(const struct gb_team *team);

/* work(data, item) once for each item 0 .. items - 1 (at most 2^31); returns after the
 * last one.  What an item wrote is visible to the caller. */
void gb_team_run(struct gb_team *team, int64_t items, gb_team_item *work, void *data);

/* The same with items of unequal cost: cost[i] is that of all items before i (items + 1
 * numbers, ascending, of any unit), and every thread begins with a share of about the same
 * cost. */
void gb_team_run_costs(struct gb_team *team, int64_t items, const int64_t *cost,
                       gb_team_item *work, void *data);

/* work(data, begin, end) for ranges that cover 0 .. count - 1, none shorter than `grain`
 * but a single one.  The ranges depend on the number of threads. */
void gb_team_run_ranges(struct gb_team *team, int64_t count, int64_t grain,
                        gb_team_range *work, void *data);

/* Around work that costs the same each time: from its elapsed times the team finds how
 * many threads pay (base/team.h), also while other processes come and go. */
void gb_team_measured_begin(struct gb_team *team);
void gb_team_measured_end(struct gb_team *team);

/* Starts a thread with all signals blocked: they are handled by the program's first
 * thread.  pthread_join is due.
 *
 * what   name of the thread in the message, as in "the engine thread"
 * Errors: GB_ERR_MACHINE. */
bool gb_team_start_thread(pthread_t *thread, void *(*work)(void *data), void *data,
                          const char *what, struct gb_error *err);

#endif
