/* Pictures: a few spheres at known places, looked up in the pixels; the file. */
#include "small_packing.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <png.h>
#include <math.h>
#include <string.h>

#include "draw/image.h"
#include "draw/picture_style.h"

/* The coordination number whose colour has the hue nearest to a lit pixel. */
static int nearest_contacts(const uint8_t *pixel)
{
    int best = -1;
    double closest = 1e9;
    const double size = hypot(hypot(pixel[0], pixel[1]), pixel[2]);
    for (int k = 0; k <= GB_IMAGE_MAP_CONTACTS; k++) {
        uint8_t rgb[3];
        gb_image_map_colour(NULL, (double)k / GB_IMAGE_MAP_CONTACTS, rgb);
        const double full = hypot(hypot(rgb[0], rgb[1]), rgb[2]);
        double far = 0.0;
        for (int c = 0; c < 3; c++) {
            far += fabs(pixel[c] / size - rgb[c] / full);
        }
        if (far < closest) {
            closest = far;
            best = k;
        }
    }
    return best;
}

/* The sphere in front hides the one behind it; each has its colour; the rest is ground.
 */
static void test_colours_and_depth(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_image *image = small_packing_paint(&packing_image, state);
    g_assert_cmpint(
        abs(nearest_contacts(small_packing_particle(image, &packing_image, state, 0)) -
            2),
        <=, 1);
    g_assert_cmpint(
        abs(nearest_contacts(small_packing_particle(image, &packing_image, state, 2)) -
            7),
        <=, 1);
    const uint8_t white[4] = {255, 255, 255, 255};
    g_assert_cmpint(memcmp(small_packing_pixel(image, 2, 2), white, 4), ==, 0);
    gb_image_destroy(image);
    /* from the other side it is the other way round */
    g_assert_true(gb_view_parse("90,0,flat", &packing_image.viewpoint, NULL));
    image = small_packing_paint(&packing_image, state);
    g_assert_cmpint(
        nearest_contacts(small_packing_particle(image, &packing_image, state, 1)), >=,
        11);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* The silhouette is a disc of the right area: antialiased coverage, transparent ground.
 */
static void test_silhouette(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_caption_layout layout;
    double covered = 0.0;
    double inked = 0.0;
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    packing_image.background = GB_BACKGROUND_TRANSPARENT;
    struct gb_image *image = small_packing_paint(&packing_image, state);
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    const double scale = gb_view_scale(&scene->view);
    for (int y = 0; y < SMALL_PACKING_SIDE; y++) {
        for (int x = 0; x < SMALL_PACKING_SIDE; x++) {
            const double alpha = small_packing_pixel(image, x, y)[3] / 255.0;
            const bool inside = x > 30 && y > 30 && x < SMALL_PACKING_SIDE - 30 &&
                                y < SMALL_PACKING_SIDE - 30;
            covered += inside ? alpha : 0.0;
            inked += inside ? 0.0 : alpha;
        }
    }
    /* two discs: the third is hidden */
    g_assert_cmpfloat_with_epsilon(covered / (2.0 * G_PI * scale * scale), 1.0, 0.01);
    g_assert_cmpfloat(inked, >, SMALL_PACKING_SIDE); /* the box */
    gb_scene_destroy(scene);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void test_same_bits(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image;
    gb_packing_image_init(&packing_image);
    packing_image.width = 640;
    packing_image.height = 480;
    struct gb_image *one = small_packing_paint(&packing_image, state);
    struct gb_image *two = small_packing_paint(&packing_image, state);
    g_assert_cmpint(memcmp(one->rgba, two->rgba, (size_t)640 * 480 * 4), ==, 0);
    gb_image_destroy(one);
    gb_image_destroy(two);
    gb_state_destroy(state);
}

/* A picture wider than a tile has no seam: it is the same picture. */
static void test_tiles(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    packing_image.width = 2100; /* two tiles */
    packing_image.height = 300;
    struct gb_image *image = small_packing_paint(&packing_image, state);
    /* the middle column crosses the nearest sphere: its row must be as smooth there */
    const int y = 150;
    for (int x = 1030; x < 1070; x++) {
        for (int c = 0; c < 3; c++) {
            g_assert_cmpint(abs(small_packing_pixel(image, x, y)[c] -
                                small_packing_pixel(image, x + 1, y)[c]),
                            <=, 12);
        }
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void test_planar(void)
{
    struct gb_state *state = small_packing_make(2);
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_image *image = small_packing_paint(&packing_image, state);
    g_assert_cmpint(
        nearest_contacts(small_packing_particle(image, &packing_image, state, 1)), >=,
        11);
    g_assert_cmpint(
        abs(nearest_contacts(small_packing_particle(image, &packing_image, state, 0)) -
            2),
        <=, 1);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* Every allowed shape of image, however odd, is painted. */
static void test_odd_sizes(void)
{
    static const int sizes[][2] = {
        {16, 16}, {16, 3000}, {3000, 16}, {17, 243}, {241, 240}};
    struct gb_state *state = small_packing_make(3);
    for (size_t k = 0; k < G_N_ELEMENTS(sizes); k++) {
        struct gb_packing_image packing_image;
        gb_packing_image_init(&packing_image);
        packing_image.width = sizes[k][0];
        packing_image.height = sizes[k][1];
        gb_image_destroy(small_packing_paint(&packing_image, state));
    }
    gb_state_destroy(state);
}

/* The colour of a value does not depend on the depth: no fog, which would add 70 to red. */
static void test_no_fog(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    for (int i = 0; i < 3; i++) { /* at three depths, none in the shadow of another */
        state->position[3 * i] = 2.0 + 3.0 * i;
        state->position[3 * i + 1] = 1.0 + 4.0 * i;
        state->position[3 * i + 2] = 2.0 + 3.0 * i;
        state->radius[i] = 1.0;
        state->contacts[i] = 6;
    }
    struct gb_image *image = small_packing_paint(&packing_image, state);
    const uint8_t *near = small_packing_particle(image, &packing_image, state, 0);
    for (int i = 1; i < 3; i++) {
        const uint8_t *far = small_packing_particle(image, &packing_image, state, i);
        for (int c = 0; c < 3; c++) {
            g_assert_cmpint(abs(near[c] - far[c]), <=, 4);
        }
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* A cut is flat: particles on either side of its plane show discs of their sections, all of
 * one shade; what is beyond is not there. */
static void test_cut_faces(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_caption_layout layout;
    struct gb_error err = {0};
    static const double depth[3] = {4.6, 5.5, 6.2}; /* y of the centres, plane at 5 */
    static const double radius[3] = {1.0, 1.0, 1.0};
    for (int i = 0; i < 3; i++) {
        state->position[3 * i] = state->position[3 * i + 2] = 2.0 + 3.0 * i;
        state->position[3 * i + 1] = depth[i];
        state->radius[i] = radius[i];
        state->contacts[i] = 6;
    }
    g_assert_true(gb_view_parse("90,0,flat", &packing_image.viewpoint, NULL));
    g_assert_true(gb_picture_style_parse_cut(&packing_image.style, "y=0.5", &err));
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    struct gb_image *image = small_packing_paint(&packing_image, state);
    g_assert_cmpuint(scene->count, ==, 2);
    const double scale = gb_view_scale(&scene->view);
    const uint8_t *face = NULL;
    for (int i = 0; i < 2; i++) {
        const float *ball = &scene->sphere[4 * i];
        const double section = sqrt(1.0 - (depth[i] - 5.0) * (depth[i] - 5.0));
        double pixel[2];
        gb_view_pixel(&scene->view, (const double[3]){ball[0], ball[1], ball[2]}, pixel);
        face = face != NULL ? face : small_packing_pixel(image, pixel[0], pixel[1]);
        for (int k = 0; k < 16; k++) {
            const double x = scale * section * cos(G_PI * k / 8.0);
            const double y = scale * section * sin(G_PI * k / 8.0);
            const uint8_t *inside =
                small_packing_pixel(image, pixel[0] + 0.9 * x, pixel[1] + 0.9 * y);
            const uint8_t *outside =
                small_packing_pixel(image, pixel[0] + 1.08 * x, pixel[1] + 1.08 * y);
            for (int c = 0; c < 3; c++) {
                g_assert_cmpint(abs(inside[c] - face[c]), <=, 6);
            }
            g_assert_true(i == 0 || outside[0] == 255);
        }
    }
    gb_scene_destroy(scene);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void assert_text(png_const_textp text, int count, const char *key,
                        const char *value)
{
    for (int k = 0; k < count; k++) {
        if (strcmp(text[k].key, key) == 0) {
            g_assert_cmpstr(text[k].text, ==, value);
            return;
        }
    }
    g_error("no text chunk %s", key);
}

static void test_file(void)
{
    char *folder = g_dir_make_tmp("greenbody-draw-XXXXXX", NULL);
    char *path = g_build_filename(folder, "x.png", NULL);
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image = small_packing_front();
    struct gb_error err = {0};
    packing_image.preset = "[scene]\ntitle = Al₂O₃\n";
    g_assert_true(gb_packing_image_write(&packing_image, state, path, &err));
    char *preset = NULL;
    g_assert_true(gb_image_read_text(path, "Preset", &preset, &err));
    g_assert_cmpstr(preset, ==, packing_image.preset);
    g_free(preset);
    g_assert_false(gb_image_read_text(path, "Nothing", &preset, &err));
    g_assert_nonnull(strstr(err.text, "no text chunk Nothing"));

    FILE *file = fopen(path, "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_textp text = NULL;
    int count = 0;
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    g_assert_cmpint((int)png_get_image_width(png, info), ==, SMALL_PACKING_SIDE);
    g_assert_cmpint((int)png_get_image_height(png, info), ==, SMALL_PACKING_SIDE);
    png_get_text(png, info, &text, &count);
    assert_text(text, count, "Software", "greenbody " GB_VERSION);
    assert_text(text, count, "Title", "Al₂O₃ test");
    assert_text(text, count, "Seed", "42");
    assert_text(text, count, "Point", "load, step 0");
    assert_text(text, count, "Density", "0.5123");
    assert_text(text, count, "Pressure", "100 MPa");
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);

    g_remove(path);
    g_rmdir(folder);
    g_assert_false(gb_packing_image_write(&packing_image, state, path, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
    g_assert_nonnull(strstr(err.text, path));
    g_assert_false(gb_packing_image_write(&packing_image, state, "/dev/null", &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_state_destroy(state);
    g_free(path);
    g_free(folder);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/snapshot/colours-and-depth", test_colours_and_depth);
    g_test_add_func("/draw/snapshot/silhouette", test_silhouette);
    g_test_add_func("/draw/snapshot/same-bits", test_same_bits);
    g_test_add_func("/draw/snapshot/tiles", test_tiles);
    g_test_add_func("/draw/snapshot/planar", test_planar);
    g_test_add_func("/draw/snapshot/odd-sizes", test_odd_sizes);
    g_test_add_func("/draw/snapshot/no-fog", test_no_fog);
    g_test_add_func("/draw/snapshot/cut-faces", test_cut_faces);
    g_test_add_func("/draw/snapshot/file", test_file);
    return g_test_run();
}
