/* The grammar of loading.path: what each leg means, and what is refused with which line. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "greenbody/params.h"
#include "scene/path/path.h"

static struct gb_path parse(const char *text, int dimension)
{
    struct gb_path path;
    struct gb_error err = {0};
    if (!gb_path_parse(&path, text, dimension, &err)) {
        g_error("%s: %s", text, err.text);
    }
    return path;
}

static void check_strain(const struct gb_leg *leg, int k, double value)
{
    g_assert_cmpint(leg->component[k].control, ==, GB_LEG_STRAIN);
    g_assert_cmpfloat(leg->component[k].value, ==, value);
}

static void check_control(const struct gb_leg *leg, int k, enum gb_leg_control control,
                          double value)
{
    g_assert_cmpint(leg->component[k].control, ==, control);
    if (isnan(value)) {
        g_assert_true(isnan(leg->component[k].value));
    } else {
        g_assert_cmpfloat_with_epsilon(leg->component[k].value, value,
                                       1e-12 * fabs(value) + 1e-15);
    }
}

static void check_end(const struct gb_leg *leg, int e, enum gb_leg_end_kind kind,
                      double value)
{
    g_assert_cmpint(e, <, leg->end_count);
    g_assert_cmpint(leg->end[e].kind, ==, kind);
    g_assert_cmpfloat_with_epsilon(leg->end[e].value, value, 1e-12 * fabs(value) + 1e-15);
}

/* The line of the specification. */
static void test_example(void)
{
    const struct gb_path path =
        parse("isotropic to 50 MPa; shear xz to 20 % at z = 50 MPa; unload", 3);
    g_assert_cmpint(path.count, ==, 3);
    for (int k = 0; k < 3; k++) {
        check_strain(&path.leg[0], k, 1.0);
        check_strain(&path.leg[0], k + 3, 0.0);
    }
    check_end(&path.leg[0], 0, GB_LEG_END_PRESSURE, 50e6);
    g_assert_cmpint(path.leg[1].leading, ==, 4);
    check_strain(&path.leg[1], 0, 0.0);
    check_control(&path.leg[1], 2, GB_LEG_STRESS, 50e6);
    check_end(&path.leg[1], 0, GB_LEG_END_STRAIN, 0.2);
    g_assert_cmpint(path.leg[2].leading, ==, 2);
    check_strain(&path.leg[2], 4, 0.0);
    check_end(&path.leg[2], 0, GB_LEG_END_PRESSURE, 0.0);
    g_assert_true(gb_path_sheared(&path));
    g_assert_cmpint(gb_path_geometry(&path, 3), ==, GB_GEOMETRY_ISOTROPIC);
    g_assert_cmpstr(path.leg[1].text, ==, "shear xz to 20 % at z = 50 MPa");
}

static void test_shorthands(void)
{
    const struct gb_path path = parse(
        "uniaxial to 100MPa then biaxial to density = 0.4 then triaxial to q/p=0.8 "
        "at 20 MPa then triaxial x extension to 5 % or x = -3 MPa then radial 0.5 "
        "to z = 80 MPa then radial to p = 90 MPa then hold 3 times then hold x = y = "
        "10 MPa, z = 0.5 x; cycle 5 times shear xy between -1 % and 1 %;",
        3);
    g_assert_cmpint(path.count, ==, 9);
    g_assert_cmpint(gb_path_geometry(&path, 3), ==, GB_GEOMETRY_UNIAXIAL);
    check_strain(&path.leg[0], 2, 1.0);
    check_strain(&path.leg[0], 1, 0.0);
    check_strain(&path.leg[1], 1, 1.0);
    check_end(&path.leg[1], 0, GB_LEG_END_DENSITY, 0.4);
    check_control(&path.leg[2], 0, GB_LEG_STRESS, 20e6);
    check_control(&path.leg[2], 1, GB_LEG_STRESS, 20e6);
    check_end(&path.leg[2], 0, GB_LEG_END_RATIO, 0.8);
    g_assert_cmpint(path.leg[3].leading, ==, 0);
    g_assert_true(path.leg[3].extension);
    check_control(&path.leg[3], 2, GB_LEG_STRESS, (double)NAN);
    check_end(&path.leg[3], 1, GB_LEG_END_STRESS, -3e6);
    check_control(&path.leg[4], 0, GB_LEG_RATIO, 0.5);
    g_assert_cmpint(path.leg[4].component[0].of, ==, 2);
    check_control(&path.leg[5], 1, GB_LEG_RATIO, (double)NAN);
    check_end(&path.leg[5], 0, GB_LEG_END_MEAN, 90e6);
    g_assert_cmpint(path.leg[6].leading, ==, -1);
    check_end(&path.leg[6], 0, GB_LEG_END_STEPS, 3.0);
    check_control(&path.leg[7], 2, GB_LEG_RATIO, 0.5);
    g_assert_cmpint(path.leg[8].cycles, ==, 5);
    check_end(&path.leg[8], 0, GB_LEG_END_STRAIN, -0.01);
    check_end(&path.leg[8], 1, GB_LEG_END_STRAIN, 0.01);
}

