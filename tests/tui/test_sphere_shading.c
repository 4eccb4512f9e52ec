/* Packings drawn as lit spheres. */
#include <glib.h>

#include "tui/panel/sphere_shading.h"

enum { ROWS = 40, COLS = 40 };

static float shade[ROWS * COLS];

static struct gb_view_sample *one_sphere(int dimension, float y)
{
    struct gb_view_sample *picture = g_new0(struct gb_view_sample, 1);
    picture->valid = true;
    picture->dimension = dimension;
    picture->window[0] = picture->window[1] = picture->window[2] = 9.0;
    picture->count = 1;
    picture->position[0][0] = picture->position[0][2] = 4.5F;
    picture->position[0][1] = y;
    for (int i = 0; i < GB_VIEW_SAMPLE_POINTS; i++) {
        picture->radius[i] = 0.5F;
    }
    return picture;
}

static int covered(void)
{
    int count = 0;
    for (int i = 0; i < ROWS * COLS; i++) {
        count += shade[i] >= 0.0F;
    }
    return count;
}

static float brightest(void)
{
    float most = -1.0F;
    for (int i = 0; i < ROWS * COLS; i++) {
        most = MAX(most, shade[i]);
    }
    return most;
}

/* 10 diameters over 40 dots: a disc of radius 2 dots in the middle. */
static void test_one(void)
{
    struct gb_view_sample *picture = one_sphere(3, 0.0F);
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    g_assert_cmpint(covered(), >=, 9);
    g_assert_cmpint(covered(), <=, 16);
    g_assert_cmpfloat(shade[20 * COLS + 20], >, 0.3F);
    g_assert_cmpfloat(shade[0], <, 0.0F);
    /* lit from above: the upper half is brighter */
    g_assert_cmpfloat(shade[19 * COLS + 19], >, shade[21 * COLS + 20]);
    g_free(picture);
}

/* Deeper spheres are darker, and nearer ones cover farther ones in any order. */
static void test_depth(void)
{
    struct gb_view_sample *near = one_sphere(3, 0.0F);
    struct gb_view_sample *far = one_sphere(3, 8.0F);
    gb_sphere_shading_render(near, NULL, ROWS, COLS, shade);
    const float front = brightest();
    gb_sphere_shading_render(far, NULL, ROWS, COLS, shade);
    const float back = brightest();
    g_assert_cmpfloat(back, <, 0.7F * front);
    near->count = 2;
    for (int order = 0; order < 2; order++) {
        near->position[order][0] = near->position[order][2] = 4.5F;
        near->position[order][1] = 0.0F;
        near->position[1 - order][0] = near->position[1 - order][2] = 4.5F;
        near->position[1 - order][1] = 8.0F;
        gb_sphere_shading_render(near, NULL, ROWS, COLS, shade);
        g_assert_cmpfloat(brightest(), ==, front);
    }
    g_free(near);
    g_free(far);
}

/* No write outside the array for any size. */
static void test_sizes(void)
{
    struct gb_view_sample *picture = one_sphere(2, 0.0F);
    picture->count = GB_VIEW_SAMPLE_POINTS;
    for (int i = 0; i < picture->count; i++) {
        picture->position[i][0] = (float)(i % 64) * 9.0F / 63.0F;
        picture->position[i][2] = (float)(i / 64) * 9.0F / 63.0F;
    }
    for (int rows = 1; rows <= ROWS; rows += 3) {
        for (int cols = 1; cols <= COLS; cols += 3) {
            float *exact = g_new(float, (gsize)(rows * cols));
            gb_sphere_shading_render(picture, NULL, rows, cols, exact);
            g_assert_cmpfloat(exact[(rows / 2) * cols + cols / 2], >=, 0.0F);
            g_free(exact);
        }
    }
    g_free(picture);
}

static int outlines(float sign)
{
    int count = 0;
    for (int i = 0; i < ROWS * COLS; i++) {
        count += shade[i] == sign;
    }
    return count;
}

/* Side and floor of a die, its funnel while it is filled, its punch. */
static void test_die(void)
{
    struct gb_view_sample *picture = one_sphere(3, 0.0F);
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    g_assert_cmpint(outlines(GB_SPHERE_SHADING_UPRIGHT), ==, 0);
    picture->die = (struct gb_view_die){.shown = true, .radius = 4.5, .top = 9.0};
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    const int side = outlines(GB_SPHERE_SHADING_UPRIGHT);
    const int floor = outlines(GB_SPHERE_SHADING_LEVEL);
    g_assert_cmpint(side, >=, 60); /* two lines of 9 d, 4 dots each d */
    g_assert_cmpint(side, <=, 80);
    g_assert_cmpint(floor, >=, 30);
    g_assert_cmpint(floor, <=, 40);
    picture->die.punch = true;
    picture->die.punch_height = 6.0;
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    g_assert_cmpint(outlines(GB_SPHERE_SHADING_LEVEL), >=, floor + 30);
    picture->die.punch = false;
    picture->die.funnel = true;
    picture->die.top = 5.0;
    picture->die.outlet = 1.0;
    picture->die.funnel_slope = 0.8;
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    g_assert_cmpint(outlines(GB_SPHERE_SHADING_RISING), >=, 10);
    g_assert_cmpint(outlines(GB_SPHERE_SHADING_FALLING), >=, 10);
    for (int row = 8; row < 30; row++) { /* the outlet is open */
        g_assert_cmpfloat(shade[row * COLS + 20], <=, 1.0F);
    }
    picture->die.gone = true;
    picture->die.funnel = false;
    gb_sphere_shading_render(picture, NULL, ROWS, COLS, shade);
    g_assert_cmpint(outlines(GB_SPHERE_SHADING_UPRIGHT), ==, 0);
    g_free(picture);
}

