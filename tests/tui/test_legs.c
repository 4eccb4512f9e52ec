/* The legs under edit, what they say of themselves, and the plan that follows from them. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "tui/app/leg_editor.h"

static void check_text(const struct gb_leg_list *list, const char *expected)
{
    char *text = gb_leg_editor_list_join(list);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
}

/* Every change, and back again. */
static void test_list(void)
{
    struct gb_leg_list list;
    gb_leg_editor_list_init(&list, "isotropic to 50 MPa; unload", 3);
    g_assert_cmpint(gb_leg_editor_list_insert(&list, 1, "shear xz to 20 % then hold"), ==,
                    2);
    check_text(&list, "isotropic to 50 MPa; shear xz to 20 %; hold; unload");
    g_assert_true(gb_leg_editor_list_move(&list, 2, -1));
    g_assert_false(gb_leg_editor_list_move(&list, 0, -1));
    gb_leg_editor_list_remove(&list, 3);
    check_text(&list, "isotropic to 50 MPa; hold; shear xz to 20 %");
    gb_leg_editor_list_replace(&list, 0, "uniaxial to 10 MPa");
    gb_leg_editor_list_set(&list, "unload");
    g_assert_cmpint(list.errors, ==, 1);
    for (int i = 0; i < 4; i++) {
        g_assert_true(gb_leg_editor_list_undo(&list));
    }
    check_text(&list, "isotropic to 50 MPa; shear xz to 20 %; hold; unload");
    g_assert_true(gb_leg_editor_list_undo(&list));
    check_text(&list, "isotropic to 50 MPa; unload");
    g_assert_false(gb_leg_editor_list_undo(&list));
    gb_leg_editor_list_finish(&list);
}

/* The error stands at the leg that has it, without its name; legs behind it are read. */
static void test_errors(void)
{
    struct gb_leg_list list;
    gb_leg_editor_list_init(&list, "isotropic to 50 MPa; sheer xz to 20 %; unload", 3);
    g_assert_cmpint(list.errors, ==, 1);
    g_assert_null(gb_leg_editor_list_leg(&list, 1));
    g_assert_true(g_str_has_prefix(list.error[1].text, "'sheer': must be uniaxial"));
    g_assert_nonnull(gb_leg_editor_list_leg(&list, 2));
    struct gb_leg leg;
    struct gb_error err = {0};
    g_assert_false(gb_leg_editor_list_try(&list, 1, "shear xz to", &leg, &err));
    g_assert_nonnull(strstr(err.text, "an end"));
    g_assert_true(gb_leg_editor_list_try(&list, 1, "shear xz to 20 %", &leg, &err));
    g_assert_cmpint(leg.leading, ==, 4);
    gb_leg_editor_list_finish(&list);
}

static struct gb_path parse(const char *text)
{
    struct gb_path path;
    struct gb_error err = {0};
    if (!gb_path_parse(&path, text, 3, &err)) {
        g_error("%s", err.text);
    }
    return path;
}

static void test_words(void)
{
    const struct gb_path path = parse(
        "isotropic to 50 MPa; shear xz to 20 % or xz = 9 MPa at z = 50 MPa, x = 0.5 z;"
        "cycle 3 times uniaxial between 20 MPa and 100 MPa");
    struct gb_leg_words words;
    gb_leg_editor_words(&path.leg[1], 3, &words);
    g_assert_cmpstr(words.leads, ==, "xz");
    g_assert_cmpstr(words.held, ==, "x = 0.5 z, z at 50 MPa");
    g_assert_cmpstr(words.fixed, ==, "y, xy, yz");
    g_assert_cmpstr(words.ends, ==, "at strain 20 % of xz or at xz = 9 MPa");
    gb_leg_editor_words(&path.leg[2], 3, &words);
    g_assert_cmpstr(
        words.ends, ==,
        "3 times there and back: at pressure = 20 MPa and at pressure = 100 MPa");
}

/* p and q at the end of the last leg; NaN where the packing decides. */
static void test_plan(void)
{
    static const struct {
        const char *path;
        double p, q;
    } cases[] = {
        {"isotropic to 50 MPa", 50.0, 0.0},
        {"isotropic to 50 MPa; unload", 0.0, 0.0},
        {"isotropic to 50 MPa; triaxial to q = 30 MPa", 60.0, 30.0},
        {"isotropic to 50 MPa; triaxial extension to q = 30 MPa", 40.0, 30.0},
        {"isotropic to 50 MPa; triaxial to q/p = 0.6", 62.5, 37.5},
        {"isotropic to 50 MPa; triaxial to z = 80 MPa; unload", 0.0, 0.0},
        {"isotropic to 50 MPa; triaxial to q = 30 MPa at x = y by -0.5 z", 50.0, 30.0},
        {"radial 0.5 to p = 8 MPa", 8.0, 6.0},
        {"isotropic to 50 MPa; shear xz to 10 MPa at x = y = z = held", 50.0,
         10.0 * 1.7320508},
        {"uniaxial to 50 MPa", NAN, NAN},
        {"isotropic to 50 MPa; shear xz to 20 % at z = 50 MPa", NAN, NAN},
        {"isotropic to 50 MPa; triaxial to 5 %", NAN, NAN},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        const struct gb_path path = parse(cases[i].path);
        struct gb_leg_plan plan;
        gb_leg_editor_plan(&plan, &path, 3);
        const struct gb_leg_plan_state *last = &plan.state[plan.count - 1];
        const double p = 1e-6 * last->p, q = 1e-6 * last->q;
        const bool good = isnan(cases[i].p) ? !isfinite(p) || !isfinite(q)
                                            : fabs(p - cases[i].p) < 1e-4 &&
                                                  fabs(q - cases[i].q) < 1e-4;
        if (!good) {
            g_error("%s: p %g, q %g MPa", cases[i].path, p, q);
        }
    }
}

/* The sketch of a leg: in (p, q), as strain, or a sentence. */
static void test_sketch(void)
{
    static const struct {
        const char *path, *shows;
        int focus;
    } cases[] = {
        {"isotropic to 50 MPa; triaxial to q = 30 MPa", "q, MPa", 2},
        {"isotropic to 50 MPa; shear xz to 20 %", "strain, %", 2},
        {"uniaxial to 50 MPa", "from the packing", 1},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        const struct gb_path path = parse(cases[i].path);
        struct gb_plot plot;
        gb_plot_init(&plot);
        g_assert_true(gb_plot_resize(&plot, 10, 40, GB_PLOT_ASCII, NULL));
        gb_leg_editor_sketch(&path, 3, cases[i].focus, &plot);
        char *text = gb_plot_dump(&plot);
        if (strstr(text, cases[i].shows) == NULL) {
            g_error("%s:\n%s", cases[i].path, text);
        }
        g_free(text);
        gb_plot_finish(&plot);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/legs/list", test_list);
    g_test_add_func("/tui/legs/errors", test_errors);
    g_test_add_func("/tui/legs/words", test_words);
    g_test_add_func("/tui/legs/plan", test_plan);
    g_test_add_func("/tui/legs/sketch", test_sketch);
    return g_test_run();
}
