/* Equations of compaction: relative density against pressure.
 *
 * Each equation has a density rho(p), its slope by the parameters, and start values for a fit.
 * The table at the end has one row for each, with its source. */

#include "measure/equations.h"

#include <math.h>
#include <string.h>

/* ---- Densities and slopes ---- */

/* ln(1/(1 - rho)) = K P + A; x = K, A */
static double model_heckel(const double *x, double pressure)
{
    return -expm1(-(x[0] * pressure + x[1]));
}

static void model_heckel_slope(const double *x, double pressure, double *slope)
{
    const double porosity = exp(-(x[0] * pressure + x[1]));
    slope[0] = pressure * porosity;
    slope[1] = porosity;
}

/* D0/(1 - C), C the relative decrease of volume */
static double compressed(double initial, double c)
{
    return c < 1.0 ? initial / (1.0 - c) : (double)NAN;
}

/* C = a b P/(1 + b P), that is P/C = 1/(a b) + P/a */
static double model_kawakita(const double *x, double pressure)
{
    const double bp = x[1] * pressure;
    return compressed(x[2], x[0] * bp / (1.0 + bp));
}

static void model_kawakita_slope(const double *x, double pressure, double *slope)
{
    const double bp = x[1] * pressure;
    const double left = 1.0 - x[0] * bp / (1.0 + bp); /* D0/rho */
    const double by_c = x[2] / (left * left);
    slope[0] = by_c * bp / (1.0 + bp);
    slope[1] = by_c * x[0] * pressure / ((1.0 + bp) * (1.0 + bp));
    slope[2] = 1.0 / left;
}

/* C = (1 - D0) (a1 exp(-k1/P) + a2 exp(-k2/P)): C_inf = 1 - D0 is that of full density */
static double model_cooper_eaton(const double *x, double pressure)
{
    const double filled = x[0] * exp(-x[2] / pressure) + x[1] * exp(-x[3] / pressure);
    return compressed(x[4], (1.0 - x[4]) * filled);
}

static void model_cooper_eaton_slope(const double *x, double pressure, double *slope)
{
    const double first = exp(-x[2] / pressure);
    const double second = exp(-x[3] / pressure);
    const double filled = x[0] * first + x[1] * second;
    const double left = 1.0 - (1.0 - x[4]) * filled;
    const double by_filled = x[4] * (1.0 - x[4]) / (left * left);
    slope[0] = by_filled * first;
    slope[1] = by_filled * second;
    slope[2] = -by_filled * x[0] * first / pressure;
    slope[3] = -by_filled * x[1] * second / pressure;
    slope[4] = (1.0 - filled) / (left * left);
}

/* A specific volume as a density. */
static double inverse(double volume)
{
    return volume > 0.0 ? 1.0 / volume : (double)NAN;
}

/* x = K, c */
/* 1/rho = c - K ln P */
static double model_walker(const double *x, double pressure)
{
    return inverse(x[1] - x[0] * log(pressure));
}

static void model_walker_slope(const double *x, double pressure, double *slope)
{
    const double rho = 1.0 / (x[1] - x[0] * log(pressure));
    slope[0] = rho * rho * log(pressure);
    slope[1] = -rho * rho;
}

/* x = C1, C2 */
/* ln P = C2 - C1/rho */
static double model_balshin(const double *x, double pressure)
{
    return inverse((x[1] - log(pressure)) / x[0]);
}

static void model_balshin_slope(const double *x, double pressure, double *slope)
{
    const double rest = x[1] - log(pressure);
    slope[0] = 1.0 / rest;
    slope[1] = -x[0] / (rest * rest);
}

/* P = tau/alpha (exp(alpha eps) - 1) with eps = ln(rho/D0): the exponential of
 * ln P = ln(tau/alpha) + alpha eps + ln(1 - exp(-alpha eps)) */
static double model_adams(const double *x, double pressure)
{
    return x[2] * exp(log1p(x[1] * pressure / x[0]) / x[1]);
}

static void model_adams_slope(const double *x, double pressure, double *slope)
{
    const double u = x[1] * pressure / x[0];
    const double strain = log1p(u) / x[1];
    const double rho = x[2] * exp(strain);
    slope[0] = -rho * pressure / (x[0] * x[0] * (1.0 + u));
    slope[1] = rho * (pressure / (x[0] * (1.0 + u)) - strain) / x[1];
    slope[2] = rho / x[2];
}

