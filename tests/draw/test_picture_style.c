/* Style of a picture: colours, hidden particles, rods; without a renderer. */
#include "draw/style/picture_style.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/image/palette.h"
#include "io/state/state_stress.h"
#include "draw/style/picture_colours.h"
#include "draw/style/picture_style_parse.h"

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
    gb_state_stress_mean(state, pressure);
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
    gb_palette_field(0.0, rgb);
    g_assert_cmpint(memcmp(style->colour, rgb, 3), ==, 0);
    gb_palette_field(1.0, rgb);
    g_assert_cmpint(memcmp(style->colour + 9, rgb, 3), ==, 0);
    gb_picture_style_destroy(style);
    request.particles = gb_picture_colours_find("bridges");
    style = create_style(state, &request);
    gb_palette_contacts(1, rgb);
    g_assert_cmpint(memcmp(style->colour + 3, rgb, 3), ==, 0);
    gb_palette_contacts(0, rgb);
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
    gb_palette_field(0.5, rgb);
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
    g_test_add_func("/draw/picture_style/selection", test_selection);
    g_test_add_func("/draw/picture_style/parse", test_parse);
    return g_test_run();
}
