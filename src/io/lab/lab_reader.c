#include "io/lab/lab_reader.h"

#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/table.h"
#include "io/lab/lab_private.h"

/* --- files of this program ------------------------------------------------------------ */

static bool is_pressure(const char *name)
{
    static const char *const names[] = {"p_MPa",        "p_GPa",        "p_kPa",
                                        "p_Pa",         "pressure_MPa", "pressure_GPa",
                                        "pressure_kPa", "pressure_Pa"};
    bool found = false;
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        found = found || strcmp(name, names[i]) == 0;
    }
    return found;
}

static bool is_density(const char *name)
{
    return strcmp(name, "density") == 0 || strcmp(name, "density_percent") == 0;
}

/* Whether a row of heads, cut at commas, has a pressure and a density, or two of the other
 * columns. */
static bool has_names(const char *line, const char *const *also)
{
    char **names = g_strsplit(line, ",", -1);
    bool pressure = false;
    bool density = false;
    size_t others = 0;
    for (size_t i = 0; names[i] != NULL; i++) {
        const char *name = g_strstrip(names[i]);
        pressure = pressure || is_pressure(name);
        density = density || is_density(name);
        others += also != NULL && g_strv_contains(also, name);
    }
    g_strfreev(names);
    return (pressure && density) || others > 1;
}

/* The first line that is neither empty nor a comment. */
static bool is_of_program(const char *text, const char *const *also)
{
    text += g_str_has_prefix(text, "\xef\xbb\xbf") ? 3 : 0;
    while (*text != '\0') {
        const size_t length = strcspn(text, "\n");
        if (*text != '#' && strspn(text, " \t\r") < length) {
            char *line = g_strndup(text, length);
            const bool found = has_names(line, also);
            g_free(line);
            return found;
        }
        text += length + (text[length] == '\n');
    }
    return false;
}

/* The words are series, or else branches. */
static bool read_of_program(struct gb_table **out, const char *path, struct gb_error *err)
{
    struct gb_error why = {0};
    struct gb_table *table = NULL;
    const bool series = gb_table_read(&table, path, "series", &why);
    if (series && gb_table_column(table, "series", NULL) != NULL) {
        *out = table;
        return true;
    }
    if (gb_table_read(out, path, "branch", NULL)) {
        gb_table_destroy(table);
        return true;
    }
    *out = table;
    return series || gb_error_set(err, why.code, "%s", why.text);
}

/* --- others --------------------------------------------------------------------------- */

static void finish(struct gb_lab_reading *reading)
{
    gb_lab_text_finish(&reading->text);
    gb_lab_grid_finish(&reading->grid);
    g_free(reading->heading);
    g_free(reading->line);
    g_free(reading->word);
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        g_free(reading->value[role]);
    }
    for (int k = 0; k < GB_LAB_OPTIONS_KEYS; k++) {
        g_free(reading->key_value[k]);
    }
    g_free(reading->pressure);
    g_free(reading->density);
    g_string_free(reading->said, TRUE);
}

/* Names of several samples and branches are two columns of words. */
static enum gb_lab_outcome check_words(struct gb_lab_reading *reading)
{
    const int branch = reading->column[GB_LAB_ROLE_BRANCH].index;
    const int series = reading->column[GB_LAB_ROLE_SERIES].index;
    if (branch == GB_LAB_NONE || series == GB_LAB_NONE) {
        return GB_LAB_READ;
    }
    const struct gb_lab_grid *grid = &reading->grid;
    const char *first = gb_lab_grid_cell(grid, reading->first, (size_t)series).text;
    for (size_t r = reading->first; r < gb_lab_grid_rows(grid); r++) {
        const char *word = gb_lab_grid_cell(grid, r, (size_t)series).text;
        if (*word != '\0' && strcmp(word, first) != 0) {
            return gb_lab_question_fail(
                reading,
                "%.200s:%d: a second sample, and branches in column %d: expected one "
                "sample in a file with branches",
                reading->path, gb_lab_grid_row(grid, r)->line, branch + 1);
        }
    }
    return GB_LAB_READ;
}

