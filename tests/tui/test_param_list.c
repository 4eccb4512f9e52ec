#include <glib.h>

#include "scene/field/field.h"
#include "tui/panel/panels.h"

static struct gb_params scene(const char *first, ...)
{
    struct gb_params params;
    struct gb_error err = {0};
    va_list more;
    gb_params_init(&params);
    va_start(more, first);
    for (const char *set = first; set != NULL; set = va_arg(more, const char *)) {
        if (!gb_params_assign(&params, set, &err)) {
            g_error("%s", err.text);
        }
    }
    va_end(more);
    return params;
}

static bool listed(const struct gb_params *params, const char *group, const char *key)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const int row = (int)(gb_params_find(group, key) - fields);
    struct gb_param_list listing;
    gb_panel_params_list_init(&listing, params, false);
    return listing.field[gb_panel_params_list_index(&listing, row)] == row;
}

/* The list of a scene has the parameters that it uses. */
static void test_scenes(void)
{
    const struct gb_params still = scene("scene.kind=quasistatic", NULL);
    const struct gb_params fast = scene("scene.kind=dynamic", NULL);
    const struct gb_params die =
        scene("scene.kind=die", "contact.normal=hertz", "loading.geometry=die",
              "particles.distribution=lognormal", NULL);
    g_assert_true(listed(&still, "contact", "alpha"));
    g_assert_true(listed(&still, "loading", "step"));
    g_assert_false(listed(&still, "loading", "rate"));
    g_assert_false(listed(&still, "material", "yield"));
    g_assert_false(listed(&still, "die", "diameter"));
    g_assert_true(listed(&fast, "loading", "rate"));
    g_assert_true(listed(&fast, "contact", "viscosity"));
    g_assert_false(listed(&fast, "numerics", "relaxer"));
    g_assert_true(listed(&die, "die", "diameter"));
    g_assert_true(listed(&die, "particles", "median"));
    g_assert_false(listed(&die, "particles", "diameter"));
    g_assert_false(listed(&die, "contact", "alpha"));
    g_assert_false(listed(&die, "material", "yield"));
}

/* All: every row of the field table, in order, each on a line of its own, with two lines
 * before a group. */
static void test_all(void)
{
    const struct gb_params params = scene(NULL);
    size_t count = 0;
    gb_params_fields(&count);
    g_assert_cmpuint(count, <=, GB_PARAM_LIST_MAX);
    struct gb_param_list listing;
    gb_panel_params_list_init(&listing, &params, true);
    g_assert_cmpint(listing.count, ==, (int)count);
    g_assert_true(listing.first[0]);
    g_assert_cmpint(listing.line[0], ==, 1);
    for (int i = 1; i < listing.count; i++) {
        g_assert_cmpint(listing.field[i], ==, i);
        g_assert_cmpint(listing.line[i] - listing.line[i - 1], ==,
                        listing.first[i] ? 3 : 1);
        g_assert_cmpint(gb_panel_params_list_index(&listing, i), ==, i);
    }
}

/* The index of a row that is not listed is that of the listed one before it. */
static void test_index(void)
{
    const struct gb_params params = scene("scene.kind=quasistatic", NULL);
    struct gb_param_list listing;
    size_t count = 0;
    gb_params_fields(&count);
    gb_panel_params_list_init(&listing, &params, false);
    g_assert_cmpint(listing.count, <, (int)count);
    for (int row = 0; row < (int)count; row++) {
        const int index = gb_panel_params_list_index(&listing, row);
        g_assert_cmpint(listing.field[index], <=, row);
        if (index + 1 < listing.count) {
            g_assert_cmpint(listing.field[index + 1], >, row);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/listing/scenes", test_scenes);
    g_test_add_func("/listing/all", test_all);
    g_test_add_func("/listing/index", test_index);
    return g_test_run();
}
