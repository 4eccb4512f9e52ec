#include "draw/style/round_number.h"

#include <math.h>
#include <stddef.h>

/* Rounding of what is round already. */
static const double rounding = 1e-9;

double gb_round_number_below(double max)
{
    static const double steps[] = {5.0, 2.0};
    const double decade = pow(10.0, floor(log10(max) + rounding));
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade <= max * (1.0 + rounding)) {
            return steps[k] * decade;
        }
    }
    return decade;
}

double gb_round_number_above(double min)
{
    static const double steps[] = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
    const double decade = pow(10.0, floor(log10(min) + rounding));
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade >= min * (1.0 - rounding)) {
            return steps[k] * decade;
        }
    }
    return 10.0 * decade;
}

double gb_round_number_step(double rough)
{
    const double decade = pow(10.0, floor(log10(rough)));
    const double share = rough / decade;
    return (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0) * decade;
}
