/* What there is to see, without a renderer: views, frames, edges, colours, sizes. */
#include "draw/scene.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/image.h"
#include "draw/rose.h"

static const struct gb_frame frame = {100.0, 50.0, 800.0, 600.0};

static struct gb_state *packing(int dimension)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 3, 0, &err));
    state->dimension = dimension;
    state->cell[0] = 4.0;
    state->cell[1] = dimension == 2 ? 1.0 : 5.0;
    state->cell[2] = 9.0;
    for (int i = 0; i < 3; i++) {
        state->position[3 * i] = 1.0 + i;
        state->position[3 * i + 2] = 2.0 * i;
        state->radius[i] = 0.5;
        state->contacts[i] = 6 * i;
    }
    return state;
}

static void assert_inside(const struct gb_view *view, const double point[3])
{
    double eye[3];
    double pixel[2];
    gb_view_eye(view, point, eye);
    gb_view_pixel(view, eye, pixel);
    g_assert_cmpfloat(pixel[0], >=, frame.left - 1e-6);
    g_assert_cmpfloat(pixel[1], >=, frame.top - 1e-6);
    g_assert_cmpfloat(pixel[0], <=, frame.left + frame.width + 1e-6);
    g_assert_cmpfloat(pixel[1], <=, frame.top + frame.height + 1e-6);
    g_assert_cmpfloat(eye[2], >=, view->near - 1e-9);
    g_assert_cmpfloat(eye[2], <=, view->far + 1e-9);
}

/* From everywhere the whole box is in the frame, and never behind the viewer. */
static void test_fit(void)
{
    const double cell[3] = {4.0, 5.0, 9.0};
    for (int flat = 0; flat < 2; flat++) {
        for (int a = -360; a <= 360; a += 45) {
            for (int e = -90; e <= 90; e += 30) {
                const struct gb_viewpoint viewpoint = {
                    .azimuth_deg = a, .elevation_deg = e, .orthographic = flat != 0};
                struct gb_view view;
                gb_view_init(&view, &viewpoint, cell, 0.5, &frame);
                for (int corner = 0; corner < 8; corner++) {
                    double point[3];
                    for (int k = 0; k < 3; k++) {
                        point[k] = (corner >> k & 1) != 0 ? cell[k] + 0.5 : -0.5;
                    }
                    assert_inside(&view, point);
                }
                g_assert_true(flat != 0 || view.near > 0.0);
            }
        }
    }
}

/* The frame of a sequence holds all corners of every cell, also of the tilted ones. */
static void test_fit_of_a_sequence(void)
{
    static const double tilt[][3] = {
        {0.0, 0.0, 0.0}, {2.0, -1.9, -2.4}, {-2.0, 2.0, 2.5}};
    struct gb_viewpoint viewpoint = {.azimuth_deg = -90.0};
    struct gb_cell cells[G_N_ELEMENTS(tilt)];
    struct gb_view view;
    for (size_t i = 0; i < G_N_ELEMENTS(tilt); i++) {
        gb_cell_init(&cells[i], 3, (const double[3]){4.0, 5.0, 9.0});
        memcpy(cells[i].tilt, tilt[i], sizeof tilt[i]);
        gb_view_include(&viewpoint, &cells[i]);
    }
    gb_view_init(&view, &viewpoint, cells[0].edge, 0.5, &frame);
    for (size_t i = 0; i < G_N_ELEMENTS(tilt); i++) {
        double matrix[3][3];
        gb_cell_matrix(&cells[i], matrix);
        for (int corner = 0; corner < 8; corner++) {
            double point[3];
            for (int k = 0; k < 3; k++) {
                point[k] = (corner & 1) * matrix[k][0] +
                           (corner >> 1 & 1) * matrix[k][1] +
                           (corner >> 2 & 1) * matrix[k][2];
            }
            assert_inside(&view, point);
        }
    }
}

