#include "cli/lab_input.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/table.h"
#include "base/visible.h"
#include "io/lab/lab_reader.h"

enum { ANSWER_MAX = 1024, QUESTIONS_MAX = 10 };

/* Options with one value each; the names are also keys of the list of --columns. */
static const struct {
    const char *key, *doc, *argument;
} keys[GB_LAB_INPUT_KEYS] = {
    {"decimal", "decimal mark of a file", "comma|point"},
    {"separator", "separator between cells", "semicolon|comma|tab|blank|bar"},
    {"die-area", "cross section of the die; converts force to pressure", "AREA"},
    {"powder-mass", "mass of powder in the die; converts height to density", "MASS"},
    {"true-density", "density of the solid; needed for g/cm3 and heights", "DENSITY"},
    {"compliance", "compliance of machine and punches; corrects the travel",
     "LENGTH/FORCE"},
    {"initial-height", "height of the powder at travel 0", "LENGTH"},
    {"zero-travel", "travel at which the empty punches touch", "LENGTH"},
};

const char gb_lab_input_help[] =
    "Measured points may come as a spreadsheet or a testing machine exports them: any\n"
    "separator, decimal mark, encoding and names.  One line on stderr reports how the file\n"
    "was read.  If a file can be read in two ways, the program asks on a terminal;\n"
    "elsewhere it stops and prints the --columns to give.  A list such as\n"
    "pressure=2:MPa,density=4:% names columns by number or by their headings in double\n"
    "quotes, with units.  Quantities: pressure, density, porosity, force, travel, height,\n"
    "density_error, pressure_error, branch, series.  The list may also contain the options\n"
    "below: pressure=2:MPa,density=4:%,decimal=comma.";

static GOptionEntry entry(const char *name, char **value, const char *doc,
                          const char *argument)
{
    return (GOptionEntry){name, 0, 0, G_OPTION_ARG_STRING, value, doc, argument};
}

GOptionEntry *gb_lab_input_entries(struct gb_lab_input *input, const GOptionEntry *own)
{
    size_t count = 0;
    while (own[count].long_name != NULL) {
        count++;
    }
    GOptionEntry *all = g_new0(GOptionEntry, count + GB_LAB_INPUT_KEYS + 3);
    memcpy(all, own, count * sizeof *own);
    all[count++] =
        entry("columns", &input->columns, "how a file of measured points is read",
              "QUANTITY=COLUMN[:UNIT],...");
    all[count++] = entry("series", &input->series,
                         "use only rows with WORD in the column series", "WORD");
    for (size_t k = 0; k < GB_LAB_INPUT_KEYS; k++) {
        all[count++] =
            entry(keys[k].key, &input->value[k], keys[k].doc, keys[k].argument);
    }
    return all;
}

const char *gb_lab_input_given(const struct gb_lab_input *input)
{
    const char *given = input->series != NULL    ? "series"
                        : input->columns != NULL ? "columns"
                                                 : NULL;
    for (size_t k = 0; k < GB_LAB_INPUT_KEYS; k++) {
        given = given == NULL && input->value[k] != NULL ? keys[k].key : given;
    }
    return given;
}

static bool parse(const struct gb_lab_input *input, struct gb_lab_options *options,
                  struct gb_error *err)
{
    struct gb_error why = {0};
    gb_lab_options_init(options);
    if (input->columns != NULL && !gb_lab_options_parse(options, input->columns, &why)) {
        return gb_error_set(err, why.code, "--columns: %s", why.text);
    }
    for (size_t k = 0; k < GB_LAB_INPUT_KEYS; k++) {
        if (input->value[k] != NULL &&
            !gb_lab_options_set(options, keys[k].key, input->value[k], &why)) {
            return gb_error_set(err, why.code, "--%s", why.text);
        }
    }
    return true;
}

/* Without a terminal: fails with the options to give. */
static bool refuse(const char *path, const struct gb_lab_report *report,
                   struct gb_error *err)
{
    GString *list = g_string_new(NULL);
    for (int k = 0; k < report->choices; k++) {
        g_string_append_printf(list, "%s--columns '%s'", k > 0 ? " or " : "",
                               report->choice[k]);
    }
    gb_error_set(err, GB_ERR_INPUT, "%.120s: %s%s Give %s", path, report->question,
                 g_str_has_suffix(report->question, "?") ? "" : ".", list->str);
    g_string_free(list, TRUE);
    return false;
}

