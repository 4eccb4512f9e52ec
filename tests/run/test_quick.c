/* The quick twin of a scene. */
#include <glib.h>
#include <math.h>

#include "common/scene.h"
#include "run/cost.h"

static void test_quasistatic(void)
{
    struct gb_params quick;
    struct gb_params full =
        scene_params("particles.count=8000", "structure.base=18 d", NULL);
    full.unload_count = 1;
    full.unload_from_pa[0] = 1e8;
    g_assert_true(gb_cost_quick(&full, &quick));
    g_assert_cmpint(quick.count, ==, GB_QUICK_COUNT);
    g_assert_true(quick.base.relative && quick.base.value == 0.0);
    g_assert_cmpint(quick.unload_count, ==, 0);
    g_assert_cmpfloat(quick.strain_step, >, full.strain_step);
    g_assert_cmpfloat(quick.until_pressure_pa, ==, full.until_pressure_pa);
    g_assert_cmpfloat(quick.mu, ==, full.mu);
    g_assert_cmpuint(quick.seed, ==, full.seed);
    g_assert_true(gb_params_check(&quick, NULL));
    g_assert_false(gb_cost_is_quick(&full));
    g_assert_true(gb_cost_is_quick(&quick));
}

/* A small scene keeps its cell: only the steps are longer. */
static void test_small(void)
{
    struct gb_params quick;
    const struct gb_params full =
        scene_params("particles.count=300", "structure.base=6 d", NULL);
    g_assert_true(gb_cost_quick(&full, &quick));
    g_assert_cmpint(quick.count, ==, 300);
    g_assert_cmpfloat(quick.base.value, ==, 6.0);
}

/* Whatever the accuracy of the full cell: a small one in the accuracy of the reference is no
 * quick cell itself. */
static void test_reference(void)
{
    struct gb_params quick, of_fast;
    const struct gb_params full =
        scene_params("particles.count=1000", "numerics.fidelity=reference",
                     "numerics.precision=double", "numerics.relaxer=fire", NULL);
    const struct gb_params fast =
        scene_params("particles.count=1000", "numerics.fidelity=fast", NULL);
    g_assert_true(gb_cost_quick(&full, &quick));
    g_assert_true(gb_cost_quick(&fast, &of_fast));
    for (size_t i = 0, count = 0; i == 0 || i < count; i++) {
        char of[256], other[256];
        const struct gb_field *field = &gb_params_fields(&count)[i];
        gb_params_format(&quick, field, of, sizeof of);
        gb_params_format(&of_fast, field, other, sizeof other);
        g_assert_cmpstr(of, ==, other);
    }
    g_assert_false(gb_cost_is_quick(&full));
    g_assert_true(gb_cost_is_quick(&fast));
}

static struct gb_params planar(const char *rate)
{
    static const char *const scene[] = {
        "scene.kind=dynamic", "scene.dimension=2", "structure.density=0.5",
        "loading.geometry=isotropic", "loading.until=density = 0.95"};
    struct gb_params params = scene_params("particles.count=1000", NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(scene); i++) {
        g_assert_true(gb_params_assign(&params, scene[i], NULL));
    }
    g_assert_true(gb_params_assign(&params, rate, NULL));
    return params;
}

static void test_dynamic(void)
{
    struct gb_params quick;
    const struct gb_params fast = planar("loading.rate=6.8e8 1/s");
    const struct gb_params slow = planar("loading.rate=6.8e4 1/s");
    g_assert_true(gb_cost_quick(&fast, &quick));
    g_assert_cmpfloat(quick.relax_s, ==, 0.0);
    g_assert_cmpfloat(quick.hold_s, ==, 0.0);
    g_assert_cmpfloat(quick.rate_per_s, ==, fast.rate_per_s);
    g_assert_false(gb_cost_quick(&slow, &quick));
    g_assert_false(gb_cost_is_quick(&slow));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/quick/quasistatic", test_quasistatic);
    g_test_add_func("/run/quick/small", test_small);
    g_test_add_func("/run/quick/reference", test_reference);
    g_test_add_func("/run/quick/dynamic", test_dynamic);
    return g_test_run();
}
