#include "greenbody/params.h"
#include "scene/derived.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

/* Every row reads its own fallback, writes it back and has all that help needs. */
static void test_table(void)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    struct gb_params params;
    gb_params_init(&params);
    g_assert_cmpuint(count, >=, 30);
    for (size_t i = 0; i < count; i++) {
        const struct gb_field *field = &fields[i];
        char text[256], accepted[256];
        g_test_message("%s.%s", field->group, field->key);
        g_assert_true(gb_params_find(field->group, field->key) == field);
        g_assert_cmpstr(gb_params_format(&params, field, text, sizeof text), ==,
                        field->fallback);
        g_assert_cmpuint(strlen(gb_params_accepted(field, accepted, sizeof accepted)), >,
                         0);
        g_assert_nonnull(field->meaning);
        g_assert_nonnull(field->source);
        g_assert_true(gb_params_set(&params, field, text, NULL));
    }
    g_assert_true(gb_params_check(&params, NULL));
}

static void test_defaults(void)
{
    struct gb_params p;
    gb_params_init(&p);
    g_assert_cmpfloat(p.young_pa, ==, 382e9);
    g_assert_cmpfloat(p.d0_m, ==, 0.392e-9);
    g_assert_cmpfloat(p.diameter_m, ==, 1e-8);
    g_assert_cmpfloat(p.n_d0_cubed, ==, sqrt(2.0));
    g_assert_cmpint(p.count, ==, 8000);
    g_assert_cmpint(p.dimension, ==, 3);
    g_assert_true(isnan(p.mu_pivot) && isnan(p.tolerance) && isnan(p.structure_density));
    g_assert_true(p.base.relative && p.base.value == 0.0);
    g_assert_true(isnan(p.cutoff.value) && p.threads < 0 && p.max_evaluations < 0);
    g_assert_cmpfloat(p.until_pressure_pa, ==, 1e9);
    g_assert_true(isnan(p.until_density) && p.unload_count == 0);
    g_assert_cmpfloat(gb_derived_bridge_length_m(&p), ==, 0.008 * 1e-8);
    g_assert_cmpfloat(gb_derived_shear_strength_pa(&p), ==, 0.018 * 382e9);
    g_assert_cmpfloat(gb_derived_structure_density(&p), ==, 0.24);
}

/* sigma_b left open: set II's with bridges, no limit without; a given one always counts.
 */
static void test_shear_strength(void)
{
    struct gb_params p;
    struct gb_error err = {0};
    gb_params_init(&p);
    g_assert_cmpfloat(gb_derived_shear_strength_pa(&p), ==, 0.018 * 382e9);
    g_assert_true(gb_params_assign(&p, "contact.bridge_length=1 d", &err));
    g_assert_cmpfloat(gb_derived_shear_strength_pa(&p), ==, 382e9);
    g_assert_true(gb_params_assign(&p, "contact.shear_strength=2 GPa", &err));
    g_assert_cmpfloat_with_epsilon(gb_derived_shear_strength_pa(&p), 2e9, 1.0);
}

/* sigma_0 left open goes through the yield point; "wall" is an infinite radius. */
static void test_pair(void)
{
    struct gb_params p;
    gb_params_init(&p);
    g_assert_true(gb_params_assign(&p, "material.young=180 GPa", NULL));
    g_assert_cmpfloat(gb_derived_hollomon_pa(&p), ==, 800e6);
    g_assert_true(gb_params_assign(&p, "material.hardening=0.2", NULL));
    g_assert_cmpfloat_with_epsilon(gb_derived_hollomon_pa(&p), 2363e6, 0.5e6);
    g_assert_true(gb_params_assign(&p, "material.hollomon=2 GPa", NULL));
    g_assert_cmpfloat(gb_derived_hollomon_pa(&p), ==, 2e9);
    char text[64];
    const struct gb_field *radius = gb_params_find("contact", "radius_j");
    g_assert_true(isnan(p.radius_j_m));
    g_assert_true(gb_params_assign(&p, "contact.radius_j = wall", NULL));
    g_assert_true(isinf(p.radius_j_m));
    g_assert_cmpstr(gb_params_format(&p, radius, text, sizeof text), ==, "wall");
    g_assert_true(gb_params_set(&p, radius, "2um", NULL));
    g_assert_cmpfloat(p.radius_j_m, ==, 2e-6);
}

