/* Completion of command lines for the shells; see completion.h.  The word to be
 * completed is recognised by its position: an option, the value of an option, or a
 * positional word of the usage line.  Candidates come from the tables of the program. */
#include "cli/completion.h"

#include <glib.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "draw/picture_colours.h"
#include "figures/figures.h"
#include "greenbody/params.h"
#include "io/export.h"
#include "io/material.h"
#include "io/preset_folders.h"
#include "measure/equations.h"
#include "study/law_table.h"
#include "tui/term/settings.h"

/* Possible continuations of a word, printed to stdout as they are found. */
struct candidates {
    const char *prefix; /* the typed part of what is completed */
    const char *before; /* text before that part in the same word, such as "--set=" */
};

/* Kinds of paths. */
enum path_kind { PATH_FILE, PATH_FOLDER, PATH_RUN };

/* Columns of a description, so that it takes one line of the list. */
enum { DOC = 90 };

/* Prints a candidate that may not begin with the prefix: a key typed without its group.
 */
static void add_any(const struct candidates *to, const char *candidate, const char *doc)
{
    char *shown = gb_visible_text(candidate, "");
    if (strcmp(shown, candidate) == 0) { /* the word must not change by escapes */
        gb_visible_print(stdout, "%s%s\t%.*s\n", to->before, candidate,
                         doc != NULL ? MIN((int)strcspn(doc, "\n"), DOC) : 0,
                         doc != NULL ? doc : "");
    }
    g_free(shown);
}

/* Prints a candidate that begins with the prefix.  doc may be NULL. */
static void add_candidate(const struct candidates *to, const char *candidate,
                          const char *doc)
{
    if (g_str_has_prefix(candidate, to->prefix)) {
        add_any(to, candidate, doc);
    }
}

/* Prints presets by name. */
static void candidates_presets(const struct candidates *to)
{
    char **names = gb_preset_folders_list();
    for (int i = 0; names[i] != NULL; i++) {
        add_candidate(to, names[i], "preset");
    }
    g_strfreev(names);
}

/* The folder of a typed path, to be opened: "" is the working folder, a leading "~/"
 * the home directory. */
static char *folder_of(const char *typed, size_t length)
{
    char *folder = g_strndup(typed, length);
    if (g_str_has_prefix(folder, "~/")) {
        char *home = g_build_filename(g_get_home_dir(), folder + 2, NULL);
        g_free(folder);
        return home;
    }
    return folder;
}

static bool has_ending(const char *name, const char *const *endings)
{
    bool found = endings == NULL;
    for (int i = 0; !found && endings[i] != NULL; i++) {
        found = g_str_has_suffix(name, endings[i]);
    }
    return found;
}

/* Is the folder a run, or a directory of runs? */
static bool is_run(const char *folder)
{
    static const char *const signs[] = {"preset.ini", "sweep.csv", "calibration.csv"};
    bool found = false;
    for (size_t i = 0; i < G_N_ELEMENTS(signs) && !found; i++) {
        char *sign = g_build_filename(folder, signs[i], NULL);
        found = g_file_test(sign, G_FILE_TEST_EXISTS);
        g_free(sign);
    }
    return found;
}