static struct gb_view_sample *two_spheres(void)
{
    struct gb_view_sample *picture = one_sphere(3, 1.0F);
    picture->count = 2;
    picture->position[0][0] = 2.0F; /* left in front, right behind */
    picture->position[1][0] = 7.0F;
    picture->position[1][1] = 8.0F;
    picture->position[1][2] = 4.5F;
    picture->value[GB_VIEW_VALUE_CONTACTS][0] = 3.0F;
    picture->value[GB_VIEW_VALUE_CONTACTS][1] = 6.0F;
    return picture;
}

/* Mean column of the dots of a shade between two bounds. */
static double middle(float low, float high)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < ROWS * COLS; i++) {
        if (shade[i] > low && shade[i] <= high) {
            sum += i % COLS;
            count++;
        }
    }
    g_assert_cmpint(count, >, 0);
    return sum / count;
}

/* By value: the larger one brighter, whatever the depth; the range is that of the sample. */
static void test_value(void)
{
    struct gb_view_sample *picture = two_spheres();
    struct gb_packing_look look = {.colour = GB_PACKING_COLOUR_CONTACTS};
    picture->value[GB_VIEW_VALUE_PRESSURE][0] = -2.0F;
    picture->value[GB_VIEW_VALUE_PRESSURE][1] = 5.0F;
    struct gb_packing_range range = gb_sphere_shading_range(picture, look.colour);
    g_assert_cmpfloat(range.low, ==, 0.0);
    g_assert_cmpfloat(range.high, ==, 3.0); /* 95 % of two */
    g_assert_true(range.beyond);
    range = gb_sphere_shading_range(picture, GB_PACKING_COLOUR_PRESSURE);
    g_assert_cmpfloat(range.low, ==, -2.0);
    picture->count = 1;
    range = gb_sphere_shading_range(picture, look.colour);
    g_assert_false(range.beyond);
    picture->count = 2;
    picture->value[GB_VIEW_VALUE_CONTACTS][1] = 0.0F;
    gb_sphere_shading_render(picture, &look, ROWS, COLS, shade);
    g_assert_cmpfloat(middle(-0.5F, 0.5F), >, 20.0); /* no contact: the right one, dark */
    g_assert_cmpfloat(middle(0.5F, 1.0F), <, 20.0);
    g_free(picture);
}

/* From behind left and right change places; from above the depth is the height. */
static void test_rotated(void)
{
    struct gb_view_sample *picture = two_spheres();
    struct gb_packing_look look = {.colour = GB_PACKING_COLOUR_CONTACTS};
    picture->value[GB_VIEW_VALUE_CONTACTS][1] = 0.0F;
    gb_sphere_shading_rotate(&look, 180.0, 0.0);
    gb_sphere_shading_render(picture, &look, ROWS, COLS, shade);
    g_assert_cmpfloat(middle(-0.5F, 0.5F), <, 20.0);
    g_assert_cmpfloat(middle(0.5F, 1.0F), >, 20.0);
    gb_sphere_shading_rotate(&look, 180.0, 0.0);
    g_assert_cmpfloat(look.azimuth_deg, ==, 0.0);
    gb_sphere_shading_rotate(&look, 0.0, 120.0);
    g_assert_cmpfloat(look.elevation_deg, ==, 90.0);
    picture->position[1][0] = 2.0F; /* the same place, above the other */
    picture->position[1][1] = 1.0F;
    picture->position[1][2] = 8.0F;
    gb_sphere_shading_render(picture, &look, ROWS, COLS, shade);
    for (int i = 0; i < ROWS * COLS; i++) {
        g_assert_cmpfloat(shade[i], <, 0.5F); /* it hides the lower one */
    }
    g_free(picture);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/sphere_shading/one", test_one);
    g_test_add_func("/tui/sphere_shading/depth", test_depth);
    g_test_add_func("/tui/sphere_shading/sizes", test_sizes);
    g_test_add_func("/tui/sphere_shading/die", test_die);
    g_test_add_func("/tui/sphere_shading/value", test_value);
    g_test_add_func("/tui/sphere_shading/turned", test_rotated);
    return g_test_run();
}
