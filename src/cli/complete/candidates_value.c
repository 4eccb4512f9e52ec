#include <string.h>

#include "cli/complete/candidates.h"
#include "draw/picture_colours.h"
#include "figures/figures.h"
#include "io/export/export.h"
#include "measure/fit/compaction/equations.h"
#include "study/law/law_table.h"
#include "tui/term/settings.h"

static void add_figures(const struct gb_candidates *to)
{
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        gb_candidates_add(to, row->name, row->doc);
    }
}

static void add_formats(const struct gb_candidates *to)
{
    const struct gb_export_format *format;
    for (size_t i = 0; (format = gb_export_at(i)) != NULL; i++) {
        gb_candidates_add(to, format->name, format->doc);
    }
}

static void add_equations(const struct gb_candidates *to)
{
    for (size_t i = 0; i < gb_equations_count(); i++) {
        gb_candidates_add(to, gb_equations_at(i)->name, gb_equations_at(i)->form);
    }
}

static void add_lattices(const struct gb_candidates *to)
{
    size_t count = 0;
    const struct gb_law_table_lattice *lattice = gb_law_table_lattices(&count);
    for (size_t i = 0; i < count; i++) {
        gb_candidates_add(to, lattice[i].name, "lattice");
    }
}

void gb_candidates_value_laws(const struct gb_candidates *to)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    for (size_t i = 0; i < count; i++) {
        gb_candidates_add(to, laws[i].name, laws[i].doc);
    }
}

static void add_colours(const struct gb_candidates *to)
{
    static const enum gb_picture_colours_kind kinds[] = {GB_PICTURE_COLOURS_PARTICLES,
                                                         GB_PICTURE_COLOURS_FORCES};
    for (size_t k = 0; k < G_N_ELEMENTS(kinds); k++) {
        char *list = gb_picture_colours_names(kinds[k]);
        char **names = g_strsplit(list, ", ", -1);
        for (int i = 0; names[i] != NULL; i++) {
            gb_candidates_add(to, names[i], "colour");
        }
        g_strfreev(names);
        g_free(list);
    }
}

/* Options whose values are the names of a table. */
static const struct {
    const char *command, *option; /* command NULL: any */
    void (*add)(const struct gb_candidates *to);
} tables[] = {
    {"plot", "figure", add_figures},
    {"export", "format", add_formats},
    {"fit", "equation", add_equations},
    {"law", "lattice", add_lattices},
    {"snapshot", "color", add_colours},
    {NULL, "set", gb_candidates_keys},
    {NULL, "vary", gb_candidates_keys},
    {NULL, "reference", gb_candidates_keys},
    {"calibrate", "free", gb_candidates_keys_list},
};

/* Of an option of the workbench, from its settings. */
static bool add_setting(const struct gb_candidates *to, const char *command,
                        const char *option)
{
    size_t count = 0;
    const struct gb_settings_row *row = gb_settings_table(&count);
    for (size_t i = 0; strcmp(command, "greenbody") == 0 && i < count; i++) {
        if (strcmp(row[i].name, option) == 0) {
            for (int k = 0; row[i].values[k] != NULL; k++) {
                gb_candidates_add(to, row[i].values[k], row[i].meaning);
            }
            return true;
        }
    }
    return false;
}

/* "FILE.png|svg|pdf": the endings, NULL for any. */
static char **endings_of(const char *description)
{
    const char *dot = strchr(description, '.');
    char **endings = dot != NULL ? g_strsplit(dot + 1, "|", -1) : NULL;
    for (int i = 0; endings != NULL && endings[i] != NULL; i++) {
        char *ending = g_strconcat(".", endings[i], NULL);
        g_free(endings[i]);
        endings[i] = ending;
    }
    return endings;
}

/* "auto|never": words that stand for themselves are written in small letters. */
static void add_words(const struct gb_candidates *to, const char *description)
{
    char **words = g_strsplit(description, "|", -1);
    for (int i = 0; words[1] != NULL && words[i] != NULL; i++) {
        if (g_ascii_islower(words[i][0])) {
            gb_candidates_add(to, words[i], NULL);
        }
    }
    g_strfreev(words);
}

void gb_candidates_value(const struct gb_candidates *to, const char *command,
                         const GOptionEntry *entry)
{
    const char *description = entry->arg_description ? entry->arg_description : "";
    for (size_t i = 0; i < G_N_ELEMENTS(tables); i++) {
        if (strcmp(entry->long_name, tables[i].option) == 0 &&
            entry->arg != G_OPTION_ARG_FILENAME &&
            (tables[i].command == NULL || strcmp(command, tables[i].command) == 0)) {
            tables[i].add(to);
            return;
        }
    }
    if (add_setting(to, command, entry->long_name)) {
        return;
    }
    if (entry->arg == G_OPTION_ARG_FILENAME && strcmp(description, "DIR") == 0) {
        gb_candidates_paths(to, GB_CANDIDATES_FOLDER, NULL);
    } else if (entry->arg == G_OPTION_ARG_FILENAME) {
        char **endings = endings_of(description);
        gb_candidates_paths(to, GB_CANDIDATES_FILE, (const char *const *)endings);
        g_strfreev(endings);
    } else {
        add_words(to, description);
    }
}
