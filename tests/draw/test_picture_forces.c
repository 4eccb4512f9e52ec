/* Forces in pictures: rods, their colours and the scale of their thickness. */
#include "small_packing.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/caption.h"
#include "pack/die/die.h"

/* Two particles one behind the other, pressed: seen from the side the rod between them
 * has its colour; seen along it the nearer particle hides it. */
static void test_forces(void)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    struct gb_packing_image packing_image = small_packing_front();
    g_assert_true(gb_state_create(&state, 2, 1, &err));
    state->dimension = 3;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 6.0;
        state->position[k] = state->position[3 + k] = 3.0;
    }
    state->position[1] = 2.6;
    state->position[4] = 3.4;
    state->radius[0] = state->radius[1] = 0.5;
    state->contacts[0] = state->contacts[1] = 12;
    state->pair[1] = 1;
    state->pair_normal[0] = 1.0;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9;
    packing_image.style.show = GB_PICTURE_STYLE_BOTH;
    g_assert_true(gb_view_parse("side,flat", &packing_image.viewpoint, NULL));
    struct gb_image *image = small_packing_paint(&packing_image, state);
    const uint8_t *middle =
        small_packing_pixel(image, 0.5 * SMALL_PACKING_SIDE, 0.5 * SMALL_PACKING_SIDE);
    g_assert_cmpint(middle[2], >, middle[0] + 40); /* blue: pressed */
    gb_image_destroy(image);
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    image = small_packing_paint(&packing_image, state);
    middle =
        small_packing_pixel(image, 0.5 * SMALL_PACKING_SIDE, 0.5 * SMALL_PACKING_SIDE);
    g_assert_cmpint(middle[0], >, middle[2] + 40); /* yellow: 12 contacts */
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* Dark or coloured pixels of a column of the image around a row. */
static int thickness(const struct gb_image *image, double x, double y)
{
    int count = 0;
    for (int side = -1; side <= 1; side += 2) {
        for (int k = side > 0 ? 0 : 1;
             k < 60 && small_packing_pixel(image, x, y + side * k)[0] < 200; k++) {
            count++;
        }
    }
    return count;
}

/* The thickest rod of the legend is as thick as the rod of that force in the picture; those
 * of smaller forces are as much thinner. */
static void test_rod_scale(void)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_caption_layout layout;
    double pixel[2] = {0.0, 0.0};
    g_assert_true(gb_state_create(&state, 2, 1, &err));
    state->dimension = 3;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 20.0;
        state->position[k] = state->position[3 + k] = 10.0;
    }
    state->position[1] = 9.6;
    state->position[4] = 10.4;
    state->radius[0] = state->radius[1] = 0.5;
    state->pair[1] = 1;
    state->pair_normal[0] = 1.0;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9; /* 100 nN */
    packing_image.annotated = true;
    packing_image.width = 1000;
    packing_image.height = 750;
    packing_image.style.show = GB_PICTURE_STYLE_FORCES;
    g_assert_true(gb_view_parse("side,flat", &packing_image.viewpoint, NULL));
    struct gb_image *image = small_packing_paint(&packing_image, state);
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    for (int end = 0; end < 2; end++) {
        double one[2];
        const float *rod = &scene->rod[4 * end];
        gb_view_pixel(&scene->view, (const double[3]){rod[0], rod[1], rod[2]}, one);
        pixel[0] += 0.5 * one[0];
        pixel[1] += 0.5 * one[1];
    }
    const int shown = thickness(image, pixel[0], pixel[1]);
    g_assert_cmpint(shown, >, 10);
    const double step = GB_CAPTION_LEGEND_LINE * layout.unit;
    static const double ratio[] = {1.0, 0.5, 0.2};
    for (int k = 0; k < 3; k++) {
        const int drawn = thickness(image, layout.legend.left + 0.95 * layout.unit,
                                    layout.legend.top + (3.5 + k) * step);
        g_assert_cmpint(abs(drawn - (int)lround(ratio[k] * shown)), <=, 2);
    }
    gb_scene_destroy(scene);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void put_wall(struct gb_state *state, int line, enum gb_die_wall wall, double x,
                     double y, double z)
{
    const double force[3] = {x, y, z};
    state->wall[2 * line + 1] = (int32_t)wall;
    memcpy(state->wall_force + 3 * line, force, sizeof force);
}

/* A particle that fills a die: rods from its centre to floor, side and punch, as thick as their
 * normal forces; shear forces do not count, a pull has the other colour. */
static void test_walls(void)
{
    static const double ends[3][3] = {{3.0, 3.0, 0.0}, {4.0, 3.0, 1.0}, {3.0, 3.0, 2.0}};
    static const int class_of[3] = {0, 1, 0};
    struct gb_state *state = NULL;
    struct gb_picture_style *style = NULL;
    struct gb_picture_style_request request;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 1, 0, &err));
    g_assert_true(gb_state_allocate_walls(state, 3, &err));
    gb_picture_style_init(&request);
    request.show = GB_PICTURE_STYLE_FORCES;
    state->cell[0] = state->cell[1] = 6.0; /* wider than the die: powder beside it */
    state->cell[2] = state->punch_height = 2.0;
    state->die_radius = 1.0;
    state->position[0] = 3.0 + 1e-9;
    state->position[1] = 3.0;
    state->position[2] = state->radius[0] = 1.0;
    state->metre_per_length = state->pascal_per_stress = 1.0;
    put_wall(state, 0, GB_DIE_FLOOR, 7.0, 0.0, 1.0);
    put_wall(state, 1, GB_DIE_SIDE, 0.5, 0.0, 7.0);
    put_wall(state, 2, GB_DIE_PUNCH, 0.0, 7.0, -0.2);
    g_assert_true(gb_picture_style_create(&style, state, &request, &err));
    g_assert_cmpuint(style->rods, ==, 3);
    g_assert_cmpfloat(style->max_force_n, ==, 1.0);
    static const float ratio[3] = {1.0F, 0.5F, 0.2F};
    for (int i = 0; i < 3; i++) {
        const float *rod = &style->rod[7 * i];
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(rod[3 + k], ends[i][k], 1e-5);
        }
        g_assert_cmpfloat_with_epsilon(rod[6], ratio[i] * style->rod[6], 1e-6);
        g_assert_cmpint(
            memcmp(&style->rod_colour[3 * i], style->legend[class_of[i]].rgb, 3), ==, 0);
    }
    gb_picture_style_destroy(style);
    state->punch_height = (double)NAN; /* a state that does not tell where its punch is */
    g_assert_true(gb_picture_style_create(&style, state, &request, &err));
    g_assert_cmpuint(style->rods, ==, 2);
    gb_picture_style_destroy(style);
    gb_state_destroy(state);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/snapshot/forces", test_forces);
    g_test_add_func("/draw/snapshot/rod-scale", test_rod_scale);
    g_test_add_func("/draw/snapshot/walls", test_walls);
    return g_test_run();
}