static void add_path(const struct candidates *to, enum path_kind kind,
                     const char *const *endings, const char *path, const char *shown)
{
    const bool folder = g_file_test(path, G_FILE_TEST_IS_DIR);
    char *below = g_strconcat(shown, "/", NULL);
    if (folder && kind == PATH_RUN && is_run(path)) {
        add_candidate(to, shown, "run");
    } else if (folder) {
        add_candidate(to, below, "folder");
    } else if (kind == PATH_FILE && has_ending(shown, endings)) {
        add_candidate(to, shown, "file");
    }
    g_free(below);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Completes files with one of the endings ("" or NULL: any), folders, or directories of
 * runs. */
static void complete_paths(const struct candidates *to, enum path_kind kind,
                           const char *const *endings)
{
    const char *slash = strrchr(to->prefix, '/');
    const size_t length = slash != NULL ? (size_t)(slash - to->prefix) + 1 : 0;
    const bool hidden = to->prefix[length] == '.';
    char *folder = folder_of(to->prefix, length);
    GDir *dir = g_dir_open(*folder != '\0' ? folder : ".", 0, NULL);
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    for (const char *name = dir != NULL ? g_dir_read_name(dir) : NULL; name != NULL;
         name = g_dir_read_name(dir)) {
        if ((name[0] == '.') == hidden) {
            g_ptr_array_add(names, g_strdup(name));
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    /* the order of files in a folder depends on the file system */
    g_ptr_array_sort(names, by_name);
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *path = g_build_filename(folder, name, NULL);
        char *shown = g_strdup_printf("%.*s%s", (int)length, to->prefix, name);
        add_path(to, kind, endings, path, shown);
        g_free(shown);
        g_free(path);
    }
    g_ptr_array_unref(names);
    g_free(folder);
}

/* --- keys and their values ---------------------------------------------------------- */

/* Adds each name of a list "a, b, c" from the table of units. */
static void add_units(const struct candidates *to, const char *number, const char *units)
{
    char **names = g_strsplit(units, ", ", -1);
    for (int i = 0; names[i] != NULL; i++) {
        char *value = g_strconcat(number, names[i], NULL);
        add_candidate(to, value, "unit");
        g_free(value);
    }
    g_strfreev(names);
}

/* Completes "10" or "10n": the number with every unit of its key. */
static void add_number(const struct candidates *to, const struct gb_field *field)
{
    const char *end = to->prefix;
    double value = 0.0;
    if (!gb_units_number(to->prefix, &end, &value) || end == to->prefix) {
        return;
    }
    char *number = g_strndup(to->prefix, (gsize)(end - to->prefix));
    if (field->relative != NULL) {
        add_units(to, number, field->relative);
    }
    if (field->dimension == GB_DIM_FRACTION) {
        add_units(to, number, "%");
    } else if (field->dimension != GB_DIM_NONE) {
        add_units(to, number, gb_units_accepted((enum gb_dimension)field->dimension));
    }
    g_free(number);
}

/* Completes the part of a value after the last separator. */
static void add_values(const struct candidates *to, const struct gb_field *field)
{
    char accepted[512];
    gb_params_accepted(field, accepted, sizeof accepted);
    for (int i = 0; field->choices != NULL && field->choices[i] != NULL; i++) {
        add_candidate(to, field->choices[i], field->meaning);
    }
    if (field->auto_allowed) {
        add_candidate(to, "auto", accepted);
    }
    if (field->infinite != NULL) {
        add_candidate(to, field->infinite, accepted);
    }
    if (field->choices == NULL && *to->prefix == '\0' && *field->fallback != '\0' &&
        strcmp(field->fallback, "auto") != 0) {
        add_candidate(to, field->fallback, accepted);
    }
    if (field->type == GB_FIELD_SIZES) {
        static const char *const tables[] = {".csv", NULL};
        complete_paths(to, PATH_FILE, tables);
    }
    if (field->type == GB_FIELD_PACKING) {
        static const char *const packings[] = {".csv",  ".xyz", ".extxyz", ".dump",
                                               ".data", ".txt", ".vtkhdf", NULL};
        complete_paths(to, PATH_FILE, packings);
    }
    add_number(to, field);
}

static void add_materials(const struct candidates *to)
{
    static const char *const files[] = {".ini", NULL};
    char **names = gb_preset_folders_list_materials();
    for (int i = 0; names[i] != NULL; i++) {
        add_candidate(to, names[i], "material");
    }
    g_strfreev(names);
    complete_paths(to, PATH_FILE, files);
}

static void complete_value(const struct candidates *to, const char *equals)
{
    char *name = g_strndup(to->prefix, (gsize)(equals - to->prefix));
    char **parts = g_strsplit(name, ".", 2);
    const struct gb_field *field =
        parts[0] != NULL && parts[1] != NULL ? gb_params_find(parts[0], parts[1]) : NULL;
    const char *last = equals + 1;
    for (const char *c = last; *c != '\0'; c++) {
        last = strchr(";,:", *c) != NULL ? c + 1 : last;
    }
    char *before =
        g_strdup_printf("%s%.*s", to->before, (int)(last - to->prefix), to->prefix);
    const struct candidates part = {.prefix = last, .before = before};
    if (field != NULL) {
        add_values(&part, field);
    } else if (strcmp(name, GB_MATERIAL_GROUP) == 0) {
        add_materials(&part);
    }
    g_free(before);
    g_strfreev(parts);
    g_free(name);
}

/* Completes "material=": a name that sets all keys of the group. */
static void add_whole(const struct candidates *to, const char *group)
{
    if (strcmp(group, GB_MATERIAL_GROUP) == 0) {
        add_candidate(to, GB_MATERIAL_GROUP "=", "all keys of this group by a name");
    }
}

/* Completes groups, the keys of a group, and keys without their group. */
static void complete_name(const struct candidates *to)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const bool in_group = strchr(to->prefix, '.') != NULL;
    const char *last = "";
    for (size_t i = 0; i < count; i++) {
        char *group = g_strconcat(fields[i].group, ".", NULL);
        char *key = g_strconcat(group, fields[i].key, "=", NULL);
        if (in_group) {
            add_candidate(to, key, fields[i].meaning);
        } else if (strcmp(last, fields[i].group) != 0) {
            add_candidate(to, group, "keys of this group");
            add_whole(to, fields[i].group);
        }
        if (!in_group && *to->prefix != '\0' &&
            g_str_has_prefix(fields[i].key, to->prefix)) {
            add_any(to, key, fields[i].meaning);
        }
        last = fields[i].group;
        g_free(key);
        g_free(group);
    }
}

/* Completes "group." and "group.key=", also the key alone, and values after the sign. */
static void complete_keys(const struct candidates *to)
{
    const char *equals = strchr(to->prefix, '=');
    if (equals != NULL) {
        complete_value(to, equals);
    } else {
        complete_name(to);
    }
}

/* Completes the last key of a list "key,key". */
static void complete_keys_list(const struct candidates *to)
{
    const char *comma = strrchr(to->prefix, ',');
    const char *last = comma != NULL ? comma + 1 : to->prefix;
    char *before =
        g_strdup_printf("%s%.*s", to->before, (int)(last - to->prefix), to->prefix);
    complete_keys(&(struct candidates){.prefix = last, .before = before});
    g_free(before);
}

/* --- values of options -------------------------------------------------------------- */

static void add_figures(const struct candidates *to)
{
    const struct gb_figures_row *row;
    for (size_t i = 0; (row = gb_figures_at(i)) != NULL; i++) {
        add_candidate(to, row->name, row->doc);
    }
}

static void add_formats(const struct candidates *to)
{
    const struct gb_export_format *format;
    for (size_t i = 0; (format = gb_export_at(i)) != NULL; i++) {
        add_candidate(to, format->name, format->doc);
    }
}

static void add_equations(const struct candidates *to)
{
    for (size_t i = 0; i < gb_equations_count(); i++) {
        add_candidate(to, gb_equations_at(i)->name, gb_equations_at(i)->form);
    }
}

static void add_lattices(const struct candidates *to)
{
    size_t count = 0;
    const struct gb_law_table_lattice *lattice = gb_law_table_lattices(&count);
    for (size_t i = 0; i < count; i++) {
        add_candidate(to, lattice[i].name, "lattice");
    }
}

/* Completes contact laws. */
static void complete_value_laws(const struct candidates *to)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    for (size_t i = 0; i < count; i++) {
        add_candidate(to, laws[i].name, laws[i].doc);
    }
}

