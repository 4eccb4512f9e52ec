/* Options that commands have in common: help pages and parsing, the screen, the size of
 * pictures, --set and presets, and printing to stdout with its errors. */
#include "cli/options.h"

#include <errno.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <json-glib/json-glib.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/visible.h"
#include "cli/completion.h"
#include "draw/image.h"
#include "greenbody/status.h"
#include "io/material.h"
#include "io/preset_folders.h"
#include "io/status_json.h"
#include "run/run_loop.h"
#include "tui/term/settings.h"

void gb_options_screen_entries(struct gb_screen_options *options, GOptionEntry *entry)
{
    const GOptionEntry entries[GB_SCREEN_OPTIONS_ENTRIES] = {
        {"color", 0, 0, G_OPTION_ARG_STRING, &options->color,
         "auto, always or never; auto: unless NO_COLOR is set", "WHEN"},
        {"theme", 0, 0, G_OPTION_ARG_STRING, &options->theme,
         "colours: auto, light, dark or contrast", "NAME"},
        {"graph", 0, 0, G_OPTION_ARG_STRING, &options->graph,
         "characters of plots: auto, braille, block or ascii", "HOW"},
        {"images", 0, 0, G_OPTION_ARG_STRING, &options->images,
         "the packing as pixels: auto, none, sixel or kitty", "HOW"},
        {"clipboard", 0, 0, G_OPTION_ARG_STRING, &options->clipboard,
         "copies by OSC 52: auto, osc52, tmux, screen or off", "HOW"},
        {"mouse", 0, 0, G_OPTION_ARG_STRING, &options->mouse,
         "on or off; dragging with Shift selects text in any case", "on"},
        {"ascii", 0, 0, G_OPTION_ARG_NONE, &options->ascii, "ASCII characters only",
         NULL},
        {"slow", 0, 0, G_OPTION_ARG_NONE, &options->slow,
         "two frames a second instead of ten", NULL},
        {"diagnose", 0, 0, G_OPTION_ARG_NONE, &options->diagnose,
         "print the detected features of the terminal and exit", NULL}};
    memcpy(entry, entries, sizeof entries);
}

bool gb_options_screen_settings(const struct gb_screen_options *options,
                                struct gb_settings *settings, struct gb_error *err)
{
    const struct {
        const char *name, *value;
    } given[] = {{"color", options->color},
                 {"theme", options->theme},
                 {"graph", options->graph},
                 {"images", options->images},
                 {"clipboard", options->clipboard},
                 {"mouse", options->mouse},
                 {"ascii", options->ascii ? "on" : NULL},
                 {"slow", options->slow ? "on" : NULL}};
    char *path = gb_settings_path();
    gb_settings_init(settings);
    bool good = gb_settings_read(settings, path, err);
    for (size_t i = 0; good && i < G_N_ELEMENTS(given); i++) {
        struct gb_error wrong = {0};
        if (given[i].value != NULL &&
            !gb_settings_set(settings, given[i].name, given[i].value, &wrong)) {
            good = gb_error_set(err, GB_ERR_INPUT, "--%s", wrong.text);
        }
    }
    g_free(path);
    return good;
}

void gb_options_screen_finish(struct gb_screen_options *options)
{
    g_free(options->color);
    g_free(options->theme);
    g_free(options->graph);
    g_free(options->images);
    g_free(options->clipboard);
    g_free(options->mouse);
}

/* Number of words of an option: 2 if its value is the next word, else 1; 0: not a
 * screen option. */
static int words_of(const char *word)
{
    static const char *const flags[] = {"--batch", "--ascii", "--slow"};
    static const char *const values[] = {"--color",  "--theme",     "--graph",
                                         "--images", "--clipboard", "--mouse"};
    for (size_t i = 0; i < G_N_ELEMENTS(flags); i++) {
        if (strcmp(word, flags[i]) == 0) {
            return 1;
        }
    }
    for (size_t i = 0; i < G_N_ELEMENTS(values); i++) {
        const size_t n = strlen(values[i]);
        if (strncmp(word, values[i], n) == 0 && (word[n] == '\0' || word[n] == '=')) {
            return word[n] == '=' ? 1 : 2;
        }
    }
    return 0;
}

int gb_options_screen_drop(int argc, char **argv)
{
    int kept = 0;
    for (int i = 0; i < argc; i++) {
        const int words = i > 0 ? words_of(argv[i]) : 0;
        if (words == 0) {
            argv[kept++] = argv[i];
        }
        i += words == 2;
    }
    argv[kept] = NULL;
    return kept;
}

