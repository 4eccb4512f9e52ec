#include "law/law_mindlin.h"

#include <math.h>

#include "base/vec.h"

void gb_law_mindlin_rotate(double force[3], const double normal[3])
{
    const double before = gb_vec_length(force);
    gb_vec_add(force, -gb_vec_dot(force, normal), normal);
    const double after = gb_vec_length(force);
    gb_vec_scale(force, after > 0.0 ? before / after : 0.0);
}

void gb_law_mindlin_slip(const double normal[3], const double velocity_i[3],
                         const double velocity_j[3], const double spin_i[3],
                         const double spin_j[3], double lever_i, double lever_j,
                         double slip[3])
{
    /* contact point at -lever_i n from i, at +lever_j n from j */
    double turning[3], swept[3];
    for (int k = 0; k < 3; k++) {
        turning[k] = -(lever_i * spin_i[k] + lever_j * spin_j[k]);
    }
    gb_vec_cross(turning, normal, swept);
    for (int k = 0; k < 3; k++) {
        slip[k] = velocity_i[k] - velocity_j[k] + swept[k];
    }
    gb_vec_add(slip, -gb_vec_dot(slip, normal), normal);
}

bool gb_law_mindlin_advance(double force[3], const double slip[3], double stiffness,
                            double dt, double mu, double normal_force)
{
    gb_vec_add(force, -stiffness * dt, slip);
    const double cap = mu * fabs(normal_force), length = gb_vec_length(force);
    if (length <= cap) {
        return false;
    }
    gb_vec_scale(force, cap / length);
    return true;
}