/* x = k, b, D0 */
/* ln(1/(1 - rho)) = ln(1/(1 - D0)) + k P + b sqrt(P) */
static double model_shapiro(const double *x, double pressure)
{
    return 1.0 - (1.0 - x[2]) * exp(-x[0] * pressure - x[1] * sqrt(pressure));
}

static void model_shapiro_slope(const double *x, double pressure, double *slope)
{
    const double share = exp(-x[0] * pressure - x[1] * sqrt(pressure));
    slope[0] = (1.0 - x[2]) * share * pressure;
    slope[1] = (1.0 - x[2]) * share * sqrt(pressure);
    slope[2] = share;
}

/* x = A, B */
/* ln(1/(1 - rho)) = A sqrt(P) + B */
static double model_panelli(const double *x, double pressure)
{
    return -expm1(-(x[0] * sqrt(pressure) + x[1]));
}

static void model_panelli_slope(const double *x, double pressure, double *slope)
{
    const double porosity = exp(-(x[0] * sqrt(pressure) + x[1]));
    slope[0] = sqrt(pressure) * porosity;
    slope[1] = porosity;
}

/* ln((r_inf - D0)/(r_inf - rho)) = K P^n */
static double model_secondi(const double *x, double pressure)
{
    return x[0] - (x[0] - x[3]) * exp(-x[1] * pow(pressure, x[2]));
}

static void model_secondi_slope(const double *x, double pressure, double *slope)
{
    const double power = pow(pressure, x[2]);
    const double share = exp(-x[1] * power);
    slope[0] = 1.0 - share;
    slope[1] = (x[0] - x[3]) * share * power;
    slope[2] = slope[1] * x[1] * log(pressure);
    slope[3] = share;
}

/* ---- Start values ---- */

/* Steps of the grids of nonlinear parameters. */
enum { GRID = 25, GRID_PAIR = 12 };

double gb_equations_weight(const struct gb_equations_points *points, size_t i)
{
    return points->error != NULL ? 1.0 / (points->error[i] * points->error[i]) : 1.0;
}

double gb_equations_squares(const struct gb_equations_points *points,
                            double (*density)(const double *x, double pressure),
                            const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        const double off = density(x, points->pressure[i]) - points->density[i];
        sum += gb_equations_weight(points, i) * off * off;
    }
    return isfinite(sum) ? sum : (double)INFINITY;
}

/* Sums of a regression y = c[0] u + c[1] v without errors of u and v. */
struct regression {
    double uu, uv, vv, uy, vy;
};

static void add(struct regression *sums, double weight, double u, double v, double y)
{
    sums->uu += weight * u * u;
    sums->uv += weight * u * v;
    sums->vv += weight * v * v;
    sums->uy += weight * u * y;
    sums->vy += weight * v * y;
}

/* Where u and v cannot be told apart, all goes to u. */
static void solve(const struct regression *sums, double c[2])
{
    const double determinant = sums->uu * sums->vv - sums->uv * sums->uv;
    if (determinant > 1e-12 * sums->uu * sums->vv) {
        c[0] = (sums->uy * sums->vv - sums->vy * sums->uv) / determinant;
        c[1] = (sums->vy * sums->uu - sums->uy * sums->uv) / determinant;
    } else {
        c[0] = sums->uu > 0.0 ? sums->uy / sums->uu : 0.0;
        c[1] = 0.0;
    }
}

/* ln(1/(1 - rho)), whose error is that of rho over the porosity. */
static double log_porosity(const struct gb_equations_points *points, size_t i,
                           double *weight)
{
    const double porosity = 1.0 - points->density[i];
    *weight = gb_equations_weight(points, i) * porosity * porosity;
    return -log(porosity);
}

static void start_heckel(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight);
        add(&sums, weight, points->pressure[i], 1.0, y);
    }
    solve(&sums, x);
}

static void start_panelli(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight);
        add(&sums, weight, sqrt(points->pressure[i]), 1.0, y);
    }
    solve(&sums, x);
}

static void start_shapiro(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight) + log(1.0 - x[2]);
        add(&sums, weight, points->pressure[i], sqrt(points->pressure[i]), y);
    }
    solve(&sums, x);
}

static void start_walker(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        const double rho = points->density[i];
        add(&sums, gb_equations_weight(points, i) * pow(rho, 4.0),
            -log(points->pressure[i]), 1.0, 1.0 / rho);
    }
    solve(&sums, x);
}