bool gb_options_has(int argc, char **argv, const char *word)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], word) == 0) {
            return true;
        }
    }
    return false;
}

bool gb_options_page_take(const struct gb_page_options *options, int *width, int *height,
                          int *per_inch, struct gb_error *err)
{
    struct gb_image_print print;
    if (options->width == NULL) {
        return (options->per_inch == 0 ||
                gb_error_set(err, GB_ERR_INPUT, "--dpi: expected with --width")) &&
               (options->size == NULL ||
                gb_image_parse_size(options->size, width, height, err));
    }
    if (options->size != NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "--size, --width: expected one of them");
    }
    if (!gb_image_parse_print(options->width,
                              options->per_inch != 0 ? options->per_inch : 300, &print,
                              err)) {
        return false;
    }
    *width = print.width;
    *height = print.height;
    *per_inch = print.per_inch;
    return true;
}

static void append_column(GString *text, const struct gb_image_journal *row,
                          const char *columns, double mm)
{
    if (mm > 0.0) {
        char *name = g_strconcat(row->name, columns, NULL);
        g_string_append_printf(text, "  %-13s%5g mm", name, mm);
        g_free(name);
    } else {
        g_string_append_printf(text, "  %21s", "");
    }
}

char *gb_options_page_journals(void)
{
    GString *text = g_string_new("Columns of journals for --width: one, one and a half, "
                                 "two (sources in docs/figures.md):\n");
    for (const struct gb_image_journal *row = gb_image_journals; row->name != NULL;
         row++) {
        append_column(text, row, "", row->single_mm);
        append_column(text, row, "-1.5", row->middle_mm);
        append_column(text, row, "-2", row->double_mm);
        g_string_append_c(text, '\n');
    }
    return g_string_free(text, FALSE);
}

void gb_options_page_finish(struct gb_page_options *options)
{
    g_free(options->size);
    g_free(options->width);
}

/* Output of --json: one object on one or more lines, followed by a newline. */

static void print_node(JsonNode *root)
{
    char *text = gb_status_json_print(root);
    gb_visible_print(stdout, "%s\n", text);
    g_free(text);
}

JsonBuilder *gb_options_json_begin(const char *name)
{
    JsonBuilder *json = json_builder_new();
    json_builder_begin_object(json);
    json_builder_set_member_name(json, name);
    json_builder_begin_array(json);
    return json;
}

void gb_options_json_end(JsonBuilder *json)
{
    json_builder_end_array(json);
    json_builder_end_object(json);
    JsonNode *root = json_builder_get_root(json);
    print_node(root);
    json_node_unref(root);
    g_object_unref(json);
}

void gb_options_json_run(const struct gb_run_loop *loop)
{
    const char *directory = gb_store_directory(gb_run_recorder_store(loop->recorder));
    char *text =
        gb_status_json_text(&loop->snapshot, gb_run_recorder_points(loop->recorder));
    char *name = g_utf8_make_valid(directory, -1);
    JsonNode *root = json_from_string(text, NULL);
    json_object_set_string_member(json_node_get_object(root), "directory", name);
    print_node(root);
    json_node_unref(root);
    g_free(name);
    g_free(text);
}

static GOptionContext *make_context(const struct gb_options_page *page,
                                    const GOptionEntry *entries, const char *command)
{
    /* GLib's own help calls exit(), which would skip the check of stdout. */
    GOptionContext *context = g_option_context_new(page->usage);
    g_option_context_set_help_enabled(context, FALSE);
    g_option_context_set_summary(context, page->summary);
    g_option_context_set_description(context, page->description);
    g_option_context_add_main_entries(context, entries, NULL);
    char *name = strcmp(command, "greenbody") == 0
                     ? g_strdup(command)
                     : g_strconcat("greenbody ", command, NULL);
    g_set_prgname(name);
    g_free(name);
    return context;
}

static void print_help(GOptionContext *context)
{
    char *text = g_option_context_get_help(context, TRUE, NULL);
    gb_visible_put(stdout, text);
    g_free(text);
}

/* The words that are not options, without the first "--". */
static char **take_words(char **arguments)
{
    GPtrArray *words = g_ptr_array_new();
    bool dashes = false;
    for (int i = 1; arguments[i]; i++) {
        if (!dashes && strcmp(arguments[i], "--") == 0) {
            dashes = true;
        } else {
            g_ptr_array_add(words, g_strdup(arguments[i]));
        }
    }
    g_ptr_array_add(words, NULL);
    return (char **)g_ptr_array_free(words, FALSE);
}

