#include "base/text/text_list.h"

#include <string.h>

#include <glib.h>

/* Bytes of " and 1000 more". */
enum { MORE_BYTES = 24 };

char *gb_text_list_join(char *const *words, size_t bytes)
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
