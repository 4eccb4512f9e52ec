#include "run/record/kept_states.h"

#include <errno.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "base/units.h"
#include "run/experiment.h"
#include "scene/field/keep_points.h"

void gb_kept_states_init(struct gb_kept_states *states, const struct gb_params *params)
{
    *states = (struct gb_kept_states){.params = params};
    (void)gb_keep_points_parse(params->snapshots_at, &states->marks, NULL);
}

/* Whether a recorded point is one of loading, where states are kept: in any leg of a path. */
static bool loads(const struct gb_point *point)
{
    return point->branch == GB_BRANCH_LOAD || point->branch < GB_BRANCH_LEG;
}

void gb_kept_states_pass(struct gb_kept_states *states, const struct gb_point *point)
{
    if (loads(point)) {
        states->p_pa = fmax(states->p_pa, point->p_pa);
        states->density = fmax(states->density, point->density);
    } else if (point->branch > GB_BRANCH_LOAD) {
        states->p_pa = fmax(states->p_pa, point->branch_from_pa);
    }
}

static bool reaches(const struct gb_kept_states *states, const struct gb_keep_point *mark,
                    const struct gb_point *point)
{
    const double before = mark->by_density ? states->density : states->p_pa;
    const double now = mark->by_density ? point->density : point->p_pa;
    return loads(point) && gb_keep_points_reached(mark, states->params, before, now);
}

char *gb_kept_states_name(const struct gb_keep_point *mark, char *name, size_t size)
{
    char value[48];
    char *to = value;
    if (mark->by_density) {
        g_ascii_formatd(value, sizeof value, "%.6g", mark->value);
    } else {
        gb_units_format_short(mark->value, GB_DIM_PRESSURE, 6, value, sizeof value);
    }
    for (const char *from = value; *from != '\0'; from++) {
        if (*from != ' ') {
            *to++ = *from;
        }
    }
    *to = '\0';
    snprintf(name, size, "%s-%s", mark->by_density ? "density" : "p", value);
    return name;
}

static bool write_state(const char *directory, const char *name,
                        const struct gb_state *state, const struct gb_record *record,
                        struct gb_error *err)
{
    char *folder = g_build_filename(directory, "snapshots", NULL);
    char *path = g_strdup_printf("%s/%s.h5", folder, name);
    bool done = g_file_test(path, G_FILE_TEST_EXISTS);
    if (!done && g_mkdir(folder, 0777) != 0 && errno != EEXIST) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", folder,
                     g_strerror(errno));
    } else if (!done) {
        done = gb_state_write(state, record, path, err);
    }
    g_free(path);
    g_free(folder);
    return done;
}

void gb_kept_states_due(const struct gb_kept_states *states, const struct gb_point *point,
                        int64_t number, struct gb_kept_names *names)
{
    const struct gb_keep_points *marks = &states->marks;
    names->count = 0;
    for (int i = 0; i < marks->count; i++) {
        if (reaches(states, &marks->point[i], point)) {
            gb_kept_states_name(&marks->point[i], names->name[names->count++],
                                sizeof names->name[0]);
        }
    }
    if (marks->every > 0 && (number - 1) % marks->every == 0) {
        snprintf(names->name[names->count++], sizeof names->name[0], "point-%06" PRId64,
                 number);
    }
}

bool gb_kept_states_write(const char *directory, const struct gb_kept_names *names,
                          const struct gb_state *state, const struct gb_record *record,
                          struct gb_error *err)
{
    bool good = true;
    for (int i = 0; i < names->count && good; i++) {
        good = write_state(directory, names->name[i], state, record, err);
    }
    return good;
}

/* Force evaluations between two questions whether to stop. */
enum { SLICE = 200 };

/* Points that a run has reached so far. */
struct progress {
    const struct gb_params *params;
    const struct gb_keep_points *points;
    double p_pa, density; /* highest while loading */
    int reached;
    bool visited; /* the state as it is */
};

/* The points of the list that the last recorded point is the first beyond, as bits. */
static unsigned find_due(struct progress *progress, const struct gb_point *point)
{
    unsigned due = 0;
    if (!loads(point)) {
        return 0;
    }
    for (int k = 0; k < progress->points->count; k++) {
        const struct gb_keep_point *at = &progress->points->point[k];
        const double before = at->by_density ? progress->density : progress->p_pa;
        const double now = at->by_density ? point->density : point->p_pa;
        if (gb_keep_points_reached(at, progress->params, before, now)) {
            due |= 1U << k;
            progress->reached++;
        }
    }
    progress->p_pa = fmax(progress->p_pa, point->p_pa);
    progress->density = fmax(progress->density, point->density);
    return due;
}

static bool press(struct gb_experiment *experiment, struct progress *progress,
                  const struct gb_keep_walk *walk, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    for (;;) {
        const enum gb_step_outcome outcome =
            gb_experiment_advance(experiment, SLICE, err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        }
        if (walk->cancelled && walk->cancelled(walk->cancel_data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        if (outcome == GB_STEP_POINT) {
            const unsigned due = find_due(progress, gb_experiment_point(experiment));
            progress->visited = due != 0;
            if (due != 0 && !walk->visit(walk->data, experiment, due, err)) {
                return false;
            }
        }
        if (outcome == GB_STEP_STOPPED) {
            struct gb_error ignored;
            (void)(progress->visited ||
                   walk->visit(walk->data, experiment, GB_KEEP_WALK_STOPPED, &ignored));
            return false;
        }
        if (outcome == GB_STEP_DONE) {
            const unsigned visited = progress->visited ? GB_KEEP_WALK_VISITED : 0U;
            return walk->visit(walk->data, experiment, GB_KEEP_WALK_END | visited, err);
        }
    }
}

bool gb_kept_states_run(const struct gb_params *params, const struct gb_keep_walk *walk,
                        int *missed, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct progress progress = {params, walk->points, -INFINITY, -INFINITY, 0, false};
    if (!gb_experiment_create(&experiment, params, walk->cancelled, walk->cancel_data,
                              err)) {
        return false;
    }
    const bool placed =
        params->structure != GB_STRUCTURE_GROWN && walk->points->count == 0;
    const bool done = placed ? walk->visit(walk->data, experiment, GB_KEEP_WALK_END, err)
                             : press(experiment, &progress, walk, err);
    *missed = walk->points->count - progress.reached;
    gb_experiment_destroy(experiment);
    return done;
}