static void add_colours(const struct candidates *to)
{
    static const enum gb_picture_colours_kind kinds[] = {GB_PICTURE_COLOURS_PARTICLES,
                                                         GB_PICTURE_COLOURS_FORCES};
    for (size_t k = 0; k < G_N_ELEMENTS(kinds); k++) {
        char *list = gb_picture_colours_names(kinds[k]);
        char **names = g_strsplit(list, ", ", -1);
        for (int i = 0; names[i] != NULL; i++) {
            add_candidate(to, names[i], "colour");
        }
        g_strfreev(names);
        g_free(list);
    }
}

/* Options whose values are names of a table. */
static const struct {
    const char *command, *option; /* command NULL: any */
    void (*add)(const struct candidates *to);
} tables[] = {
    {"plot", "figure", add_figures},
    {"export", "format", add_formats},
    {"fit", "equation", add_equations},
    {"law", "lattice", add_lattices},
    {"snapshot", "color", add_colours},
    {NULL, "set", complete_keys},
    {NULL, "vary", complete_keys},
    {NULL, "reference", complete_keys},
    {"calibrate", "free", complete_keys_list},
};

/* Completes the value of a workbench option from its settings. */
static bool add_setting(const struct candidates *to, const char *command,
                        const char *option)
{
    size_t count = 0;
    const struct gb_settings_row *row = gb_settings_table(&count);
    for (size_t i = 0; strcmp(command, "greenbody") == 0 && i < count; i++) {
        if (strcmp(row[i].name, option) == 0) {
            for (int k = 0; row[i].values[k] != NULL; k++) {
                add_candidate(to, row[i].values[k], row[i].meaning);
            }
            return true;
        }
    }
    return false;
}

