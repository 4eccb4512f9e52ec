#include "cli/pack/pack_bed.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include <glib/gstdio.h>

#include "base/text/visible.h"
#include "cli/signals.h"
#include "run/experiment.h"

/* Time steps between two looks at the time and at signals: about 0.1 s. */
static const int64_t slice = 500;

static void destroy_state(void *state)
{
    gb_state_destroy(state);
}

/* Steps so far number the states of the filling, which precede all recorded points. */
static bool take(const struct gb_experiment *experiment, struct gb_state **out,
                 struct gb_error *err)
{
    if (!gb_experiment_state(experiment, out, err)) {
        return false;
    }
    (*out)->point.step = gb_experiment_evaluations(experiment);
    return true;
}

/* Keeps a state when it is time for one. */
static bool keep(struct gb_pack_bed *bed, const struct gb_experiment *experiment,
                 double every_s, struct gb_error *err)
{
    struct gb_state *state = NULL;
    if (bed->filling->len >= GB_PACK_BED_STATES) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--every: more than %d states of the filling; accepted a longer "
            "time",
            GB_PACK_BED_STATES);
    }
    if (!take(experiment, &state, err)) {
        return false;
    }
    if (state->point.time_s >= every_s * (bed->filling->len + 1)) {
        g_ptr_array_add(bed->filling, state);
    } else {
        gb_state_destroy(state);
    }
    return true;
}

/* Prints the events; true when one says that all powder is in the die. */
static bool is_poured(struct gb_experiment *experiment)
{
    char text[GB_EVENT_TEXT];
    bool poured = false;
    while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        gb_visible_line(stderr, "  %s", text);
        poured = poured || g_str_has_prefix(text, "poured");
    }
    return poured;
}

static bool fill(struct gb_pack_bed *bed, struct gb_experiment *experiment,
                 double every_s, struct gb_error *err)
{
    bool keeping = every_s > 0.0;
    for (;;) {
        const enum gb_step_outcome outcome =
            gb_experiment_advance(experiment, slice, err);
        if (outcome == GB_STEP_STOPPED) {
            return false;
        }
        keeping = !is_poured(experiment) && keeping;
        if (outcome != GB_STEP_MORE) {
            return take(experiment, &bed->state, err);
        }
        if (gb_signals_cancelled(NULL)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "filling cancelled");
        }
        if (keeping && !keep(bed, experiment, every_s, err)) {
            return false;
        }
    }
}

bool gb_pack_bed_fill(struct gb_pack_bed *bed, const struct gb_params *params,
                      double every_s, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    *bed = (struct gb_pack_bed){.filling = g_ptr_array_new_with_free_func(destroy_state)};
    if (!gb_experiment_create(&experiment, params, gb_signals_cancelled, NULL, err)) {
        return false;
    }
    const bool filled = fill(bed, experiment, every_s, err);
    gb_experiment_destroy(experiment);
    return filled;
}

void gb_pack_bed_finish(struct gb_pack_bed *bed)
{
    if (bed->filling != NULL) {
        g_ptr_array_unref(bed->filling);
    }
    *bed = (struct gb_pack_bed){0};
}

bool gb_pack_bed_write(const struct gb_pack_bed *bed, const char *directory,
                       struct gb_error *err)
{
    char *folder = g_build_filename(directory, "snapshots", NULL);
    bool good = bed->filling == NULL || bed->filling->len == 0 ||
                g_mkdir(folder, 0777) == 0 || errno == EEXIST ||
                gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", folder,
                             g_strerror(errno));
    for (guint k = 0; good && bed->filling != NULL && k < bed->filling->len; k++) {
        char *path = g_strdup_printf("%s/filling-%06u.h5", folder, k + 1);
        good = gb_state_write(g_ptr_array_index(bed->filling, k), NULL, path, err);
        g_free(path);
    }
    g_free(folder);
    return good;
}

void gb_pack_bed_print(const struct gb_state *state)
{
    const struct gb_point *point = &state->point;
    gb_visible_print(stdout, "particles      %" PRId64 ", seed %" PRIu64 "\n",
                     state->count, state->seed);
    gb_visible_print(stdout, "die            %.5g um wide, powder %.5g um high\n",
                     2e6 * state->die_radius * state->metre_per_length,
                     1e6 * point->height_m);
    gb_visible_print(stdout, "density        %.6g\n", point->density);
    gb_visible_print(stdout, "central        %.6g\n", point->central);
    gb_visible_print(stdout, "coordination   %.6g\n", point->coordination);
}
