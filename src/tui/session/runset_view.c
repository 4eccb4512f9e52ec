#include "tui/session/runset_view.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/table.h"
#include "base/units.h"
#include "greenbody/snapshot.h"
#include "io/follow.h"
#include "many/reading.h"
#include "many/runset.h"
#include "measure/average.h"
#include "scene/field/field.h"

/* Reads the summary of a directory of many runs for the screen.  The first part finds
 * the run directories and reads the tables of sweeps and calibrations.  The second part
 * averages the replicas of each group at a set of pressure levels and finds the varied
 * keys. */

static bool has_file(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool has = g_file_test(path, G_FILE_TEST_IS_REGULAR);
    g_free(path);
    return has;
}

static int compare(const void *a, const void *b)
{
    return gb_runset_compare(*(char *const *)a, *(char *const *)b);
}

/* Run directories in a directory, sorted by name; free-func set. */
static GPtrArray *list_runs(const char *directory)
{
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    GDir *dir = g_dir_open(directory, 0, NULL);
    const char *name = NULL;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(directory, name, NULL);
        if (has_file(path, "preset.ini") && has_file(path, "status.json")) {
            g_ptr_array_add(list, path);
        } else {
            g_free(path);
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    if (list->len > 1) {
        qsort(list->pdata, list->len, sizeof list->pdata[0], compare);
    }
    return list;
}

/* Paths of the run directories in a directory, or in its folder `runs` (calibrations),
 * by name. g_ptr_array_free. */
static GPtrArray *runset_files_list(const char *directory)
{
    GPtrArray *list = list_runs(directory);
    if (list->len == 0) {
        char *inside = g_build_filename(directory, "runs", NULL);
        g_ptr_array_free(list, TRUE);
        list = list_runs(inside);
        g_free(inside);
    }
    return list;
}

bool gb_runset_view_any(const char *directory)
{
    if (has_file(directory, "preset.ini")) {
        return false;
    }
    GPtrArray *list = runset_files_list(directory);
    const bool is = list->len > 0;
    g_ptr_array_free(list, TRUE);
    return is;
}

/* Lines of a CSV table without comments, header first; g_strfreev. */
static char **read_lines(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    char *text = NULL;
    size_t length = 0;
    GPtrArray *lines = g_ptr_array_new();
    if (gb_file_read(path, GB_TABLE_BYTES_MAX, &text, &length, NULL)) {
        char **rows = g_strsplit(g_strchomp(text), "\n", -1);
        for (size_t i = 0; rows[i] != NULL; i++) {
            if (rows[i][0] == '#') {
                g_free(rows[i]);
            } else {
                g_ptr_array_add(lines, rows[i]);
            }
        }
        g_free(rows);
    }
    g_ptr_array_add(lines, NULL);
    gb_alloc_free(text);
    g_free(path);
    return (char **)g_ptr_array_free(lines, FALSE);
}

/* Index of a name among cells, counted from the last one, because values of earlier
 * keys may contain commas; 0: none. */
static guint index_from_end(char **cells, const char *name)
{
    const guint count = g_strv_length(cells);
    for (guint k = 0; k < count; k++) {
        if (strcmp(cells[k], name) == 0) {
            return count - k;
        }
    }
    return 0;
}

static bool has_pressure(const double *pa, size_t count, double wanted)
{
    for (size_t k = 0; k < count; k++) {
        if (fabs(pa[k] - wanted) <= 1e-9 * wanted) {
            return true;
        }
    }
    return false;
}

/* Pressures in the table of a sweep on loading, Pa.  Returns their number, at most
 * `most`; 0 without a table. */
static size_t runset_files_pressures(const char *directory, double *pa, size_t most)
{
    size_t count = 0;
    char **rows = read_lines(directory, "sweep.csv");
    char **names = rows[0] != NULL ? g_strsplit(rows[0], ",", -1) : NULL;
    const guint branch = names != NULL ? index_from_end(names, "branch") : 0;
    const guint pressure = names != NULL ? index_from_end(names, "p_MPa") : 0;
    for (size_t i = 1; branch > 0 && pressure > 0 && rows[i] != NULL && count < most;
         i++) {
        char **cells = g_strsplit(rows[i], ",", -1);
        const guint length = g_strv_length(cells);
        const bool whole = length >= MAX(branch, pressure);
        const double mpa = whole ? g_ascii_strtod(cells[length - pressure], NULL) : 0.0;
        if (mpa > 0.0 && strcmp(cells[length - branch], "load") == 0 &&
            !has_pressure(pa, count, 1e6 * mpa)) {
            pa[count++] = 1e6 * mpa;
        }
        g_strfreev(cells);
    }
    g_strfreev(names);
    g_strfreev(rows);
    return count;
}

/* "name value" of every cell of a row. */
static char *line_of(char **names, char **cells)
{
    GString *line = g_string_new(NULL);
    for (size_t k = 0; cells[k] != NULL && names[k] != NULL; k++) {
        g_string_append_printf(line, "%s%s %s", k > 0 ? "  " : "", names[k], cells[k]);
    }
    return g_string_free(line, FALSE);
}

/* Appends the rows of a CSV table of a calibration as lines. */
static void add_lines(GPtrArray *lines, const char *directory, const char *name)
{
    char **rows = read_lines(directory, name);
    char **names = rows[0] != NULL ? g_strsplit(rows[0], ",", -1) : NULL;
    for (size_t i = 1; names != NULL && rows[i] != NULL; i++) {
        char **cells = g_strsplit(rows[i], ",", -1);
        g_ptr_array_add(lines, line_of(names, cells));
        g_strfreev(cells);
    }
    g_strfreev(names);
    g_strfreev(rows);
}

/* Lines with the result and the rounds of a calibration; NULL for other directories.
 * g_strfreev. */
static char **runset_files_fit(const char *directory)
{
    GPtrArray *lines = g_ptr_array_new();
    char *runs = g_build_filename(directory, "runs", NULL);
    add_lines(lines, directory, "calibration.csv");
    add_lines(lines, directory, "rounds.csv");
    if (lines->len == 0 && g_file_test(runs, G_FILE_TEST_IS_DIR)) {
        g_ptr_array_add(lines, g_strdup("the first round is not finished yet"));
    }
    g_free(runs);
    const bool some = lines->len > 0;
    g_ptr_array_add(lines, NULL);
    char **list = (char **)g_ptr_array_free(lines, !some);
    return some ? list : NULL;
}

static const double min_pa = 1e6;

static void read_states(struct gb_runset_view *runset, GPtrArray *list)
{
    double progress = 0.0;
    runset->runs = list->len;
    runset->run = g_new0(struct gb_runset_view_run, list->len + 1);
    for (size_t i = 0; i < list->len; i++) {
        struct gb_runset_view_run *run = &runset->run[i];
        struct gb_snapshot shot = {0};
        struct gb_follow_engine engine;
        struct gb_error err = {0};
        run->name = g_path_get_basename(list->pdata[i]);
        run->state = GB_RUN_PACKING;
        if (gb_follow_status(list->pdata[i], &shot, &engine, &err)) {
            run->state = shot.state;
            run->progress = shot.state == GB_RUN_DONE ? 1.0 : shot.progress;
            g_strlcpy(run->error, shot.error.text, sizeof run->error);
            if (run->state <= GB_RUN_PAUSED && gb_follow_engine_gone(&engine)) {
                run->state = GB_RUN_STOPPED;
                g_strlcpy(run->error,
                          "its engine has ended; the command of these runs, repeated, "
                          "does it again",
                          sizeof run->error);
            }
        } else if (err.code == GB_ERR_INPUT) { /* unlike a run without a status yet */
            run->state = GB_RUN_STOPPED;
            g_strlcpy(run->error, err.text, sizeof run->error);
        }
        runset->done += run->state == GB_RUN_DONE;
        runset->failed += run->state == GB_RUN_FAILED;
        runset->live += run->state <= GB_RUN_PAUSED;
        progress += run->progress;
    }
    runset->progress = list->len > 0 ? progress / (double)list->len : 0.0;
}

/* The runs with a readable curve; a run that has just started has none. */
static GPtrArray *readable(const GPtrArray *list)
{
    GPtrArray *good = g_ptr_array_new();
    for (size_t i = 0; i < list->len; i++) {
        struct gb_table *table = NULL;
        struct gb_error err = {0};
        if (gb_reading_open(&table, list->pdata[i], &err)) {
            if (gb_table_rows(table) > 0) {
                g_ptr_array_add(good, list->pdata[i]);
            }
            gb_table_destroy(table);
        }
    }
    return good;
}

static double largest_pressure(const struct gb_runset *set)
{
    double max_pa = 10.0 * min_pa;
    for (size_t i = 0; i < set->count; i++) {
        const double *p = gb_table_column(set->run[i].table, "p_MPa", NULL);
        for (size_t k = 0; p != NULL && k < gb_table_rows(set->run[i].table); k++) {
            max_pa = fmax(max_pa, 1e6 * p[k]); /* fmax ignores NaN */
        }
    }
    return max_pa;
}

/* Inserts a level if there is room; an existing level becomes a level of the table. */
static void add_level(struct gb_runset_view *runset, double pa, bool tabulated)
{
    size_t at = 0;
    while (at < runset->levels && runset->level_pa[at] < pa * (1.0 - 1e-9)) {
        at++;
    }
    if (at < runset->levels && runset->level_pa[at] <= pa * (1.0 + 1e-9)) {
        runset->tabulated[at] = runset->tabulated[at] || tabulated;
        return;
    }
    if (runset->levels == GB_RUNSET_VIEW_LEVELS) {
        return;
    }
    for (size_t k = runset->levels++; k > at; k--) {
        runset->level_pa[k] = runset->level_pa[k - 1];
        runset->tabulated[k] = runset->tabulated[k - 1];
    }
    runset->level_pa[at] = pa;
    runset->tabulated[at] = tabulated;
}

/* Levels of one decade. */
static const double steps[] = {1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0,
                               3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0, 9.0};

static void set_levels(struct gb_runset_view *runset, const struct gb_runset *set)
{
    double table[GB_RUNSET_VIEW_LEVELS];
    const double max_pa = largest_pressure(set);
    const size_t count =
        runset_files_pressures(runset->directory, table, G_N_ELEMENTS(table));
    add_level(runset, max_pa, false);
    for (double decade = min_pa; decade < max_pa; decade *= 10.0) {
        for (size_t k = 0; k < G_N_ELEMENTS(steps) && decade * steps[k] < max_pa; k++) {
            add_level(runset, decade * steps[k], false);
        }
    }
    for (size_t k = 0; k < count; k++) {
        if (table[k] <= max_pa) {
            add_level(runset, table[k], true);
        }
    }
}

/* Averages over the replicas that reached each level: mean and standard error. */
static void average(struct gb_runset_view *runset, const struct gb_runset *set,
                    size_t group)
{
    struct gb_runset_view_group *out = &runset->group[group];
    double *values = g_new(double, set->count);
    for (size_t k = 0; k < runset->levels; k++) {
        size_t count = 0;
        for (size_t i = 0; i < set->count; i++) {
            double read[GB_READING_QUANTITIES];
            if (set->run[i].group == group && set->run[i].table != NULL) {
                gb_reading_loaded(set->run[i].table, runset->level_pa[k], read);
                values[count++] = read[GB_READING_DENSITY];
            }
        }
        out->reached[k] = gb_average_values(values, count, &out->mean[k], &out->error[k]);
    }
    g_free(values);
}

/* Index of a value in the list of a key; appends a new value. */
static size_t index_of_value(struct gb_runset_view_key *key, const char *value)
{
    for (size_t i = 0; i < key->count; i++) {
        if (strcmp(key->values[i], value) == 0) {
            return i;
        }
    }
    key->values = g_renew(char *, key->values, key->count + 2);
    key->values[key->count] = g_strdup(value);
    key->values[key->count + 1] = NULL;
    return key->count++;
}

static double number_of(const char *value)
{
    double number = NAN;
    return gb_units_number(value, NULL, &number) ? number : (double)NAN;
}

/* Sorts numbers of one unit; words keep their order. */
static void sort_values(struct gb_runset_view_key *key, size_t *value_index,
                        size_t groups)
{
    for (size_t i = 1; i < key->count; i++) {
        for (size_t k = i;
             k > 0 && number_of(key->values[k]) < number_of(key->values[k - 1]); k--) {
            char *kept = key->values[k];
            key->values[k] = key->values[k - 1];
            key->values[k - 1] = kept;
            for (size_t g = 0; g < groups; g++) {
                value_index[g] = value_index[g] == k       ? k - 1
                                 : value_index[g] == k - 1 ? k
                                                           : value_index[g];
            }
        }
    }
}

static void find_keys(struct gb_runset_view *runset, const struct gb_runset *set)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (gb_runset_follows_material(set, &field[i])) {
            continue;
        }
        struct gb_runset_view_key key = {&field[i], NULL, 0};
        size_t *value_index = g_new0(size_t, set->groups + 1);
        for (size_t g = 0; g < set->groups && !gb_runset_bookkeeping(&field[i]); g++) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(&gb_runset_first(set, g)->params, &field[i], value,
                             sizeof value);
            value_index[g] = index_of_value(&key, value);
        }
        if (key.count > 1 && runset->keys++ < GB_RUNSET_VIEW_VARIED) {
            const size_t k = runset->keys - 1;
            sort_values(&key, value_index, set->groups);
            runset->key[k] = key;
            for (size_t g = 0; g < set->groups; g++) {
                runset->group[g].value_index[k] = value_index[g];
            }
        } else {
            g_strfreev(key.values);
        }
        g_free(value_index);
    }
}

