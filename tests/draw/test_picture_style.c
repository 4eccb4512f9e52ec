/* Style of a picture: colours, hidden particles, rods; without a renderer. */
#include "draw/picture_style.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/image.h"
#include "draw/picture_colours.h"
#include "io/state_forces.h"

/* Four particles in a row along z; the last touches the first through the wall.  The
 * contacts press with 1, 2, pull with 0.5, and press with 0 over the wall. */
static struct gb_state *row(void)
{
    static const double force[4] = {1.0, 2.0, -0.5, 0.25};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 4, 4, &err));
    state->dimension = 3;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9;
    state->cell[0] = state->cell[1] = 4.0;
    state->cell[2] = 3.8;
    for (int i = 0; i < 4; i++) {
        state->position[3 * i] = 1.0;
        state->position[3 * i + 1] = 1.0 + 0.5 * i;
        state->position[3 * i + 2] = 0.1 + 0.95 * i;
        state->radius[i] = 0.5 + 0.1 * i;
        state->contacts[i] = 2;
        state->pair[2 * i] = i;
        state->pair[2 * i + 1] = (i + 1) % 4;
        state->pair_normal[i] = force[i];
        state->pair_force[3 * i + 2] = i < 3 ? -force[i] : -force[i];
        state->pair_bridged[i] = i == 1;
    }
    return state;
}

