#include "measure/cap/cap_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <math.h>

#include "base/alloc.h"
#include "measure/cap/cap_side.h"

enum { SIZE = GB_CAP_SIDE_FREE, REWEIGHTINGS = 4 };

/* Steps of the differences by which errors of d and beta pass on to R and p_a, in their
 * standard errors. */
static const double passing_step = 0.1;

struct line {
    double d, slope;
    double cov00, cov01, cov11;
};

enum gb_cap_fit_side gb_cap_fit_side_of(const struct gb_yield_point *point)
{
    if (!(point->flow_volume < 0.0)) {
        return GB_CAP_FIT_CAP;
    }
    return -point->flow_volume > GB_CAP_FIT_TENSION * fabs(point->flow_shear)
               ? GB_CAP_FIT_LEFT_OUT
               : GB_CAP_FIT_SHEAR;
}

static bool has_error(const struct gb_yield_point *point)
{
    return point->p_error_pa > 0.0 && point->q_error_pa > 0.0;
}

static bool take_side(struct gb_cap_side *side, const struct gb_yield_point *points,
                      size_t count, enum gb_cap_fit_side which, struct gb_error *err)
{
    side->weighted = true;
    side->point = gb_alloc_array(count > 0 ? count : 1, sizeof(void *), err);
    if (!side->point) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        side->weighted = side->weighted && has_error(&points[i]);
        if (gb_cap_fit_side_of(&points[i]) == which) {
            side->point[side->count++] = &points[i];
        }
    }
    return side->count >= SIZE ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%zu of %zu yield points %s: at least 2 are needed", side->count,
                        count,
                        which == GB_CAP_FIT_SHEAR ? "fail in shear" : "lie on the cap");
}

/* Errors of p count through the slope, which the last round gave. */
static bool fit_line(struct line *line, const struct gb_cap_side *side,
                     struct gb_error *err)
{
    double *room = gb_alloc_array(3 * side->count, sizeof *room, err);
    if (!room) {
        return false;
    }
    double *p = room, *q = room + side->count, *weight = room + 2 * side->count;
    double squares = 0.0;
    line->slope = 0.0;
    for (int round = 0; round < REWEIGHTINGS; round++) {
        for (size_t i = 0; i < side->count; i++) {
            const struct gb_yield_point *point = side->point[i];
            const double error =
                hypot(point->q_error_pa, line->slope * point->p_error_pa);
            p[i] = point->p_pa;
            q[i] = fabs(point->q_pa);
            weight[i] = side->weighted ? 1.0 / (error * error) : 1.0;
        }
        gsl_fit_wlinear(p, 1, weight, 1, q, 1, side->count, &line->d, &line->slope,
                        &line->cov00, &line->cov01, &line->cov11, &squares);
    }
    if (!side->weighted && side->count > SIZE) {
        const double variance = squares / (double)(side->count - SIZE);
        line->cov00 *= variance;
        line->cov01 *= variance;
        line->cov11 *= variance;
    }
    gb_alloc_free(room);
    if (!(line->slope > 0.0) || !(line->d > 0.0) || !isfinite(line->slope)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the points of shear failure give d = %.4g MPa and "
                            "tan(beta) = %.4g: both must be above 0",
                            line->d / 1e6, line->slope);
    }
    return true;
}

static struct gb_cap line_cap(double d, double slope, double a)
{
    return (struct gb_cap){.d = d, .beta = atan(slope), .r = 1.0, .a = a};
}

/* Changes of R and p_a with d and the slope; columns of `by`. */
static bool pass_on(double by[SIZE][SIZE], const struct gb_cap_side *side,
                    const struct line *line, double a, struct gb_error *err)
{
    const double step[SIZE] = {passing_step * sqrt(line->cov00) + 1e-6 * line->d,
                               passing_step * sqrt(line->cov11) + 1e-6 * line->slope};
    for (int k = 0; k < SIZE; k++) {
        struct gb_cap_side_found side_of[2];
        for (int s = 0; s < 2; s++) {
            const double move = s == 0 ? -step[k] : step[k];
            const struct gb_cap cap = line_cap(line->d + (k == 0 ? move : 0.0),
                                               line->slope + (k == 1 ? move : 0.0), a);
            if (!gb_cap_side_fit(&side_of[s], side, &cap, err)) {
                return false;
            }
        }
        by[0][k] = (side_of[1].r - side_of[0].r) / (2.0 * step[k]);
        by[1][k] = (side_of[1].p_a - side_of[0].p_a) / (2.0 * step[k]);
    }
    return true;
}

static struct gb_fit_value value_of(double value, double variance, double quantile)
{
    const double error = sqrt(fmax(0.0, variance));
    return (struct gb_fit_value){value, error, value - quantile * error,
                                 value + quantile * error};
}

static double quantile_of(const struct gb_cap_side *side)
{
    return side->weighted       ? gsl_cdf_ugaussian_Pinv(0.975)
           : side->count > SIZE ? gsl_cdf_tdist_Pinv(0.975, (double)(side->count - SIZE))
                                : (double)NAN;
}

