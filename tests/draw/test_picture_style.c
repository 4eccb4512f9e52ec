/* What particles and forces wear: colours, selections, rods; without a painter. */
#include "draw/picture_style.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/image/palette.h"
#include "draw/picture_style_parse.h"

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

static struct gb_picture_style *wear(const struct gb_state *state,
                                     const struct gb_picture_style_request *request)
{
    struct gb_picture_style *dress = NULL;
    struct gb_error err = {0};
    const bool done = gb_picture_style_create(&dress, state, request, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(done);
    return dress;
}

static void test_rods(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    gb_picture_style_init(&request);
    request.show = GB_PICTURE_STYLE_FORCES;
    struct gb_picture_style *dress = wear(state, &request);
    g_assert_cmpuint(dress->rods, ==, 5); /* the one over the wall is two halves */
    /* thick as the force, cut at the thickest */
    g_assert_cmpfloat_with_epsilon(dress->rod[7 + 6], 2.0F * dress->rod[6], 1e-6F);
    g_assert_cmpint(memcmp(&dress->rod_colour[0], dress->swatch[0].rgb, 3), ==, 0);
    g_assert_cmpint(memcmp(&dress->rod_colour[6], dress->swatch[1].rgb, 3), ==, 0);
    g_assert_cmpfloat_with_epsilon(dress->thickest_n, 2.0 * 1e9 * 1e-16, 1e-12);
    /* halves leave the cell, they do not cross it */
    g_assert_cmpfloat(fabsf(dress->rod[21 + 5] - dress->rod[21 + 2]), <, 1.0F);
    gb_picture_style_destroy(dress);
    request.force = GB_PICTURE_STYLE_BRIDGED;
    dress = wear(state, &request);
    g_assert_cmpint(memcmp(&dress->rod_colour[3], dress->swatch[0].rgb, 3), ==, 0);
    g_assert_cmpint(memcmp(&dress->rod_colour[0], dress->swatch[1].rgb, 3), ==, 0);
    gb_picture_style_destroy(dress);
    gb_state_destroy(state);
}

/* Shares of the particles add up to the virial of the cell. */
static void test_pressure(void)
{
    struct gb_state *state = row();
    double pressure[4];
    double sum = 0.0;
    double solid = 0.0;
    gb_picture_style_pressure(state, pressure);
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
    request.colour = GB_PICTURE_STYLE_SIZE;
    struct gb_picture_style *dress = wear(state, &request);
    g_assert_cmpstr(dress->scale.title, ==, "diameter (nm)");
    g_assert_cmpfloat_with_epsilon(dress->scale.low, 10.0, 1e-9);
    g_assert_cmpfloat_with_epsilon(dress->scale.high, 16.0, 1e-9);
    gb_palette_field(0.0, rgb);
    g_assert_cmpint(memcmp(dress->colour, rgb, 3), ==, 0);
    gb_palette_field(1.0, rgb);
    g_assert_cmpint(memcmp(dress->colour + 9, rgb, 3), ==, 0);
    gb_picture_style_destroy(dress);
    request.colour = GB_PICTURE_STYLE_BRIDGES;
    dress = wear(state, &request);
    gb_palette_contacts(1, rgb);
    g_assert_cmpint(memcmp(dress->colour + 3, rgb, 3), ==, 0);
    gb_palette_contacts(0, rgb);
    g_assert_cmpint(memcmp(dress->colour, rgb, 3), ==, 0);
    gb_picture_style_destroy(dress);
    gb_state_destroy(state);
}

/* The strain of the cell moves nothing; a step through the wall is short. */
static void test_displacement(void)
{
    struct gb_picture_style_request request;
    struct gb_state *state = row();
    struct gb_state *since = row();
    struct gb_error err = {0};
    struct gb_picture_style *dress = NULL;
    gb_picture_style_init(&request);
    request.colour = GB_PICTURE_STYLE_DISPLACEMENT;
    g_assert_false(gb_picture_style_create(&dress, state, &request, &err));
    g_assert_nonnull(strstr(err.text, "--since"));
    for (int i = 0; i < 4; i++) {
        since->position[3 * i + 2] *= 2.0;
    }
    since->cell[2] *= 2.0;
    since->position[2] = 2.0 * 3.8 - 2.0 * 0.2; /* 0.3 d through the wall */
    request.since = since;
    dress = wear(state, &request);
    g_assert_cmpfloat_with_epsilon(dress->scale.high, 3.0, 1e-6); /* nm */
    g_assert_cmpfloat(dress->scale.low, ==, 0.0);
    gb_picture_style_destroy(dress);
    since->seed = 99;
    g_assert_false(gb_picture_style_create(&dress, state, &request, &err));
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
    struct gb_picture_style *dress = wear(state, &request);
    g_assert_cmpint(dress->hidden[0], ==, 1);
    g_assert_cmpint(dress->hidden[1], ==, 0);
    g_assert_cmpint(dress->hidden[2], ==, 1);
    gb_picture_style_destroy(dress);
    gb_picture_style_init(&request);
    g_assert_true(gb_picture_style_parse_cut(&request, "z=0.5", NULL));
    request.show = GB_PICTURE_STYLE_BOTH;
    dress = wear(state, &request);
    g_assert_cmpint(dress->hidden[1], ==, 0);
    g_assert_cmpint(dress->hidden[3], ==, 1);
    g_assert_cmpuint(dress->rods, ==, 1); /* forces of hidden particles are hidden */
    gb_picture_style_destroy(dress);
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
    g_assert_cmpint(request.force, ==, GB_PICTURE_STYLE_BRIDGED);
    g_assert_cmpint(request.colour, ==, GB_PICTURE_STYLE_COORDINATION);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/dress/rods", test_rods);
    g_test_add_func("/draw/dress/pressure", test_pressure);
    g_test_add_func("/draw/dress/colours", test_colours);
    g_test_add_func("/draw/dress/displacement", test_displacement);
    g_test_add_func("/draw/dress/selection", test_selection);
    g_test_add_func("/draw/dress/parse", test_parse);
    return g_test_run();
}
