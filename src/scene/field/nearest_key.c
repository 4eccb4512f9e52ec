#include "scene/field/nearest_key.h"

#include <string.h>

#include <glib.h>

#include "scene/field/field_words.h"
#include "scene/field/params_table.h"

enum { NAME_MAX_BYTES = 40 };

static int least(int a, int b, int c)
{
    return MIN(MIN(a, b), c);
}

/* Characters to replace, to insert, to leave out, or neighbours to exchange, from a to b.
 * Source: Damerau, Commun. ACM 7, 171 (1964). */
static int distance(const char *a, const char *b)
{
    int row[3][NAME_MAX_BYTES + 1];
    int *before = row[0], *last = row[1], *now = row[2];
    const int lengths[2] = {(int)strlen(a), (int)strlen(b)};
    if (lengths[0] > NAME_MAX_BYTES || lengths[1] > NAME_MAX_BYTES) {
        return NAME_MAX_BYTES;
    }
    for (int j = 0; j <= lengths[1]; j++) {
        before[j] = last[j] = j;
    }
    for (int i = 1; i <= lengths[0]; i++) {
        now[0] = i;
        for (int j = 1; j <= lengths[1]; j++) {
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

/* A third of the characters, at most two. */
static int allowed(const char *name)
{
    return MIN(2, (int)strlen(name) / 3);
}

static int distance_to(const struct gb_field *field, const char *name, bool with_group)
{
    if (!with_group) {
        return distance(field->key, name);
    }
    char *full = g_strconcat(field->group, ".", field->key, NULL);
    const int edits = distance(full, name);
    g_free(full);
    return edits;
}

static const char *without_group(const char *name)
{
    const char *dot = strchr(name, '.');
    return dot != NULL ? dot + 1 : name;
}

char *gb_nearest_key(const char *name, char *buffer, size_t size)
{
    size_t count = 0, nearest = 0;
    const struct gb_field *fields = gb_params_table(&count);
    const bool with_group = strchr(name, '.') != NULL;
    int best = allowed(name) + 1;
    bool several = false;
    buffer[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        const int edits = distance_to(&fields[i], name, with_group);
        several = edits == best || (edits > best && several);
        if (edits < best) {
            best = edits;
            nearest = i;
        }
    }
    const struct gb_field *meant = best <= allowed(name) && !several
                                       ? &fields[nearest]
                                       : gb_field_words_find(without_group(name));
    if (meant != NULL) {
        g_snprintf(buffer, (gulong)size, "did you mean %s.%s? ", meant->group, meant->key);
    }
    return buffer;
}
