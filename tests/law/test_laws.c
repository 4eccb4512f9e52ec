#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "common/exact.h"
#include "scene/model.h"

/* The table has 13 significant digits. */
static const double tolerance = 1e-10;

static void make_model(struct gb_model *model, double diameter, double alpha,
                       double length)
{
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.diameter_m = diameter;
    params.alpha = alpha;
    params.bridge_length = (struct gb_relative){length, true};
    const bool good = gb_model_init(model, &params, &err);
    g_test_message("%s", err.text);
    g_assert_true(good);
}

static double lattice_pressure(const struct gb_model *model, bool fcc, double h)
{
    const double r = 1.0 - h;
    const double force =
        gb_law_rod_force(&model->rod, h) - gb_law_dispersion_force(&model->dispersion, r);
    const double volume = fcc ? r * r * r / sqrt(2.0) : r * r * r;
    const double bonds = fcc ? 6.0 : 3.0;
    return bonds * force * r / (3.0 * volume) * model->pascal_per_stress * 1e-9;
}

static double evaluate(const char *law, const char *words, const char *input)
{
    struct gb_model scene;
    make_model(&scene, exact_number(words, "d=", 1e-8),
               exact_number(words, "alpha=", 0.24), exact_number(words, "drch=", 0.008));
    const struct gb_model *model = &scene;
    const double h = exact_number(input, "h=", 0.0), r = exact_number(input, "r=", 1.0);
    const double a = 0.5 * sqrt(h);
    const struct gb_law_rod *rod = &model->rod;
    if (strcmp(law, "rod_force") == 0) {
        return gb_law_rod_force(rod, h);
    } else if (strcmp(law, "rod_stiffness") == 0) {
        return gb_law_rod_stiffness(rod, h);
    } else if (strcmp(law, "contact_moment_M") == 0) {
        return gb_law_rod_moment(rod, h);
    } else if (strcmp(law, "shear_stiffness") == 0) {
        return gb_law_slip_shear_stiffness(&model->slip, a);
    } else if (strcmp(law, "pivot_stiffness") == 0) {
        return gb_law_slip_pivot_stiffness(&model->slip, a);
    } else if (strcmp(law, "roll_stiffness") == 0) {
        return gb_law_slip_roll_stiffness(&model->slip, a);
    } else if (strcmp(law, "adhesion") == 0 || strcmp(law, "adhesion_max") == 0) {
        return gb_law_dispersion_force(&model->dispersion, r);
    } else if (strcmp(law, "adhesion_max_nN") == 0) {
        return gb_law_dispersion_force(&model->dispersion, r) * model->newton_per_force *
               1e9;
    } else if (strcmp(law, "equilibrium_overlap") == 0) {
        return model->h_eq;
    } else if (strcmp(law, "bridge_line_end_fn") == 0) {
        return gb_law_bridge_force(rod, exact_number(words, "h_min=", 0.0), h) -
               model->adhesion;
    } else if (strcmp(law, "lattice_pressure_sc") == 0) {
        return lattice_pressure(model, false, h);
    } else if (strcmp(law, "lattice_pressure_fcc") == 0) {
        return lattice_pressure(model, true, h);
    } else if (strcmp(law, "bridge_strength_GPa") == 0) {
        return gb_law_bridge_peel_stress(&model->bridge, rod, h) *
               model->pascal_per_stress * 1e-9;
    }
    return NAN;
}

static void test_exact_values(void)
{
    g_assert_cmpint(exact_rows(GB_TEST_DIR "/exact_values_p1.csv", tolerance, evaluate),
                    ==, 93);
}

static double rod_energy(const void *law, double h)
{
    return gb_law_rod_energy(law, h);
}

static double rod_force(const void *law, double h)
{
    return gb_law_rod_force(law, h);
}

static double dispersion_energy(const void *law, double r)
{
    return gb_law_dispersion_energy(law, r);
}

static double dispersion_force(const void *law, double r)
{
    return gb_law_dispersion_force(law, r);
}

static void test_force_is_slope_of_energy(void)
{
    static const double poissons[] = {0.0, 0.25, 0.45};
    for (size_t k = 0; k < G_N_ELEMENTS(poissons); k++) {
        struct gb_law_rod rod;
        gb_law_rod_init(&rod, poissons[k]);
        for (double h = 1e-4; h < 0.9; h *= 1.37) {
            const double step = 1e-3 * fmin(h, 1.0 - h);
            assert_close(exact_slope(rod_energy, &rod, h, step),
                         gb_law_rod_force(&rod, h), 1e-9);
            assert_close(exact_slope(rod_force, &rod, h, step),
                         gb_law_rod_stiffness(&rod, h), 1e-9);
        }
    }
    struct gb_model model;
    make_model(&model, 9.7e-9, 0.24, 0.008);
    const struct gb_law_dispersion *law = &model.dispersion;
    for (double gap = 1e-3; gap < 1.0; gap *= 1.5) {
        const double r = 1.0 + gap, step = 1e-3 * (r + law->shift - 1.0);
        assert_close(exact_slope(dispersion_energy, law, r, step),
                     gb_law_dispersion_force(law, r), 1e-6);
        assert_close(exact_slope(dispersion_force, law, r, step),
                     gb_law_dispersion_slope(law, r), 1e-8);
    }
    assert_close(gb_law_dispersion_energy(law, 0.9),
                 gb_law_dispersion_energy(law, 1.0) - 0.1 * law->contact, 1e-12);
}

