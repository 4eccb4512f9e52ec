#include "base/visible.h"

#include <stdarg.h>
#include <string.h>

/* Bytes of the longest escape, "\u009b", or UTF-8 character, and a NUL. */
enum { UNIT_BYTES = 8 };

/* Copies the next character or its escape to unit; returns the number of bytes read. */
static size_t take(const char *at, const char *kept, char unit[UNIT_BYTES])
{
    const unsigned char byte = (unsigned char)*at;
    const gunichar code = g_utf8_get_char_validated(at, -1);
    const bool text = code != (gunichar)-1 && code != (gunichar)-2;
    if (!text || (byte < 0x80 && g_ascii_iscntrl(*at) && strchr(kept, *at) == NULL)) {
        g_snprintf(unit, UNIT_BYTES, "\\x%02x", byte);
        return 1;
    }
    const size_t width = (size_t)(g_utf8_next_char(at) - at);
    if (byte >= 0x80 && code < 0xa0) {
        g_snprintf(unit, UNIT_BYTES, "\\u%04x", code);
    } else {
        memcpy(unit, at, width);
        unit[width] = '\0';
    }
    return width;
}

void gb_visible_copy(char *to, size_t size, const char *text)
{
    char unit[UNIT_BYTES];
    size_t length = 0;
    for (const char *at = text; *at != '\0';) {
        at += take(at, "", unit);
        const size_t more = strlen(unit);
        if (length + more >= size) {
            break;
        }
        memcpy(to + length, unit, more);
        length += more;
    }
    to[length] = '\0';
}

char *gb_visible_text(const char *text, const char *kept)
{
    char unit[UNIT_BYTES];
    GString *out = g_string_sized_new(strlen(text) + 1);
    for (const char *at = text; *at != '\0';) {
        at += take(at, kept, unit);
        g_string_append(out, unit);
    }
    return g_string_free(out, FALSE);
}

bool gb_visible_put(FILE *to, const char *text)
{
    char *shown = gb_visible_text(text, "\n\t");
    const bool good = fputs(shown, to) >= 0;
    g_free(shown);
    return good;
}

bool gb_visible_print(FILE *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    const bool good = gb_visible_put(to, text);
    g_free(text);
    return good;
}

bool gb_visible_line_of(FILE *to, const char *format, va_list arguments)
{
    char *text = g_strdup_vprintf(format, arguments);
    char *shown = gb_visible_text(text, "");
    const bool good = fprintf(to, "%s\n", shown) >= 0;
    g_free(shown);
    g_free(text);
    return good;
}

bool gb_visible_line(FILE *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const bool good = gb_visible_line_of(to, format, arguments);
    va_end(arguments);
    return good;
}

void gb_visible_rewrite(FILE *to, int width, const char *line)
{
    char *shown = gb_visible_text(line, "");
    fprintf(to, "\r%-*s%s", width, shown, *shown == '\0' ? "\r" : "");
    fflush(to);
    g_free(shown);
}

/* Is the rest of a cell a number? */
static bool is_number(const char *text)
{
    char *end = NULL;
    (void)g_ascii_strtod(text, &end);
    return end != text && (*end == '\0' || strchr(" ,;\t)", *end) != NULL);
}

void gb_visible_add_cell(GString *to, const char *text, bool cell)
{
    bool begins = cell;
    for (const char *c = text; *c != '\0'; c++) {
        if (begins && strchr("=+-@", *c) != NULL && !is_number(c)) {
            g_string_append_c(to, '\'');
        }
        g_string_append_c(to, *c);
        begins = strchr(",;\t", *c) != NULL || (begins && strchr(" \"", *c) != NULL);
    }
}