bool gb_options_parse(const struct gb_options_page *page, const GOptionEntry *entries,
                      int argc, char **argv, char ***words, int *status)
{
    gboolean help = FALSE;
    if (gb_completion_requested(argc, argv)) {
        gb_completion_command(page, entries, argc, argv);
        *status = 0;
        return false;
    }
    const GOptionEntry own[] = {
        {"help", 'h', 0, G_OPTION_ARG_NONE, &help, "show this page", NULL},
        {0},
    };
    GOptionContext *context = make_context(page, entries, argv[0]);
    g_option_context_add_main_entries(context, own, NULL);
    char **arguments = g_new0(char *, (gsize)argc + 1);
    for (int i = 0; i < argc; i++) {
        arguments[i] = g_strdup(argv[i]);
    }
    GError *failure = NULL;
    const bool good = g_option_context_parse_strv(context, &arguments, &failure);
    *status = 0;
    if (!good) {
        struct gb_error err;
        gb_error_set(&err, GB_ERR_INPUT, "%s; see %s --help", failure->message,
                     g_get_prgname());
        g_error_free(failure);
        *status = gb_options_fail(&err);
    } else if (help) {
        print_help(context);
    } else {
        *words = take_words(arguments);
    }
    g_strfreev(arguments);
    g_option_context_free(context);
    return good && !help;
}

GOptionEntry gb_options_set(char ***sets)
{
    return (GOptionEntry){"set",
                          0,
                          0,
                          G_OPTION_ARG_STRING_ARRAY,
                          sets,
                          "give a parameter another value; may be repeated",
                          "group.key=value"};
}

GOptionEntry gb_options_quiet(gboolean *quiet)
{
    return (GOptionEntry){
        "quiet", 'q', 0, G_OPTION_ARG_NONE, quiet, "only errors on stderr", NULL};
}

GOptionEntry gb_options_json(gboolean *json)
{
    return (GOptionEntry){
        "json", 0, 0, G_OPTION_ARG_NONE, json, "the result as a JSON object on stdout",
        NULL};
}

static bool is_assignment(const char *word)
{
    return strchr(word, '=') != NULL;
}

/* Assigns the values of --set. */
static bool assign_sets(struct gb_params *params, char **sets, struct gb_error *err)
{
    for (int i = 0; sets != NULL && sets[i] != NULL; i++) {
        if (!gb_material_assign(params, sets[i], err)) {
            return false;
        }
    }
    return true;
}

static bool assign_words(struct gb_params *params, char **words, struct gb_error *err)
{
    for (int i = 0; words != NULL && words[i] != NULL; i++) {
        if (is_assignment(words[i]) && !gb_material_assign(params, words[i], err)) {
            return false;
        }
    }
    return true;
}

/* Is the word like "contact.mu", without a value, and not the name of a file? */
static bool is_key(const char *word)
{
    char **parts = g_strsplit(word, ".", 2);
    const bool known = parts[0] != NULL && parts[1] != NULL &&
                       gb_params_find(parts[0], parts[1]) != NULL;
    g_strfreev(parts);
    return known && !g_file_test(word, G_FILE_TEST_EXISTS);
}

/* Finds the only word that is not an assignment, or NULL. */
static bool find_name(char **words, const char **name, struct gb_error *err)
{
    *name = NULL;
    for (int i = 0; words != NULL && words[i] != NULL; i++) {
        if (is_assignment(words[i])) {
            continue;
        }
        if (is_key(words[i])) {
            return gb_error_set(err, GB_ERR_INPUT, "%.80s: missing \"=value\"", words[i]);
        }
        if (*name != NULL) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.80s: expected one preset, %.80s is given already",
                                words[i], *name);
        }
        *name = words[i];
    }
    return true;
}

/* Loads the preset stored in a picture, through a temporary file with the picture's
 * name. */
static bool load_from_picture(struct gb_preset **out, const char *path,
                              struct gb_error *err)
{
    char *text = NULL;
    if (!gb_image_read_text(path, "Preset", &text, err)) {
        return false;
    }
    char *folder = g_dir_make_tmp("greenbody-XXXXXX", NULL);
    char *name = g_path_get_basename(path);
    memcpy(strrchr(name, '.'), ".ini", 4);
    char *file = g_build_filename(folder != NULL ? folder : "/nowhere", name, NULL);
    bool good = g_file_set_contents(file, text, -1, NULL) ||
                gb_error_set(err, GB_ERR_MACHINE,
                             "%.300s: cannot make a temporary file for its preset in "
                             "%.100s",
                             path, g_get_tmp_dir());
    good = good && gb_preset_load(out, file, err);
    g_unlink(file);
    if (folder != NULL) {
        g_rmdir(folder);
    }
    g_free(file);
    g_free(name);
    g_free(folder);
    g_free(text);
    return good;
}