static struct gb_picture_style *
create_style(const struct gb_state *state, const struct gb_picture_style_request *request)
{
    struct gb_picture_style *style = NULL;
    struct gb_error err = {0};
    const bool done = gb_picture_style_create(&style, state, request, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(done);
    return style;
}

static void test_rods(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    gb_picture_style_init(&request);
    request.show = GB_PICTURE_STYLE_FORCES;
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpuint(style->rods, ==, 5); /* the one over the wall is two halves */
    /* thick as the force, cut at the thickest */
    g_assert_cmpfloat_with_epsilon(style->rod[7 + 6], 2.0F * style->rod[6], 1e-6F);
    g_assert_cmpint(memcmp(&style->rod_colour[0], style->legend[0].rgb, 3), ==, 0);
    g_assert_cmpint(memcmp(&style->rod_colour[6], style->legend[1].rgb, 3), ==, 0);
    g_assert_cmpfloat_with_epsilon(style->max_force_n, 2.0 * 1e9 * 1e-16, 1e-12);
    /* halves leave the cell, they do not cross it */
    g_assert_cmpfloat(fabsf(style->rod[21 + 5] - style->rod[21 + 2]), <, 1.0F);
    gb_picture_style_destroy(style);
    request.forces = gb_picture_colours_find("bridged");
    style = create_style(state, &request);
    g_assert_cmpint(memcmp(&style->rod_colour[3], style->legend[0].rgb, 3), ==, 0);
    g_assert_cmpint(memcmp(&style->rod_colour[0], style->legend[1].rgb, 3), ==, 0);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

/* Shares of the particles add up to the virial of the cell. */
static void test_pressure(void)
{
    struct gb_state *state = row();
    double pressure[4];
    double sum = 0.0;
    double solid = 0.0;
    gb_state_forces_stress_mean(state, &(struct gb_state_gaps){0}, pressure);
    for (int i = 0; i < 4; i++) {
        sum += pressure[i] * pow(state->radius[i], 3.0);
        solid += pow(state->radius[i], 3.0);
    }
    sum /= solid;
    const double virial = (1.0 + 2.0 - 0.5 + 0.25) * 0.95;
    g_assert_cmpfloat_with_epsilon(sum, virial / (3.0 * 4.0 * 4.0 * 3.8) * 1e9, 1.0);
    gb_state_destroy(state);
}

static void test_colours(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    uint8_t rgb[3];
    gb_picture_style_init(&request);
    request.particles = gb_picture_colours_find("size");
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpstr(style->scale.title, ==, "diameter (nm)");
    g_assert_cmpfloat_with_epsilon(style->scale.low, 10.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 16.0, 1e-9);
    gb_image_map_colour(NULL, 0.0, rgb);
    g_assert_cmpint(memcmp(style->colour, rgb, 3), ==, 0);
    gb_image_map_colour(NULL, 1.0, rgb);
    g_assert_cmpint(memcmp(style->colour + 9, rgb, 3), ==, 0);
    gb_picture_style_destroy(style);
    request.particles = gb_picture_colours_find("bridges");
    style = create_style(state, &request);
    gb_image_map_colour(NULL, 1.0 / GB_IMAGE_MAP_CONTACTS, rgb);
    g_assert_cmpint(memcmp(style->colour + 3, rgb, 3), ==, 0);
    gb_image_map_colour(NULL, 0.0, rgb);
    g_assert_cmpint(memcmp(style->colour, rgb, 3), ==, 0);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

/* Particles of one size have a scale of one value, also when the last bit differs; one
 * outlier of many is an end of the scale. */
static void test_one_size(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    uint8_t rgb[3];
    gb_picture_style_init(&request);
    request.particles = gb_picture_colours_find("size");
    for (int i = 0; i < 4; i++) {
        state->radius[i] = i == 3 ? nextafter(0.5, 1.0) : 0.5;
    }
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpfloat(style->scale.low, ==, style->scale.high);
    g_assert_cmpfloat_with_epsilon(style->scale.low, 10.0, 1e-9);
    g_assert_false(style->scale.below || style->scale.above);
    gb_image_map_colour(NULL, 0.5, rgb);
    for (int i = 0; i < 4; i++) {
        g_assert_cmpint(memcmp(style->colour + 3 * i, rgb, 3), ==, 0);
    }
    gb_picture_style_destroy(style);
    state->radius[0] = 0.4;
    style = create_style(state, &request);
    g_assert_cmpfloat_with_epsilon(style->scale.low, 8.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 10.0, 1e-9);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

/* The strain of the cell moves nothing; a step through the wall is short. */
static void test_displacement(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    struct gb_state *since = row();
    struct gb_error err = {0};
    struct gb_picture_style *style = NULL;
    gb_picture_style_init(&request);
    request.particles = gb_picture_colours_find("displacement");
    g_assert_false(gb_picture_style_create(&style, state, &request, &err));
    g_assert_nonnull(strstr(err.text, "--since"));
    for (int i = 0; i < 4; i++) {
        since->position[3 * i + 2] *= 2.0;
    }
    since->cell[2] *= 2.0;
    since->position[2] = 2.0 * 3.8 - 2.0 * 0.2; /* 0.3 d through the wall */
    request.since = since;
    style = create_style(state, &request);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 3.0, 1e-6); /* nm */
    g_assert_cmpfloat(style->scale.low, ==, 0.0);
    gb_picture_style_destroy(style);
    since->seed = 99;
    g_assert_false(gb_picture_style_create(&style, state, &request, &err));
    g_assert_nonnull(strstr(err.text, "same run"));
    gb_state_destroy(since);
    gb_state_destroy(state);
}

/* A hundred particles of sizes 10.3 to 99.7 nm, and two far beyond. */
static struct gb_state *sizes(double outlier)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 102, 0, &err));
    state->dimension = 3;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9;
    for (int i = 0; i < 102; i++) {
        state->radius[i] = i < 100 ? 0.515 + (4.985 - 0.515) * i / 99.0 : outlier;
    }
    return state;
}

/* Ends at ticks; outliers that would make all others one colour are beyond the scale, near
 * ones are on it; given ends stay. */
static void test_range(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = sizes(500.0);
    struct gb_error err = {0};
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_colour(&request, "size", &err));
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpfloat_with_epsilon(style->scale.low, 0.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 100.0, 1e-9);
    g_assert_true(style->scale.above && !style->scale.below);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
    state = sizes(6.0);
    style = create_style(state, &request);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 120.0, 1e-9);
    g_assert_false(style->scale.above);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

