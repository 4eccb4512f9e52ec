#include "measure/fit/power_choice.h"

#include <math.h>

/* What the criterion of a fit has beside its parameters. */
static double misfit(const struct gb_power_choice *choice, size_t count, bool given)
{
    const double n = (double)count;
    return given ? choice->rate.chi2 : n * log(choice->rate.chi2 / n);
}

static void set_weights(struct gb_power_choice *choices, size_t exponents, size_t count,
                        bool given)
{
    double least = INFINITY, sum = 0.0;
    for (size_t c = 0; c < exponents; c++) {
        least = fmin(least, misfit(&choices[c], count, given));
    }
    for (size_t c = 0; c < exponents; c++) {
        choices[c].delta = misfit(&choices[c], count, given) - least;
        choices[c].weight = exp(-0.5 * choices[c].delta);
        sum += choices[c].weight;
    }
    for (size_t c = 0; c < exponents; c++) {
        choices[c].weight /= sum;
    }
}

bool gb_power_choice_fit(struct gb_power_choice *choices, size_t exponents,
                         const struct gb_power_law *law,
                         const struct gb_power_point *points, size_t count,
                         struct gb_error *err)
{
    const bool given = count > 0 && points[0].error > 0.0;
    for (size_t c = 0; c < exponents; c++) {
        struct gb_power_law tried = *law;
        tried.exponent = choices[c].exponent;
        if (!gb_power_rate(&choices[c].rate, &tried, points, count, err)) {
            return false;
        }
        if (!given && !(choices[c].rate.chi2 > 0.0)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%zu pressures without errors are on a power law with "
                                "the exponent %g: nothing to compare",
                                count, tried.exponent);
        }
    }
    set_weights(choices, exponents, count, given);
    return true;
}