/* Any strains in proportion; stresses that follow another one. */
static void test_general(void)
{
    const struct gb_path path =
        parse("strain z = 2, xz = -1 to 3 % at x = held, y by -0.25 z", 3);
    const struct gb_leg *leg = &path.leg[0];
    g_assert_cmpint(leg->leading, ==, 2);
    check_strain(leg, 2, 1.0);
    check_strain(leg, 4, -0.5);
    check_control(leg, 0, GB_LEG_STRESS, (double)NAN);
    check_control(leg, 1, GB_LEG_FOLLOW, -0.25);
    g_assert_cmpint(leg->component[1].of, ==, 2);
}

/* What was moved is moved back, what was held falls in proportion, walls stay. */
static void test_unload(void)
{
    const struct gb_path uniaxial = parse("uniaxial to 100 MPa; unload", 3);
    check_strain(&uniaxial.leg[1], 0, 0.0);
    check_strain(&uniaxial.leg[1], 2, 1.0);
    const struct gb_path triaxial =
        parse("triaxial to 100 MPa at 20 MPa; hold; unload to 5 MPa", 3);
    g_assert_cmpint(triaxial.leg[2].leading, ==, 2);
    check_control(&triaxial.leg[2], 0, GB_LEG_RATIO, (double)NAN);
    g_assert_cmpint(triaxial.leg[2].component[0].of, ==, 2);
    check_end(&triaxial.leg[2], 0, GB_LEG_END_PRESSURE, 5e6);
    const struct gb_path mixed = parse("strain z = 1, x = 0.5 to 4 %; unload", 3);
    check_strain(&mixed.leg[1], 0, 0.5);
}

static void test_plane(void)
{
    const struct gb_path path = parse("isotropic to 10 MPa; shear xz to 5 %", 2);
    check_strain(&path.leg[0], 1, 0.0);
    check_strain(&path.leg[0], 0, 1.0);
    g_assert_cmpint(gb_path_geometry(&path, 2), ==, GB_GEOMETRY_ISOTROPIC);
    g_assert_false(gb_path_has_component(2, 3));
}

