#include "cli/screening.h"

#include <string.h>

bool gb_screening_settings(const struct gb_screening *screening,
                           struct gb_settings *settings, struct gb_error *err)
{
    const struct {
        const char *name, *value;
    } given[] = {{"color", screening->color},
                 {"graph", screening->graph},
                 {"images", screening->images},
                 {"mouse", screening->mouse},
                 {"ascii", screening->ascii ? "on" : NULL},
                 {"slow", screening->slow ? "on" : NULL}};
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

void gb_screening_finish(struct gb_screening *screening)
{
    g_free(screening->color);
    g_free(screening->graph);
    g_free(screening->images);
    g_free(screening->mouse);
}

/* 1: a word of its own, 2: with its value in the next one, 0: it is something else. */
static int length_of(const char *word)
{
    static const char *const flags[] = {"--batch", "--ascii", "--slow"};
    static const char *const values[] = {"--color", "--graph", "--images", "--mouse"};
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

int gb_screening_drop(int argc, char **argv)
{
    int kept = 0;
    for (int i = 0; i < argc; i++) {
        const int length = i > 0 ? length_of(argv[i]) : 0;
        if (length == 0) {
            argv[kept++] = argv[i];
        }
        i += length == 2;
    }
    argv[kept] = NULL;
    return kept;
}

bool gb_screening_has(int argc, char **argv, const char *word)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], word) == 0) {
            return true;
        }
    }
    return false;
}
