#include "draw/image/print_size.h"

#include <math.h>
#include <string.h>

#include "base/units.h"
#include "draw/image/image.h"

/* Inches of the units that widths are given in. */
static const struct {
    const char *name;
    double inches;
} units[] = {{"cm", 1.0 / 2.54}, {"mm", 1.0 / 25.4}, {"in", 1.0}};

static double inches_of(const char *text)
{
    const char *end = NULL;
    double value = 0.0;
    if (gb_units_number(text, &end, &value)) {
        end += strspn(end, " ");
        for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
            if (strcmp(end, units[i].name) == 0) {
                return value * units[i].inches;
            }
        }
    }
    return NAN;
}

bool gb_print_size_parse(const char *width, int per_inch, struct gb_print_size *size,
                         struct gb_error *err)
{
    const double inches = inches_of(width);
    if (!(inches >= 0.999 && inches <= 20.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--width %.80s: accepted 2.54 to 50 cm, as in 8cm, 80mm, 3.3in", width);
    }
    if (per_inch < 100 || per_inch > 1200) {
        return gb_error_set(err, GB_ERR_INPUT, "--dpi %d: accepted 100 to 1200",
                            per_inch);
    }
    const double pixels = round(inches * per_inch);
    if (pixels > GB_IMAGE_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--width %.80s --dpi %d: %g pixels; accepted %d", width,
                            per_inch, pixels, GB_IMAGE_MAX);
    }
    *size = (struct gb_print_size){(int)pixels, (int)round(0.75 * pixels), per_inch};
    return true;
}
