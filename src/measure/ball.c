/* Volumes of spheres: within a ball, a slab, a cylinder, and the map of density over rings. */
#include "measure/ball.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

double gb_ball_volume(double radius)
{
    return 4.0 * M_PI / 3.0 * radius * radius * radius;
}

/* With the depth of the intersection s = a + b - d and t = d - (a - b), a >= b, the usual
 * formula
 *   pi s^2 (d^2 + 2 d (a + b) - 3 (a - b)^2)/(12 d)
 * is pi/12 s^2 ((t/d)(d + 3 (a - b)) + 4 b): every term positive.  d - a is exact where
 * the sizes differ much, so that s and t keep all digits of b. */
double gb_ball_shared_volume(double a, double b, double distance)
{
    const double big = a < b ? b : a, small = a < b ? a : b;
    const double s = (big - distance) + small;
    const double t = (distance - big) + small;
    if (s <= 0.0) {
        return 0.0;
    }
    if (t <= 0.0) {
        return gb_ball_volume(small);
    }
    const double waist = t / distance * (distance + 3.0 * (big - small));
    return M_PI / 12.0 * s * s * (waist + 4.0 * small);
}

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* pi times the integral of r^2 - z^2 from u to v is pi/3 (v - u) times
 * (r^2 - u^2) + (r^2 - u v) + (r^2 - v^2); each bracket is a sum of products of the
 * distances to the poles. */
double gb_ball_slab(double radius, double low, double high)
{
    const double u = clamp(low, -radius, radius), v = clamp(high, -radius, radius);
    const double below_u = radius + u, above_u = radius - u;
    const double below_v = radius + v, above_v = radius - v;
    const double sum = below_u * above_u + below_v * above_v +
                       0.5 * (above_u * below_v + below_u * above_v);
    return M_PI / 3.0 * (v - u) * sum;
}

static double distance(const double *a, const double *b)
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

double gb_ball_solid_volume(int64_t count, const double *position, const double *radius,
                            const double centre[3], double ball_radius)
{
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        sum += gb_ball_shared_volume(ball_radius, radius[i],
                                     distance(position + 3 * i, centre));
    }
    return sum;
}

double gb_ball_density_whole(int64_t count, const double *radius, double die_radius,
                             double height)
{
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        sum += gb_ball_volume(radius[i]);
    }
    return height > 0.0 ? sum / (M_PI * die_radius * die_radius * height) : (double)NAN;
}

double gb_ball_density_central(int64_t count, const double *position,
                               const double *radius, const double centre[3],
                               double ball_radius)
{
    return gb_ball_solid_volume(count, position, radius, centre, ball_radius) /
           gb_ball_volume(ball_radius);
}

double gb_ball_overlap_volume(int64_t count, const double *position, const double *radius,
                              const int64_t *start, const int32_t *other)
{
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        for (int64_t k = start[i]; k < start[i + 1]; k++) {
            const int32_t j = other[k];
            sum += gb_ball_shared_volume(
                radius[i], radius[j],
                distance(position + 3 * i, position + 3 * (int64_t)j));
        }
    }
    return sum;
}

/* Gauss-Legendre, 24 points: abscissae and weights of the positive half.  Abramowitz and
 * Stegun, Table 25.4. */
enum { HALF = 12 };
static const double node[HALF] = {
    0.064056892862605626085, 0.191118867473616309159, 0.315042679696163374387,
    0.433793507626045138487, 0.545421471388839535658, 0.648093651936975569252,
    0.740124191578554364244, 0.820001985973902921954, 0.886415527004401034213,
    0.938274552002732758524, 0.974728555971309498198, 0.995187219997021360180};
static const double weight[HALF] = {
    0.127938195346752156974, 0.125837456346828296121, 0.121670472927803391204,
    0.115505668053725601353, 0.107444270115965634783, 0.097618652104113888270,
    0.086190161531953275917, 0.073346481411080305734, 0.059298584915436780746,
    0.044277438817419806169, 0.028531388628933663181, 0.012341229799987199547};

/* Area that a disc of radius a shares with one of radius b at this distance of the
 * centres. */
