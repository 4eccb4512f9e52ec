#include "tui/session/past/kept_runs.h"

#include <string.h>

#include "base/alloc.h"
#include "tui/session/params_diff.h"

static void remove_at(struct gb_kept_runs *kept, int index)
{
    gb_alloc_free(kept->run[index]);
    kept->count--;
    memmove(&kept->run[index], &kept->run[index + 1],
            (size_t)(kept->count - index) * sizeof kept->run[0]);
}

bool gb_kept_runs_take(struct gb_kept_runs *kept, const struct gb_params *params,
                       bool quick, struct gb_kept_run *out)
{
    for (int i = kept->count - 1; i >= 0; i--) {
        if (kept->run[i]->quick == quick &&
            gb_params_diff_count(&kept->run[i]->params, params) == 0) {
            *out = *kept->run[i];
            remove_at(kept, i);
            return true;
        }
    }
    return false;
}

void gb_kept_runs_add(struct gb_kept_runs *kept, const struct gb_kept_run *run)
{
    struct gb_kept_run same;
    struct gb_kept_run *own = gb_alloc_array(1, sizeof *own, NULL);
    gb_runner_stop(run->runner);
    if (own == NULL || gb_curve_count(gb_runner_curve(run->runner)) < 2) {
        gb_runner_destroy(run->runner);
        gb_alloc_free(own);
        return;
    }
    if (gb_kept_runs_take(kept, &run->params, run->quick, &same)) {
        gb_runner_destroy(same.runner);
    }
    if (kept->count == GB_KEPT_RUNS) {
        gb_runner_destroy(kept->run[0]->runner);
        remove_at(kept, 0);
    }
    *own = *run;
    kept->run[kept->count++] = own;
}

void gb_kept_runs_finish(struct gb_kept_runs *kept)
{
    while (kept->count > 0) {
        gb_runner_destroy(kept->run[0]->runner);
        remove_at(kept, 0);
    }
}
