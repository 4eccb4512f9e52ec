#include <glib.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "common/bed.h"
#include "scene/tolerances.h"
#include "solve/loading/die/die_state.h"

static void advance_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed)
{
    struct gb_error err = {0};
    if (!gb_die_state_leapfrog_step(leapfrog, bed, &err)) {
        g_error("%s", err.text);
    }
}

/* P3 (1), (6)-(9) of two equal spheres that approach: h'' = -2 F/m. */
struct duo {
    struct gb_bed_law law;
    double radius, mass;
};

static int collision(double time, const double y[], double dydt[], void *data)
{
    (void)time;
    const struct duo *duo = data;
    const struct gb_law_hertz *hertz = &duo->law.normal.hertz;
    const double star = gb_law_hertz_radius(duo->radius, duo->radius);
    const double dashpot = gb_law_hertz_damping(gb_law_hertz_stiffness(hertz, star, y[0]),
                                                0.5 * duo->mass, duo->law.damping);
    const double elastic = gb_law_hertz_force(hertz, star, y[0]);
    dydt[0] = y[1];
    dydt[1] = -2.0 / duo->mass * gb_law_hertz_damped_force(elastic, dashpot, y[1]);
    return 0;
}

static double exact_speed_after(struct duo *duo, double speed, double length)
{
    gsl_odeiv2_system system = {collision, NULL, 2, duo};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rkf45, 1e-3, 1e-15, 1e-12);
    double y[2] = {1e-12, speed}, time = 0.0;
    gsl_odeiv2_driver_apply(driver, &time, length, y);
    gsl_odeiv2_driver_free(driver);
    return -y[1];
}

/* Approach speed after the collision of two spheres in the middle of a wide die. */
static double speed_after(const struct duo *duo, double speed, double safety,
                          double length)
{
    const struct gb_die die = bed_die(10.0);
    const double radius[2] = {duo->radius, duo->radius};
    struct gb_bed *bed = bed_create(2, radius, &die, &duo->law);
    struct gb_leapfrog motion;
    gb_die_state_leapfrog_init(&motion, safety, 0.0);
    motion.fastest = speed;
    bed_set_position(bed, 0, -duo->radius, 0.0, 5.0);
    bed_set_position(bed, 1, duo->radius, 0.0, 5.0);
    bed->velocity[0][0] = 0.5 * speed;
    bed->velocity[1][0] = -0.5 * speed;
    for (double time = 0.0; time < length; time += motion.step) {
        advance_step(&motion, bed);
    }
    const double after = bed->velocity[1][0] - bed->velocity[0][0];
    g_assert_cmpfloat(fabs(bed->velocity[1][0] + bed->velocity[0][0]), <, 1e-15);
    gb_bed_destroy(bed);
    return after;
}

/* A collision leaves the speed that its equation leaves: all of it without damping.  The
 * error falls with the square of the step, as that of central differences does. */
static void test_collision(void)
{
    static const double damping[] = {0.0, 0.05, 0.3};
    const double speed = 1e-3;
    for (size_t k = 0; k < G_N_ELEMENTS(damping); k++) {
        struct duo duo = {bed_law(), 0.5, 1.0};
        duo.law.damping = damping[k];
        const double contact = 2.868 * pow(1.0 / (0.5 * duo.law.normal.hertz.modulus *
                                                  duo.law.normal.hertz.modulus * speed),
                                           0.2);
        const double exact = exact_speed_after(&duo, speed, 4.0 * contact);
        const double coarse = speed_after(&duo, speed, 0.1, 4.0 * contact);
        const double fine = speed_after(&duo, speed, 0.01, 4.0 * contact);
        g_test_message("xi %.2f: exact %.9f, safety 0.1 %+.1e, 0.01 %+.1e", damping[k],
                       exact / speed, coarse / exact - 1.0, fine / exact - 1.0);
        g_assert_cmpfloat_with_epsilon(coarse / exact, 1.0, 2e-2);
        g_assert_cmpfloat_with_epsilon(fine / exact, 1.0, 1e-3);
    }
}

enum { ACROSS = 3, LAYERS = 4, SPHERES = ACROSS * ACROSS * LAYERS };

static double potential(const struct gb_bed_list *list)
{
    double sum = 0.0;
    for (int64_t s = 0; s < list->count; s++) {
        const double force = list->contacts.normal[s];
        if (force > 0.0) { /* F = c h^1.5, so that its integral is 2/5 F h */
            sum += 0.4 * force * cbrt(pow(force / list->contacts.hertz[s], 2.0));
        }
    }
    return sum;
}