/* The endings in "FILE.png|svg|pdf"; NULL for any. */
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

/* Completes "auto|never": words in lower case stand for themselves. */
static void add_words(const struct candidates *to, const char *description)
{
    char **words = g_strsplit(description, "|", -1);
    for (int i = 0; words[1] != NULL && words[i] != NULL; i++) {
        if (g_ascii_islower(words[i][0])) {
            add_candidate(to, words[i], NULL);
        }
    }
    g_strfreev(words);
}

/* Completes the value of an option, by the names of command and option and by its
 * description: names of a table, keys, files or folders. */
static void complete_option(const struct candidates *to, const char *command,
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
        complete_paths(to, PATH_FOLDER, NULL);
    } else if (entry->arg == G_OPTION_ARG_FILENAME) {
        char **endings = endings_of(description);
        complete_paths(to, PATH_FILE, (const char *const *)endings);
        g_strfreev(endings);
    } else {
        add_words(to, description);
    }
}

/* --- command lines ------------------------------------------------------------------ */

bool gb_completion_requested(int argc, char **argv)
{
    return argc > 2 && strcmp(argv[1], GB_COMPLETION_WORD) == 0;
}

static bool takes_value(const GOptionEntry *entry)
{
    return entry->arg != G_OPTION_ARG_NONE;
}

/* The option of a word "--out", "--out=..." or "-o"; NULL for other words. */
static const GOptionEntry *find_option(const GOptionEntry *entries, const char *word)
{
    const size_t length = strcspn(word, "=");
    for (int i = 0; word[0] == '-' && entries[i].long_name != NULL; i++) {
        const char *name = entries[i].long_name;
        const bool is_long = g_str_has_prefix(word, "--") && length == strlen(name) + 2 &&
                             strncmp(word + 2, name, length - 2) == 0;
        const bool is_short = entries[i].short_name != '\0' &&
                              word[1] == entries[i].short_name && word[2] == '\0';
        if (is_long || is_short) {
            return &entries[i];
        }
    }
    return NULL;
}

static void add_options(const struct candidates *to, const GOptionEntry *entries)
{
    for (int i = 0; entries[i].long_name != NULL; i++) {
        char *name = g_strconcat("--", entries[i].long_name,
                                 takes_value(&entries[i]) ? "=" : "", NULL);
        if ((entries[i].flags & G_OPTION_FLAG_HIDDEN) == 0) {
            add_candidate(to, name, entries[i].description);
        }
        g_free(name);
    }
    add_candidate(to, "--help", "show the help page");
}

