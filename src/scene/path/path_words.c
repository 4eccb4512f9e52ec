#include "scene/path/path_words.h"

#include <glib.h>
#include <string.h>

#include "base/units.h"
#include "scene/path/path.h"

static bool stands_alone(char c)
{
    return c == '=' || c == ',';
}

/* Copies text with blanks around '=' and ',' and before '%'. */
static char *spread(const char *text)
{
    GString *out = g_string_new(NULL);
    for (const char *c = text; *c != '\0'; c++) {
        if (stands_alone(*c)) {
            g_string_append_printf(out, " %c ", *c);
        } else if (*c == '%') {
            g_string_append(out, " %");
        } else {
            g_string_append_c(out, *c);
        }
    }
    return g_string_free(out, FALSE);
}

bool gb_path_words_init(struct gb_path_words *words, const char *text,
                        struct gb_error *err)
{
    *words = (struct gb_path_words){.storage = spread(text)};
    char *rest = words->storage;
    for (;;) {
        rest += strspn(rest, " \t");
        if (*rest == '\0') {
            return true;
        }
        if (words->count == GB_PATH_WORDS_MAX) {
            return gb_error_set(err, GB_ERR_INPUT, "must be at most %d words",
                                GB_PATH_WORDS_MAX);
        }
        words->word[words->count++] = rest;
        rest += strcspn(rest, " \t");
        if (*rest != '\0') {
            *rest++ = '\0';
        }
    }
}

void gb_path_words_finish(struct gb_path_words *words)
{
    g_free(words->storage);
    words->storage = NULL;
}

const char *gb_path_words_peek(const struct gb_path_words *words)
{
    return words->next < words->count ? words->word[words->next] : "";
}

const char *gb_path_words_take(struct gb_path_words *words)
{
    const char *word = gb_path_words_peek(words);
    words->next += words->next < words->count;
    return word;
}

bool gb_path_words_accept(struct gb_path_words *words, const char *word)
{
    const bool same = strcmp(gb_path_words_peek(words), word) == 0;
    words->next += same;
    return same;
}

bool gb_path_words_quantity(struct gb_path_words *words, enum gb_dimension dimension,
                            double *value)
{
    const int left = words->count - words->next;
    for (int used = left < 2 ? left : 2; used >= 1; used--) {
        char *text = used == 2 ? g_strjoin(" ", words->word[words->next],
                                           words->word[words->next + 1], NULL)
                               : g_strdup(words->word[words->next]);
        const bool good = gb_units_parse(text, dimension, value, NULL);
        g_free(text);
        if (good) {
            words->next += used;
            return true;
        }
    }
    return false;
}

int gb_path_words_component(struct gb_path_words *words)
{
    const char *word = gb_path_words_peek(words);
    const int component = gb_path_component_find(word, strlen(word));
    words->next += component >= 0;
    return component;
}