/* Reads a line of stdin, the number of a choice or a list, into the options; false: no
 * line. */
static bool ask(const char *path, const struct gb_lab_report *report,
                struct gb_lab_options *options, struct gb_error *err)
{
    char answer[ANSWER_MAX];
    guint64 number = 0;
    gb_visible_line(stderr, "%s: %s", path, report->question);
    for (int k = 0; k < report->choices; k++) {
        gb_visible_line(stderr, "  %d  %s", k + 1, report->choice[k]);
    }
    gb_visible_print(stderr, "Number, or a list as these (Enter ends): ");
    if (fgets(answer, sizeof answer, stdin) == NULL || *g_strstrip(answer) == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: not read", path);
    }
    const char *list = answer;
    if (report->choices > 0 &&
        g_ascii_string_to_unsigned(answer, 10, 1, (guint64)report->choices, &number,
                                   NULL)) {
        list = report->choice[number - 1];
    }
    struct gb_error why = {0};
    if (!gb_lab_options_parse(options, list, &why)) {
        gb_visible_line(stderr, "%s", why.text); /* then the question is repeated */
    }
    return true;
}

static bool keep_series(struct gb_table *table, const char *series, struct gb_error *err)
{
    const char *words = gb_table_words(table);
    if (words == NULL || strcmp(words, "series") != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: has no column series",
                            gb_table_path(table));
    }
    GString *known = g_string_new(NULL);
    GHashTable *seen = g_hash_table_new(g_str_hash, g_str_equal);
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const char *word = gb_table_word(table, i);
        if (g_hash_table_add(seen, (char *)(uintptr_t)word) && known->len < 200) {
            g_string_append_printf(known, "%s%.40s", known->len > 0 ? ", " : "", word);
        }
    }
    const bool found = g_hash_table_contains(seen, series);
    g_hash_table_destroy(seen);
    if (found) {
        gb_table_keep(table, series);
    } else {
        gb_error_set(err, GB_ERR_INPUT,
                     "%.200s: --series %.80s: expected one series of %s",
                     gb_table_path(table), series, known->str);
    }
    g_string_free(known, TRUE);
    return found;
}

bool gb_lab_input_read(struct gb_table **out, const struct gb_lab_input *input,
                       const char *path, const char *const *also, struct gb_error *err)
{
    struct gb_lab_options options;
    struct gb_lab_report report;
    enum gb_lab_outcome outcome = GB_LAB_QUESTION;
    const char *option = gb_lab_input_given(input);
    *out = NULL;
    if (path == NULL) {
        return option == NULL ||
               gb_error_set(err, GB_ERR_INPUT, "--%s: expected a file given with --data",
                            option);
    }
    if (!parse(input, &options, err)) {
        return false;
    }
    const bool terminal = isatty(STDIN_FILENO) && isatty(STDERR_FILENO);
    for (int questions = 0; outcome == GB_LAB_QUESTION; questions++) {
        outcome = gb_lab_reader_read(out, path, &options, also, &report, err);
        if (outcome == GB_LAB_QUESTION &&
            (terminal && questions < QUESTIONS_MAX ? !ask(path, &report, &options, err)
                                                   : !refuse(path, &report, err))) {
            return false;
        }
    }
    if (outcome == GB_LAB_FAILED) {
        return false;
    }
    if (report.told[0] != '\0') {
        gb_visible_line(stderr, "greenbody: %s: %s", path, report.told);
    }
    if (input->series != NULL && !keep_series(*out, input->series, err)) {
        gb_table_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

void gb_lab_input_finish(struct gb_lab_input *input)
{
    g_free(input->columns);
    g_free(input->series);
    for (size_t k = 0; k < GB_LAB_INPUT_KEYS; k++) {
        g_free(input->value[k]);
    }
    *input = (struct gb_lab_input){0};
}
