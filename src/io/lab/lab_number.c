#include "io/lab/lab_number.h"

#include <math.h>
#include <string.h>

#include <glib.h>

enum { TEXT_MAX = 64, GROUP = 3 };

/* A plain number for g_ascii_strtod. */
struct plain {
    char text[TEXT_MAX];
    size_t length;
};

static bool put(struct plain *plain, char c)
{
    if (plain->length + 1 >= TEXT_MAX) {
        return false;
    }
    plain->text[plain->length++] = c;
    plain->text[plain->length] = '\0';
    return true;
}

/* Digits at *at; their number, or -1: too many. */
static int put_digits(struct plain *plain, const char **at)
{
    int count = 0;
    for (; g_ascii_isdigit(**at); (*at)++, count++) {
        if (!put(plain, **at)) {
            return -1;
        }
    }
    return count;
}

static bool put_sign(struct plain *plain, const char **at)
{
    static const char minus[] = "\xe2\x88\x92"; /* U+2212 */
    if (g_str_has_prefix(*at, minus)) {
        *at += strlen(minus);
        return put(plain, '-');
    }
    if (**at == '-' || **at == '+') {
        return put(plain, *(*at)++);
    }
    return true;
}

/* The separator of thousands at `at`, in bytes: the other mark, blanks of several widths,
 * apostrophes; 0: none. */
static size_t group_mark(const char *at, char mark)
{
    static const char *const marks[] = {
        " ", "\xc2\xa0", "\xe2\x80\x89", "\xe2\x80\xaf", "'", "\xe2\x80\x99"};
    if (*at == (mark == '.' ? ',' : '.')) {
        return 1;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(marks); i++) {
        if (g_str_has_prefix(at, marks[i])) {
            return strlen(marks[i]);
        }
    }
    return 0;
}

/* Digits in groups of three behind one to three; all groups have the same separator. */
static int put_whole(struct plain *plain, const char **at, char mark, bool *grouped)
{
    const char *start = *at;
    int digits = put_digits(plain, at);
    const char *separator = *at;
    const size_t size = group_mark(separator, mark);
    *grouped = false;
    if (digits < 1 || digits > GROUP || *start == '0' || size == 0) {
        return digits;
    }
    while (strncmp(*at, separator, size) == 0 && g_ascii_isdigit((*at)[size])) {
        *at += size;
        if (put_digits(plain, at) != GROUP) {
            return -1;
        }
        digits += GROUP;
        *grouped = *separator == '.' || *separator == ',';
    }
    return digits;
}

static bool put_exponent(struct plain *plain, const char **at)
{
    if (**at == '\0' || strchr("eEdD", **at) == NULL) {
        return true;
    }
    (*at)++;
    return put(plain, 'e') && put_sign(plain, at) && put_digits(plain, at) > 0;
}

static bool scan_percent(const char **at)
{
    const char *rest = *at;
    while (*rest == ' ' || g_str_has_prefix(rest, "\xc2\xa0") ||
           g_str_has_prefix(rest, "\xe2\x80\xaf")) {
        rest = g_utf8_next_char(rest);
    }
    if (*rest != '%') {
        return false;
    }
    *at = rest + 1;
    return true;
}

static bool scan(const char *text, char mark, double *value, bool *grouped, bool *percent)
{
    struct plain plain = {.length = 0};
    const char *at = text;
    if (!put_sign(&plain, &at)) {
        return false;
    }
    const int whole = put_whole(&plain, &at, mark, grouped);
    int part = 0;
    if (whole >= 0 && *at == mark) {
        at++;
        if (!put(&plain, '.')) {
            return false;
        }
        part = put_digits(&plain, &at);
    }
    if (whole < 0 || part < 0 || whole + part == 0 || !put_exponent(&plain, &at)) {
        return false;
    }
    *percent = scan_percent(&at);
    *value = g_ascii_strtod(plain.text, NULL);
    return *at == '\0' && isfinite(*value);
}

bool gb_lab_number_scan(const char *text, struct gb_lab_number *out)
{
    bool percent = false;
    *out = (struct gb_lab_number){0};
    out->is_point = scan(text, '.', &out->point, &out->grouped_point, &percent);
    out->percent = out->is_point && percent;
    out->is_comma = scan(text, ',', &out->comma, &out->grouped_comma, &percent);
    out->percent = out->percent || (out->is_comma && percent);
    return out->is_point || out->is_comma;
}

bool gb_lab_number_read(const struct gb_lab_number *number, char decimal, double *value)
{
    *value = decimal == ',' ? number->comma : number->point;
    return decimal == ',' ? number->is_comma : number->is_point;
}