static void test_assign(void)
{
    struct gb_params p;
    gb_params_init(&p);
    g_assert_true(gb_params_assign(&p, "particles.diameter=9.7nm", NULL));
    g_assert_cmpfloat(p.diameter_m, ==, 9.7e-9);
    g_assert_true(gb_params_assign(&p, "contact.bridge_length = 0.1 nm", NULL));
    g_assert_true(!p.bridge_length.relative && p.bridge_length.value == 1e-10);
    g_assert_true(gb_params_assign(&p, "loading.until=density=0.6", NULL));
    g_assert_true(p.until_density == 0.6 && isnan(p.until_pressure_pa));
    g_assert_true(gb_params_assign(&p, "loading.until = 500 MPa", NULL));
    g_assert_true(p.until_pressure_pa == 5e8 && isnan(p.until_density));
    g_assert_true(
        gb_params_assign(&p, "loading.unload_from=200 MPa;100MPa; 150 MPa;", NULL));
    g_assert_cmpint(p.unload_count, ==, 3);
    g_assert_true(p.unload_from_pa[0] == 1e8 && p.unload_from_pa[2] == 2e8);
    g_assert_true(gb_params_assign(&p, "loading.unload_from=", NULL));
    g_assert_cmpint(p.unload_count, ==, 0);
    g_assert_true(gb_params_assign(&p, "scene.dimension=2", NULL));
    g_assert_cmpint(p.dimension, ==, 2);
    g_assert_true(gb_params_assign(&p, "structure.seed=18446744073709551615", NULL));
    g_assert_true(p.seed == UINT64_MAX);
    g_assert_true(gb_params_assign(&p, "scene.title=a = b", NULL));
    g_assert_cmpstr(p.title, ==, "a = b");
    /* keys of one group alone */
    g_assert_true(gb_params_assign(&p, "mu=0.125", NULL));
    g_assert_true(gb_params_assign(&p, "until=50 MPa", NULL));
    g_assert_true(p.mu == 0.125 && p.until_pressure_pa == 5e7);
}

/* What is refused, and a part of the line that says so. */
static const char *const refused[][2] = {
    {"contact.mu=-1", "contact.mu = -1: must be between 0 and 2"},
    {"contact.mu=2.1", "must be between 0 and 2"},
    {"contact.mu=nan", "must be between 0 and 2"},
    {"contact.mu=0,1", "decimals have a point, thousands no mark: 0.1"},
    {"contact.mu=", "must be between 0 and 2"},
    {"material.poisson=0.5", "must be between 0 and 0.49"},
    {"particles.diameter=10", "units nm"},
    {"particles.diameter=10 MPa", "must be between 1 nm and 1 mm; units nm"},
    {"particles.diameter=0.1 nm", "must be between 1 nm and 1 mm"},
    {"particles.count=9", "must be a whole number between 10 and 10000000"},
    {"particles.count=1000.5", "whole number"},
    {"particles.count=1e30", "whole number"},
    {"particles.distribution=sieve", "must be mono, lognormal or table"},
    {"scene.kind=pile", "must be quasistatic, dynamic or die"},
    {"scene.dimension=4", "must be 3 or 2"},
    {"contact.normal=hook", "must be rod, hertz"},
    {"contact.storakers=rigid", "must be capped or printed"},
    {"contact.radius_j=inf", "must be auto, wall or between 0.1 nm and 10 mm; units nm"},
    {"contact.radius_j=0 nm", "must be auto, wall or between 0.1 nm and 10 mm"},
    {"material.young=wall", "must be between 1 kPa and 10000 GPa"},
    {"material.hardening=1", "must be between 0 and 0.5"},
    {"material.yield=800", "units Pa"},
    {"material.poisson_j=0.5", "must be auto or between 0 and 0.49"},
    {"loading.geometry=cone", "must be uniaxial, biaxial, isotropic or die"},
    {"loading.step=5 %", "between 0.0001 % and 2 %"},
    {"loading.until=density = 1.5", "density = 0.02 to 0.99"},
    {"loading.until=density", "density = 0.02 to 0.99"},
    {"loading.until=0.6", "between 1 kPa and"},
    {"loading.unload_from=100 MPa; 100 MPa", "different pressures"},
    {"loading.unload_from=100", "units Pa"},
    {"loading.unload_from=1MPa;2MPa;3MPa;4MPa;5MPa;6MPa;7MPa;8MPa;9MPa;10MPa;11MPa;12MPa;"
     "13MPa;14MPa;15MPa;16MPa;17MPa",
     "up to 16"},
    {"structure.seed=-1", "whole number between 0 and 18446744073709551615"},
    {"structure.seed=18446744073709551616", "whole number"},
    {"structure.density=0.75", "auto or between 0.01 and 0.74"},
    {"structure.base=2 d", "auto or between 3 d and 10000 d"},
    {"contact.bridge_length=0 d", "at least 0.00001 d"},
    {"contact.bridge_length=0.1 E", "units nm"},
    {"contact.bridge_length=-1 nm", "at least 0.00001 d"},
    {"contact.shear_strength=2 E", "between 0 E and 1 E"},
    {"loading.rate=0 1/s", "loading.rate = 0 1/s: must be between 1 1/s and 1 1/ps"},
    {"loading.rate=1e6", "units 1/s"},
    {"loading.relax=-1 ns", "loading.relax = -1 ns: must be between 0 fs and 1 s"},
    {"loading.record=0", "must be between 0.0001 % and 10 %"},
    {"loading.record_time=0 ns", "must be between 1 fs and 1 s"},
    {"contact.viscosity=-1 Pa s", "must be between 0 mPa s and 1000 Pa s"},
    {"numerics.time_step=0 T", "must be auto or between 1e-6 T and 10 T"},
    {"numerics.time_step=0.04", "units s, ms"},
    {"numerics.time_step=-1 fs", "must be auto or between"},
    {"numerics.step_error=0 %", "must be between 1e-6 % and 50 %"},
    {"numerics.tolerance_scale=force", "must be contact, attraction or displacement"},
    {"numerics.relaxer=magic", "must be auto, predict, fire"},
    {"scene.title=a\tb", "text of at most"},
    {"scene.title=\xff", "text of at most"},
    {"contact.muu=1", "no such key; did you mean contact.mu? must be one of normal, "},
    {"contacts.mu=1",
     "no such group; did you mean contact.mu? must be one of scene, material"},
    {"nu=1", "nu: no such key; did you mean material.poisson? expected group.key, as"},
    {"alhpa=1", "no such key; did you mean contact.alpha? expected group.key"},
    {"particles.coutn=1", "did you mean particles.count? must be one of"},
    {"zzzz=1", "zzzz: no such key; expected group.key, as contact.mu"},
    {"diameter=1 mm", "must be one of particles.diameter, die.diameter"},
    {"contact.mu", "must be group.key=value"},
    {"=", ": no such key; expected group.key"},
    {"", "must be group.key=value"},
};