static bool load_named(struct gb_preset **out, const char *name, struct gb_error *err)
{
    return g_str_has_suffix(name, ".png") ? load_from_picture(out, name, err)
                                          : gb_preset_load(out, name, err);
}

bool gb_options_preset(struct gb_preset **out, char **words, char **sets,
                       enum gb_options_preset need, struct gb_error *err)
{
    const char *name = NULL;
    if (!find_name(words, &name, err)) {
        return false;
    }
    if (need == GB_OPTIONS_PRESET_NEEDED && name == NULL) {
        char **known = gb_preset_folders_list();
        char *list = g_strjoinv(", ", known);
        gb_error_set(err, GB_ERR_INPUT, "a preset is needed: a file, or one of %s", list);
        g_free(list);
        g_strfreev(known);
        return false;
    }
    struct gb_preset *preset = NULL;
    if (name ? !load_named(&preset, name, err) : !gb_preset_create(&preset, err)) {
        return false;
    }
    struct gb_params *params = gb_preset_params(preset);
    if (!assign_words(params, words, err) || !assign_sets(params, sets, err)) {
        gb_preset_destroy(preset);
        return false;
    }
    *out = preset;
    return true;
}

bool gb_options_scene(struct gb_preset **out, char **words, char **sets,
                      enum gb_options_preset need, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_options_preset(&preset, words, sets, need, err)) {
        return false;
    }
    if (!gb_params_check(gb_preset_params(preset), err)) {
        gb_preset_destroy(preset);
        return false;
    }
    *out = preset;
    return true;
}

bool gb_options_points(struct gb_keep_points *points, const char *at,
                       struct gb_error *err)
{
    struct gb_error why;
    char **parts = g_strsplit(at ? at : "", ";", -1);
    for (int k = 0; parts[k] != NULL; k++) {
        char *part = g_strstrip(parts[k]);
        if (part[0] == 'p' && strchr(" =", part[1]) != NULL) {
            char *value = strchr(part, '=');
            memmove(part, value ? value + 1 : part, strlen(value ? value + 1 : part) + 1);
        }
    }
    char *text = g_strjoinv(";", parts);
    const bool good = gb_keep_points_parse(text, points, &why) && points->every == 0;
    g_free(text);
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--at %.80s: must be up to %d pressures or densities "
                                "separated by ';', as in \"p=100 MPa; density=0.5\"",
                                at, GB_KEEP_POINTS_MAX);
}

const char *gb_options_directory(char **words, const char *command, struct gb_error *err)
{
    if (g_strv_length(words) == 1) {
        return words[0];
    }
    gb_error_set(err, GB_ERR_INPUT, "%s: expected one run directory", command);
    return NULL;
}

int gb_options_fail(const struct gb_error *err)
{
    if (err->code != GB_OK) {
        gb_visible_line(stderr, "greenbody: %s", err->text);
    }
    return gb_status_exit_code(err->code);
}

bool gb_options_output_failed(struct gb_error *err)
{
    const int number = errno;
    if (number == EPIPE) {
        return gb_error_set(err, GB_OK, "the reader has closed the pipe");
    }
    return gb_error_set(err, GB_ERR_MACHINE, "standard output: %s", g_strerror(number));
}

bool gb_options_print(GString *text, struct gb_error *err)
{
    const bool good = (gb_visible_put(stdout, text->str) && fflush(stdout) == 0) ||
                      gb_options_output_failed(err);
    g_string_free(text, TRUE);
    return good;
}

char *gb_options_command(const char *head, int argc, char **argv)
{
    GString *text = g_string_new(head);
    g_string_append(text, "greenbody");
    for (int i = 0; i < argc; i++) {
        const bool plain = strpbrk(argv[i], " ;'\"\n") == NULL;
        char *quoted = plain ? g_strdup(argv[i]) : g_shell_quote(argv[i]);
        g_string_append_printf(text, " %s", quoted);
        g_free(quoted);
    }
    char *shown = gb_visible_text(text->str, "");
    g_string_free(text, TRUE);
    return shown;
}
