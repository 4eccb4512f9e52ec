#include "many/runset.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/params.h"
#include "io/follow.h"
#include "io/status_json.h"
#include "scene/seed.h"

/* A set of finished runs, grouped into experiments.  The first part compares two scenes
 * key by key, then runs are read and grouped, groups are labelled by the keys that
 * differ, and points of branches are selected from the curves. */

static bool is_listed(const struct gb_field *field, const char *const *list)
{
    for (size_t i = 0; list[i] != NULL; i++) {
        const size_t length = strlen(field->group);
        if (strncmp(list[i], field->group, length) == 0 && list[i][length] == '.' &&
            (list[i][length + 1] == '\0' ||
             strcmp(list[i] + length + 1, field->key) == 0)) {
            return true;
        }
    }
    return false;
}

/* Keys of random numbers, and keys that change no result. */
bool gb_runset_bookkeeping(const struct gb_field *field)
{
    return field->no_result || field->type == GB_FIELD_SEED;
}

/* Compares values as preset text: equal texts are equal values. */
static bool key_difference_equal(const struct gb_field *field, const struct gb_params *a,
                                 const struct gb_params *b)
{
    char first[GB_PARAMS_VALUE_MAX], second[GB_PARAMS_VALUE_MAX];
    return strcmp(gb_params_format(a, field, first, sizeof first),
                  gb_params_format(b, field, second, sizeof second)) == 0;
}

const struct gb_field *gb_runset_differing_key(const struct gb_params *a,
                                               const struct gb_params *b,
                                               const char *const *ignored)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_runset_bookkeeping(&fields[i]) && !is_listed(&fields[i], ignored) &&
            !key_difference_equal(&fields[i], a, b)) {
            return &fields[i];
        }
    }
    return NULL;
}

bool gb_runset_same(const struct gb_params *a, const struct gb_params *b)
{
    static const char *const none[] = {NULL};
    return gb_runset_differing_key(a, b, none) == NULL;
}

static bool has_file(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool there = g_file_test(path, G_FILE_TEST_IS_REGULAR);
    g_free(path);
    return there;
}

static bool read_run(struct gb_runset_run *run, const char *directory,
                     struct gb_error *err)
{
    run->directory = g_strdup(directory);
    if (!gb_follow_params(directory, &run->params, err)) {
        return false;
    }
    char *path = g_build_filename(directory, "curve.csv", NULL);
    const bool is_packing =
        has_file(directory, "packing.csv") && !g_file_test(path, G_FILE_TEST_EXISTS);
    const bool good = is_packing || gb_table_read(&run->table, path, "branch", err);
    g_free(path);
    return good;
}

/* Do the scenes give the same cell: equal seeds, or no dependence on the seed? */
static bool is_one_cell(const struct gb_params *a, const struct gb_params *b)
{
    return a->seed == b->seed ||
           (!gb_seed_matters(a) && !gb_seed_matters(b) && a->from.sum == b->from.sum);
}

/* Adds the run to the group of an earlier run, or starts a new group. */
static bool join(struct gb_runset *set, size_t index, struct gb_error *err)
{
    struct gb_runset_run *run = &set->run[index];
    run->group = set->groups;
    for (size_t i = 0; i < index; i++) {
        const struct gb_runset_run *other = &set->run[i];
        if (!gb_runset_same(&run->params, &other->params)) {
            continue;
        }
        if (run->params.seed == other->params.seed) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s: same preset and seed as %.200s; a mean takes "
                                "each seed once",
                                run->directory, other->directory);
        }
        if (is_one_cell(&run->params, &other->params)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s: same cell as %.200s, whatever the seed; a mean "
                                "takes each cell once",
                                run->directory, other->directory);
        }
        run->group = other->group;
    }
    set->groups += run->group == set->groups;
    return true;
}

/* The group of a run among the runs before it.  If it starts a new one, the number of
 * groups so far. */
static size_t group_of(const struct gb_runset *set, size_t index, const char *const *keys)
{
    const struct gb_runset_run *run = &set->run[index];
    for (size_t i = 0; i < index; i++) {
        bool taken =
            gb_runset_differing_key(&run->params, &set->run[i].params, keys) != NULL;
        for (size_t k = 0; k < index && !taken; k++) {
            taken = set->run[k].group == set->run[i].group &&
                    is_one_cell(&set->run[k].params, &run->params);
        }
        if (!taken) {
            return set->run[i].group;
        }
    }
    return set->groups;
}

