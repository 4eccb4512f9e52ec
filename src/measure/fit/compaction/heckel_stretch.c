#include "measure/fit/compaction/heckel_stretch.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/alloc.h"
#include "measure/fit/compaction/equation_starts.h"

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
            share *
            (gb_equation_starts_weight(points, i) * porosity * porosity - dot.weight);
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

bool gb_heckel_stretch(struct gb_heckel_stretch *stretch,
                       const struct gb_equations_points *points, struct gb_error *err)
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
    *stretch = (struct gb_heckel_stretch){begin, last->first + last->count - begin,
                                          straight, 1.0 - best->remainder};
    gb_alloc_free(dots);
    return true;
}