static void test_refused(void)
{
    static const struct {
        const char *text, *says;
        int dimension;
    } cases[] = {
        {"squeeze to 5 MPa", "leg 1 'squeeze to 5 MPa': 'squeeze': must be uniaxial", 3},
        {"uniaxial", "ends too early: must continue with 'to'", 3},
        {"uniaxial to 5", "", 3},
        {"uniaxial to 50 MPa; shear to 5 %", "leg 2", 3},
        {"shear z to 5 %", "'z': must be xy, xz or yz", 3},
        {"shear xy to 5 %", "x, z or xz with scene.dimension = 2", 2},
        {"biaxial to 5 MPa", "uniaxial or isotropic", 2},
        {"uniaxial to 5 nm", "must be", 3},
        {"uniaxial to density 1.5", "must be between 0 and 1", 3},
        {"triaxial to 5 % at z = 5 MPa", "it leads the leg", 3},
        {"triaxial to 5 % at x = 0.5 x", "fraction of itself", 3},
        {"triaxial to 5 % at x 5 MPa", "'=' or 'by'", 3},
        {"unload", "must follow a leg", 3},
        {"cycle 2 times hold between 1 MPa and 2 MPa", "must be of a leg that moves", 3},
        {"cycle 2.5 times shear xz between 0 % and 1 %", "whole number", 3},
        {"cycle 2 times shear xz between 1 % and 1 %", "two different values", 3},
        {"cycle 2 times shear xz between 1 % and 1 MPa", "two different values", 3},
        {"uniaxial to 5 MPa please", "'please': must be the end of the leg", 3},
        {"uniaxial to 1 TPa", "'1 TPa': its unit must be one of Pa, kPa", 3},
        {"uniaxial to 5 kg", "'5 kg': its unit must be", 3},
        {"uniaxial to density 0.4 MPa", "'0.4 MPa': its unit must be", 3},
        {"hold 0 times", "whole number", 3},
        {"uniaxial to 1 MPa or 2 MPa or 3 MPa", "at most 2 ends", 3},
        {"strain z = 0 to 3 %", "must not be 0", 3},
        {"uniaxial to 5 MPa; ; unload", "leg 2", 3},
        {"strain z = 1, z = 0.5 to 3 %", "'z': must be given once", 3},
        {"strain z = 1, x = 0.5 to 3 % at x = 5 MPa", "'x': must be given once", 3},
        {"triaxial to 5 % at x = 5 MPa, x = 6 MPa", "'x': must be given once", 3},
        {"triaxial to 5 % at x = x = 5 MPa", "'x': must be given once", 3},
        {"hold z = 5 MPa and z = 6 MPa", "'z': must be given once", 3},
        {"shear xz to 5 % at z = 5 MPa, z by 0.5 x", "'z': must be given once", 3},
        {"triaxial at 5 MPa to 5 % at 6 MPa", "'at': must be given once", 3},
        {"triaxial to 5 % at x = 5 MPa at y = 5 MPa", "'at': must be the end", 3},
        {"hold at z = 5 MPa 3 times at x = 5 MPa", "'at': must be given once", 3},
        {"triaxial to 5 % at x = y = 0 z", "'0': a fraction must not be 0", 3},
        {"triaxial to 5 % at x = y by 0 z", "'0': a fraction must not be 0", 3},
        {"radial 0 to 5 MPa", "'radial 0': a fraction must not be 0", 3},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        struct gb_path path;
        struct gb_error err = {0};
        const bool good = gb_path_parse(&path, cases[i].text, cases[i].dimension, &err);
        if (cases[i].says[0] == '\0') { /* a bare number is a strain: 500 % */
            g_assert_true(good);
            continue;
        }
        g_assert_false(good);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (strstr(err.text, cases[i].says) == NULL) {
            g_error("%s: %s", cases[i].text, err.text);
        }
    }
}

/* More legs and more words than there is room for. */
static void test_long(void)
{
    GString *text = g_string_new(NULL);
    struct gb_path path;
    struct gb_error err = {0};
    for (int i = 0; i <= GB_PATH_LEGS_MAX; i++) {
        g_string_append(text, "uniaxial to 1 MPa;");
    }
    g_assert_false(gb_path_parse(&path, text->str, 3, &err));
    g_assert_nonnull(strstr(err.text, "at most 24 legs"));
    g_string_assign(text, "strain");
    for (int i = 0; i < 60; i++) {
        g_string_append(text, " z = 1,");
    }
    g_assert_false(gb_path_parse(&path, text->str, 3, &err));
    g_assert_nonnull(strstr(err.text, "at most"));
    g_string_free(text, TRUE);
}

/* Every shorthand has a usage and a doc line, and its usage names it first. */
static void test_table(void)
{
    const char *usage = NULL, *doc = NULL;
    int count = 0;
    while (gb_path_parse_shorthand(count, &usage, &doc)) {
        g_assert_cmpuint(strlen(usage), >, 0);
        g_assert_cmpuint(strlen(doc), >, 0);
        count++;
    }
    g_assert_cmpint(count, ==, 10);
}

/* The page has the usage and the sentence of every shorthand, word by word. */
static void test_page(void)
{
    char *page = NULL;
    const char *usage, *doc;
    g_assert_true(
        g_file_get_contents(GB_TEST_DIR "/../../docs/mechanics.md", &page, NULL, NULL));
    for (int i = 0; gb_path_parse_shorthand(i, &usage, &doc); i++) {
        char *entry = g_strdup_printf("\n%s\n    %s\n", usage, doc);
        if (strstr(page, entry) == NULL) {
            g_error("docs/mechanics.md lacks:%s", entry);
        }
        g_free(entry);
    }
    g_free(page);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/path/example", test_example);
    g_test_add_func("/path/shorthands", test_shorthands);
    g_test_add_func("/path/page", test_page);
    g_test_add_func("/path/general", test_general);
    g_test_add_func("/path/unload", test_unload);
    g_test_add_func("/path/plane", test_plane);
    g_test_add_func("/path/refused", test_refused);
    g_test_add_func("/path/long", test_long);
    g_test_add_func("/path/table", test_table);
    return g_test_run();
}
