#include "measure/fit/compaction/equations.h"

#include <math.h>
#include <string.h>

#include "measure/fit/compaction/equation_models.h"
#include "measure/fit/compaction/equation_starts.h"

/* Points beyond the parameters: one for the scatter, and AICc needs two more. */
enum { POINTS_BEYOND = 3 };

/* Densities below D0 by more than this share of the whole rise are no scatter. */
static const double below_initial = 0.02;

static const struct gb_equations_parameter initial = {"D0", "1", true};

static const struct gb_equation table[] = {
    {.name = "heckel",
     .title = "Heckel",
     .form = "ln(1/(1 - rho)) = K P + A",
     .source = "R. W. Heckel, Trans. Metall. Soc. AIME 221, 671 (1961)",
     .domain = GB_EQUATIONS_BELOW_ONE,
     .count = 2,
     .parameter = {{"K", "1/MPa", false}, {"A", "1", false}},
     .density = gb_equation_models_heckel,
     .slope = gb_equation_models_heckel_slope,
     .start = gb_equation_starts_heckel},
    {.name = "kawakita",
     .title = "Kawakita",
     .form = "P/C = 1/(a b) + P/a",
     .source = "K. Kawakita, K.-H. L\xc3\xbc"
               "dde, Powder Technol. 4, 61 (1971)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"a", "1", false}, {"b", "1/MPa", true}},
     .density = gb_equation_models_kawakita,
     .slope = gb_equation_models_kawakita_slope,
     .start = gb_equation_starts_kawakita},
    {.name = "cooper-eaton",
     .title = "Cooper-Eaton",
     .form = "C/C_inf = a1 exp(-k1/P) + a2 exp(-k2/P), C_inf = 1 - D0",
     .source = "A. R. Cooper, L. E. Eaton, J. Am. Ceram. Soc. 45, 97 (1962)",
     .domain = GB_EQUATIONS_BELOW_ONE | GB_EQUATIONS_ABOVE_INITIAL,
     .count = 4,
     .parameter = {{"a1", "1", false},
                   {"a2", "1", false},
                   {"k1", "MPa", true},
                   {"k2", "MPa", true}},
     .density = gb_equation_models_cooper_eaton,
     .slope = gb_equation_models_cooper_eaton_slope,
     .start = gb_equation_starts_cooper_eaton},
    {.name = "walker",
     .title = "Walker",
     .form = "1/rho = c - K ln P",
     .source = "E. E. Walker, Trans. Faraday Soc. 19, 73 (1923)",
     .count = 2,
     .parameter = {{"K", "1", false}, {"c", "1", false}},
     .density = gb_equation_models_walker,
     .slope = gb_equation_models_walker_slope,
     .start = gb_equation_starts_walker},
    {.name = "balshin",
     .title = "Balshin",
     .form = "ln P = C2 - C1/rho",
     .source = "M. Yu. Balshin, Vestn. Metalloprom. 18, 124 (1938)",
     .count = 2,
     .parameter = {{"C1", "1", true}, {"C2", "1", false}},
     .density = gb_equation_models_balshin,
     .slope = gb_equation_models_balshin_slope,
     .start = gb_equation_starts_balshin},
    {.name = "adams",
     .title = "Adams",
     .form = "ln P = ln(tau/alpha) + alpha eps + ln(1 - exp(-alpha eps)), "
             "eps = ln(rho/D0)",
     .source = "M. J. Adams, M. A. Mullier, J. P. K. Seville, Powder Technol. 78, 5 "
               "(1994)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"tau", "MPa", true}, {"alpha", "1", true}},
     .density = gb_equation_models_adams,
     .slope = gb_equation_models_adams_slope,
     .start = gb_equation_starts_adams},
    {.name = "shapiro-konopicky",
     .title = "Shapiro-Konopicky",
     .form = "ln(1/(1 - rho)) = ln(1/(1 - D0)) + k P + b sqrt(P)",
     .source = "K. Konopicky, Radex Rundsch. 3, 141 (1948); I. Shapiro, Adv. Powder "
               "Metall. Part. Mater. 3, 229 (1993)",
     .domain = GB_EQUATIONS_BELOW_ONE | GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"k", "1/MPa", false}, {"b", "MPa^-0.5", false}},
     .density = gb_equation_models_shapiro,
     .slope = gb_equation_models_shapiro_slope,
     .start = gb_equation_starts_shapiro},
    {.name = "panelli-ambrozio",
     .title = "Panelli-Ambrozio",
     .form = "ln(1/(1 - rho)) = A sqrt(P) + B",
     .source = "R. Panelli, F. Ambrozio Filho, Powder Technol. 114, 255 (2001)",
     .domain = GB_EQUATIONS_BELOW_ONE,
     .count = 2,
     .parameter = {{"A", "MPa^-0.5", false}, {"B", "1", false}},
     .density = gb_equation_models_panelli,
     .slope = gb_equation_models_panelli_slope,
     .start = gb_equation_starts_panelli},
    {.name = "secondi",
     .title = "Secondi",
     .form = "ln((r_inf - D0)/(r_inf - rho)) = K P^n",
     .source = "J. Secondi, Powder Metall. 45, 213 (2002)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 3,
     .parameter = {{"r_inf", "1", true}, {"K", "MPa^-n", true}, {"n", "1", true}},
     .density = gb_equation_models_secondi,
     .slope = gb_equation_models_secondi_slope,
     .start = gb_equation_starts_secondi},
};

