#include "tui/watch/runset_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/read_file.h"
#include "base/table.h"
#include "many/runset.h"

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

GPtrArray *gb_runset_files_list(const char *directory)
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

bool gb_runset_files_any(const char *directory)
{
    if (has_file(directory, "preset.ini")) {
        return false;
    }
    GPtrArray *list = gb_runset_files_list(directory);
    const bool is = list->len > 0;
    g_ptr_array_free(list, TRUE);
    return is;
}

/* Lines of a CSV table without comments, the header first; g_strfreev. */
static char **read_lines(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    char *text = NULL;
    size_t length = 0;
    GPtrArray *lines = g_ptr_array_new();
    if (gb_read_file(path, GB_TABLE_BYTES_MAX, &text, &length, NULL)) {
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

/* Index of a name among cells, counted from the last one: values of keys before it may contain
 * commas; 0: none. */
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

size_t gb_runset_files_pressures(const char *directory, double *pa, size_t most)
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

char **gb_runset_files_fit(const char *directory)
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
