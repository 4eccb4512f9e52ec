#include "scene/field/nearest_key.h"

#include <string.h>

#include <glib.h>

#include "base/words.h"
#include "scene/field/field_words.h"
#include "scene/field/params_table.h"

static int edits_to(const struct gb_field *field, const char *name, bool with_group)
{
    if (!with_group) {
        return gb_words_edits(field->key, name);
    }
    char *full = g_strconcat(field->group, ".", field->key, NULL);
    const int edits = gb_words_edits(full, name);
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
    int best = gb_words_allowed(name) + 1;
    bool several = false;
    buffer[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        const int edits = edits_to(&fields[i], name, with_group);
        several = edits == best || (edits > best && several);
        if (edits < best) {
            best = edits;
            nearest = i;
        }
    }
    const struct gb_field *meant = best <= gb_words_allowed(name) && !several
                                       ? &fields[nearest]
                                       : gb_field_words_find(without_group(name));
    if (meant != NULL) {
        g_snprintf(buffer, (gulong)size, "did you mean %s.%s? ", meant->group,
                   meant->key);
    }
    return buffer;
}
