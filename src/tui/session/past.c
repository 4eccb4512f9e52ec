#include "tui/session/past.h"

#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "io/preset.h"
#include "tui/session/previous.h"

/* Parameter sets in the order of their changes, for undo and redo. */

/* Are two sets equal, including the title?  Copies are equal byte by byte; otherwise
 * sets are compared as text. */
static bool same(const struct gb_params *a, const struct gb_params *b)
{
    return memcmp(a, b, sizeof *a) == 0 ||
           (gb_previous_diff_count(a, b) == 0 && strcmp(a->title, b->title) == 0);
}

static void forget(struct gb_param_steps *steps, int from, int to)
{
    for (int i = from; i < to; i++) {
        gb_alloc_free(steps->step[i]);
    }
    memmove(&steps->step[from], &steps->step[to],
            (size_t)(steps->count - to) * sizeof steps->step[0]);
    steps->count -= to - from;
}

void gb_past_steps_note(struct gb_param_steps *steps, struct gb_preset *preset)
{
    const struct gb_params *params = gb_preset_params(preset);
    if (steps->count > 0 && steps->step[steps->at]->preset == preset &&
        same(&steps->step[steps->at]->params, params)) {
        return;
    }
    struct gb_param_step *step = gb_alloc_array(1, sizeof *step, NULL);
    if (step == NULL) {
        return;
    }
    *step = (struct gb_param_step){preset, *params};
    if (steps->count > 0) {
        forget(steps, steps->at + 1, steps->count);
    }
    if (steps->count == GB_PARAM_STEPS) {
        forget(steps, 0, 1);
    }
    steps->at = steps->count;
    steps->step[steps->count++] = step;
}

struct gb_preset *gb_past_steps_move(struct gb_param_steps *steps, int direction)
{
    if (gb_past_steps_left(steps, direction) == 0) {
        return NULL;
    }
    steps->at += direction;
    const struct gb_param_step *step = steps->step[steps->at];
    *gb_preset_params(step->preset) = step->params;
    return step->preset;
}

int gb_past_steps_left(const struct gb_param_steps *steps, int direction)
{
    return steps->count == 0 ? 0
           : direction < 0   ? steps->at
                             : steps->count - 1 - steps->at;
}

void gb_past_steps_finish(struct gb_param_steps *steps)
{
    forget(steps, 0, steps->count);
    steps->at = 0;
}

static void remove_at(struct gb_kept_runs *kept, int index)
{
    gb_alloc_free(kept->run[index]);
    kept->count--;
    memmove(&kept->run[index], &kept->run[index + 1],
            (size_t)(kept->count - index) * sizeof kept->run[0]);
}

bool gb_past_runs_take(struct gb_kept_runs *kept, const struct gb_params *params,
                       bool quick, struct gb_kept_run *out)
{
    for (int i = kept->count - 1; i >= 0; i--) {
        if (kept->run[i]->quick == quick &&
            gb_previous_diff_count(&kept->run[i]->params, params) == 0) {
            *out = *kept->run[i];
            remove_at(kept, i);
            return true;
        }
    }
    return false;
}

void gb_past_runs_add(struct gb_kept_runs *kept, const struct gb_kept_run *run)
{
    struct gb_kept_run same;
    struct gb_kept_run *own = gb_alloc_array(1, sizeof *own, NULL);
    gb_runner_stop(run->runner);
    if (own == NULL || gb_curve_count(gb_runner_curve(run->runner)) < 2) {
        gb_runner_destroy(run->runner);
        gb_alloc_free(own);
        return;
    }
    if (gb_past_runs_take(kept, &run->params, run->quick, &same)) {
        gb_runner_destroy(same.runner);
    }
    if (kept->count == GB_KEPT_RUNS) {
        gb_runner_destroy(kept->run[0]->runner);
        remove_at(kept, 0);
    }
    *own = *run;
    kept->run[kept->count++] = own;
}

void gb_past_runs_finish(struct gb_kept_runs *kept)
{
    while (kept->count > 0) {
        gb_runner_destroy(kept->run[0]->runner);
        remove_at(kept, 0);
    }
}
