#include "greenbody/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

/* A message may quote a hostile file: it must stay one line, valid UTF-8, and must not
 * drive the terminal. */
static void clean(char *text)
{
    const char *bad = NULL;
    while (!g_utf8_validate(text, -1, &bad)) {
        text[bad - text] = '?';
    }
    for (char *c = text; *c != '\0'; c = g_utf8_next_char(c)) {
        if (!g_unichar_iscntrl(g_utf8_get_char(c))) {
            continue;
        }
        const size_t width = (size_t)(g_utf8_next_char(c) - c);
        memset(c, '?', width);
    }
}

bool gb_error_set(struct gb_error *err, enum gb_status code, const char *format, ...)
{
    if (!err) {
        return false;
    }
    char text[sizeof err->text]; /* the arguments may point into err itself */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    clean(text);
    memcpy(err->text, text, sizeof text);
    err->code = code;
    return false;
}

int gb_status_exit_code(enum gb_status code)
{
    switch (code) {
    case GB_OK:
        return 0;
    case GB_ERR_INPUT:
        return 2;
    case GB_ERR_MACHINE:
    case GB_ERR_MEMORY:
        return 3;
    case GB_ERR_GUARD:
    case GB_ERR_NOT_CONVERGED:
        return 1;
    case GB_ERR_CANCELLED:
        return 130;
    }
    return 1;
}
