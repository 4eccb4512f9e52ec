#include "tui/session/value_step.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A step of 4 to 10 % of the value, so that the number stays short. */
static double increment_of(double value)
{
    const double decade = pow(10.0, floor(log10(fabs(value)) + 1e-9));
    const double mantissa = fabs(value) / decade;
    return decade * (mantissa < 2.0 - 1e-9 ? 0.1 : mantissa < 5.0 - 1e-9 ? 0.2 : 0.5);
}

static void step_choice(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size)
{
    int count = 0;
    int at = 0;
    for (; field->choices[count] != NULL; count++) {
        at = strcmp(field->choices[count], value) == 0 ? count : at;
    }
    snprintf(text, size, "%s", field->choices[(at + direction + count) % count]);
}

/* "9.7 nm" becomes "10.2 nm": the text after the number is kept. */
static bool step_number(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size)
{
    char *rest = NULL;
    const double number = strtod(value, &rest);
    if (rest == value) {
        return false; /* "auto", or empty */
    }
    if (field->type == GB_FIELD_SEED) {
        snprintf(text, size, "%.0f%s", fmax(number + direction, 0.0), rest);
        return true;
    }
    const double step = number != 0.0 ? increment_of(number) : 0.01;
    /* below 1 the steps are those of 0.9 */
    const double down = number != 0.0 ? increment_of(number * (1.0 - 1e-6)) : step;
    const double next = direction > 0 ? number + step : number - down;
    snprintf(text, size, "%.6g%s",
             field->type == GB_FIELD_INTEGER ? floor(next + 0.5) : next, rest);
    return true;
}

bool gb_value_step_next(const struct gb_field *field, const char *value, int direction,
                        char *text, size_t size)
{
    if (field->choices != NULL) {
        step_choice(field, value, direction, text, size);
        return true;
    }
    return field->type != GB_FIELD_TEXT && field->type != GB_FIELD_PRESSURES &&
           step_number(field, value, direction, text, size);
}