/* Is one of the words neither an option, a value nor an assignment? */
static bool has_name(const GOptionEntry *entries, char **words, int count)
{
    for (int i = 0; i < count; i++) {
        const GOptionEntry *option = find_option(entries, words[i]);
        if (option != NULL && takes_value(option) && strchr(words[i], '=') == NULL) {
            i++;
        } else if (words[i][0] != '-' && strchr(words[i], '=') == NULL) {
            return true;
        }
    }
    return false;
}

/* Completes what the usage line of the command takes: PRESET, DIR, FILE, NAME,
 * group.key=value.  Words that may be repeated are followed by "...". */
static void add_positions(const struct candidates *to, const char *usage, bool named)
{
    static const char *const presets[] = {".ini", ".png", NULL};
    static const char *const states[] = {".h5", NULL};
    const bool first = !named;
    const bool assigned = strchr(to->prefix, '=') != NULL;
    if (strstr(usage, "NAME") != NULL && first) {
        complete_value_laws(to);
        return;
    }
    if (strstr(usage, "PRESET") != NULL && !assigned &&
        (first || strstr(usage, "NAME") != NULL)) {
        candidates_presets(to);
        complete_paths(to, PATH_FILE, presets);
    }
    if (strstr(usage, "DIR") != NULL && strstr(usage, "--out DIR") == NULL && !assigned &&
        (first || strstr(usage, "DIR...") != NULL)) {
        complete_paths(to, PATH_RUN, NULL);
    }
    if (strstr(usage, "STATE.h5") != NULL && first) {
        complete_paths(to, PATH_FILE, states);
    } else if (strstr(usage, "FILE") != NULL && strstr(usage, "-o FILE") == NULL &&
               first) {
        complete_paths(to, PATH_FILE, NULL);
    }
    if (strstr(usage, "group.key") != NULL) {
        complete_keys(to);
    }
}

void gb_completion_command(const struct gb_options_page *page,
                           const GOptionEntry *entries, int argc, char **argv)
{
    char **words = argv + 2;
    const int before = argc - 3;
    const char *prefix = argv[argc - 1];
    const GOptionEntry *option =
        before > 0 ? find_option(entries, words[before - 1]) : NULL;
    const GOptionEntry *own = find_option(entries, prefix);
    const struct candidates whole = {.prefix = prefix, .before = ""};
    if (option != NULL && takes_value(option) && strchr(words[before - 1], '=') == NULL) {
        complete_option(&whole, argv[0], option);
    } else if (own != NULL && strchr(prefix, '=') != NULL) {
        const size_t length = strcspn(prefix, "=") + 1;
        char *name = g_strndup(prefix, length);
        complete_option(&(struct candidates){.prefix = prefix + length, .before = name},
                        argv[0], own);
        g_free(name);
    } else if (prefix[0] == '-') {
        add_options(&whole, entries);
    } else {
        add_positions(&whole, page->usage, has_name(entries, words, before));
    }
}

void gb_completion_first(const char *prefix)
{
    const struct candidates to = {.prefix = prefix, .before = ""};
    static const char *const presets[] = {".ini", ".png", NULL};
    if (prefix[0] == '-') {
        add_candidate(&to, "--version", "version, compiler, features, threads");
        add_candidate(&to, "--batch", "greenbody run instead of the workbench");
        add_candidate(&to, "--keys", "the keys of the workbench");
        return; /* the other options belong to the workbench */
    }
    for (size_t i = 0; gb_commands_at(i) != NULL; i++) {
        add_candidate(&to, gb_commands_at(i)->name, gb_commands_at(i)->doc);
    }
    candidates_presets(&to);
    complete_paths(&to, PATH_FILE, presets);
}
