#include "base/team/team_pace.h"

#include <math.h>
#include <stdbool.h>

/* A window spans several time slices of the scheduler; rounds that are longer than a
 * slice need only a few. */
static const double window_s = 0.02;
enum { WINDOW_ROUNDS = 4 };

static const double rest_least_s = 0.1, rest_most_s = 3.2;

/* More threads have to be faster by this factor, fewer may be slower by that one: a
 * thread that gains nothing leaves its core to others. */
static const double worth_more = 0.95, worth_fewer = 1.01;

/* A candidate that is slower by this factor after a quarter of its window ends. */
static const double hopeless = 1.4;

enum { NEIGHBOURS = 4 };

/* Neighbour k of `active` threads: half, one fewer, twice, one more. */
static int neighbour(const struct gb_team_pace *pace, int k)
{
    const int active = pace->active;
    const int number[NEIGHBOURS] = {active / 2, active - 1, 2 * active, active + 1};
    const int threads = number[k];
    return threads < 1 ? 1 : threads > pace->most ? pace->most : threads;
}

static void enter(struct gb_team_pace *pace, enum gb_team_pace_phase phase)
{
    pace->phase = phase;
    pace->spent_s = 0.0;
    pace->rounds = 0;
}

void gb_team_pace_init(struct gb_team_pace *pace, int most)
{
    *pace = (struct gb_team_pace){.most = most, .active = most, .rest_s = rest_least_s};
    enter(pace, most > 1 ? GB_TEAM_PACE_BASE : GB_TEAM_PACE_REST);
}

int gb_team_pace_threads(const struct gb_team_pace *pace)
{
    return pace->phase == GB_TEAM_PACE_CANDIDATE ? pace->candidate : pace->active;
}

/* Starts the window of the next neighbour that differs from `active`; rests after all of
 * them. */
static void try_next(struct gb_team_pace *pace)
{
    for (; pace->failed < NEIGHBOURS; pace->failed++) {
        pace->candidate = neighbour(pace, pace->next);
        if (pace->candidate != pace->active && pace->candidate != pace->last) {
            enter(pace, GB_TEAM_PACE_CANDIDATE);
            return;
        }
        pace->next = (pace->next + 1) % NEIGHBOURS;
    }
    enter(pace, GB_TEAM_PACE_REST);
    pace->last = 0;
}

static void judge(struct gb_team_pace *pace, double candidate_s)
{
    const double worth = pace->candidate > pace->active ? worth_more : worth_fewer;
    if (candidate_s < worth * pace->base_s) {
        pace->last = pace->active; /* known to be worse */
        pace->active = pace->candidate;
        pace->base_s = candidate_s;
        pace->failed = 0; /* goes on in the same direction */
        pace->rest_s = rest_least_s;
    } else {
        pace->last = pace->candidate;
        pace->failed++;
        pace->next = (pace->next + 1) % NEIGHBOURS;
    }
    try_next(pace);
}

/* True at the end of a window; early if the candidate is hopeless. */
static bool window_ends(const struct gb_team_pace *pace, double mean_s)
{
    if (pace->rounds < WINDOW_ROUNDS) {
        return false;
    }
    return pace->spent_s >= window_s ||
           (pace->phase == GB_TEAM_PACE_CANDIDATE && pace->spent_s >= window_s / 4.0 &&
            mean_s > hopeless * pace->base_s);
}

void gb_team_pace_add(struct gb_team_pace *pace, double seconds)
{
    if (pace->most < 2) {
        return;
    }
    pace->spent_s += seconds;
    pace->rounds++;
    const double mean_s = pace->spent_s / (double)pace->rounds;
    if (pace->phase == GB_TEAM_PACE_REST) {
        if (pace->spent_s >= pace->rest_s) {
            pace->rest_s = fmin(2.0 * pace->rest_s, rest_most_s);
            enter(pace, GB_TEAM_PACE_BASE);
        }
    } else if (window_ends(pace, mean_s)) {
        if (pace->phase == GB_TEAM_PACE_CANDIDATE) {
            judge(pace, mean_s);
        } else {
            pace->base_s = mean_s;
            pace->failed = 0;
            try_next(pace);
        }
    }
}