static void start_balshin(const struct gb_equations_points *points, double *x)
{
    double walker[2];
    start_walker(points, walker);
    const double slope = walker[0] > 1e-6 ? walker[0] : 1e-6;
    x[0] = 1.0 / slope;
    x[1] = walker[1] / slope;
}

/* Geometric middle of the pressures. */
static double middle_pressure(const struct gb_equations_points *points)
{
    return sqrt(points->pressure[0] * points->pressure[points->count - 1]);
}

/* Step k of `steps` from low to high, geometric. */
static double grid_value(double low, double high, int k, int steps)
{
    return low * pow(high / low, (double)k / (steps - 1));
}

/* A grid of one parameter: the others follow from it. */
typedef void grid_fill(const struct gb_equations_points *points, double value, double *x);

static void search(const struct gb_equations_points *points,
                   double (*density)(const double *x, double pressure), size_t size,
                   double low, double high, grid_fill *fill, double *x)
{
    double best[GB_EQUATIONS_PARAMETERS];
    double least = INFINITY;
    memcpy(best, x, size * sizeof *best);
    for (int k = 0; k < GRID; k++) {
        double sample[GB_EQUATIONS_PARAMETERS];
        memcpy(sample, x, size * sizeof *sample);
        fill(points, grid_value(low, high, k, GRID), sample);
        const double squares = gb_equations_squares(points, density, sample);
        if (k == 0 || squares < least) {
            least = squares;
            memcpy(best, sample, size * sizeof *best);
        }
    }
    memcpy(x, best, size * sizeof *best);
}

/* a by regression: D0/rho = 1 - a b P/(1 + b P). */
static void fill_kawakita(const struct gb_equations_points *points, double b, double *x)
{
    struct regression sums = {0};
    double c[2];
    for (size_t i = 0; i < points->count; i++) {
        const double bp = b * points->pressure[i];
        add(&sums, gb_equations_weight(points, i) * pow(points->density[i], 4.0),
            bp / (1.0 + bp), 0.0, 1.0 - x[2] / points->density[i]);
    }
    solve(&sums, c);
    x[0] = fmin(c[0], 0.999);
    x[1] = b;
}

static void start_kawakita(const struct gb_equations_points *points, double *x)
{
    const double p = middle_pressure(points);
    search(points, model_kawakita, 3, 1e-3 / p, 1e3 / p, fill_kawakita, x);
}

/* tau from the mean of ln P. */
static void fill_adams(const struct gb_equations_points *points, double alpha, double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        const double strain = log(points->density[i] / x[2]);
        sum += log(points->pressure[i]) - log(fmax(expm1(alpha * strain), 1e-12) / alpha);
    }
    x[0] = exp(sum / (double)points->count);
    x[1] = alpha;
}

static void start_adams(const struct gb_equations_points *points, double *x)
{
    search(points, model_adams, 3, 0.1, 100.0, fill_adams, x);
}

/* K and n by regression of ln ln((r_inf - D0)/(r_inf - rho)) on ln P. */
static void fill_secondi(const struct gb_equations_points *points, double beyond,
                         double *x)
{
    struct regression sums = {0};
    double c[2];
    double most = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        most = fmax(most, points->density[i]);
    }
    x[0] = most + beyond;
    for (size_t i = 0; i < points->count; i++) {
        const double share = log((x[0] - x[3]) / (x[0] - points->density[i]));
        add(&sums, 1.0, log(points->pressure[i]), 1.0, log(fmax(share, 1e-9)));
    }
    solve(&sums, c);
    x[1] = exp(c[1]);
    x[2] = fmax(c[0], 1e-3);
}

static void start_secondi(const struct gb_equations_points *points, double *x)
{
    search(points, model_secondi, 4, 1e-3, 1.0, fill_secondi, x);
}

/* a1 and a2 by regression: C/C_inf = a1 exp(-k1/P) + a2 exp(-k2/P). */
static void fill_cooper_eaton(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        const double p = points->pressure[i];
        const double rho = points->density[i];
        add(&sums, gb_equations_weight(points, i) * pow(rho, 4.0), exp(-x[2] / p),
            exp(-x[3] / p), (1.0 - x[4] / rho) / (1.0 - x[4]));
    }
    solve(&sums, x);
}

