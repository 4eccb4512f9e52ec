#ifndef GB_BASE_TEAM_PACE_H
#define GB_BASE_TEAM_PACE_H

#include <stdint.h>

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

#endif