static void test_refused(void)
{
    struct gb_params p, before;
    gb_params_init(&p);
    before = p;
    for (size_t i = 0; i < G_N_ELEMENTS(refused); i++) {
        struct gb_error err = {0};
        g_test_message("row %zu", i);
        g_assert_false(gb_params_assign(&p, refused[i][0], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_test_message("%s", err.text);
        g_assert_nonnull(strstr(err.text, refused[i][1]));
        g_assert_true(memcmp(&p, &before, sizeof p) == 0); /* untouched */
    }
}

struct check {
    const char *sets[4];
    const char *said[2]; /* NULL: passes */
};

static const struct check checks[] = {
    {{"loading.unload_from=1 GPa"}, {NULL}},
    {{"loading.unload_from=2 GPa"}, {"loading.unload_from = 2 GPa", "loading.until"}},
    {{"loading.unload_from=2 GPa", "loading.until=density=0.6"}, {NULL}},
    {{"loading.until=density=0.2"}, {"loading.until", "structure.density"}},
    {{"scene.dimension=2", "loading.geometry=biaxial"},
     {"loading.geometry", "dimension"}},
    {{"scene.dimension=2", "loading.geometry=isotropic"}, {NULL}},
    {{"scene.dimension=2", "loading.until=density=0.45"}, {"loading.until", "0.5"}},
    {{"particles.count=10", "structure.base=3 d"}, {"particles.count", "structure.base"}},
    {{"particles.count=30"}, {"particles.count", "structure.base"}},
    {{"particles.count=1000", "structure.base=40 d"}, {"particles.count", "along z"}},
    {{"contact.bridge_length=10 um"}, {NULL}}, /* a diameter or more: no bridges */
    {{"contact.shear_strength=400 GPa"},
     {"contact.shear_strength", "between 0 E and 1 E"}},
    {{"structure.base=180 nm"}, {NULL}},
    {{"structure.base=20 nm"}, {"structure.base", "3 d"}},
    {{"numerics.cutoff=3 d", "particles.count=200"}, {"particles.count", "6 d"}},
    {{"contact.normal=hertz"}, {NULL}}, /* dry grains */
    {{"numerics.tolerance_scale=attraction", "numerics.tolerance=0.1"}, {NULL}},
    {{"numerics.tolerance_scale=displacement", "numerics.tolerance=0.01"}, {NULL}},
    {{"numerics.tolerance_scale=attraction"},
     {"numerics.tolerance = auto: must be a number",
      "numerics.tolerance_scale = attraction"}},
    {{"numerics.tolerance_scale=attraction", "numerics.tolerance=0.1",
      "contact.normal=hertz"},
     {"numerics.tolerance_scale = attraction: must be contact", "without attraction"}},
    {{"numerics.tolerance_scale=displacement", "numerics.tolerance=0.1",
      "material.epsilon=0 J"},
     {"numerics.tolerance_scale = displacement: must be contact", "without attraction"}},
    {{"numerics.tolerance_scale=displacement", "numerics.tolerance=0.1",
      "particles.distribution=lognormal"},
     {"must be contact or attraction", "more than one particle size"}},
    {{"numerics.tolerance_scale=attraction", "numerics.tolerance=0.1",
      "particles.distribution=lognormal"},
     {NULL}},
    {{"contact.normal=hertz", "particles.distribution=lognormal"},
     {"contact.normal = hertz: must be rod", "particles.distribution = lognormal"}},
    {{"contact.normal=storakers"},
     {"contact.normal = storakers: must be rod or hertz", "scene.kind = quasistatic"}},
    {{"contact.normal=storakers", "scene.kind=dynamic", "loading.until=density=0.9"},
     {"contact.normal = storakers: must be rod", "scene.kind = dynamic"}},
    {{"contact.radius_j=wall", "material.yield_j=1 GPa"}, {NULL}},
};

static void test_checks(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(checks); i++) {
        struct gb_params p;
        struct gb_error err = {0};
        gb_params_init(&p);
        for (int k = 0; k < 4 && checks[i].sets[k]; k++) {
            g_test_message("%s", checks[i].sets[k]);
            g_assert_true(gb_params_assign(&p, checks[i].sets[k], &err));
        }
        const bool good = gb_params_check(&p, &err);
        g_test_message("%s", err.text);
        g_assert_true(good == (checks[i].said[0] == NULL));
        for (int k = 0; k < 2 && checks[i].said[k]; k++) {
            g_assert_nonnull(strstr(err.text, checks[i].said[k]));
        }
    }
}

/* Programs fill the struct too. */
static void test_check_memory(void)
{
    struct gb_params p;
    gb_params_init(&p);
    p.mu = NAN;
    g_assert_false(gb_params_check(&p, NULL));
    gb_params_init(&p);
    p.diameter_m = INFINITY;
    g_assert_false(gb_params_check(&p, NULL));
    gb_params_init(&p);
    p.radius_i_m = -INFINITY;
    g_assert_false(gb_params_check(&p, NULL));
    gb_params_init(&p);
    p.geometry = 7;
    g_assert_false(gb_params_check(&p, NULL));
    gb_params_init(&p);
    p.unload_count = GB_UNLOAD_MAX + 1;
    g_assert_false(gb_params_check(&p, NULL));
    gb_params_init(&p);
    p.until_density = 0.5;
    g_assert_false(gb_params_check(&p, NULL)); /* two ends */
    gb_params_init(&p);
    memset(p.title, 'x', sizeof p.title); /* no end */
    g_assert_false(gb_params_check(&p, NULL));
}

static void test_cell(void)
{
    struct gb_params p;
    double e[3];
    gb_params_init(&p);
    gb_derived_cell(&p, e);
    g_assert_cmpfloat(e[0], ==, 18.0);
    g_assert_cmpfloat(e[1], ==, 18.0);
    g_assert_cmpfloat_with_epsilon(e[2], 53.868186789948446, 1e-12);
    p.count = 1000;
    gb_derived_cell(&p, e);
    g_assert_cmpfloat_with_epsilon(e[0], 9.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(e[2] / e[0], 53.868186789948446 / 18.0, 1e-12);
    p.base = (struct gb_relative){12.0, true};
    gb_derived_cell(&p, e);
    g_assert_cmpfloat_with_epsilon(e[0] * e[1] * e[2], 1000.0 * G_PI / 6.0 / 0.24, 1e-9);
    p.dimension = 2;
    p.base = (struct gb_relative){0.0, true};
    gb_derived_cell(&p, e);
    g_assert_cmpfloat(e[1], ==, 1.0);
    g_assert_cmpfloat_with_epsilon(e[0], sqrt(1000.0 * G_PI / 4.0 / 0.5), 1e-12);
    g_assert_cmpfloat_with_epsilon(e[2], e[0], 1e-12);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/params/table", test_table);
    g_test_add_func("/params/defaults", test_defaults);
    g_test_add_func("/params/shear-strength", test_shear_strength);
    g_test_add_func("/params/pair", test_pair);
    g_test_add_func("/params/assign", test_assign);
    g_test_add_func("/params/refused", test_refused);
    g_test_add_func("/params/checks", test_checks);
    g_test_add_func("/params/check-memory", test_check_memory);
    g_test_add_func("/params/cell", test_cell);
    return g_test_run();
}