static void start_cooper_eaton(const struct gb_equations_points *points, double *x)
{
    const double low = 0.1 * points->pressure[0];
    const double high = 3.0 * points->pressure[points->count - 1];
    double best[GB_EQUATIONS_PARAMETERS];
    double least = INFINITY;
    for (int i = 0; i < GRID_PAIR; i++) {
        for (int j = i + 1; j < GRID_PAIR; j++) {
            x[2] = grid_value(low, high, i, GRID_PAIR);
            x[3] = grid_value(low, high, j, GRID_PAIR);
            fill_cooper_eaton(points, x);
            const double squares = gb_equations_squares(points, model_cooper_eaton, x);
            if ((i == 0 && j == 1) || squares < least) {
                least = squares;
                memcpy(best, x, sizeof best);
            }
        }
    }
    memcpy(x, best, sizeof best);
}

/* ---- The table ---- */

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
     .density = model_heckel,
     .slope = model_heckel_slope,
     .start = start_heckel},
    {.name = "kawakita",
     .title = "Kawakita",
     .form = "P/C = 1/(a b) + P/a",
     .source = "K. Kawakita, K.-H. L\xc3\xbc"
               "dde, Powder Technol. 4, 61 (1971)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"a", "1", false}, {"b", "1/MPa", true}},
     .density = model_kawakita,
     .slope = model_kawakita_slope,
     .start = start_kawakita},
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
     .density = model_cooper_eaton,
     .slope = model_cooper_eaton_slope,
     .start = start_cooper_eaton},
    {.name = "walker",
     .title = "Walker",
     .form = "1/rho = c - K ln P",
     .source = "E. E. Walker, Trans. Faraday Soc. 19, 73 (1923)",
     .count = 2,
     .parameter = {{"K", "1", false}, {"c", "1", false}},
     .density = model_walker,
     .slope = model_walker_slope,
     .start = start_walker},
    {.name = "balshin",
     .title = "Balshin",
     .form = "ln P = C2 - C1/rho",
     .source = "M. Yu. Balshin, Vestn. Metalloprom. 18, 124 (1938)",
     .count = 2,
     .parameter = {{"C1", "1", true}, {"C2", "1", false}},
     .density = model_balshin,
     .slope = model_balshin_slope,
     .start = start_balshin},
    {.name = "adams",
     .title = "Adams",
     .form = "ln P = ln(tau/alpha) + alpha eps + ln(1 - exp(-alpha eps)), "
             "eps = ln(rho/D0)",
     .source = "M. J. Adams, M. A. Mullier, J. P. K. Seville, Powder Technol. 78, 5 "
               "(1994)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"tau", "MPa", true}, {"alpha", "1", true}},
     .density = model_adams,
     .slope = model_adams_slope,
     .start = start_adams},
    {.name = "shapiro-konopicky",
     .title = "Shapiro-Konopicky",
     .form = "ln(1/(1 - rho)) = ln(1/(1 - D0)) + k P + b sqrt(P)",
     .source = "K. Konopicky, Radex Rundsch. 3, 141 (1948); I. Shapiro, Adv. Powder "
               "Metall. Part. Mater. 3, 229 (1993)",
     .domain = GB_EQUATIONS_BELOW_ONE | GB_EQUATIONS_ABOVE_INITIAL,
     .count = 2,
     .parameter = {{"k", "1/MPa", false}, {"b", "MPa^-0.5", false}},
     .density = model_shapiro,
     .slope = model_shapiro_slope,
     .start = start_shapiro},
    {.name = "panelli-ambrozio",
     .title = "Panelli-Ambrozio",
     .form = "ln(1/(1 - rho)) = A sqrt(P) + B",
     .source = "R. Panelli, F. Ambrozio Filho, Powder Technol. 114, 255 (2001)",
     .domain = GB_EQUATIONS_BELOW_ONE,
     .count = 2,
     .parameter = {{"A", "MPa^-0.5", false}, {"B", "1", false}},
     .density = model_panelli,
     .slope = model_panelli_slope,
     .start = start_panelli},
    {.name = "secondi",
     .title = "Secondi",
     .form = "ln((r_inf - D0)/(r_inf - rho)) = K P^n",
     .source = "J. Secondi, Powder Metall. 45, 213 (2002)",
     .domain = GB_EQUATIONS_ABOVE_INITIAL,
     .count = 3,
     .parameter = {{"r_inf", "1", true}, {"K", "MPa^-n", true}, {"n", "1", true}},
     .density = model_secondi,
     .slope = model_secondi_slope,
     .start = start_secondi},
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
