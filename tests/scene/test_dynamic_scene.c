#include <math.h>
#include <string.h>

#include <glib.h>

#include "law/law_viscous.h"
#include "scene/derived.h"
#include "scene/model.h"

/* P2's scene at v1, by the keys a preset would set. */
static struct gb_params p2_params(void)
{
    static const char *const sets[] = {
        "scene.kind=dynamic",         "scene.dimension=2",
        "particles.count=1000",       "contact.mu=0.5",
        "loading.geometry=isotropic", "loading.until=density=0.95",
        "loading.rate=6.8e8 1/s"};
    struct gb_params params;
    gb_params_init(&params);
    for (size_t i = 0; i < G_N_ELEMENTS(sets); i++) {
        g_assert_true(gb_params_assign(&params, sets[i], NULL));
    }
    return params;
}

static void assert_near(double got, double want, double relative)
{
    g_assert_cmpfloat_with_epsilon(got, want, relative * fabs(want));
}

static void test_defaults(void)
{
    struct gb_params p;
    gb_params_init(&p);
    g_assert_cmpint(p.kind, ==, GB_KIND_QUASISTATIC);
    g_assert_cmpfloat(p.viscosity_pa_s, ==, 1e-3);
    g_assert_cmpfloat(p.rate_per_s, ==, 6.8e8);
    g_assert_cmpfloat(p.relax_s, ==, 1e-8);
    g_assert_cmpfloat(p.hold_s, ==, 3e-8);
    g_assert_cmpfloat(p.record_density, ==, 1e-3);
    g_assert_cmpfloat(p.record_time_s, ==, 2e-11);
    g_assert_cmpfloat(p.step_error, ==, 1e-3);
    g_assert_true(isnan(p.time_step.value) && isnan(gb_derived_time_step_s(&p)));
}

/* The time step is a multiple of T, which follows the material, or a time. */
static void test_time_step(void)
{
    struct gb_params p = p2_params();
    g_assert_true(gb_params_assign(&p, "numerics.time_step=0.04 T", NULL));
    assert_near(gb_derived_time_step_s(&p), 0.04 * gb_derived_unit_time_s(&p), 1e-14);
    assert_near(gb_derived_time_step_s(&p), 29.581e-15, 1e-3);
    p.diameter_m *= 2.0;
    assert_near(gb_derived_time_step_s(&p), 59.162e-15, 1e-3);
    g_assert_true(gb_params_assign(&p, "numerics.time_step=0.03 ps", NULL));
    assert_near(gb_derived_time_step_s(&p), 3e-14, 1e-14);
}

/* P2 section 2: T = 0.74 ps; A = 6.54e-15 s by the formula under (3). */
static void test_numbers(void)
{
    const struct gb_params p = p2_params();
    assert_near(gb_derived_unit_time_s(&p), 0.73953e-12, 1e-4);
    assert_near(gb_law_viscous_time(1e-3, 382e9, 0.25), 6.5445e-15, 1e-4);
    g_assert_cmpfloat(gb_law_viscous_time(0.0, 382e9, 0.25), ==, 0.0);
    g_assert_cmpfloat(gb_law_viscous_time(0.0, 382e9, 0.0), ==, 0.0);
    g_assert_true(isinf(gb_law_viscous_time(1e-3, 382e9, 0.0)));
}

static void test_model(void)
{
    struct gb_params p = p2_params();
    struct gb_model model;
    g_assert_true(gb_params_check(&p, NULL) && gb_model_init(&model, &p, NULL));
    const struct gb_dynamics *dynamics = &model.dynamics;
    const double unit = gb_derived_unit_time_s(&p);
    g_assert_cmpint(model.kind, ==, GB_KIND_DYNAMIC);
    g_assert_cmpfloat(dynamics->second_per_time, ==, unit);
    /* the unit of time is that of the reduced mass, length and stress */
    const double mass = G_PI / 6.0 * p.density_kg_m3 * pow(p.diameter_m, 3);
    assert_near(unit, sqrt(mass / (p.young_pa * p.diameter_m)), 1e-13);
    assert_near(dynamics->viscous, 6.5445e-15 / 0.73953e-12, 2e-4);
    /* P2: 1e-5 of both sides in a step of 0.04 T is 6.8e8 1/s, in two digits */
    assert_near(dynamics->rate * 0.04, 2e-5, 0.01);
    assert_near(dynamics->relax * unit, 1e-8, 1e-13);
    assert_near(dynamics->hold * unit, 3e-8, 1e-13);
    assert_near(dynamics->record_time * unit, 2e-11, 1e-13);
    g_assert_cmpfloat(dynamics->record_density, ==, 1e-3);
    g_assert_cmpfloat(dynamics->step_error, ==, 1e-3);
    g_assert_cmpfloat(dynamics->time_step, ==, 0.0);
    g_assert_cmpfloat(dynamics->inertia, ==, 0.1);
    g_assert_cmpfloat(model.until_density, ==, 0.95);
    p.time_step = (struct gb_relative){0.04, true};
    g_assert_true(gb_model_init(&model, &p, NULL));
    assert_near(model.dynamics.time_step, 0.04, 1e-14);
}

/* Quasi-static scenes do not look at the keys of dynamic ones. */
static void test_ignored(void)
{
    struct gb_params p;
    struct gb_model model;
    const struct gb_dynamics none = {0};
    gb_params_init(&p);
    p.poisson = 0.0;
    g_assert_true(gb_params_check(&p, NULL) && gb_model_init(&model, &p, NULL));
    g_assert_true(memcmp(&model.dynamics, &none, sizeof none) == 0);
}

