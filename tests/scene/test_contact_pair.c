/* Two bodies frozen from the keys of a preset. */
#include <math.h>

#include <glib.h>

#include "common/exact.h"
#include "scene/contact_pair.h"

/* NiAl spheres of 20 um with the keys given, which end with NULL. */
static bool make(struct gb_contact_pair *pair, const char *const *keys,
                 struct gb_error *err)
{
    static const char *const nial[] = {"material.young=180 GPa", "material.poisson=0.3",
                                       "material.density=5910 kg/m3",
                                       "particles.diameter=20 um", NULL};
    struct gb_params params;
    gb_params_init(&params);
    for (int i = 0; nial[i]; i++) {
        g_assert_true(gb_params_assign(&params, nial[i], NULL));
    }
    for (int i = 0; keys[i]; i++) {
        g_assert_true(gb_params_assign(&params, keys[i], NULL));
    }
    return gb_contact_pair_init(pair, &params, err);
}

static struct gb_contact_pair pair_of(const char *const *keys)
{
    struct gb_contact_pair pair = {0};
    g_assert_true(make(&pair, keys, NULL));
    return pair;
}

static const double mass = 4.0 / 3.0 * G_PI * 1e-15 * 5910.0; /* of 10 um */

static void test_sizes(void)
{
    const struct gb_contact_pair equal = pair_of((const char *[]){NULL});
    assert_close(equal.radius, 5e-6, 1e-14);
    assert_close(equal.diameter, 20e-6, 1e-14);
    assert_close(equal.mass[0], mass, 1e-13);
    assert_close(equal.mass[1], mass, 1e-13);
    const struct gb_contact_pair small =
        pair_of((const char *[]){"contact.radius_j=2 um", NULL});
    assert_close(small.radius, 1e-5 / 6.0, 1e-14);
    assert_close(small.diameter, 4e-6, 1e-14);
    assert_close(small.mass[1], 0.008 * mass, 1e-13);
    const struct gb_contact_pair wall =
        pair_of((const char *[]){"contact.radius_i=wall", NULL});
    assert_close(wall.radius, 1e-5, 1e-14);
    assert_close(wall.diameter, 20e-6, 1e-14);
    g_assert_true(isinf(wall.mass[0]) && isfinite(wall.mass[1]));
    assert_close(wall.law.hertz.modulus, 180e9 / 1.82, 1e-13); /* as between particles */
}

static void test_materials(void)
{
    const struct gb_contact_pair pair = pair_of(
        (const char *[]){"material.young_j=382 GPa", "material.poisson_j=0.25",
                         "material.density_j=3990 kg/m3", "material.yield_j=2 GPa",
                         "material.hardening=0.2", NULL});
    assert_close(1.0 / pair.law.hertz.modulus, 0.91 / 180e9 + 0.9375 / 382e9, 1e-13);
    const double soft = 800e6 * pow(225.0, 0.2), hard = 2e9 * pow(191.0, 0.2);
    assert_close(pair.law.strength, pow(pow(soft, -5.0) + pow(hard, -5.0), -0.2), 1e-12);
    assert_close(pair.mass[1], mass * 3990.0 / 5910.0, 1e-13);
    g_assert_cmpfloat(pair.yield_pa, ==, 800e6);
    /* a sigma_0 that was typed is that of both, unless the second is another material */
    const struct gb_contact_pair typed = pair_of(
        (const char *[]){"material.hollomon=1375 MPa", "material.hardening=0.1", NULL});
    assert_close(typed.law.strength, 1375e6 * pow(2.0, -0.1), 1e-13);
    const struct gb_contact_pair mixed = pair_of(
        (const char *[]){"material.hollomon=1375 MPa", "material.yield_j=400 MPa", NULL});
    assert_close(mixed.law.strength, 400e6, 1e-13);
    g_assert_cmpfloat(mixed.yield_pa, ==, 400e6);
    g_assert_false(mixed.law.printed);
    g_assert_true(
        pair_of((const char *[]){"contact.storakers=printed", NULL}).law.printed);
}

/* (27): the least over both, that of the lighter body; a wall asks for nothing. */
static void test_step(void)
{
    const char *const sizes[] = {"auto", "2 um", "wall"};
    const double lighter[] = {1.0, 0.008, 1.0};
    for (size_t i = 0; i < G_N_ELEMENTS(sizes); i++) {
        char *key = g_strconcat("contact.radius_j=", sizes[i], NULL);
        const struct gb_contact_pair pair =
            pair_of((const char *[]){key, "contact.damping=0.9", NULL});
        assert_close(gb_contact_pair_critical_step(&pair, 1e5),
                     2.0 * sqrt(lighter[i] * mass / 1e5) * (sqrt(1.81) - 0.9), 1e-12);
        g_free(key);
    }
}

static void test_refused(void)
{
    static const struct {
        const char *keys[3];
        const char *said;
    } rows[] = {
        {{"contact.radius_i=wall", "contact.radius_j=wall", NULL}, "contact.radius_i"},
        {{"material.yield=181 GPa", NULL}, "at most material.young = 180 GPa"},
        {{"material.yield_j=181 GPa", NULL}, "material.yield_j = 181 GPa"},
        {{"material.young_j=700 MPa", NULL}, "at most material.young_j = 700 MPa"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        struct gb_contact_pair pair;
        struct gb_error err = {0};
        g_assert_false(make(&pair, rows[i].keys, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_test_message("%s", err.text);
        g_assert_nonnull(strstr(err.text, rows[i].said));
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/contact-pair/sizes", test_sizes);
    g_test_add_func("/contact-pair/materials", test_materials);
    g_test_add_func("/contact-pair/step", test_step);
    g_test_add_func("/contact-pair/refused", test_refused);
    return g_test_run();
}