static bool read_groups(struct gb_runset_view *runset, const GPtrArray *good,
                        struct gb_error *err)
{
    struct gb_runset set = {0};
    if (!gb_runset_read(&set, (char *const *)good->pdata, good->len, err)) {
        return false;
    }
    runset->groups = set.groups;
    runset->group = g_new0(struct gb_runset_view_group, set.groups + 1);
    set_levels(runset, &set);
    for (size_t g = 0; g < set.groups; g++) {
        runset->group[g].label = gb_runset_label(&set, g);
        runset->group[g].members = gb_runset_members(&set, g);
        average(runset, &set, g);
    }
    find_keys(runset, &set);
    gb_runset_finish(&set);
    return true;
}

bool gb_runset_view_read(struct gb_runset_view *runset, const char *directory,
                         struct gb_error *err)
{
    memset(runset, 0, sizeof *runset);
    GPtrArray *list = runset_files_list(directory);
    runset->directory = g_strdup(directory);
    runset->fit = runset_files_fit(directory);
    bool read = true;
    if (list->len == 0) {
        read = gb_error_set(err, GB_ERR_INPUT, "%s: contains no run", directory);
    } else {
        read_states(runset, list);
        GPtrArray *good = readable(list);
        read = good->len == 0 || read_groups(runset, good, err);
        g_ptr_array_free(good, TRUE);
    }
    g_ptr_array_free(list, TRUE);
    return read;
}