void gb_runset_merge(struct gb_runset *set, const char *const *keys)
{
    set->groups = 0;
    for (size_t i = 0; i < set->count; i++) {
        set->run[i].group = group_of(set, i, keys);
        set->groups += set->run[i].group == set->groups;
    }
}

int gb_runset_compare(const char *a, const char *b)
{
    while (*a != '\0' && *b != '\0') {
        if (g_ascii_isdigit(*a) && g_ascii_isdigit(*b)) {
            char *a_end = NULL;
            char *b_end = NULL;
            const double x = g_ascii_strtod(a, &a_end);
            const double y = g_ascii_strtod(b, &b_end);
            if (x != y) {
                return x < y ? -1 : 1;
            }
            a = a_end;
            b = b_end;
        } else if (*a != *b) {
            break;
        } else {
            a++;
            b++;
        }
    }
    return strcmp(a, b);
}

static gint compare_paths(gconstpointer a, gconstpointer b)
{
    return gb_runset_compare(*(const char *const *)a, *(const char *const *)b);
}

void gb_runset_expand(GPtrArray *list, const char *directory)
{
    GDir *dir = has_file(directory, "preset.ini") ? NULL : g_dir_open(directory, 0, NULL);
    GPtrArray *found = g_ptr_array_new();
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(directory, name, NULL);
        char *status = g_build_filename(path, "status.json", NULL);
        if (has_file(path, "preset.ini") && gb_status_json_is_done(status)) {
            g_ptr_array_add(found, g_steal_pointer(&path));
        }
        g_free(status);
        g_free(path);
    }
    g_ptr_array_sort(found, compare_paths);
    for (guint i = 0; i < found->len; i++) {
        g_ptr_array_add(list, g_ptr_array_index(found, i));
    }
    if (found->len == 0) {
        g_ptr_array_add(list, g_strdup(directory));
    }
    g_ptr_array_unref(found);
    if (dir != NULL) {
        g_dir_close(dir);
    }
}

bool gb_runset_read(struct gb_runset *set, char *const *directories, size_t count,
                    struct gb_error *err)
{
    *set = (struct gb_runset){0};
    set->run = gb_alloc_array(count, sizeof *set->run, err);
    if (set->run == NULL) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        set->count = i + 1;
        if (!read_run(&set->run[i], directories[i], err) || !join(set, i, err)) {
            gb_runset_finish(set);
            return false;
        }
    }
    return true;
}

void gb_runset_finish(struct gb_runset *set)
{
    for (size_t i = 0; i < set->count; i++) {
        g_free(set->run[i].directory);
        gb_table_destroy(set->run[i].table);
    }
    gb_alloc_free(set->run);
    *set = (struct gb_runset){0};
}

const struct gb_runset_run *gb_runset_first(const struct gb_runset *set, size_t group)
{
    size_t i = 0;
    while (set->run[i].group != group) {
        i++;
    }
    return &set->run[i];
}

size_t gb_runset_members(const struct gb_runset *set, size_t group)
{
    size_t members = 0;
    for (size_t i = 0; i < set->count; i++) {
        members += set->run[i].group == group;
    }
    return members;
}

/* Does the key differ between groups (of one title, if given)?  Within a group, keys
 * that were merged may differ. */
static bool differs_somewhere(const struct gb_runset *set, const struct gb_field *field,
                              const struct gb_params *params, const char *title)
{
    for (size_t g = 0; g < set->groups; g++) {
        const struct gb_params *other = &gb_runset_first(set, g)->params;
        if ((title == NULL || strcmp(title, other->title) == 0) &&
            !key_difference_equal(field, params, other)) {
            return true;
        }
    }
    return false;
}

bool gb_runset_follows_material(const struct gb_runset *set, const struct gb_field *field)
{
    if (strcmp(field->group, "material") != 0 || strcmp(field->key, "name") == 0) {
        return false;
    }
    for (size_t g = 1; g < set->groups; g++) {
        const struct gb_params *one = &gb_runset_first(set, g)->params;
        for (size_t h = 0; h < g; h++) {
            const struct gb_params *other = &gb_runset_first(set, h)->params;
            if (strcmp(one->material, other->material) == 0 &&
                !key_difference_equal(field, one, other)) {
                return false;
            }
        }
    }
    return true;
}

