#include "measure/ball.h"

#include <math.h>

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
