#include "measure/fit/compaction/compaction_fits.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/alloc.h"
#include "measure/fit/compaction/equation_fit.h"
#include "measure/fit/compaction/equations.h"

/* Least length: points, and this share of all. */
enum { POINTS_LEAST = 5 };
static const double share_least = 1.0 / 6.0;

/* Ends of stretches that are tried, for tables of many points. */
enum { ENDS = 200 };

/* Of the F test. */
static const double level = 0.95;

/* Ratios of variances that need no quantile: F at 95 % lies between for any length. */
static const double ratio_small = 1.0;
static const double ratio_large = 10.0;

/* Least share of the variance that is more than rounding. */
static const double rounding = 1e-14;

/* Weighted moments of the points (P, y). */
struct moments {
    double w, x, y, xx, xy, yy; /* means, and sums of products about them */
    double steps;               /* sum of squares from point to point */
};

/* West's update: no cancellation of large sums. */
static void add_point(struct moments *m, double weight, double x, double y)
{
    m->w += weight;
    const double dx = x - m->x;
    const double dy = y - m->y;
    const double share = weight / m->w;
    m->x += share * dx;
    m->y += share * dy;
    m->xx += weight * dx * (x - m->x);
    m->xy += weight * dx * (y - m->y);
    m->yy += weight * dy * (y - m->y);
}

/* A point of the plot: all that were measured at one pressure. */
struct dot {
    double x, y, weight; /* P, y, 1/error^2 of y */
    size_t first, count; /* its points */
};

/* Means over the points from `first` on at its pressure. */
static struct dot dot_at(const struct gb_equations_points *points, size_t first)
{
    struct dot dot = {.x = points->pressure[first], .first = first};
    for (size_t i = first; i < points->count && points->pressure[i] == dot.x; i++) {
        const double porosity = 1.0 - points->density[i];
        const double share = 1.0 / (double)++dot.count;
        dot.y += share * (-log(porosity) - dot.y);
        dot.weight +=
            share * (gb_equations_weight(points, i) * porosity * porosity - dot.weight);
    }
    return dot;
}

/* Squared distance of a dot from the line through its neighbours, in units in which it
 * is the variance of a point on average. */
static double step_at(const struct dot *dot)
{
    const double span = dot[1].x - dot[-1].x;
    const double share = (dot->x - dot[-1].x) / span;
    const double off = dot->y - (1.0 - share) * dot[-1].y - share * dot[1].y;
    return dot->weight * off * off /
           (1.0 + share * share + (1.0 - share) * (1.0 - share));
}

/* Sum of squares that a line leaves. */
static double rest_of(const struct moments *m)
{
    return m->xx > 0.0 ? fmax(m->yy - m->xy * m->xy / m->xx, rounding * m->yy) : m->yy;
}

/* A stretch, its length in MPa, and 1 - R^2 (adjusted). */
struct candidate {
    size_t first, count;
    double length, remainder;
};

static double remainder_of(const struct moments *m, size_t count)
{
    if (count <= 2) {
        return 0.0;
    }
    return m->yy > 0.0 ? rest_of(m) / m->yy * (double)(count - 1) / (double)(count - 2)
                       : 1.0;
}

static bool is_straight(const struct moments *m, size_t count)
{
    const double ratio =
        rest_of(m) / fmax(m->steps, rounding * m->yy); /* as many terms in both */
    const double degrees = (double)(count - 2);
    return ratio <= ratio_small ||
           (ratio < ratio_large && ratio <= gsl_cdf_fdist_Pinv(level, degrees, degrees));
}

/* The best stretches so far. */
struct found {
    struct candidate straight, least; /* count 0: none */
};

static void judge(struct found *found, const struct moments *moments,
                  const struct candidate *here)
{
    if (here->length > found->straight.length && is_straight(moments, here->count)) {
        found->straight = *here;
    }
    if (found->least.count == 0 || here->remainder < found->least.remainder) {
        found->least = *here;
    }
}

static void search_from(struct found *found, const struct dot *dots, size_t size,
                        size_t first, size_t least, size_t stride)
{
    struct moments moments = {0};
    for (size_t i = first; i < size; i++) {
        const size_t count = i + 1 - first;
        add_point(&moments, dots[i].weight, dots[i].x, dots[i].y);
        moments.steps += count > 2 ? step_at(&dots[i - 1]) : 0.0;
        if (count >= least && (size - 1 - i) % stride == 0) {
            const struct candidate here = {first, count, dots[i].x - dots[first].x,
                                           remainder_of(&moments, count)};
            judge(found, &moments, &here);
        }
    }
}

bool gb_compaction_fits_heckel_stretch(struct gb_compaction_fits_heckel_stretch *stretch,
                                       const struct gb_equations_points *points,
                                       struct gb_error *err)
{
    struct dot *dots = gb_alloc_array(points->count, sizeof *dots, err);
    if (dots == NULL) {
        return false;
    }
    size_t size = 0;
    for (size_t i = 0; i < points->count; i += dots[size++].count) {
        dots[size] = dot_at(points, i);
    }
    const double share = ceil(share_least * (double)size);
    const size_t enough = share > POINTS_LEAST ? (size_t)share : POINTS_LEAST;
    const size_t least = enough < size ? enough : size;
    const size_t stride = 1 + size / ENDS;
    struct found found = {0};
    for (size_t first = 0; first + least <= size; first += stride) {
        search_from(&found, dots, size, first, least, stride);
    }
    const bool straight = found.straight.count > 0;
    const struct candidate *best = straight ? &found.straight : &found.least;
    const struct dot *last = &dots[best->first + best->count - 1];
    const size_t begin = dots[best->first].first;
    *stretch = (struct gb_compaction_fits_heckel_stretch){
        begin, last->first + last->count - begin, straight, 1.0 - best->remainder};
    gb_alloc_free(dots);
    return true;
}