static double shared_area(double a, double b, double distance)
{
    const double small = fmin(a, b), big = fmax(a, b);
    if (distance >= a + b) {
        return 0.0;
    }
    if (distance <= big - small) {
        return M_PI * small * small;
    }
    /* 16 times the squared area of the triangle of both centres and a point of both
     * circles; factors and products keep their digits where the radii differ much */
    const double kite = sqrt(fmax((a + b - distance) * (distance + a - b) *
                                      (distance + b - a) * (distance + a + b),
                                  0.0));
    const double at_a = atan2(kite, (distance - b) * (distance + b) + a * a);
    const double at_b = atan2(kite, (distance - a) * (distance + a) + b * b);
    return a * a * at_a + b * b * at_b - 0.5 * kite;
}

/* Volume between two angles, z = r sin angle. */
static double integrate(double cylinder, double sphere, double axis, double from,
                        double to)
{
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0.0;
    for (int k = 0; k < 2 * HALF; k++) {
        const double side = k < HALF ? -1.0 : 1.0;
        const double angle = middle + side * half * node[k % HALF];
        const double section = sphere * cos(angle);
        sum += weight[k % HALF] * section * shared_area(section, cylinder, axis);
    }
    return half * sum;
}

double gb_ball_cylinder(double cylinder, double sphere, double axis, double low,
                        double high)
{
    const double u = fmax(low, -sphere), v = fmin(high, sphere);
    if (!(u < v) || axis >= cylinder + sphere) {
        return 0.0;
    }
    /* sections of these radii touch the cylinder from outside, or from inside */
    const double touch = fabs(axis - cylinder);
    const double inner = touch < sphere ? acos(touch / sphere) : 0.0;
    const double outer =
        axis + cylinder < sphere ? acos((axis + cylinder) / sphere) : 0.0;
    const double from = asin(fmax(u / sphere, -1.0)), to = asin(fmin(v / sphere, 1.0));
    const double cut[] = {-0.5 * M_PI, -inner, -outer, outer, inner, 0.5 * M_PI};
    double sum = 0.0;
    for (size_t k = 0; k + 1 < sizeof cut / sizeof cut[0]; k++) {
        const double a = fmax(cut[k], from), b = fmin(cut[k + 1], to);
        sum += a < b ? integrate(cylinder, sphere, axis, a, b) : 0.0;
    }
    return sum;
}

/* One sphere into the rings and bands that it meets. */
static void add_sphere(const struct gb_density_map *map, const double x[3], double radius,
                       double *solid)
{
    const double axis = hypot(x[0], x[1]);
    const double width = map->radius / map->rings;
    const double height = (map->high - map->low) / map->bands;
    const int first = (int)fmax(floor((axis - radius) / width), 0.0);
    for (int band = 0; band < map->bands; band++) {
        const double low = map->low + height * band - x[2];
        if (low >= radius || low + height <= -radius) {
            continue;
        }
        double inside = gb_ball_cylinder(first * width, radius, axis, low, low + height);
        for (int ring = first; ring < map->rings; ring++) {
            const double within =
                gb_ball_cylinder((ring + 1) * width, radius, axis, low, low + height);
            solid[ring * map->bands + band] += within - inside;
            inside = within;
            if ((ring + 1) * width >= axis + radius) {
                break;
            }
        }
    }
}

void gb_ball_density_map(const struct gb_density_map *map, int64_t count,
                         const double *position, const double *radius,
                         const double centre[2], double *density)
{
    const double width = map->radius / map->rings;
    const double height = (map->high - map->low) / map->bands;
    for (int k = 0; k < map->rings * map->bands; k++) {
        density[k] = 0.0;
    }
    for (int64_t i = 0; i < count; i++) {
        const double x[3] = {position[3 * i] - centre[0], position[3 * i + 1] - centre[1],
                             position[3 * i + 2]};
        add_sphere(map, x, radius[i], density);
    }
    for (int k = 0; k < map->rings * map->bands; k++) {
        const int ring = k / map->bands;
        density[k] /= M_PI * width * width * (2.0 * ring + 1.0) * height;
    }
}