enum compared { WITH_ALL_GROUPS, WITH_SAME_TITLE };

static char *label_among(const struct gb_runset *set, size_t group,
                         enum compared compared)
{
    const struct gb_params *params = &gb_runset_first(set, group)->params;
    const char *title = compared == WITH_SAME_TITLE ? params->title : NULL;
    GString *label = g_string_new(NULL);
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_runset_bookkeeping(&fields[i]) &&
            !gb_runset_follows_material(set, &fields[i]) &&
            differs_somewhere(set, &fields[i], params, title)) {
            char value[GB_PARAMS_VALUE_MAX];
            g_string_append_printf(
                label, "%s%s.%s = %s", label->len ? ", " : "", fields[i].group,
                fields[i].key, gb_params_format(params, &fields[i], value, sizeof value));
        }
    }
    return g_string_free(label, FALSE);
}

char *gb_runset_label(const struct gb_runset *set, size_t group)
{
    return label_among(set, group, WITH_ALL_GROUPS);
}

char *gb_runset_label_of_title(const struct gb_runset *set, size_t group)
{
    return label_among(set, group, WITH_SAME_TITLE);
}

const struct gb_field *gb_runset_difference(const struct gb_runset *set, size_t a,
                                            size_t b, const char *const *ignored)
{
    return gb_runset_differing_key(&gb_runset_first(set, a)->params,
                                   &gb_runset_first(set, b)->params, ignored);
}

/* Selects points of a branch (NULL: all) that have x: those in equilibrium, or the
 * others.  Allocates the arrays even if there is no point. */
static bool select_points(const struct gb_runset_run *run, const char *branch,
                          const char *x, const char *y, bool unrelaxed, double **xs,
                          double **ys, size_t *count, struct gb_error *err)
{
    const size_t rows = gb_table_rows(run->table);
    const double *from_x = gb_table_column(run->table, x, err);
    const double *from_y = from_x ? gb_table_column(run->table, y, err) : NULL;
    const double *above = gb_table_column(run->table, "unrelaxed", NULL);
    if (from_y == NULL || !gb_table_column(run->table, "branch", err)) {
        return false;
    }
    *count = 0;
    *xs = gb_alloc_array(rows, sizeof **xs, err);
    *ys = gb_alloc_array(rows, sizeof **ys, err);
    const bool made = *xs != NULL && *ys != NULL;
    for (size_t i = 0; made && i < rows; i++) {
        const bool here = !branch || strcmp(gb_table_word(run->table, i), branch) == 0;
        if (here && !isnan(from_x[i]) && (above && above[i] > 0.0) == unrelaxed) {
            (*xs)[*count] = from_x[i];
            (*ys)[(*count)++] = from_y[i];
        }
    }
    return made;
}

static bool has_curve(const struct gb_runset_run *run, struct gb_error *err)
{
    return run->table != NULL ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: a packing has no curve.csv; expected runs",
                        run->directory);
}

bool gb_runset_points(const struct gb_runset_run *run, const char *branch, const char *x,
                      const char *y, double **xs, double **ys, size_t *count,
                      struct gb_error *err)
{
    *xs = *ys = NULL;
    if (!has_curve(run, err)) {
        return false;
    }
    const bool made = select_points(run, branch, x, y, false, xs, ys, count, err);
    if (made && *count > 0) {
        return true;
    }
    gb_alloc_free(*xs);
    gb_alloc_free(*ys);
    *xs = *ys = NULL;
    return made && gb_error_set(err, GB_ERR_INPUT,
                                "%s: no point of branch %s that is in equilibrium",
                                gb_table_path(run->table), branch ? branch : "any");
}

bool gb_runset_unrelaxed(const struct gb_runset_run *run, const char *branch,
                         const char *x, const char *y, double **xs, double **ys,
                         size_t *count, struct gb_error *err)
{
    *xs = *ys = NULL;
    return has_curve(run, err) &&
           select_points(run, branch, x, y, true, xs, ys, count, err);
}
