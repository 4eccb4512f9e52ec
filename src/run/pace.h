#ifndef GB_RUN_PACE_H
#define GB_RUN_PACE_H

#include <stdbool.h>
#include <stdint.h>

/* Rate of a run and its remaining time, from its progress so far.  All times are seconds
 * of work: the caller leaves out pauses. */
enum { GB_PACE_WINDOW = 64 };

struct gb_pace {
    /* the last reports: rates are taken over this sliding window */
    double seconds[GB_PACE_WINDOW];
    double evaluations[GB_PACE_WINDOW];
    int filled, next;
    /* progress per second, recent times weighing more */
    double progress, progress_at, progress_rate;
    double progress_from; /* seconds of the first report of it */
    bool begun;           /* there was one */
    int64_t slice;
};

void gb_pace_init(struct gb_pace *pace);

/* Takes in one report; progress: NaN while it says nothing of the time left. */
void gb_pace_add(struct gb_pace *pace, double seconds, int64_t evaluations,
                 double progress);

/* Force evaluations per second over the window; 0 while unknown. */
double gb_pace_rate(const struct gb_pace *pace);

/* Seconds to the end of loading; negative while unknown. */
double gb_pace_left(const struct gb_pace *pace);

/* Evaluations to allow in the next slice, so that it takes 5 to 20 ms. */
int64_t gb_pace_slice(const struct gb_pace *pace);

/* Time of the last slice, s; full: it used all evaluations that it was allowed. */
void gb_pace_sliced(struct gb_pace *pace, double seconds, bool full);

#endif