/* g . C . g of the four parameters d, slope, R, p_a: errors of the line reach the cap by
 * `by`. */
static double variance_of(const double g[2 * SIZE], const struct line *line,
                          const struct gb_cap_side_found *found, double by[SIZE][SIZE])
{
    double own = 0.0, through[SIZE];
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) {
            own += g[SIZE + i] * found->cov[i][j] * g[SIZE + j];
        }
        through[i] = g[i] + g[SIZE] * by[0][i] + g[SIZE + 1] * by[1][i];
    }
    return own + through[0] * through[0] * line->cov00 +
           2.0 * through[0] * through[1] * line->cov01 +
           through[1] * through[1] * line->cov11;
}

static void take_values(struct gb_cap_fit *fit, const struct line *line,
                        const struct gb_cap_side_found *found, double by[SIZE][SIZE],
                        const struct gb_cap_side side[2])
{
    const double cosine = cos(fit->cap.beta), depth = gb_cap_depth(&fit->cap);
    const double gradient[5][2 * SIZE] = {
        {1.0, 0.0, 0.0, 0.0},
        {0.0, cosine * cosine, 0.0, 0.0},
        {0.0, 0.0, 1.0, 0.0},
        {0.0, 0.0, 0.0, 1.0},
        {found->r, found->r * found->p_a, depth, 1.0 + found->r * line->slope}};
    const double value[5] = {fit->cap.d, fit->cap.beta, found->r, found->p_a,
                             gb_cap_end(&fit->cap)};
    struct gb_fit_value *const to[5] = {&fit->d, &fit->beta, &fit->r, &fit->p_a,
                                        &fit->p_b};
    const double quantile[2] = {quantile_of(&side[0]),
                                fmax(quantile_of(&side[0]), quantile_of(&side[1]))};
    for (int k = 0; k < 5; k++) {
        *to[k] = value_of(value[k], variance_of(gradient[k], line, found, by),
                          quantile[k > 1]);
    }
}

static struct gb_cap_fit_misses misses_of(const struct gb_cap *cap,
                                          const struct gb_cap_side *side,
                                          enum gb_cap_fit_side which)
{
    const double slope = tan(cap->beta), count = (double)side->count;
    struct gb_cap_fit_misses sum = {0.0, 0.0};
    for (size_t i = 0; i < side->count; i++) {
        const struct gb_yield_point *point = side->point[i];
        double off = fabs(point->q_pa) - cap->d - point->p_pa * slope;
        double error = hypot(point->q_error_pa, slope * point->p_error_pa);
        if (which == GB_CAP_FIT_CAP) {
            off = gb_cap_side_radius(cap, point) - cap->r * gb_cap_depth(cap);
            error = gb_cap_side_radius_error(cap, point);
        }
        sum.distance += off * off;
        sum.error += error * error;
    }
    return (struct gb_cap_fit_misses){sqrt(sum.distance / count),
                                      sqrt(sum.error / count)};
}

static bool fit_sides(struct gb_cap_fit *fit, const struct gb_cap_side side[2], double a,
                      struct gb_error *err)
{
    struct line line;
    struct gb_cap_side_found found;
    double by[SIZE][SIZE];
    if (!fit_line(&line, &side[0], err)) {
        return false;
    }
    const struct gb_cap base = line_cap(line.d, line.slope, a);
    if (!(gb_cap_flattening(&base) > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "beta = %.4g degrees: too steep for a transition of %.3g",
                            base.beta * 180.0 / M_PI, a);
    }
    if (!gb_cap_side_fit(&found, &side[1], &base, err) ||
        !pass_on(by, &side[1], &line, a, err)) {
        return false;
    }
    *fit = (struct gb_cap_fit){
        .cap = base, .shear_points = side[0].count, .cap_points = side[1].count};
    fit->cap.r = found.r;
    fit->cap.p_a = found.p_a;
    double squares = 0.0;
    for (int k = 0; k < 2; k++) {
        fit->misses[k] = misses_of(&fit->cap, &side[k], (enum gb_cap_fit_side)k);
        squares +=
            (double)side[k].count * fit->misses[k].distance * fit->misses[k].distance;
    }
    fit->rms = sqrt(squares / (double)(side[0].count + side[1].count));
    take_values(fit, &line, &found, by, side);
    return true;
}

bool gb_cap_fit(struct gb_cap_fit *fit, const struct gb_yield_point *points, size_t count,
                double a, double flow, struct gb_error *err)
{
    struct gb_cap_side side[2] = {{.count = 0}, {.count = 0}};
    bool good = take_side(&side[0], points, count, GB_CAP_FIT_SHEAR, err) &&
                take_side(&side[1], points, count, GB_CAP_FIT_CAP, err);
    side[1].flow = flow;
    side[1].weighted = side[1].weighted && !(flow > 0.0);
    good = good && fit_sides(fit, side, a, err);
    gb_alloc_free(side[0].point);
    gb_alloc_free(side[1].point);
    return good;
}