/* The power series below h = 1/16 and the logarithms above meet. */
static void test_series_border(void)
{
    struct gb_law_rod rod;
    gb_law_rod_init(&rod, 0.25);
    const double border = 0.0625, step = 1e-10;
    const double below = border - step, above = border + step;
    assert_close(gb_law_rod_force(&rod, above) -
                     gb_law_rod_stiffness(&rod, border) * 2 * step,
                 gb_law_rod_force(&rod, below), 1e-13);
    assert_close(gb_law_rod_energy(&rod, above) -
                     gb_law_rod_force(&rod, border) * 2 * step,
                 gb_law_rod_energy(&rod, below), 1e-11);
    const double rise = (gb_law_rod_moment(&rod, border * 1.001) -
                         gb_law_rod_moment(&rod, border * 0.999)) /
                        (0.002 * border);
    assert_close(gb_law_rod_moment(&rod, above) - rise * 2 * step,
                 gb_law_rod_moment(&rod, below), 1e-12);
}

static void test_limits(void)
{
    struct gb_law_rod rod;
    gb_law_rod_init(&rod, 0.25);
    g_assert_cmpfloat(gb_law_rod_force(&rod, 0.0), ==, 0.0);
    g_assert_cmpfloat(gb_law_rod_force(&rod, -1.0), ==, 0.0);
    g_assert_true(isinf(gb_law_rod_force(&rod, 1.0)));
    g_assert_true(isinf(gb_law_rod_energy(&rod, 2.0)));
    for (double h = 1e-12; h < 1e-6; h *= 10.0) { /* Hertz */
        assert_close(gb_law_rod_force(&rod, h), pow(h, 1.5) / (3.0 * (1.0 - 0.0625)),
                     3.0 * sqrt(h));
    }
    /* P1: up to drch = 0.01 d the strength of a bridge stays below E/30. */
    const struct gb_law_bridge bridge = {.length = 0.01, .strength = 0.018};
    for (double h = 0.0; h < 0.1; h += 0.001) {
        g_assert_cmpfloat(gb_law_bridge_peel_stress(&bridge, &rod, h), <, 1.0 / 30.0);
    }
}

/* f_n of one contact with its history. */
struct contact {
    const struct gb_model *model;
    double h_min;
};

static double move(struct contact *contact, double h)
{
    const struct gb_model *model = contact->model;
    contact->h_min = gb_law_bridge_deepest(&model->bridge, contact->h_min, h);
    const double elastic = contact->h_min > h && contact->h_min > 0.0
                               ? gb_law_bridge_force(&model->rod, contact->h_min, h)
                               : gb_law_rod_force(&model->rod, h);
    return elastic - gb_law_dispersion_force(&model->dispersion, 1.0 - h);
}

/* Equation (1) as printed, for values that do not come from the code under test. */
static double printed_force(double h)
{
    const double nu = 0.25, m = (1.0 - nu) / ((1.0 - 2.0 * nu) * (1.0 + nu));
    return pow(h, 1.5) / (3.0 * (1.0 - nu * nu)) - G_PI / 4.0 * m * (h + log(1.0 - h));
}

static double printed_slope(double h)
{
    const double nu = 0.25, m = (1.0 - nu) / ((1.0 - 2.0 * nu) * (1.0 + nu));
    return sqrt(h) / (2.0 * (1.0 - nu * nu)) + G_PI / 4.0 * m * h / (1.0 - h);
}

/* Goes from one overlap to another in fine steps; the force at the end. */
static double walk(struct contact *contact, double from, double to)
{
    double force = 0.0;
    for (int i = 1; i <= 1000; i++) {
        force = move(contact, i == 1000 ? to : from + (to - from) * i / 1000.0);
    }
    return force;
}