static void test_front_is_upright(void)
{
    const double cell[3] = {4.0, 5.0, 9.0};
    const double low[3] = {0.0, 0.0, 0.0};
    const double high[3] = {4.0, 0.0, 9.0};
    double eye[2][3];
    struct gb_view view;
    struct gb_viewpoint viewpoint = {0};
    g_assert_true(gb_view_parse("front,flat", &viewpoint, NULL));
    gb_view_init(&view, &viewpoint, cell, 0.5, &frame);
    gb_view_eye(&view, low, eye[0]);
    gb_view_eye(&view, high, eye[1]);
    g_assert_cmpfloat_with_epsilon(eye[1][0] - eye[0][0], 4.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(eye[1][1] - eye[0][1], 9.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(eye[1][2], eye[0][2], 1e-12);
    g_assert_cmpfloat_with_epsilon(gb_view_scale(&view), 600.0 / 10.0, 1e-9);
}

static void test_views(void)
{
    struct gb_viewpoint viewpoint = {
        .azimuth_deg = 1.0, .elevation_deg = 2.0, .orthographic = false};
    struct gb_error err = {0};
    const char *wrong[] = {"",        "back",  "1",     "1,",    "1,2,3",
                           "nan,0",   "inf,0", "0,91",  "361,0", "1,2,flat,flat",
                           "corner ", ",flat", "0x10,1"};
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        g_assert_false(gb_view_parse(wrong[k], &viewpoint, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, "corner"));
        g_assert_cmpfloat(viewpoint.azimuth_deg, ==, 1.0);
    }
    g_assert_true(gb_view_parse("-30,12.5,flat", &viewpoint, &err));
    g_assert_cmpfloat(viewpoint.azimuth_deg, ==, -30.0);
    g_assert_cmpfloat(viewpoint.elevation_deg, ==, 12.5);
    g_assert_true(viewpoint.orthographic);
}

static void test_sizes(void)
{
    struct gb_error err = {0};
    int width = 0;
    int height = 0;
    const char *wrong[] = {"",       "x",         "1600",       "1600x",
                           "x1200",  "15x100",    "100x16385",  "99999999999x100",
                           "-5x100", "1600X1200", "1600x1200 ", "1e3x100"};
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        g_assert_false(gb_image_parse_size(wrong[k], &width, &height, &err));
        g_assert_nonnull(strstr(err.text, "16 to 16384"));
    }
    g_assert_true(gb_image_parse_size("16x16384", &width, &height, &err));
    g_assert_cmpint(width, ==, 16);
    g_assert_cmpint(height, ==, 16384);
}

/* Lightness grows along the scale: the order survives grey and any colour blindness. */
static void test_palette(void)
{
    double last = -1.0;
    uint8_t top[3];
    uint8_t beyond[3];
    for (int k = 0; k <= GB_IMAGE_MAP_CONTACTS; k++) {
        uint8_t rgb[3];
        gb_image_map_colour(NULL, (double)k / GB_IMAGE_MAP_CONTACTS, rgb);
        const double light = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
        g_assert_cmpfloat(light, >, last + 5.0);
        last = light;
    }
    gb_image_map_colour(NULL, 1.0, top);
    gb_image_map_colour(NULL, 100.0, beyond);
    g_assert_cmpint(memcmp(top, beyond, 3), ==, 0);
    gb_image_map_colour(NULL, 0.0, top);
    gb_image_map_colour(NULL, -3.0 / GB_IMAGE_MAP_CONTACTS, beyond);
    g_assert_cmpint(memcmp(top, beyond, 3), ==, 0);
}

