#include "base/text/nearest_word.h"

#include <stdbool.h>
#include <string.h>

#include <glib.h>

enum { BYTES_MAX = 40 };

static int least(int a, int b, int c)
{
    return MIN(MIN(a, b), c);
}

int gb_nearest_word_edits(const char *a, const char *b)
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

int gb_nearest_word_allowed(const char *name)
{
    return (int)MIN(2, strlen(name) / 3);
}

char *gb_nearest_word(const char *name, char *const *words, char *buffer, size_t size)
{
    const char *nearest = NULL;
    int best = gb_nearest_word_allowed(name) + 1;
    bool several = false;
    buffer[0] = '\0';
    for (; *words != NULL; words++) {
        const int edits = gb_nearest_word_edits(name, *words);
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

char *gb_nearest_word_in(const char *name, const char *words, char *buffer, size_t size)
{
    char **list = g_strsplit(words, ", ", -1);
    gb_nearest_word(name, list, buffer, size);
    g_strfreev(list);
    return buffer;
}