static bool set_intervals(struct gb_equation_fit *fit,
                          const struct gb_equations_points *points,
                          enum gb_compaction_intervals intervals, struct gb_error *err)
{
    return intervals == GB_COMPACTION_LINEAR ||
           (gb_equation_fit_profile(fit, points, err) &&
            gb_equation_fit_jackknife(fit, points, err));
}

static bool fit_one(struct gb_compaction_fit *row, const struct gb_equation *equation,
                    const struct gb_equations_points *points,
                    enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *row = (struct gb_compaction_fit){.equation = equation, .delta = NAN};
    row->fitted = gb_equation_fit(&row->all, equation, points, &row->refusal);
    if (row->refusal.code == GB_ERR_MEMORY) {
        return gb_error_set(err, GB_ERR_MEMORY, "%s", row->refusal.text);
    }
    return !row->fitted || set_intervals(&row->all, points, intervals, err);
}

static bool fit_stretch(struct gb_compaction_fits *fits,
                        const struct gb_equation *equation,
                        const struct gb_equations_points *points,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_equations_points part = *points;
    if (!gb_compaction_fits_heckel_stretch(&fits->stretch, points, err)) {
        return false;
    }
    const size_t first = fits->stretch.first;
    part.count = fits->stretch.count;
    part.pressure += first;
    part.density += first;
    part.error = points->error != NULL ? points->error + first : NULL;
    part.rows = points->rows != NULL ? points->rows + first : NULL;
    return gb_equation_fit(&fits->heckel, equation, &part, err) &&
           set_intervals(&fits->heckel, &part, intervals, err);
}

/* 1/K; unbounded where the interval of K contains 0 or K is not above it. */
static void set_yield(struct gb_compaction_fits *fits)
{
    const struct gb_fit_value *k = &fits->heckel.value[0];
    fits->yield = (struct gb_fit_value){
        .value = k->value > 0.0 ? 1.0 / k->value : (double)INFINITY,
        .error = k->error / (k->value * k->value),
        .low = k->high > 0.0 ? 1.0 / k->high : -(double)INFINITY,
        .high = k->low > 0.0 ? 1.0 / k->low : (double)INFINITY,
    };
}

/* The straightest stretch of Heckel's plot, where the equation is defined. */
static bool fit_heckel(struct gb_compaction_fits *fits, struct gb_compaction_fit *row,
                       const struct gb_equations_points *points,
                       enum gb_compaction_intervals intervals, struct gb_error *err)
{
    struct gb_error cause = {0};
    if (!row->fitted) {
        return true;
    }
    if (fit_stretch(fits, row->equation, points, intervals, &cause)) {
        set_yield(fits);
        return true;
    }
    row->fitted = false;
    row->refusal = cause;
    return cause.code != GB_ERR_MEMORY || gb_error_set(err, cause.code, "%s", cause.text);
}

static bool before(const struct gb_compaction_fit *a, const struct gb_compaction_fit *b)
{
    return a->fitted != b->fitted ? a->fitted : a->fitted && a->all.aicc < b->all.aicc;
}

/* By AICc; equal ones, such as Walker's and Balshin's, in the order of the table. */
static void sort(struct gb_compaction_fits *fits)
{
    for (size_t i = 1; i < fits->count; i++) {
        const struct gb_compaction_fit moved = fits->fit[i];
        size_t at = i;
        for (; at > 0 && before(&moved, &fits->fit[at - 1]); at--) {
            fits->fit[at] = fits->fit[at - 1];
        }
        fits->fit[at] = moved;
    }
    for (size_t i = 0; i < fits->count; i++) {
        struct gb_compaction_fit *row = &fits->fit[i];
        fits->fitted += row->fitted;
        row->delta = row->fitted ? row->all.aicc - fits->fit[0].all.aicc : (double)NAN;
    }
}

static bool is_heckel(const struct gb_equation *equation)
{
    return equation == gb_equations_find("heckel");
}

bool gb_compaction_fits(struct gb_compaction_fits *fits,
                        const struct gb_equations_points *points,
                        const struct gb_equation *only,
                        enum gb_compaction_intervals intervals, struct gb_error *err)
{
    *fits = (struct gb_compaction_fits){0};
    for (size_t i = 0; i < gb_equations_count(); i++) {
        const struct gb_equation *equation = gb_equations_at(i);
        if (only != NULL && only != equation) {
            continue;
        }
        struct gb_compaction_fit *row = &fits->fit[fits->count++];
        if (!fit_one(row, equation, points, intervals, err) ||
            (is_heckel(equation) && !fit_heckel(fits, row, points, intervals, err))) {
            return false;
        }
    }
    sort(fits);
    return true;
}

const struct gb_equation_fit *
gb_compaction_fits_reported(const struct gb_compaction_fits *fits, size_t index)
{
    const struct gb_compaction_fit *row = &fits->fit[index];
    return is_heckel(row->equation) ? &fits->heckel : &row->all;
}

size_t gb_compaction_fits_values(const struct gb_compaction_fits *fits, size_t index)
{
    return gb_compaction_fits_reported(fits, index)->size +
           is_heckel(fits->fit[index].equation);
}

struct gb_compaction_value gb_compaction_fits_value(const struct gb_compaction_fits *fits,
                                                    size_t index, size_t k)
{
    const struct gb_equation_fit *fit = gb_compaction_fits_reported(fits, index);
    if (k == fit->size) {
        return (struct gb_compaction_value){"yield_pressure", "MPa", fits->yield};
    }
    const struct gb_equations_parameter *parameter =
        gb_equations_parameter(fit->equation, k);
    return (struct gb_compaction_value){parameter->name, parameter->unit, fit->value[k]};
}
