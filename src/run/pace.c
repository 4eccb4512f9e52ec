#include "run/pace.h"

#include <math.h>
#include <string.h>

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

void gb_pace_init(struct gb_pace *pace)
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

void gb_pace_add(struct gb_pace *pace, double seconds, int64_t evaluations,
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

double gb_pace_rate(const struct gb_pace *pace)
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

double gb_pace_left(const struct gb_pace *pace)
{
    if (pace->progress >= 1.0) {
        return 0.0;
    }
    if (pace->progress_at - pace->progress_from < left_known_s ||
        pace->progress < left_known_progress ||
        !(pace->progress_rate > 0.0)) {
        return -1.0;
    }
    return (1.0 - pace->progress) / pace->progress_rate;
}

int64_t gb_pace_slice(const struct gb_pace *pace)
{
    return pace->slice;
}

void gb_pace_sliced(struct gb_pace *pace, double seconds, bool full)
{
    if (seconds > slice_long_s && pace->slice > 1) {
        pace->slice /= 2;
    } else if (seconds < slice_short_s && full && pace->slice < slice_most) {
        pace->slice *= 2;
    }
}
