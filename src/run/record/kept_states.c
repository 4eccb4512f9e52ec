#include "run/record/kept_states.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "base/units.h"
#include "io/state/state.h"
#include "io/state/state_record.h"

void gb_kept_states_init(struct gb_kept_states *states, const struct gb_params *params)
{
    *states = (struct gb_kept_states){.p_pa = -INFINITY, .density = -INFINITY};
    (void)gb_keep_points_parse(params->snapshots_at, &states->marks, NULL);
}

void gb_kept_states_pass(struct gb_kept_states *states, const struct gb_point *point)
{
    if (point->branch == GB_BRANCH_LOAD) {
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
    return point->branch == GB_BRANCH_LOAD && before < mark->value && now >= mark->value;
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

/* Names of what is due, one for each mark. */
static int list_due(const struct gb_kept_states *states, const struct gb_point *point,
                    int64_t number, char names[GB_KEEP_POINTS_MAX + 1][64])
{
    const struct gb_keep_points *marks = &states->marks;
    int count = 0;
    for (int i = 0; i < marks->count; i++) {
        if (reaches(states, &marks->point[i], point)) {
            gb_kept_states_name(&marks->point[i], names[count++], sizeof names[0]);
        }
    }
    if (marks->every > 0 && (number - 1) % marks->every == 0) {
        snprintf(names[count++], sizeof names[0], "point-%06" PRId64, number);
    }
    return count;
}

bool gb_kept_states_point(struct gb_kept_states *states, const char *directory,
                          const struct gb_point *point, int64_t number,
                          const struct gb_record *record, const struct gb_params *params,
                          const struct gb_model *model, struct gb_error *err)
{
    char names[GB_KEEP_POINTS_MAX + 1][64];
    struct gb_state *state = NULL;
    const int count = list_due(states, point, number, names);
    bool good = count == 0 || gb_state_record(&state, record, params, model, err);
    for (int i = 0; i < count && good; i++) {
        good = write_state(directory, names[i], state, record, err);
    }
    gb_state_destroy(state);
    gb_kept_states_pass(states, point);
    return good;
}