static double kinetic(const struct gb_bed *bed)
{
    const struct gb_bed_kinetic_energy all = gb_bed_kinetic_energy(bed);
    return all.translational + all.rotational;
}

/* Smooth elastic spheres thrown about in a closed die lose nothing to the method. */
static void test_closed(void)
{
    struct gb_die die = bed_die(2.0);
    die.punch = true;
    die.punch_position = 5.0;
    const struct gb_bed_law law = bed_law();
    double radius[SPHERES];
    for (int i = 0; i < SPHERES; i++) {
        radius[i] = 0.30 + 0.02 * (i % 5);
    }
    struct gb_bed *bed = bed_create(SPHERES, radius, &die, &law);
    for (int i = 0; i < SPHERES; i++) {
        bed_set_position(bed, i, 0.9 * (i % ACROSS - 1), 0.9 * (i / ACROSS % ACROSS - 1),
                         0.6 + 1.2 * (i / (ACROSS * ACROSS)));
        for (int c = 0; c < 3; c++) {
            bed->velocity[i][c] = 2e-3 * sin(1.0 + i + 37.0 * c);
        }
    }
    struct gb_leapfrog motion;
    gb_die_state_leapfrog_init(&motion, 0.05, 0.0);
    motion.fastest = 4e-3;
    const double before = kinetic(bed);
    double worst = 0.0, stored = 0.0, half = before;
    for (int step = 0; step < 200000; step++) {
        advance_step(&motion, bed);
        const double next = kinetic(bed);
        const double energy =
            0.5 * (half + next) + (potential(&bed->pairs) + potential(&bed->walls));
        stored = fmax(stored, energy - 0.5 * (half + next));
        worst = fmax(worst, fabs(energy / before - 1.0));
        half = next;
    }
    g_test_message("energy within %.1e; at most %.0f %% of it in contacts", worst,
                   100.0 * stored / before);
    g_assert_cmpfloat(stored, >, 0.1 * before);
    g_assert_cmpfloat(worst, <, 5e-3);
    g_assert_cmpint(gb_bed_escaped(bed), ==, -1);
    gb_bed_destroy(bed);
}

/* Up to nine tenths of the critical step a collision gives back no more than it got. */
static void test_critical(void)
{
    struct duo duo = {bed_law(), 0.5, 1.0};
    const double speed = 1e-3;
    for (double safety = 0.1; safety < 1.0; safety += 0.2) {
        g_assert_cmpfloat(speed_after(&duo, speed, safety, 500.0), <, 1.1 * speed);
    }
}

/* Two elastic spheres of unequal sizes, a gap of 1e-6 apart, that close in at this speed. */
static struct gb_bed *create_closing(double speed)
{
    const double radius[2] = {0.5, 0.2};
    const struct gb_die die = bed_die(10.0);
    const struct gb_bed_law law = bed_law();
    struct gb_bed *bed = bed_create(2, radius, &die, &law);
    bed_set_position(bed, 0, -0.5, 0.0, 5.0);
    bed_set_position(bed, 1, 0.2 + 1e-6, 0.0, 5.0);
    bed->velocity[1][0] = -speed;
    return bed;
}

/* The step for an impact is the share of 2 T/pi of the collision that follows; nothing bounds it
 * where spheres part or slip past each other. */
static void test_impact(void)
{
    struct gb_error err = {0};
    for (double speed = 1e-5; speed < 0.02; speed *= 30.0) {
        struct gb_bed *bed = create_closing(speed);
        g_assert_true(gb_bed_evaluate(bed, 0.0, 0.0, &err));
        const double duration =
            gb_die_state_leapfrog_impact(bed) / (GB_IMPACT_SHARE * 2.0 / M_PI);
        struct gb_leapfrog motion;
        gb_die_state_leapfrog_init(&motion, 1.0, duration / 2000.0);
        double touching = 0.0;
        for (int step = 0; step < 5000; step++) {
            advance_step(&motion, bed);
            touching += bed->tally.stiffest > 0.0 ? motion.step : 0.0;
        }
        g_test_message("speed %g: %.6g, took %.6g", speed, duration, touching);
        g_assert_cmpfloat(bed->velocity[1][0], >, 0.0);
        g_assert_cmpfloat_with_epsilon(touching / duration, 1.0, 2e-3);
        g_assert_true(isinf(gb_die_state_leapfrog_impact(bed)));
        gb_bed_destroy(bed);
    }
    struct gb_bed *past = create_closing(0.0);
    past->velocity[1][1] = 1e-3;
    g_assert_true(gb_bed_evaluate(past, 0.0, 0.0, &err));
    g_assert_true(isinf(gb_die_state_leapfrog_impact(past)));
    gb_bed_destroy(past);
}