static void test_range_given(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = sizes(6.0);
    struct gb_error err = {0};
    uint8_t rgb[3];
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_colour(&request, "size", &err));
    g_assert_true(gb_picture_style_parse_range(&request, "20 nm:0.05um", &err));
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpfloat_with_epsilon(style->scale.low, 20.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 50.0, 1e-9);
    g_assert_true(style->scale.below && style->scale.above);
    gb_image_map_colour(NULL, 0.0, rgb);
    g_assert_cmpint(memcmp(style->colour, rgb, 3), ==, 0);
    gb_image_map_colour(NULL, 1.0, rgb);
    g_assert_cmpint(memcmp(style->colour + 3 * 99, rgb, 3), ==, 0);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
    static const char *const wrong[] = {"",      "5",       "20:10nm", "0:5", "0:5MPa",
                                        "a:5nm", "0:5nm:7", "0:nan",   ":",   "0:0nm"};
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        g_assert_false(gb_picture_style_parse_range(&request, wrong[k], &err));
        g_assert_nonnull(strstr(err.text, "as in 0:20nm"));
    }
    request.show = GB_PICTURE_STYLE_FORCES;
    g_assert_true(gb_picture_style_parse_range(&request, "0:50nN", &err));
    g_assert_cmpfloat_with_epsilon(request.max_force_n, 5e-8, 1e-20);
    g_assert_false(gb_picture_style_parse_range(&request, "1:50nN", &err));
    g_assert_nonnull(strstr(err.text, "0:50nN"));
}

/* Equal ratios have equal steps of colour; what is not above 0 has the first one. */
static void test_log(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    struct gb_error err = {0};
    uint8_t rgb[3];
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_colour(&request, "size", &err));
    request.log = true;
    for (int i = 0; i < 4; i++) {
        state->radius[i] = 0.5 * pow(10.0, i);
    }
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_true(style->scale.log);
    g_assert_cmpfloat_with_epsilon(style->scale.low, 10.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(style->scale.high, 1e4, 1e-6);
    for (int i = 0; i < 4; i++) {
        gb_image_map_colour(NULL, i / 3.0, rgb);
        g_assert_cmpint(memcmp(style->colour + 3 * i, rgb, 3), ==, 0);
    }
    gb_picture_style_destroy(style);
    g_assert_true(gb_picture_style_parse_range(&request, "0:50nm", &err));
    g_assert_false(gb_picture_style_create(&style, state, &request, &err));
    g_assert_nonnull(strstr(err.text, "above 0 with --log"));
    request.ranged = false;
    g_assert_true(gb_picture_style_parse_colour(&request, "coordination", &err));
    g_assert_false(gb_picture_style_create(&style, state, &request, &err));
    g_assert_nonnull(strstr(err.text, "--log: whole numbers"));
    gb_state_destroy(state);
}