static enum gb_lab_outcome interpret(struct gb_lab_reading *reading)
{
    static enum gb_lab_outcome (*const steps[])(struct gb_lab_reading *) = {
        gb_lab_layout_find,  gb_lab_columns_assign, check_words,
        gb_lab_decimal_find, gb_lab_rows_read,      gb_lab_needs_check,
        gb_lab_press_convert};
    for (size_t i = 0; i < G_N_ELEMENTS(steps); i++) {
        const enum gb_lab_outcome outcome = steps[i](reading);
        if (outcome != GB_LAB_READ) {
            return outcome;
        }
    }
    gb_lab_words_settle(reading);
    gb_lab_branch_drop(reading);
    gb_lab_told_write(reading);
    return GB_LAB_READ;
}

static bool make_table(const struct gb_lab_reading *reading, struct gb_table **out,
                       struct gb_error *err)
{
    enum { COLUMNS = GB_LAB_OPTIONS_KEYS + 5 };
    const char *name[COLUMNS] = {"p_MPa", "density"};
    const double *value[COLUMNS] = {reading->pressure, reading->density};
    size_t columns = 2;
    const bool branch = reading->column[GB_LAB_ROLE_BRANCH].index != GB_LAB_NONE;
    const bool words = branch || reading->column[GB_LAB_ROLE_SERIES].index != GB_LAB_NONE;
    if (reading->column[GB_LAB_ROLE_DENSITY_ERROR].index != GB_LAB_NONE) {
        name[columns] = "density_error";
        value[columns++] = reading->value[GB_LAB_ROLE_DENSITY_ERROR];
    }
    if (reading->column[GB_LAB_ROLE_PRESSURE_ERROR].index != GB_LAB_NONE) {
        name[columns] = "p_MPa_error";
        value[columns++] = reading->value[GB_LAB_ROLE_PRESSURE_ERROR];
    }
    for (int k = 0; k < reading->options->keys; k++) {
        name[columns] = reading->options->key[k].key;
        value[columns++] = reading->key_value[k];
    }
    if (words) {
        name[columns] = branch ? "branch" : "series";
        value[columns++] = NULL;
    }
    const struct gb_table_content content = {
        .path = reading->path,
        .name = name,
        .columns = columns,
        .rows = reading->count,
        .value = value,
        .word = words ? reading->word : NULL,
        .line = reading->line,
    };
    return gb_table_build(out, &content, err);
}

static enum gb_lab_outcome read_other(struct gb_table **out, const char *path,
                                      const struct gb_lab_options *options,
                                      struct gb_lab_report *report, struct gb_error *err)
{
    struct gb_lab_options own = *options;
    struct gb_lab_reading reading = {
        .path = path, .options = &own, .report = report, .err = err};
    if (!gb_lab_text_read(&reading.text, path, err)) {
        return GB_LAB_FAILED;
    }
    reading.said = g_string_new(NULL);
    enum gb_lab_outcome outcome = interpret(&reading);
    if (outcome == GB_LAB_READ && !make_table(&reading, out, err)) {
        outcome = GB_LAB_FAILED;
    }
    finish(&reading);
    return outcome;
}

enum gb_lab_outcome gb_lab_reader_read(struct gb_table **out, const char *path,
                                       const struct gb_lab_options *options,
                                       const char *const *also,
                                       struct gb_lab_report *report, struct gb_error *err)
{
    struct gb_lab_options none;
    char *text = NULL;
    size_t length = 0;
    *report = (struct gb_lab_report){.choices = 0};
    if (!gb_file_read(path, GB_TABLE_BYTES_MAX, &text, &length, err)) {
        return GB_LAB_FAILED;
    }
    const bool own = is_of_program(text, also);
    gb_alloc_free(text);
    if (options == NULL) {
        gb_lab_options_init(&none);
        options = &none;
    }
    if (own && !gb_lab_options_given(options)) {
        return read_of_program(out, path, err) ? GB_LAB_READ : GB_LAB_FAILED;
    }
    return read_other(out, path, options, report, err);
}
