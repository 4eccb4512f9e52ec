#include <glib.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

#include "common/bed.h"
#include "solve/leapfrog.h"

static void advance_step(struct gb_leapfrog *leapfrog, struct gb_bed *bed)
{
    struct gb_error err = {0};
    if (!gb_leapfrog_step(leapfrog, bed, &err)) {
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
    gb_leapfrog_init(&motion, safety, 0.0);
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
    gb_leapfrog_init(&motion, 0.05, 0.0);
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

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/leapfrog/collision", test_collision);
    g_test_add_func("/leapfrog/closed", test_closed);
    g_test_add_func("/leapfrog/critical", test_critical);
    return g_test_run();
}
