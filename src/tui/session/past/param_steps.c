#include "tui/session/past/param_steps.h"

#include <string.h>

#include "base/alloc.h"
#include "tui/session/params_diff.h"

/* The title counts, too.  Copies are equal byte by byte; other sets are compared as
 * text. */
static bool same(const struct gb_params *a, const struct gb_params *b)
{
    return memcmp(a, b, sizeof *a) == 0 ||
           (gb_params_diff_count(a, b) == 0 && strcmp(a->title, b->title) == 0);
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

void gb_param_steps_note(struct gb_param_steps *steps, struct gb_preset *preset)
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

struct gb_preset *gb_param_steps_move(struct gb_param_steps *steps, int direction)
{
    if (gb_param_steps_left(steps, direction) == 0) {
        return NULL;
    }
    steps->at += direction;
    const struct gb_param_step *step = steps->step[steps->at];
    *gb_preset_params(step->preset) = step->params;
    return step->preset;
}

int gb_param_steps_left(const struct gb_param_steps *steps, int direction)
{
    return steps->count == 0 ? 0
           : direction < 0   ? steps->at
                             : steps->count - 1 - steps->at;
}

void gb_param_steps_finish(struct gb_param_steps *steps)
{
    forget(steps, 0, steps->count);
    steps->at = 0;
}