/* A diverging scale has its light middle at 0; whole numbers take scale and range, too. */
static void test_colormap(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    struct gb_error err = {0};
    uint8_t rgb[3];
    gb_picture_style_init(&request);
    g_assert_false(gb_picture_style_parse_colormap(&request, "jet", &err));
    g_assert_nonnull(strstr(err.text, "viridis, fire, blue-yellow, grey, diverging"));
    g_assert_true(gb_picture_style_parse_colormap(&request, "diverging", &err));
    g_assert_true(gb_picture_style_parse_colour(&request, "pressure", &err));
    state->pair_normal[2] = -5.0;
    state->pair_force[8] = 5.0;
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpfloat(style->scale.low, <, 0.0);
    g_assert_cmpfloat(style->scale.high, ==, -style->scale.low);
    gb_picture_style_destroy(style);
    g_assert_true(gb_picture_style_parse_colour(&request, "coordination", &err));
    g_assert_true(gb_picture_style_parse_range(&request, "1:3", &err));
    style = create_style(state, &request);
    gb_image_map_colour(request.map, 0.5, rgb); /* 2 of 1, 2, 3 */
    g_assert_cmpint(memcmp(style->colour, rgb, 3), ==, 0);
    g_assert_cmpint(rgb[0], >, 230);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

/* CIELAB of sRGB. */
static void lab_of(const uint8_t rgb[3], double lab[3])
{
    static const double m[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                   {0.2126729, 0.7151522, 0.0721750},
                                   {0.0193339, 0.1191920, 0.9503041}};
    static const double white[3] = {0.95047, 1.0, 1.08883};
    double f[3];
    for (int k = 0; k < 3; k++) {
        double sum = 0.0;
        for (int c = 0; c < 3; c++) {
            const double x = rgb[c] / 255.0;
            sum += m[k][c] * (x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
        }
        const double t = sum / white[k];
        f[k] = t > 0.008856 ? cbrt(t) : 7.787 * t + 16.0 / 116.0;
    }
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

/* Equal steps for the eye (viridis is uniform in another space), lightness that grows, or
 * falls alike on both sides of the middle. */
static void test_maps(void)
{
    for (const struct gb_image_map *map = gb_image_maps(); map->name; map++) {
        double lab[17][3], mean = 0.0;
        for (int k = 0; k < 17; k++) {
            lab_of(map->anchor[k], lab[k]);
        }
        for (int k = 0; k < 16; k++) {
            mean += hypot(hypot(lab[k + 1][0] - lab[k][0], lab[k + 1][1] - lab[k][1]),
                          lab[k + 1][2] - lab[k][2]) /
                    16.0;
            const double sign = map->diverging && k >= 8 ? -1.0 : 1.0;
            g_assert_cmpfloat(sign * (lab[k + 1][0] - lab[k][0]), >, 0.0);
        }
        for (int k = 0; k < 16 && strcmp(map->name, "viridis") != 0; k++) {
            const double step =
                hypot(hypot(lab[k + 1][0] - lab[k][0], lab[k + 1][1] - lab[k][1]),
                      lab[k + 1][2] - lab[k][2]);
            g_assert_cmpfloat(fabs(step / mean - 1.0), <, 0.15);
        }
        for (int k = 0; k < 8 && map->diverging; k++) {
            g_assert_cmpfloat(fabs(lab[k][0] - lab[16 - k][0]), <, 1.0);
        }
    }
}

static void test_selection(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_slice(&request, "z=0.25:1d", NULL));
    struct gb_picture_style *style = create_style(state, &request);
    g_assert_cmpint(style->hidden[0], ==, 1);
    g_assert_cmpint(style->hidden[1], ==, 0);
    g_assert_cmpint(style->hidden[2], ==, 1);
    gb_picture_style_destroy(style);
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_cut(&request, "z=0.5", NULL));
    request.show = GB_PICTURE_STYLE_BOTH;
    style = create_style(state, &request);
    g_assert_cmpint(style->hidden[1], ==, 0);
    g_assert_cmpint(style->hidden[3], ==, 1);
    g_assert_cmpuint(style->rods, ==, 1); /* forces of hidden particles are hidden */
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

static void test_parse(void)
{
    static const char *const planes[] = {"",        "z",         "z=",    "z=2",
                                         "q=0.5",   "z=-1",      "z=nan", "z=0.5:0",
                                         "z=0.5:x", "z=0.5:1 dd"};
    struct gb_picture_style_request request;
    struct gb_error err = {0};
    gb_picture_style_init(&request);
    for (size_t k = 0; k < G_N_ELEMENTS(planes); k++) {
        g_assert_false(gb_picture_style_parse_slice(&request, planes[k], &err));
        g_assert_nonnull(strstr(err.text, "--slice"));
        g_assert_false(gb_picture_style_parse_cut(&request, planes[k], &err));
    }
    g_assert_false(gb_picture_style_parse_colour(&request, "red", &err));
    g_assert_nonnull(strstr(err.text, "coordination"));
    g_assert_false(gb_picture_style_parse_show(&request, "all", &err));
    g_assert_true(gb_picture_style_parse_colour(&request, "bridged", &err));
    g_assert_true(request.forces == gb_picture_colours_find("bridged"));
    g_assert_true(request.particles == gb_picture_colours_find("coordination"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/picture_style/rods", test_rods);
    g_test_add_func("/draw/picture_style/pressure", test_pressure);
    g_test_add_func("/draw/picture_style/colours", test_colours);
    g_test_add_func("/draw/picture_style/one-size", test_one_size);
    g_test_add_func("/draw/picture_style/displacement", test_displacement);
    g_test_add_func("/draw/picture_style/range", test_range);
    g_test_add_func("/draw/picture_style/range-given", test_range_given);
    g_test_add_func("/draw/picture_style/log", test_log);
    g_test_add_func("/draw/picture_style/colormap", test_colormap);
    g_test_add_func("/draw/picture_style/maps", test_maps);
    g_test_add_func("/draw/picture_style/selection", test_selection);
    g_test_add_func("/draw/picture_style/parse", test_parse);
    return g_test_run();
}
