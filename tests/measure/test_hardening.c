#include <gsl/gsl_errno.h>
#include <math.h>

#include <glib.h>

#include "greenbody/params.h"
#include "measure/theory.h"

enum { POINTS = 200 };

static const int geometries[] = {GB_GEOMETRY_UNIAXIAL, GB_GEOMETRY_BIAXIAL,
                                 GB_GEOMETRY_ISOTROPIC};

/* Simpson's rule with 20000 intervals over P1 (20)-(23), written down anew. */
static void test_values(void)
{
    static const double shear[][2] = {{0.5817287476093925, 0.9623767435313227},
                                      {0.45225436681434567, 0.7758967485746995},
                                      {0.39972578016561766, 0.701918078147933}};
    g_assert_cmpfloat_with_epsilon(gb_theory_hardening_phi(0.5), 0.3149802624737183,
                                   1e-15);
    g_assert_cmpfloat_with_epsilon(gb_theory_hardening_psi(0.5), 0.26248355206143187,
                                   1e-15);
    for (size_t i = 0; i < G_N_ELEMENTS(geometries); i++) {
        g_assert_cmpfloat_with_epsilon(
            gb_theory_hardening_shear(geometries[i], 0.24, 0.5), shear[i][0], 1e-11);
        g_assert_cmpfloat_with_epsilon(
            gb_theory_hardening_shear(geometries[i], 0.24, 0.7), shear[i][1], 1e-11);
    }
}

/* The curve of a known law: tau_0 = 100 (1 + 2 gamma_0) Pa. */
static void known_curve(int geometry, double *density, double *pressure)
{
    for (int i = 0; i < POINTS; i++) {
        density[i] = 0.24 + 0.46 * i / (POINTS - 1);
        const double shear = gb_theory_hardening_shear(geometry, 0.24, density[i]);
        pressure[i] = gb_theory_hardening_resistance(geometry, density[i]) *
                      sqrt(density[i]) * 100.0 * (1.0 + 2.0 * shear);
    }
}

/* The curve of any geometry gives the law back, and the law predicts the other curves. */
static void test_law(void)
{
    static const double want[] = {105.15275826068579, 75.5804791811202,
                                  65.18928380562176};
    for (size_t from = 0; from < G_N_ELEMENTS(geometries); from++) {
        double density[POINTS], pressure[POINTS];
        struct gb_hardening law;
        known_curve(geometries[from], density, pressure);
        g_assert_true(gb_theory_hardening_init(&law, geometries[from], density, pressure,
                                               POINTS, NULL));
        for (size_t to = 0; to < G_N_ELEMENTS(geometries); to++) {
            g_assert_cmpfloat_with_epsilon(
                gb_theory_hardening_pressure(&law, geometries[to], 0.5), want[to], 1e-8);
        }
        for (int i = 0; i < POINTS; i++) {
            g_assert_cmpfloat_with_epsilon(
                gb_theory_hardening_pressure(&law, geometries[from], density[i]),
                pressure[i], 1e-7);
        }
        g_assert_cmpfloat_with_epsilon(
            gb_theory_hardening_density_max(&law, geometries[from]), 0.7, 1e-9);
        gb_theory_hardening_finish(&law);
    }
}

/* The law ends where the uniaxial curve ends: to a higher density where less
 * shear belongs to it. */
static void test_ends(void)
{
    double density[POINTS], pressure[POINTS];
    struct gb_hardening law;
    known_curve(GB_GEOMETRY_UNIAXIAL, density, pressure);
    pressure[0] = pressure[1] = -1.0; /* tensile: a loose packing */
    g_assert_true(gb_theory_hardening_init(&law, GB_GEOMETRY_UNIAXIAL, density, pressure,
                                           POINTS, NULL));
    g_assert_cmpuint(law.count, ==, POINTS - 2);
    g_assert_true(
        isnan(gb_theory_hardening_pressure(&law, GB_GEOMETRY_UNIAXIAL, density[1])));
    g_assert_true(isnan(gb_theory_hardening_pressure(&law, GB_GEOMETRY_UNIAXIAL, 0.701)));
    g_assert_true(isnan(gb_theory_hardening_pressure(&law, GB_GEOMETRY_ISOTROPIC, 0.2)));
    g_assert_true(isnan(gb_theory_hardening_pressure(&law, GB_GEOMETRY_ISOTROPIC, 1.0)));
    const double end = gb_theory_hardening_density_max(&law, GB_GEOMETRY_ISOTROPIC);
    g_assert_cmpfloat(end, >, 0.75);
    g_assert_cmpfloat(end, <, 1.0);
    g_assert_cmpfloat_with_epsilon(
        gb_theory_hardening_shear(GB_GEOMETRY_ISOTROPIC, 0.24, end),
        gb_theory_hardening_shear(GB_GEOMETRY_UNIAXIAL, 0.24, 0.7), 1e-9);
    gb_theory_hardening_finish(&law);
}

static void test_refuse(void)
{
    static const double falls[] = {0.3, 0.4, 0.4};
    static const double dense[] = {0.3, 0.4, 1.0};
    static const double good[] = {0.3, 0.4, 0.5};
    static const double pressure[] = {1.0, 2.0, 3.0};
    static const double pulls[] = {-1.0, 0.0, 3.0};
    struct gb_error err = {0};
    struct gb_hardening law;
    g_assert_false(gb_theory_hardening_init(&law, 0, falls, pressure, 3, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_false(gb_theory_hardening_init(&law, 0, dense, pressure, 3, &err));
    g_assert_false(gb_theory_hardening_init(&law, 0, good, pulls, 3, &err));
    g_assert_false(gb_theory_hardening_init(&law, 0, good, pressure, 0, &err));
    g_assert_true(gb_theory_hardening_init(&law, 0, good, pressure, 3, &err));
    gb_theory_hardening_finish(&law);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/hardening/values", test_values);
    g_test_add_func("/hardening/law", test_law);
    g_test_add_func("/hardening/ends", test_ends);
    g_test_add_func("/hardening/refuse", test_refuse);
    return g_test_run();
}