/* A straight chain of equal spheres, squeezed between floor and punch. */
static struct gb_bed *create_chain(int count, double overlap, double damping)
{
    const double radius[] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    struct gb_die die = bed_die(10.0);
    struct gb_bed_law law = bed_law();
    law.damping = damping;
    const double at_wall = overlap * cbrt(0.5); /* the same force at twice the R* */
    die.punch = true;
    die.punch_position = 1.0 - 2.0 * at_wall + (count - 1) * (1.0 - overlap);
    struct gb_bed *bed = bed_create(count, radius, &die, &law);
    for (int i = 0; i < count; i++) {
        bed_set_position(bed, i, 0.0, 0.0, 0.5 - at_wall + i * (1.0 - overlap));
    }
    return bed;
}

/* Just below the critical step a chain, in which no direction is free of dashpots, comes to
 * rest for any damping, and without damping keeps its energy. */
static void test_chain(void)
{
    static const double damping[] = {0.0, 0.05, 0.3, 0.9, 3.0, 30.0};
    for (size_t k = 0; k < G_N_ELEMENTS(damping); k++) {
        for (int count = 1; count <= 8; count++) {
            struct gb_bed *bed = create_chain(count, 1e-3, damping[k]);
            struct gb_leapfrog motion;
            gb_die_state_leapfrog_init(&motion, 0.98, 0.0);
            for (int i = 0; i < count; i++) {
                bed->velocity[i][2] = 1e-9 * cos(2.0 * i);
            }
            const double before = kinetic(bed);
            double most = 0.0;
            for (int step = 0; step < 20000; step++) {
                advance_step(&motion, bed);
                most = step >= 19000 ? fmax(most, kinetic(bed)) : 0.0;
            }
            g_assert_cmpfloat(most, <, damping[k]> 0.0 ? 1e-6 * before : 30.0 * before);
            gb_bed_destroy(bed);
        }
    }
}

enum { SIDE = 6, HEAP = SIDE * SIDE * SIDE };

/* Overlapping spheres of sizes to 1 : ratio at the nodes of a disturbed lattice, on the floor and
 * the side. */
static struct gb_bed *create_heap(double ratio, double mu, double mu_wall, GRand *rand)
{
    const struct gb_die die = bed_die(0.55 * SIDE);
    struct gb_bed_law law = bed_law();
    law.mu = mu;
    law.mu_wall = mu_wall;
    law.damping = 0.9;
    double radius[HEAP];
    for (int i = 0; i < HEAP; i++) {
        radius[i] = 0.55 / (1.0 + (ratio - 1.0) * g_rand_double(rand));
    }
    struct gb_bed *bed = bed_create(HEAP, radius, &die, &law);
    for (int i = 0; i < HEAP; i++) {
        double x[3] = {i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)};
        for (int c = 0; c < 3; c++) {
            x[c] += g_rand_double_range(rand, -0.3, 0.3) - (c < 2 ? 0.5 * SIDE - 0.5 : 0);
        }
        bed_set_position(bed, i, x[0], x[1], fmax(x[2], 0.0) + 0.5);
    }
    return bed;
}

/* A mode: displacements u and rotations w. */
struct mode {
    double u[HEAP][3], w[HEAP][3];
};

/* Forces and torques of the springs of one contact against a small motion. */
static void add_spring(const struct gb_bed *bed, int32_t i, int32_t j,
                       const double unit[3], double normal, double shear,
                       const struct mode *motion, struct mode *force)
{
    const double ri = bed->position[i][3], rj = j >= 0 ? bed->position[j][3] : 0.0;
    double slip[3], roll[3], across[3], moment[3];
    for (int c = 0; c < 3; c++) {
        slip[c] = motion->u[i][c] - (j >= 0 ? motion->u[j][c] : 0.0);
        roll[c] = ri * motion->w[i][c] + (j >= 0 ? rj * motion->w[j][c] : 0.0);
    }
    gb_vec_cross(roll, unit, across);
    gb_vec_add(slip, -1.0, across);
    const double along = gb_vec_dot(slip, unit);
    gb_vec_scale(slip, shear);
    gb_vec_add(slip, (normal - shear) * along, unit);
    gb_vec_cross(slip, unit, moment);
    for (int c = 0; c < 3; c++) {
        force->u[i][c] += slip[c];
        force->w[i][c] += ri * moment[c];
        if (j >= 0) {
            force->u[j][c] -= slip[c];
            force->w[j][c] += rj * moment[c];
        }
    }
}

