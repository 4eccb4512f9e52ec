/* Packings drawn as lit spheres. */
#include <glib.h>

#include "tui/plot/sphere_shading.h"

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
    gb_sphere_shading_render(picture, ROWS, COLS, shade);
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
    gb_sphere_shading_render(near, ROWS, COLS, shade);
    const float front = brightest();
    gb_sphere_shading_render(far, ROWS, COLS, shade);
    const float back = brightest();
    g_assert_cmpfloat(back, <, 0.7F * front);
    near->count = 2;
    for (int order = 0; order < 2; order++) {
        near->position[order][0] = near->position[order][2] = 4.5F;
        near->position[order][1] = 0.0F;
        near->position[1 - order][0] = near->position[1 - order][2] = 4.5F;
        near->position[1 - order][1] = 8.0F;
        gb_sphere_shading_render(near, ROWS, COLS, shade);
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
            gb_sphere_shading_render(picture, rows, cols, exact);
            g_assert_cmpfloat(exact[(rows / 2) * cols + cols / 2], >=, 0.0F);
            g_free(exact);
        }
    }
    g_free(picture);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/sphere_shading/one", test_one);
    g_test_add_func("/tui/sphere_shading/depth", test_depth);
    g_test_add_func("/tui/sphere_shading/sizes", test_sizes);
    return g_test_run();
}
