#include <math.h>

#include <glib.h>

#include "measure/theory.h"

/* The powder of P2: alumina, 10 nm, discs. */
static struct gb_model model_of_p2(void)
{
    struct gb_params params;
    struct gb_model model;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.dimension = 2;
    params.count = 1000;
    params.diameter_m = 1e-8;
    params.geometry = GB_GEOMETRY_ISOTROPIC;
    if (!gb_params_check(&params, &err) || !gb_model_init(&model, &params, &err)) {
        g_error("%s", err.text);
    }
    return model;
}

/* Lattices of discs: 3, 4 and 6 contacts. */
static void test_regular(void)
{
    g_assert_cmpfloat_with_epsilon(gb_theory_regular_density(3.0),
                                   G_PI / (3.0 * sqrt(3.0)), 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_theory_regular_density(4.0), G_PI / 4.0, 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_theory_regular_density(6.0),
                                   G_PI / (2.0 * sqrt(3.0)), 1e-14);
    g_assert_cmpfloat_with_epsilon(gb_theory_coordination(0.9), 4.73, 1e-14);
}

/* Evaluated with 30 digits from the equations of both papers. */
static void test_values(void)
{
    static const double rows[][3] = {
        {0.85, 0.012155247931144126, -111.85643222105725},
        {0.90, 0.02906783469232985, 691.6642363308873},
        {0.95, 0.04566248003952317, 2037.5082861237725},
        {0.97, 0.05220091353420686, 2736.9177865842794},
        {1.00, 0.06189411340106696, 3969.8236280341785},
    };
    const struct gb_model model = model_of_p2();
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_cmpfloat_with_epsilon(gb_theory_overlap(rows[i][0]), rows[i][1], 1e-13);
        g_assert_cmpfloat_with_epsilon(1e-6 * gb_theory_pressure(&model, rows[i][0]),
                                       rows[i][2], 1e-8 * fabs(rows[i][2]));
    }
    g_assert_true(isnan(gb_theory_pressure(&model, 0.8)));
    g_assert_true(isnan(gb_theory_pressure(&model, -1.0)));
    g_assert_true(isnan(gb_theory_pressure(&model, (double)NAN)));
}

/* P2: at 3 GPa the density of the asymptote is less than 3 % off the curves' 0.95. */
static void test_published(void)
{
    const struct gb_model model = model_of_p2();
    struct gb_error err = {0};
    double density = 0.0;
    g_assert_true(gb_theory_density(&model, 3e9, &density, &err));
    g_test_message("density at 3 GPa: %.5f", density);
    g_assert_cmpfloat(fabs(density / 0.95 - 1.0), <, 0.03);
    g_assert_cmpfloat_with_epsilon(density, 0.9768842763920459, 1e-8);
}

static void test_inverse(void)
{
    const struct gb_model model = model_of_p2();
    struct gb_error err = {0};
    double density = 0.0;
    for (double rho = 0.87; rho < 1.2; rho += 0.01) {
        const double pressure = gb_theory_pressure(&model, rho);
        g_assert_true(gb_theory_density(&model, pressure, &density, &err));
        g_assert_cmpfloat_with_epsilon(density, rho, 1e-12);
    }
    const double bad[] = {-1.0, 1e15, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        g_assert_false(gb_theory_density(&model, bad[i], &density, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/theory/regular", test_regular);
    g_test_add_func("/theory/values", test_values);
    g_test_add_func("/theory/published", test_published);
    g_test_add_func("/theory/inverse", test_inverse);
    return g_test_run();
}