/* Forces of all contacts of a bed. */
static void add_springs(const struct gb_bed *bed, const struct mode *motion,
                        struct mode *force)
{
    for (int kind = 0; kind < 2; kind++) {
        const struct gb_bed_list *list = kind ? &bed->walls : &bed->pairs;
        const double mu = kind ? bed->law.mu_wall : bed->law.mu;
        const double shear_over_normal = mu > 0.0 ? bed->law.shear : 0.0;
        for (int64_t s = 0; s < list->count; s++) {
            const int32_t i = list->first[s], j = list->other[s];
            const double *x = bed->position[i];
            double unit[3], overlap = 0.0;
            if (kind) {
                overlap = gb_die_overlap(&bed->die, (enum gb_die_wall)j, x, x[3], unit);
            } else {
                memcpy(unit, x, sizeof unit);
                gb_vec_add(unit, -1.0, bed->position[j]);
                const double r = gb_vec_length(unit);
                gb_vec_scale(unit, 1.0 / r);
                overlap = x[3] + bed->position[j][3] - r;
            }
            const double k = 1.5 * list->contacts.hertz[s] * sqrt(fmax(overlap, 0.0));
            add_spring(bed, i, kind ? -1 : j, unit, k, shear_over_normal * k, motion,
                       force);
        }
    }
}

static double inertia(const struct gb_bed *bed, int i)
{
    const double radius = bed->position[i][3];
    return bed->inertia * bed->mass[i] * radius * radius;
}

/* Largest omega^2 of the bed by power iteration, from below. */
static double fastest_mode(const struct gb_bed *bed, GRand *rand)
{
    static struct mode motion, force;
    double square = 0.0;
    for (int i = 0; i < HEAP; i++) {
        for (int c = 0; c < 3; c++) {
            motion.u[i][c] = g_rand_double(rand) - 0.5;
            motion.w[i][c] = g_rand_double(rand) - 0.5;
        }
    }
    for (int k = 0; k < 500; k++) {
        double energy = 0.0, power = 0.0;
        memset(&force, 0, sizeof force);
        add_springs(bed, &motion, &force);
        for (int i = 0; i < HEAP; i++) {
            energy += bed->mass[i] * gb_vec_dot(motion.u[i], motion.u[i]) +
                      inertia(bed, i) * gb_vec_dot(motion.w[i], motion.w[i]);
            power +=
                gb_vec_dot(motion.u[i], force.u[i]) + gb_vec_dot(motion.w[i], force.w[i]);
        }
        square = power / energy;
        for (int i = 0; i < HEAP; i++) {
            memcpy(motion.u[i], force.u[i], sizeof motion.u[i]);
            memcpy(motion.w[i], force.w[i], sizeof motion.w[i]);
            gb_vec_scale(motion.u[i], bed->inverse_mass[i] / sqrt(energy));
            gb_vec_scale(motion.w[i], 1.0 / (inertia(bed, i) * sqrt(energy)));
        }
    }
    return square;
}

/* The critical step against the fastest mode of heaps: dashpots have their share of stability,
 * and the step is not many times shorter than it needs to be. */
static void test_modes(void)
{
    static const double ratio[] = {1.0, 2.0, 6.0};
    GRand *rand = g_rand_new_with_seed(11);
    for (int k = 0; k < 18; k++) {
        const double mu = k % 3 == 2 ? 0.3 : 0.0, mu_wall = k % 3 > 0 ? 0.3 : 0.0;
        struct gb_error err = {0};
        struct gb_bed *bed = create_heap(ratio[k / 3 % 3], mu, mu_wall, rand);
        struct gb_leapfrog motion;
        gb_die_state_leapfrog_init(&motion, 1e-6, 0.0);
        g_assert_true(gb_die_state_leapfrog_step(&motion, bed, &err));
        const double critical = gb_die_state_leapfrog_critical(bed);
        const double square = fastest_mode(bed, rand);
        g_test_message("sizes to %g, mu %.1f, of walls %.1f: (omega dt)^2 %.2f",
                       ratio[k / 3 % 3], mu, mu_wall, critical * critical * square);
        g_assert_cmpfloat(critical * critical * square, <, 3.0);
        g_assert_cmpfloat(critical * critical * square, >, 1.0);
        gb_bed_destroy(bed);
    }
    g_rand_free(rand);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/leapfrog/collision", test_collision);
    g_test_add_func("/leapfrog/closed", test_closed);
    g_test_add_func("/leapfrog/critical", test_critical);
    g_test_add_func("/leapfrog/impact", test_impact);
    g_test_add_func("/leapfrog/chain", test_chain);
    g_test_add_func("/leapfrog/modes", test_modes);
    return g_test_run();
}