enum { COUNT = sizeof table / sizeof table[0] };

size_t gb_equations_count(void)
{
    return COUNT;
}

const struct gb_equation *gb_equations_at(size_t index)
{
    return &table[index];
}

const struct gb_equation *gb_equations_find(const char *name)
{
    for (size_t i = 0; i < COUNT; i++) {
        if (strcmp(table[i].name, name) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

bool gb_equations_fits_initial(const struct gb_equation *equation,
                               const struct gb_equations_points *points)
{
    return (equation->domain & GB_EQUATIONS_ABOVE_INITIAL) != 0 && isnan(points->initial);
}

size_t gb_equations_size(const struct gb_equation *equation,
                         const struct gb_equations_points *points)
{
    return equation->count + gb_equations_fits_initial(equation, points);
}

const struct gb_equations_parameter *
gb_equations_parameter(const struct gb_equation *equation, size_t k)
{
    return k < equation->count ? &equation->parameter[k] : &initial;
}

static bool check_point(const struct gb_equation *equation,
                        const struct gb_equations_points *points, size_t i,
                        struct gb_error *err)
{
    const double rho = points->density[i];
    const double p = points->pressure[i];
    if (!(rho > 0.0) || !isfinite(rho) || !(p > 0.0) || !isfinite(p) ||
        (points->error != NULL && !(points->error[i] > 0.0))) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: pressure %g MPa, density %g: pressures, densities and "
                            "errors must be finite and above 0",
                            equation->name, p, rho);
    }
    if ((equation->domain & GB_EQUATIONS_BELOW_ONE) != 0 && rho >= 1.0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: not defined at a density of 1 or more (%.6g at %.6g "
                            "MPa); the window must end below",
                            equation->name, rho, p);
    }
    const double most = points->density[points->count - 1];
    const double least =
        points->initial - below_initial * fmax(most - points->initial, 0.0);
    if ((equation->domain & GB_EQUATIONS_ABOVE_INITIAL) != 0 &&
        (rho <= least || most <= points->initial)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: not defined below the initial density %.6g (%.6g at "
                            "%.6g MPa)",
                            equation->name, points->initial, rho, p);
    }
    return true;
}

bool gb_equations_check(const struct gb_equation *equation,
                        const struct gb_equations_points *points, struct gb_error *err)
{
    const size_t needed = gb_equations_size(equation, points) + POINTS_BEYOND;
    if (points->count < needed) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: %zu points in the window; %zu parameters take %zu or "
                            "more",
                            equation->name, points->count,
                            gb_equations_size(equation, points), needed);
    }
    if ((equation->domain & GB_EQUATIONS_ABOVE_INITIAL) != 0 && !isnan(points->initial) &&
        !(points->initial > 0.0 && points->initial < 1.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: initial density %g: must be above 0 and below 1",
                            equation->name, points->initial);
    }
    for (size_t i = 0; i < points->count; i++) {
        if (!check_point(equation, points, i, err)) {
            return false;
        }
    }
    size_t pressures = 1;
    for (size_t i = 1; i < points->count; i++) {
        pressures += points->pressure[i] > points->pressure[i - 1];
    }
    const size_t size = gb_equations_size(equation, points);
    if (pressures == 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: all points are at one pressure, %g MPa", equation->name,
                            points->pressure[0]);
    }
    return pressures >= size ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: points at %zu pressures; %zu parameters take %zu or more",
                        equation->name, pressures, size, size);
}