struct refusal {
    const char *set;
    const char *said[3];
};

static const struct refusal refusals[] = {
    {"loading.until=1 GPa",
     {"loading.until = 1 GPa", "structure.density = 0.5", "scene.kind = dynamic"}},
    {"loading.until=density=0.5", {"loading.until", "structure.density", "0.5"}},
    {"loading.unload_from=100 MPa",
     {"loading.unload_from = 100 MPa", "must be empty", "scene.kind = dynamic"}},
    {"loading.geometry=biaxial", {"loading.geometry = biaxial", "", "scene.dimension"}},
    {"numerics.time_step=0 fs", {"numerics.time_step", "between 1e-6 T and 10 T", ""}},
    {"numerics.time_step=1 ns", {"numerics.time_step", "between 1e-6 T and 10 T", ""}},
    {"material.poisson=0", {"material.poisson = 0", "contact.viscosity", "dynamic"}},
};

static void test_refusals(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(refusals); i++) {
        struct gb_params p = p2_params();
        struct gb_error err = {0};
        g_test_message("%s", refusals[i].set);
        g_assert_true(gb_params_assign(&p, refusals[i].set, &err));
        g_assert_false(gb_params_check(&p, &err));
        g_test_message("%s", err.text);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        for (size_t k = 0; k < G_N_ELEMENTS(refusals[i].said); k++) {
            g_assert_nonnull(strstr(err.text, refusals[i].said[k]));
        }
    }
}

static void test_accepted(void)
{
    static const char *const sets[] = {"contact.viscosity=0 Pa s",
                                       "loading.relax=0 s",
                                       "loading.hold=0 s",
                                       "numerics.time_step=0.03 ps",
                                       "loading.rate=6.8e4 1/s",
                                       "loading.geometry=uniaxial",
                                       "particles.distribution=lognormal"};
    struct gb_params p = p2_params();
    g_assert_true(gb_params_check(&p, NULL));
    for (size_t i = 0; i < G_N_ELEMENTS(sets); i++) {
        g_assert_true(gb_params_assign(&p, sets[i], NULL));
        g_assert_true(gb_params_check(&p, NULL));
    }
    p.dimension = 3;
    for (int geometry = 0; geometry <= GB_GEOMETRY_ISOTROPIC; geometry++) {
        p.geometry = geometry;
        g_assert_true(gb_params_check(&p, NULL));
    }
}

static char *all_notes(const struct gb_params *params)
{
    struct gb_model model;
    char note[256];
    GString *all = g_string_new(NULL);
    g_assert_true(gb_model_init(&model, params, NULL));
    for (int k = 0; gb_model_note(&model, k, note, sizeof note); k++) {
        g_string_append_printf(all, "%s\n", note);
    }
    return g_string_free(all, FALSE);
}

static void notes_say(const struct gb_params *params, const char *said, bool expected)
{
    char *notes = all_notes(params);
    g_test_message("%s", notes);
    g_assert_true((strstr(notes, said) != NULL) == expected);
    g_free(notes);
}

static void test_notes(void)
{
    struct gb_params p = p2_params();
    notes_say(&p, "time step chosen for an error up to 0.1 % (T = 739.5 fs)", true);
    notes_say(&p, "viscous forces: carried, A = 6.545 fs", true);
    notes_say(&p, "relax 10 ns, compress at 680 1/us to density 0.95, hold 30 ns", true);
    notes_say(&p, "third dimension", true);
    notes_say(&p, "relaxer", false);
    p.time_step = (struct gb_relative){0.04, true};
    p.viscosity_pa_s = 0.0;
    p.dimension = 3;
    notes_say(&p, "time step 0.04 T = 29.58 fs", true);
    notes_say(&p, "viscous forces: left out", true);
    notes_say(&p, "hold 30 ns", true);
    p.kind = GB_KIND_QUASISTATIC;
    notes_say(&p, "relaxer", true);
    notes_say(&p, "viscous", false);
}

/* High columns are told to be out of equilibrium, with what to do. */
static void test_columns(void)
{
    struct gb_params p;
    gb_params_init(&p);
    g_assert_true(gb_params_assign(&p, "structure.base=18 d", NULL));
    p.count = 8000;
    notes_say(&p, "equilibrium", false);
    p.count = 40000;
    notes_say(&p, "d high and 18 d wide", true);
    notes_say(&p, "or numerics.tolerance = 0.00", true);
    p.tolerance = 0.007;
    notes_say(&p, "equilibrium", false);
    p.tolerance = NAN;
    g_assert_true(gb_params_assign(&p, "structure.base=auto", NULL));
    notes_say(&p, "equilibrium", false);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/dynamics/defaults", test_defaults);
    g_test_add_func("/dynamics/time-step", test_time_step);
    g_test_add_func("/dynamics/numbers", test_numbers);
    g_test_add_func("/dynamics/model", test_model);
    g_test_add_func("/dynamics/ignored", test_ignored);
    g_test_add_func("/dynamics/refusals", test_refusals);
    g_test_add_func("/dynamics/accepted", test_accepted);
    g_test_add_func("/dynamics/notes", test_notes);
    g_test_add_func("/quasistatic/columns", test_columns);
    return g_test_run();
}
