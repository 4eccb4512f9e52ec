#include "cli/screen_options.h"

#include <string.h>

void gb_screen_options_entries(struct gb_screen_options *options, GOptionEntry *entry)
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

bool gb_screen_options_settings(const struct gb_screen_options *options,
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

void gb_screen_options_finish(struct gb_screen_options *options)
{
    g_free(options->color);
    g_free(options->theme);
    g_free(options->graph);
    g_free(options->images);
    g_free(options->clipboard);
    g_free(options->mouse);
}

/* Words of an option: 1, or 2 where its value is the next word; 0: no screen option. */
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

int gb_screen_options_drop(int argc, char **argv)
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

bool gb_screen_options_has(int argc, char **argv, const char *word)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], word) == 0) {
            return true;
        }
    }
    return false;
}
