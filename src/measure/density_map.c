#include "measure/density_map.h"

#include <math.h>
#include <stddef.h>

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

double gb_density_map_shared_area(double a, double b, double distance)
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
        sum += weight[k % HALF] * section *
               gb_density_map_shared_area(section, cylinder, axis);
    }
    return half * sum;
}

double gb_density_map_cylinder(double cylinder, double sphere, double axis, double low,
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
        double inside =
            gb_density_map_cylinder(first * width, radius, axis, low, low + height);
        for (int ring = first; ring < map->rings; ring++) {
            const double within = gb_density_map_cylinder((ring + 1) * width, radius,
                                                          axis, low, low + height);
            solid[ring * map->bands + band] += within - inside;
            inside = within;
            if ((ring + 1) * width >= axis + radius) {
                break;
            }
        }
    }
}

void gb_density_map_fill(const struct gb_density_map *map, int64_t count,
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