static void test_scene(void)
{
    struct gb_scene *scene = NULL;
    struct gb_error err = {0};
    struct gb_state *state = packing(3);
    const struct gb_viewpoint viewpoint = {
        .azimuth_deg = -58.0, .elevation_deg = 20.0, .orthographic = false};
    g_assert_true(gb_scene_create(&scene, state, NULL, &viewpoint, &frame,
                                  GB_BACKGROUND_WHITE, &err));
    g_assert_cmpuint(scene->count, ==, 3);
    g_assert_cmpint(scene->edge_count, ==, 12);
    for (int k = 0; k < 3; k++) {
        uint8_t rgb[3];
        gb_image_map_colour(NULL, (double)(6 * k) / GB_IMAGE_MAP_CONTACTS, rgb);
        g_assert_cmpint(memcmp(rgb, &scene->colour[4 * k], 3), ==, 0);
        g_assert_cmpfloat(scene->sphere[4 * k + 3], ==, 0.5F);
    }
    double sum = 0.0;
    for (int k = 0; k < 12; k++) {
        const float *e = scene->edge[k];
        sum += hypot(hypot(e[3] - e[0], e[4] - e[1]), e[5] - e[2]);
    }
    g_assert_cmpfloat_with_epsilon(sum, 4.0 * (4.0 + 5.0 + 9.0), 1e-3);
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* A die: rims of floor and bore, all of its lines on the wall. */
static void test_die(void)
{
    struct gb_scene *scene = NULL;
    struct gb_error err = {0};
    struct gb_state *state = packing(3);
    const struct gb_viewpoint viewpoint = {
        .azimuth_deg = 0.0, .elevation_deg = 90.0, .orthographic = true}; /* from above */
    state->cell[1] = state->cell[0];
    state->die_radius = 2.0;
    g_assert_true(gb_scene_create(&scene, state, NULL, &viewpoint, &frame,
                                  GB_BACKGROUND_WHITE, &err));
    g_assert_cmpint(scene->edge_count, ==, 2 * GB_SCENE_RING);
    for (int k = 0; k < scene->edge_count; k++) {
        g_assert_cmpfloat_with_epsilon(hypot(scene->edge[k][0], scene->edge[k][1]), 2.0,
                                       0.02);
    }
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* 2D: four edges, all at one depth, no perspective whatever was asked for. */
static void test_planar(void)
{
    struct gb_scene *scene = NULL;
    struct gb_error err = {0};
    struct gb_state *state = packing(2);
    const struct gb_viewpoint viewpoint = {
        .azimuth_deg = -58.0, .elevation_deg = 20.0, .orthographic = false};
    g_assert_true(gb_scene_create(&scene, state, NULL, &viewpoint, &frame,
                                  GB_BACKGROUND_WHITE, &err));
    g_assert_true(scene->view.orthographic);
    g_assert_cmpint(scene->edge_count, ==, 4);
    for (size_t k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(scene->sphere[4 * k + 2], 0.0F, 1e-6F);
    }
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* Forces of discs have no direction out of their plane: neither has the rose. */
static void test_planar_rose(void)
{
    enum { FORCES = 64 };
    static double axis[3 * FORCES], value[FORCES];
    struct gb_error err = {0};
    struct gb_scene *scene = NULL;
    struct gb_rose rose;
    const struct gb_viewpoint viewpoint = {.azimuth_deg = -58.0, .elevation_deg = 20.0};
    for (int k = 0; k < FORCES; k++) {
        axis[3 * k] = cos(M_PI * k / FORCES);
        axis[3 * k + 2] = sin(M_PI * k / FORCES);
        value[k] = 1.0 + 0.5 * axis[3 * k + 2] * axis[3 * k + 2];
    }
    g_assert_true(gb_rose_fit(&rose, 2, axis, value, FORCES, &err));
    const double reach = gb_rose_reach(&rose);
    g_assert_cmpfloat_with_epsilon(reach, 1.4, 1e-9); /* 1.5/1.25, rounded up */
    g_assert_true(gb_rose_scene(&scene, &rose, reach, &viewpoint, &frame,
                                GB_BACKGROUND_WHITE, &err));
    g_assert_true(scene->view.orthographic);
    for (size_t k = 0; k < 3 * scene->facets; k++) { /* eye coordinates: x, y, depth */
        g_assert_cmpfloat_with_epsilon(scene->facet[3 * k + 2], scene->facet[2], 1e-6F);
    }
    for (size_t k = 0; k < scene->rods; k++) {
        g_assert_cmpfloat_with_epsilon(scene->rod[8 * k + 2], scene->facet[2], 1e-6F);
        g_assert_cmpfloat_with_epsilon(scene->rod[8 * k + 6], scene->facet[2], 1e-6F);
    }
    gb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/scene/fit", test_fit);
    g_test_add_func("/draw/scene/fit-of-a-sequence", test_fit_of_a_sequence);
    g_test_add_func("/draw/scene/front-is-upright", test_front_is_upright);
    g_test_add_func("/draw/scene/views", test_views);
    g_test_add_func("/draw/scene/sizes", test_sizes);
    g_test_add_func("/draw/scene/palette", test_palette);
    g_test_add_func("/draw/scene/scene", test_scene);
    g_test_add_func("/draw/scene/die", test_die);
    g_test_add_func("/draw/scene/planar", test_planar);
    g_test_add_func("/draw/scene/planar-rose", test_planar_rose);
    return g_test_run();
}
