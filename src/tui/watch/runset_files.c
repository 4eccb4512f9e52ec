#include "tui/watch/runset_files.h"

#include <stdlib.h>

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
    char *path = g_build_filename(directory, name, NULL);
    char *text = NULL;
    char **names = NULL;
    char **rows = g_file_get_contents(path, &text, NULL, NULL)
                      ? g_strsplit(g_strchomp(text), "\n", -1)
                      : NULL;
    for (size_t i = 0; rows != NULL && rows[i] != NULL; i++) {
        if (rows[i][0] == '#') {
            continue;
        }
        char **cells = g_strsplit(rows[i], ",", -1);
        if (names == NULL) {
            names = cells; /* the header */
        } else {
            g_ptr_array_add(lines, line_of(names, cells));
            g_strfreev(cells);
        }
    }
    g_strfreev(rows);
    g_strfreev(names);
    g_free(text);
    g_free(path);
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
