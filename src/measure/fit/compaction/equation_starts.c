#include "measure/fit/compaction/equation_starts.h"

#include <math.h>
#include <string.h>

#include "measure/fit/compaction/equation_models.h"

/* Steps of the grids of nonlinear parameters. */
enum { GRID = 25, GRID_PAIR = 12 };

double gb_equation_starts_weight(const struct gb_equations_points *points, size_t i)
{
    return points->error != NULL ? 1.0 / (points->error[i] * points->error[i]) : 1.0;
}

double gb_equation_starts_squares(const struct gb_equations_points *points,
                                  double (*density)(const double *x, double pressure),
                                  const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < points->count; i++) {
        const double off = density(x, points->pressure[i]) - points->density[i];
        sum += gb_equation_starts_weight(points, i) * off * off;
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
    *weight = gb_equation_starts_weight(points, i) * porosity * porosity;
    return -log(porosity);
}

void gb_equation_starts_heckel(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight);
        add(&sums, weight, points->pressure[i], 1.0, y);
    }
    solve(&sums, x);
}

void gb_equation_starts_panelli(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight);
        add(&sums, weight, sqrt(points->pressure[i]), 1.0, y);
    }
    solve(&sums, x);
}

void gb_equation_starts_shapiro(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        double weight = 0.0;
        const double y = log_porosity(points, i, &weight) + log(1.0 - x[2]);
        add(&sums, weight, points->pressure[i], sqrt(points->pressure[i]), y);
    }
    solve(&sums, x);
}

void gb_equation_starts_walker(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        const double rho = points->density[i];
        add(&sums, gb_equation_starts_weight(points, i) * pow(rho, 4.0),
            -log(points->pressure[i]), 1.0, 1.0 / rho);
    }
    solve(&sums, x);
}

void gb_equation_starts_balshin(const struct gb_equations_points *points, double *x)
{
    double walker[2];
    gb_equation_starts_walker(points, walker);
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
        const double squares = gb_equation_starts_squares(points, density, sample);
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
        add(&sums, gb_equation_starts_weight(points, i) * pow(points->density[i], 4.0),
            bp / (1.0 + bp), 0.0, 1.0 - x[2] / points->density[i]);
    }
    solve(&sums, c);
    x[0] = fmin(c[0], 0.999);
    x[1] = b;
}

void gb_equation_starts_kawakita(const struct gb_equations_points *points, double *x)
{
    const double p = middle_pressure(points);
    search(points, gb_equation_models_kawakita, 3, 1e-3 / p, 1e3 / p, fill_kawakita, x);
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

void gb_equation_starts_adams(const struct gb_equations_points *points, double *x)
{
    search(points, gb_equation_models_adams, 3, 0.1, 100.0, fill_adams, x);
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

void gb_equation_starts_secondi(const struct gb_equations_points *points, double *x)
{
    search(points, gb_equation_models_secondi, 4, 1e-3, 1.0, fill_secondi, x);
}

/* a1 and a2 by regression: C/C_inf = a1 exp(-k1/P) + a2 exp(-k2/P). */
static void fill_cooper_eaton(const struct gb_equations_points *points, double *x)
{
    struct regression sums = {0};
    for (size_t i = 0; i < points->count; i++) {
        const double p = points->pressure[i];
        const double rho = points->density[i];
        add(&sums, gb_equation_starts_weight(points, i) * pow(rho, 4.0), exp(-x[2] / p),
            exp(-x[3] / p), (1.0 - x[4] / rho) / (1.0 - x[4]));
    }
    solve(&sums, x);
}

void gb_equation_starts_cooper_eaton(const struct gb_equations_points *points, double *x)
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
            const double squares =
                gb_equation_starts_squares(points, gb_equation_models_cooper_eaton, x);
            if ((i == 0 && j == 1) || squares < least) {
                least = squares;
                memcpy(best, x, sizeof best);
            }
        }
    }
    memcpy(x, best, sizeof best);
}
