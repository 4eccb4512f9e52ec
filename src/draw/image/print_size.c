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

const struct gb_print_size_journal gb_print_size_journals[] = {
    {"elsevier", 90.0, 140.0, 190.0, "Elsevier, Artwork sizing"},
    {"aps", 86.0, 140.0, 178.0, "APS, Style and Notation Guide; REVTeX page"},
    {"aip", 85.0, 0.0, 170.0, "AIP Publishing, Preparing your manuscript: graphics"},
    {"springer", 84.0, 0.0, 174.0, "Springer, Artwork guidelines, large journals"},
    {"wiley", 80.0, 0.0, 180.0, "Wiley, Guidelines for figure preparation"},
    {"nature", 89.0, 120.0, 183.0, "Nature, Final submission"},
    {"acs", 82.5, 0.0, 177.8, "ACS, Preparing graphics"},
    {"rsc", 83.0, 0.0, 171.0, "RSC, Prepare your article: graphics"},
    {.name = NULL},
};

/* Inches of a column of a journal; NaN: not a name of one, or the journal has none. */
static double column_inches(const char *text)
{
    for (const struct gb_print_size_journal *row = gb_print_size_journals;
         row->name != NULL; row++) {
        const size_t length = strlen(row->name);
        if (strncmp(text, row->name, length) == 0) {
            const char *columns = text + length;
            const double mm = *columns == '\0'               ? row->single_mm
                              : strcmp(columns, "-1.5") == 0 ? row->middle_mm
                              : strcmp(columns, "-2") == 0   ? row->double_mm
                                                             : 0.0;
            return mm > 0.0 ? mm / 25.4 : (double)NAN;
        }
    }
    return NAN;
}

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
    return column_inches(text);
}

bool gb_print_size_parse(const char *width, int per_inch, struct gb_print_size *size,
                         struct gb_error *err)
{
    const double inches = inches_of(width);
    if (!(inches >= 0.999 && inches <= 20.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--width %.80s: must be between 2.54 and 50 cm, as in 8cm, 80mm, 3.3in, or a "
            "column of a journal that plot --help lists, as elsevier, elsevier-1.5, "
            "elsevier-2",
            width);
    }
    if (per_inch < 100 || per_inch > 1200) {
        return gb_error_set(err, GB_ERR_INPUT, "--dpi %d: must be between 100 and 1200",
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
