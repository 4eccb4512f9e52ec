#include "base/words.h"

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Bytes of " and 1000 more". */
enum { MORE_BYTES = 24 };

char *gb_words_join(char *const *words, size_t bytes)
{
    GString *text = g_string_new("");
    size_t more = 0;
    for (size_t i = 0; words[i] != NULL; i++) {
        const char *between = text->len > 0 ? ", " : "";
        const size_t count = (words[i + 1] != NULL || more > 0) ? MORE_BYTES : 0;
        if (text->len + strlen(between) + strlen(words[i]) + count <= bytes) {
            g_string_append_printf(text, "%s%s", between, words[i]);
        } else {
            more++;
        }
    }
    if (text->len > 0 && more > 0) {
        g_string_append_printf(text, " and %zu more", more);
    }
    return g_string_free(text, FALSE);
}

enum { BYTES_MAX = 40 };

static int least(int a, int b, int c)
{
    return MIN(MIN(a, b), c);
}

int gb_words_edits(const char *a, const char *b)
{
    int row[3][BYTES_MAX + 1];
    int *before = row[0], *last = row[1], *now = row[2];
    const size_t lengths[2] = {strlen(a), strlen(b)};
    if (lengths[0] > BYTES_MAX || lengths[1] > BYTES_MAX) {
        return BYTES_MAX;
    }
    for (size_t j = 0; j <= lengths[1]; j++) {
        before[j] = last[j] = (int)j;
    }
    for (size_t i = 1; i <= lengths[0]; i++) {
        now[0] = (int)i;
        for (size_t j = 1; j <= lengths[1]; j++) {
            const int other = a[i - 1] != b[j - 1];
            now[j] = least(last[j] + 1, now[j - 1] + 1, last[j - 1] + other);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = MIN(now[j], before[j - 2] + 1);
            }
        }
        int *oldest = before;
        before = last;
        last = now;
        now = oldest;
    }
    return last[lengths[1]];
}

int gb_words_allowed(const char *name)
{
    return (int)MIN(2, strlen(name) / 3);
}

char *gb_words_nearest(const char *name, char *const *words, char *buffer, size_t size)
{
    const char *nearest = NULL;
    int best = gb_words_allowed(name) + 1;
    bool several = false;
    buffer[0] = '\0';
    for (; *words != NULL; words++) {
        const int edits = gb_words_edits(name, *words);
        several = edits == best || (edits > best && several);
        if (edits < best) {
            best = edits;
            nearest = *words;
        }
    }
    if (nearest != NULL && !several) {
        g_snprintf(buffer, (gulong)size, "did you mean %s? ", nearest);
    }
    return buffer;
}

char *gb_words_nearest_in(const char *name, const char *words, char *buffer, size_t size)
{
    char **list = g_strsplit(words, ", ", -1);
    gb_words_nearest(name, list, buffer, size);
    g_strfreev(list);
    return buffer;
}