/* P1 Fig. 1 at d = 16 nm: A-B-C-D and C-C'-D'-C. */
static void test_two_particle_path(void)
{
    struct gb_model model;
    make_model(&model, 16e-9, 0.24, 0.008);
    const double pull = model.adhesion, drch = 0.008, near = 1e-12;
    struct contact contact = {&model, 0.0};
    /* A to B and short of C: reversible, no bridge. */
    g_assert_cmpfloat(walk(&contact, -0.02, 0.0), <, 0.0);
    g_assert_cmpfloat(contact.h_min, ==, 0.0);
    assert_close(move(&contact, 0.0), -pull, 1e-12);
    assert_close(walk(&contact, 0.0, 0.0079), printed_force(0.0079) - pull, 1e-10);
    g_assert_cmpfloat(contact.h_min, ==, 0.0);
    assert_close(walk(&contact, 0.0079, 0.004), printed_force(0.004) - pull, 1e-10);
    /* C, and the straight line to D. */
    const double c = drch + near;
    assert_close(walk(&contact, 0.004, c), printed_force(drch) - pull, 1e-8);
    g_assert_cmpfloat(contact.h_min, ==, c);
    assert_close(walk(&contact, c, 2.0 * near),
                 printed_force(drch) - drch * printed_slope(drch) - pull, 1e-8);
    /* D to B: the bridge has gone. */
    assert_close(move(&contact, 0.0), -pull, 1e-12);
    g_assert_cmpfloat(contact.h_min, ==, 0.0);
    g_assert_cmpfloat(move(&contact, 0.004), ==, move(&contact, 0.004));
    g_assert_cmpfloat(contact.h_min, ==, 0.0);
    /* C' and D'. */
    assert_close(walk(&contact, 0.004, 0.02), printed_force(0.02) - pull, 1e-10);
    const double d1 = 0.02 - drch + near;
    assert_close(walk(&contact, 0.02, d1),
                 printed_force(0.02) - drch * printed_slope(0.02) - pull, 1e-8);
    g_assert_cmpfloat(contact.h_min, ==, 0.02);
    /* Partial breaking: r_min follows at a distance of drch, up to C. */
    walk(&contact, d1, 0.004);
    g_assert_cmpfloat_with_epsilon(contact.h_min, 0.012, 1e-15);
    assert_close(walk(&contact, 0.004, 0.012), printed_force(0.012) - pull, 1e-10);
    walk(&contact, 0.012, 1e-9);
    g_assert_cmpfloat_with_epsilon(contact.h_min, drch, 2e-9);
    move(&contact, -1e-9);
    g_assert_cmpfloat(contact.h_min, ==, 0.0);
}

/* No jump of the force where one branch hands over to the next, except where a bridge
 * breaks for good. */
static void test_continuity(void)
{
    struct gb_model model;
    make_model(&model, 9.7e-9, 0.24, 0.008);
    const double eps = 1e-13;
    const struct gb_law_dispersion *law = &model.dispersion;
    assert_close(gb_law_dispersion_force(law, 1.0 + eps), law->contact, 1e-9);
    assert_close(gb_law_dispersion_energy(law, 1.0 + eps),
                 gb_law_dispersion_energy(law, 1.0 - eps), 1e-9);
    struct contact contact = {&model, 0.0};
    const double before = move(&contact, 0.008 - eps),
                 after = move(&contact, 0.008 + eps);
    g_assert_true(contact.h_min > 0.0); /* forming */
    assert_close(after, before, 1e-9);
    const double deepest = move(&contact, 0.03);
    assert_close(move(&contact, 0.03 - eps), deepest, 1e-9);
    const double whole = move(&contact, 0.022 + eps),
                 broken = move(&contact, 0.022 - eps);
    g_assert_cmpfloat(contact.h_min, <, 0.03); /* partial break */
    assert_close(broken, whole, 1e-9);
}

static void test_caps(void)
{
    struct gb_model model;
    make_model(&model, 1e-8, 0.24, 0.008);
    const struct gb_law_slip *slip = &model.slip;
    for (double h = 1e-3; h < 0.3; h *= 1.5) {
        const double a = 0.5 * sqrt(h);
        const double coulomb = 0.1 * printed_force(h), strength = G_PI * a * a * 0.018;
        assert_close(gb_law_slip_shear_cap(slip, &model.rod, h), fmin(coulomb, strength),
                     1e-9);
        assert_close(gb_law_slip_bridge_shear_cap(slip, a), strength, 1e-12);
        assert_close(gb_law_slip_bridge_pivot_cap(slip, a),
                     G_PI / 2.0 * a * a * a * 0.018, 1e-12);
        assert_close(
            gb_law_slip_pivot_cap(slip, &model.rod, h),
            fmin(0.1 * gb_law_rod_moment(&model.rod, h), G_PI / 2.0 * a * a * a * 0.018),
            1e-12);
        assert_close(gb_law_slip_roll_cap(a, 0.3), 0.1 * a, 1e-12);
    }
    g_assert_cmpfloat(gb_law_slip_roll_cap(0.1, -1.0), ==, 0.0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/laws/exact-values", test_exact_values);
    g_test_add_func("/laws/force-is-slope-of-energy", test_force_is_slope_of_energy);
    g_test_add_func("/laws/series-border", test_series_border);
    g_test_add_func("/laws/limits", test_limits);
    g_test_add_func("/laws/two-particle-path", test_two_particle_path);
    g_test_add_func("/laws/continuity", test_continuity);
    g_test_add_func("/laws/caps", test_caps);
    return g_test_run();
}
