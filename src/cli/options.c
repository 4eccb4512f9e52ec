#include "cli/options.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <glib/gstdio.h>

#include "base/text/visible.h"
#include "cli/completion.h"
#include "draw/image/png.h"
#include "io/material.h"
#include "io/preset_folders.h"

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

/* The words that are no options, without the first "--". */
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

/* The values of --set, all of them assignments. */
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

/* A word like "contact.mu", without a value and without a file of that name. */
static bool is_key(const char *word)
{
    char **parts = g_strsplit(word, ".", 2);
    const bool known = parts[0] != NULL && parts[1] != NULL &&
                       gb_params_find(parts[0], parts[1]) != NULL;
    g_strfreev(parts);
    return known && !g_file_test(word, G_FILE_TEST_EXISTS);
}

/* The only word that is no assignment, or NULL. */
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

/* The preset stored in a picture, through a temporary file with the picture's name. */
static bool load_from_picture(struct gb_preset **out, const char *path,
                              struct gb_error *err)
{
    char *text = NULL;
    if (!gb_png_read_text(path, "Preset", &text, err)) {
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
