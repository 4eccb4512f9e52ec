#include <glib.h>
#include <math.h>

#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/normal_law.h"

/* The rows are the choices of contact.normal, in the same order. */
static void test_names(void)
{
    const struct gb_field *normal = gb_params_find("contact", "normal");
    for (int law = 0; law < GB_NORMAL_LAWS; law++) {
        g_assert_cmpstr(gb_normal_law_at(law)->name, ==, normal->choices[law]);
    }
    g_assert_null(normal->choices[GB_NORMAL_LAWS]);
}

/* A kind of scenes with a periodic cell accepts only laws that have a force. */
static bool accepted(int law)
{
    bool any = false;
    for (int kind = 0; kind < GB_LOADING_KINDS; kind++) {
        const struct gb_loading_kind *row = gb_loading_kind_at(kind);
        const bool cell = row->periodic_cell && (row->normals >> law & 1u) != 0;
        g_assert_true(!cell || gb_normal_law_at(law)->force != NULL);
        any = any || cell;
    }
    return any;
}

/* The model of the default scene with this law. */
static struct gb_model model_of(int law)
{
    struct gb_params params;
    struct gb_model model;
    struct gb_error err = {0};
    gb_params_init(&params);
    params.normal = law;
    if (!gb_params_check(&params, &err) || !gb_model_init(&model, &params, &err)) {
        g_error("%s: %s", gb_normal_law_at(law)->name, err.text);
    }
    return model;
}

/* Nothing without an overlap, a growing force, and a stiffness that is its slope. */
static void test_slopes(void)
{
    int laws = 0;
    for (int law = 0; law < GB_NORMAL_LAWS; law++) {
        if (!accepted(law)) {
            continue;
        }
        const struct gb_model model = model_of(law);
        double before = 0.0;
        g_assert_cmpint(model.normal, ==, law);
        g_assert_cmpfloat(model.force_floor, >, 0.0);
        g_assert_cmpfloat(gb_normal_law_force(&model, 0.0), ==, 0.0);
        g_assert_cmpfloat(gb_normal_law_force(&model, -0.1), ==, 0.0);
        g_assert_cmpfloat(gb_normal_law_stiffness(&model, -0.1), ==, 0.0);
        for (double h = 1e-4; h < 0.4; h *= 1.3) {
            const double step = 1e-5 * h;
            const double slope = (gb_normal_law_force(&model, h + step) -
                                  gb_normal_law_force(&model, h - step)) /
                                 (2.0 * step);
            g_assert_cmpfloat(gb_normal_law_force(&model, h), >, before);
            g_assert_cmpfloat_with_epsilon(gb_normal_law_stiffness(&model, h) / slope,
                                           1.0, 1e-7);
            before = gb_normal_law_force(&model, h);
        }
        laws++;
    }
    g_assert_cmpint(laws, >=, 2);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/normal-law/names", test_names);
    g_test_add_func("/normal-law/slopes", test_slopes);
    return g_test_run();
}