void gb_runset_view_finish(struct gb_runset_view *runset)
{
    for (size_t i = 0; i < runset->runs; i++) {
        g_free(runset->run[i].name);
    }
    for (size_t g = 0; g < runset->groups; g++) {
        g_free(runset->group[g].label);
    }
    for (size_t k = 0; k < GB_RUNSET_VIEW_VARIED; k++) {
        g_strfreev(runset->key[k].values);
    }
    g_strfreev(runset->fit);
    g_free(runset->run);
    g_free(runset->group);
    g_free(runset->directory);
    memset(runset, 0, sizeof *runset);
}

static size_t groups_at(const struct gb_runset_view *runset, size_t level)
{
    size_t count = 0;
    for (size_t g = 0; g < runset->groups; g++) {
        count += runset->group[g].reached[level] == runset->group[g].members;
    }
    return count;
}

enum choice { ANY_LEVEL, TABULATED };

static size_t nearest(const struct gb_runset_view *runset, double pressure_pa,
                      enum choice choice)
{
    size_t best = 0;
    double closest = INFINITY;
    for (size_t k = 0; k < runset->levels; k++) {
        const double distance = fabs(log(runset->level_pa[k] / pressure_pa));
        if (distance < closest && (choice == ANY_LEVEL || runset->tabulated[k])) {
            closest = distance;
            best = k;
        }
    }
    return best;
}

size_t gb_runset_view_nearest(const struct gb_runset_view *runset, double pressure_pa)
{
    return nearest(runset, pressure_pa, ANY_LEVEL);
}

size_t gb_runset_view_level(const struct gb_runset_view *runset, double pressure_pa)
{
    bool table = false;
    for (size_t k = 0; k < runset->levels; k++) {
        table = table || runset->tabulated[k];
    }
    size_t best = nearest(runset, pressure_pa, table ? TABULATED : ANY_LEVEL);
    for (size_t k = best; k > 0; k--) {
        best = groups_at(runset, k - 1) > groups_at(runset, best) ? k - 1 : best;
    }
    return best;
}

const struct gb_runset_view_group *gb_runset_view_at(const struct gb_runset_view *runset,
                                                     size_t first, size_t second)
{
    for (size_t g = 0; g < runset->groups; g++) {
        if (runset->group[g].value_index[0] == first &&
            runset->group[g].value_index[1] == second) {
            return &runset->group[g];
        }
    }
    return NULL;
}
