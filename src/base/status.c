#include "greenbody/status.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/visible.h"

bool gb_error_set(struct gb_error *err, enum gb_status code, const char *format, ...)
{
    if (!err) {
        return false;
    }
    if (!format) {
        format = "";
    }
    char text[2 * sizeof err->text]; /* the arguments may point into err itself */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    /* one line without control characters, whatever file it quotes; only characters
     * that vsnprintf cut off beyond the end of the message are incomplete */
    gb_visible_copy(err->text, sizeof err->text, text);
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
