#include "cli/complete/completion.h"

#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/complete/candidates.h"

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

static void add_options(const struct gb_candidates *to, const GOptionEntry *entries)
{
    for (int i = 0; entries[i].long_name != NULL; i++) {
        char *name = g_strconcat("--", entries[i].long_name,
                                 takes_value(&entries[i]) ? "=" : "", NULL);
        if ((entries[i].flags & G_OPTION_FLAG_HIDDEN) == 0) {
            gb_candidates_add(to, name, entries[i].description);
        }
        g_free(name);
    }
    gb_candidates_add(to, "--help", "show the help page");
}

/* Whether the words have one that is neither option, value nor assignment. */
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

/* What the usage line of the command takes: PRESET, DIR, FILE, NAME, group.key=value.
 * Words that are repeated have "..." behind them. */
static void add_positions(const struct gb_candidates *to, const char *usage, bool named)
{
    static const char *const presets[] = {".ini", ".png", NULL};
    static const char *const states[] = {".h5", NULL};
    const bool first = !named;
    const bool assigned = strchr(to->prefix, '=') != NULL;
    if (strstr(usage, "NAME") != NULL && first) {
        gb_candidates_value_laws(to);
        return;
    }
    if (strstr(usage, "PRESET") != NULL && !assigned &&
        (first || strstr(usage, "NAME") != NULL)) {
        gb_candidates_presets(to);
        gb_candidates_paths(to, GB_CANDIDATES_FILE, presets);
    }
    if (strstr(usage, "DIR") != NULL && strstr(usage, "--out DIR") == NULL && !assigned &&
        (first || strstr(usage, "DIR...") != NULL)) {
        gb_candidates_paths(to, GB_CANDIDATES_RUN, NULL);
    }
    if (strstr(usage, "STATE.h5") != NULL && first) {
        gb_candidates_paths(to, GB_CANDIDATES_FILE, states);
    } else if (strstr(usage, "FILE") != NULL && strstr(usage, "-o FILE") == NULL &&
               first) {
        gb_candidates_paths(to, GB_CANDIDATES_FILE, NULL);
    }
    if (strstr(usage, "group.key") != NULL) {
        gb_candidates_keys(to);
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
    const struct gb_candidates whole = {.prefix = prefix, .before = ""};
    if (option != NULL && takes_value(option) && strchr(words[before - 1], '=') == NULL) {
        gb_candidates_value(&whole, argv[0], option);
    } else if (own != NULL && strchr(prefix, '=') != NULL) {
        const size_t length = strcspn(prefix, "=") + 1;
        char *name = g_strndup(prefix, length);
        gb_candidates_value(
            &(struct gb_candidates){.prefix = prefix + length, .before = name}, argv[0],
            own);
        g_free(name);
    } else if (prefix[0] == '-') {
        add_options(&whole, entries);
    } else {
        add_positions(&whole, page->usage, has_name(entries, words, before));
    }
}

void gb_completion_first(const char *prefix)
{
    const struct gb_candidates to = {.prefix = prefix, .before = ""};
    static const char *const presets[] = {".ini", ".png", NULL};
    if (prefix[0] == '-') {
        gb_candidates_add(&to, "--version", "version, compiler, features, threads");
        gb_candidates_add(&to, "--batch", "greenbody run instead of the workbench");
        gb_candidates_add(&to, "--keys", "the keys of the workbench");
        return; /* the other options are those of the workbench */
    }
    for (size_t i = 0; gb_commands_at(i) != NULL; i++) {
        gb_candidates_add(&to, gb_commands_at(i)->name, gb_commands_at(i)->doc);
    }
    gb_candidates_presets(&to);
    gb_candidates_paths(&to, GB_CANDIDATES_FILE, presets);
}
