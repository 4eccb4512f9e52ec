#include "tui/term/text_fit.h"

#include <glib.h>
#include <string.h>

#include "tui/term/paint.h"

#define ELLIPSIS "\u2026"

/* Decimals that a number is left at least where nothing else of a text fits. */
enum { DECIMALS_MIN = 2 };

static bool is_exponent_mark(const char *text, const char *at)
{
    return (*at == 'e' || *at == 'E') && at > text && g_ascii_isdigit(at[-1]);
}

/* Digits, a decimal point among them, an exponent with its sign. */
static bool is_of_number(const char *text, const char *at)
{
    return g_ascii_isdigit(*at) || *at == '.' || is_exponent_mark(text, at) ||
           ((*at == '-' || *at == '+') && at > text && is_exponent_mark(text, at - 1));
}

static bool has_digit(const char *from, const char *end)
{
    while (from < end && !g_ascii_isdigit(*from)) {
        from++;
    }
    return from < end;
}

/* Whether a number from the beginning of a text is cut behind some of its decimals. */
static bool is_cut_decimal(const char *text, const char *end)
{
    const char *point = memchr(text, '.', (size_t)(end - text));
    for (const char *at = text; is_of_number(text, at); at++) {
        if (is_exponent_mark(text, at)) {
            return false;
        }
    }
    return point != NULL && end - point > DECIMALS_MIN;
}

/* Whether a cut at this place takes the end of a word. */
static bool is_in_word(const char *text, const char *end)
{
    return end > text && end[-1] != ' ' && g_ascii_isalpha(*end);
}

/* The end of a cut text without a part of the unit of a number: "2.9 s" says seconds where
 * the text had standard errors. */
static const char *leave_unit(const char *text, const char *end)
{
    const char *from = end;
    if (!is_in_word(text, end)) {
        return end;
    }
    while (from > text && from[-1] != ' ') {
        from--;
    }
    return from - text >= 2 && g_ascii_isdigit(from[-2]) ? from - 1 : end;
}

/* The end of a cut text without the number there. */
static const char *leave_number(const char *text, const char *end)
{
    const char *from = end = leave_unit(text, end);
    while (from > text && is_of_number(text, from - 1)) {
        from--;
    }
    if (!has_digit(from, end) || (from == text && is_cut_decimal(text, end))) {
        return end;
    }
    return from;
}

char *gb_text_fit(const char *text, int cols)
{
    const char *end = text;
    if (gb_paint_width(text) <= cols) {
        return g_strdup(text);
    }
    for (int left = cols - 1; *end != '\0'; end = g_utf8_next_char(end)) {
        left -= gb_paint_char_width(g_utf8_get_char(end));
        if (left < 0) {
            break;
        }
    }
    end = leave_number(text, end);
    return cols > 0 ? g_strdup_printf("%.*s" ELLIPSIS, (int)(end - text), text)
                    : g_strdup("");
}

char *gb_text_fit_copy(char *to, size_t size, const char *text)
{
    const char *end = text;
    if (strlen(text) < size) {
        g_strlcpy(to, text, size);
        return to;
    }
    while ((size_t)(g_utf8_next_char(end) - text) + sizeof ELLIPSIS <= size) {
        end = g_utf8_next_char(end);
    }
    end = leave_number(text, end);
    g_snprintf(to, (gulong)size, "%.*s" ELLIPSIS, (int)(end - text), text);
    return to;
}
