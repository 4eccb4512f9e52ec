/* What pictures show beside the packing: axes, arrows of pressing, the walls of a die. */
#include "small_packing.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/caption.h"

/* The packing in a die of radius 5 with a punch on it. */
static struct gb_state *make_die(void)
{
    struct gb_state *state = small_packing_make(3);
    state->die_radius = 5.0;
    state->punch_height = 10.0;
    state->pressed[2] = 1.0;
    return state;
}

static struct gb_packing_image page(const char *view)
{
    struct gb_packing_image packing_image;
    gb_packing_image_init(&packing_image);
    packing_image.width = 800;
    packing_image.height = 600;
    g_assert_true(gb_view_parse(view, &packing_image.viewpoint, NULL));
    return packing_image;
}

/* Dark pixels in a rectangle of an image. */
static int count_ink(const struct gb_image *image, const struct gb_frame *frame)
{
    int count = 0;
    for (int y = (int)frame->top; y < (int)(frame->top + frame->height); y++) {
        for (int x = (int)frame->left; x < (int)(frame->left + frame->width); x++) {
            const uint8_t *pixel = small_packing_pixel(image, x, y);
            count += pixel[0] < 90 && pixel[1] < 90 && pixel[2] < 90;
        }
    }
    return count;
}

/* Ink of the widest row of a third of a frame, 0 the upper one. */
static int widest_row(const struct gb_image *image, const struct gb_frame *frame,
                      int third)
{
    int widest = 0;
    for (int k = 0; k < (int)(frame->height / 3.0); k++) {
        const struct gb_frame row = {
            frame->left, frame->top + third * frame->height / 3.0 + k, frame->width, 1.0};
        const int ink = count_ink(image, &row);
        widest = ink > widest ? ink : widest;
    }
    return widest;
}

/* The axes stand in their frame: seen from the front there is ink along x and along z, and
 * nothing of it in a bare picture. */
static void test_axes(void)
{
    static const char *const views[] = {"corner", "front", "side", "top", "-20,-60"};
    struct gb_state *state = small_packing_make(3);
    for (size_t k = 0; k < G_N_ELEMENTS(views); k++) {
        struct gb_packing_image packing_image = page(views[k]);
        struct gb_caption_layout layout;
        struct gb_image *image = small_packing_paint(&packing_image, state);
        gb_scene_destroy(small_packing_scene(&packing_image, state, &layout));
        g_assert_cmpint(count_ink(image, &layout.axes), >, 60);
        g_assert_cmpfloat(layout.axes.left + layout.axes.width, <=, image->width);
        g_assert_cmpfloat(layout.axes.top + layout.axes.height, <=, image->height);
        gb_image_destroy(image);
        packing_image.annotated = false;
        image = small_packing_paint(&packing_image, state);
        const struct gb_frame corner = {780.0, 580.0, 20.0, 20.0};
        g_assert_cmpint(count_ink(image, &corner), ==, 0);
        gb_image_destroy(image);
    }
    gb_state_destroy(state);
}

/* Frame around the arrow of a scene, and nothing above its tail. */
static struct gb_frame arrow_frame(const struct gb_scene *scene, int arrow)
{
    double end[2][2];
    for (int k = 0; k < 2; k++) {
        const float *at = &scene->arrow[arrow][3 * k];
        gb_view_pixel(&scene->view, (const double[3]){at[0], at[1], at[2]}, end[k]);
    }
    return (struct gb_frame){fmin(end[0][0], end[1][0]) - 9.0, fmin(end[0][1], end[1][1]),
                             fabs(end[0][0] - end[1][0]) + 18.0,
                             fabs(end[0][1] - end[1][1])};
}

/* Pressed along z: one arrow, whose head is below its shaft, over the packing and within the
 * page.  Pressed from all sides, or not at all: none. */
static void test_arrow(void)
{
    static const double pressed[][3] = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0, 0, 0}};
    static const int arrows[] = {1, 2, 0, 0};
    static const enum gb_caption_crop crops[] = {GB_CAPTION_NO_CROP,
                                                        GB_CAPTION_CROP_BOTH};
    struct gb_state *state = small_packing_make(3);
    for (size_t k = 0; k < 2 * G_N_ELEMENTS(pressed); k++) {
        struct gb_packing_image packing_image = page("corner");
        struct gb_caption_layout layout;
        packing_image.crop = crops[k / 4];
        memcpy(state->pressed, pressed[k % 4], sizeof state->pressed);
        struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
        g_assert_cmpint(scene->arrows, ==, arrows[k % 4]);
        struct gb_image *image = small_packing_paint(&packing_image, state);
        for (int i = 0; i < scene->arrows; i++) {
            const struct gb_frame around = arrow_frame(scene, i);
            g_assert_cmpfloat(around.top, >=, layout.scene.top - 1.0);
            g_assert_cmpfloat(around.left, >, 0.0);
            g_assert_cmpfloat(around.left + around.width, <, image->width);
            g_assert_cmpint(count_ink(image, &around), >, 40);
        }
        if (k % 4 == 0) {
            const struct gb_frame around = arrow_frame(scene, 0);
            const int shaft = widest_row(image, &around, 0);
            g_assert_cmpint(shaft, >, 1);
            g_assert_cmpint(widest_row(image, &around, 2), >, 2 * shaft);
        }
        gb_image_destroy(image);
        gb_scene_destroy(scene);
    }
    gb_state_destroy(state);
}

/* Discs: an arrow along z alone; pressed along x and z: none. */
static void test_planar_arrow(void)
{
    struct gb_state *state = small_packing_make(2);
    struct gb_packing_image packing_image = page("corner");
    struct gb_caption_layout layout;
    state->pressed[2] = 1.0;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    g_assert_cmpint(scene->arrows, ==, 1);
    g_assert_cmpfloat_with_epsilon(scene->arrow[0][0], scene->arrow[0][3], 1e-5);
    gb_scene_destroy(scene);
    state->pressed[0] = state->pressed[1] = 1.0;
    scene = small_packing_scene(&packing_image, state, &layout);
    g_assert_cmpint(scene->arrows, ==, 0);
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* A die has its arrow while its punch is there. */
static void test_die_arrow(void)
{
    struct gb_state *state = make_die();
    struct gb_packing_image packing_image = page("corner");
    struct gb_caption_layout layout;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    g_assert_cmpint(scene->arrows, ==, 1);
    gb_scene_destroy(scene);
    state->punch_height = (double)NAN;
    scene = small_packing_scene(&packing_image, state, &layout);
    g_assert_cmpint(scene->arrows, ==, 0);
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* The word of pressing stands beside its arrow, within the page, and no line of box or die and
 * no particle is behind it; its letters are there. */
static void check_word(size_t k, enum gb_caption_crop crop,
                       const struct gb_state *state)
{
    static const char *const views[] = {"corner", "front", "side", "-58,35", "20,50"};
    struct gb_packing_image packing_image = page(views[k]);
    struct gb_caption_layout layout;
    struct gb_frame word;
    packing_image.crop = crop;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    const double unit = layout.unit;
    g_assert_cmpint(gb_caption_load_arrow(scene->arrow[0], scene->arrows), ==,
                    scene->arrows - 1);
    gb_caption_load_word(scene, scene->arrows - 1, unit, layout.width, 2.15 * unit, &word);
    const struct gb_frame arrow = arrow_frame(scene, scene->arrows - 1);
    g_assert_cmpfloat(word.left, >, 0.0);
    g_assert_cmpfloat(word.left + word.width, <, layout.width);
    g_assert_cmpfloat(word.top, >=, 2.1 * unit);
    if (k < 3) { /* from above the punch reaches higher than the arrow on it */
        g_assert_cmpfloat(word.top + word.height, >, arrow.top - unit);
    }
    g_assert_cmpfloat(word.left, <, arrow.left + arrow.width + unit);
    g_assert_cmpfloat(word.left + word.width, >, arrow.left - unit);
    for (int e = 0; e < scene->edge_count; e++) {
        for (int j = 0; j <= 64; j++) {
            double at[3], pixel[2];
            for (int i = 0; i < 3; i++) {
                const double from = scene->edge[e][i], to = scene->edge[e][3 + i];
                at[i] = from + j * (to - from) / 64.0;
            }
            gb_view_pixel(&scene->view, at, pixel);
            g_assert_false(pixel[0] > word.left && pixel[0] < word.left + word.width &&
                           pixel[1] > word.top && pixel[1] < word.top + word.height);
        }
    }
    struct gb_image *image = small_packing_paint(&packing_image, state);
    g_assert_cmpint(count_ink(image, &word), >, 40);
    gb_image_destroy(image);
    gb_scene_destroy(scene);
}

static void test_word(void)
{
    struct gb_state *state = make_die();
    struct gb_state *cell = small_packing_make(3);
    cell->pressed[1] = cell->pressed[2] = 1.0;
    for (size_t k = 0; k < 5; k++) {
        check_word(k, GB_CAPTION_NO_CROP, state);
        check_word(k, GB_CAPTION_CROP_BOTH, state);
        check_word(k, GB_CAPTION_CROP_BOTH, cell);
    }
    gb_state_destroy(cell);
    gb_state_destroy(state);
}

static const uint8_t *seen_at(const struct gb_image *image, const struct gb_scene *scene,
                              double x, double y, double z)
{
    double eye[3], pixel[2];
    gb_view_eye(&scene->view, (const double[3]){x, y, z}, eye);
    gb_view_pixel(&scene->view, eye, pixel);
    return small_packing_pixel(image, pixel[0], pixel[1]);
}

/* Walls are translucent: the ground and the particles are seen through them, a little darker;
 * what lies before them hides them.  Beside the die there is the ground. */
static void test_walls(void)
{
    struct gb_state *state = make_die();
    struct gb_packing_image packing_image = page("front,flat");
    struct gb_caption_layout layout;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    struct gb_image *image = small_packing_paint(&packing_image, state);
    const uint8_t *wall = seen_at(image, scene, 6.5, 5.0, 2.0);
    const uint8_t *rim = seen_at(image, scene, 9.7, 5.0, 2.0);
    const uint8_t *punch = seen_at(image, scene, 6.5, 5.0, 10.7);
    const uint8_t *beside = seen_at(image, scene, 10.3, 5.0, 2.0);
    g_assert_cmpint(wall[0], <, 252);
    g_assert_cmpint(wall[0], >, 190);
    g_assert_cmpint(rim[0], <, wall[0] - 20); /* more opaque at a grazing angle */
    g_assert_cmpint(punch[0], <, wall[0] - 20);
    g_assert_cmpint(beside[0], ==, 255);
    uint8_t through[3];
    memcpy(through, seen_at(image, scene, 5.0, 2.0, 5.0), 3);
    gb_image_destroy(image);
    gb_scene_destroy(scene);
    state->die_radius = 0.0;
    scene = small_packing_scene(&packing_image, state, &layout);
    image = small_packing_paint(&packing_image, state);
    const uint8_t *plain = seen_at(image, scene, 5.0, 2.0, 5.0);
    g_assert_true(memcmp(plain, through, 3) != 0);
    for (int c = 0; c < 3; c++) {
        g_assert_cmpint(abs(plain[c] - through[c]), <=, 24);
    }
    gb_image_destroy(image);
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* Funnel and bore are surfaces at their places; all of them lie within the cropped page. */
static void test_funnel(void)
{
    struct gb_state *state = make_die();
    struct gb_packing_image packing_image = page("corner");
    struct gb_caption_layout layout;
    double high = 0.0, wide = 0.0;
    packing_image.crop = GB_CAPTION_CROP_BOTH;
    state->punch_height = (double)NAN;
    state->funnel_height = 6.0;
    state->funnel_outlet = 3.0;
    state->funnel_slope = 2.0;
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    g_assert_cmpuint(scene->walls, ==, 4 * 2 * GB_SCENE_RING);
    for (size_t k = 0; k < 3 * scene->walls; k++) {
        const float *at = &scene->wall[7 * k]; /* from the middle of the box, 10 d */
        double pixel[2];
        high = fmax(high, at[1]);
        wide = fmax(wide, at[0]);
        gb_view_pixel(&scene->view, (const double[3]){at[0], at[1], at[2]}, pixel);
        g_assert_cmpfloat(pixel[0], >=, layout.scene.left - 0.5);
        g_assert_cmpfloat(pixel[1], >=, layout.scene.top - 0.5);
        g_assert_cmpfloat(pixel[0], <=, layout.width);
        g_assert_cmpfloat(pixel[1], <=, layout.scene.top + layout.scene.height + 0.5);
    }
    g_assert_cmpfloat_with_epsilon(high, 10.0 - 5.0, 1e-5);      /* up to the powder */
    g_assert_cmpfloat_with_epsilon(wide, 3.0 + 4.0 * 2.0, 1e-5); /* of the cone */
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* The far ones first; the same state gives the same picture. */
static void test_order(void)
{
    struct gb_state *state = make_die();
    struct gb_packing_image packing_image = page("corner");
    struct gb_caption_layout layout;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    double last = INFINITY;
    for (size_t k = 0; k < scene->walls; k++) {
        const float *wall = &scene->wall[GB_SCENE_WALL_NUMBERS * k];
        const double depth = wall[2] + wall[9] + wall[16];
        g_assert_cmpfloat(depth, <=, last + 1e-4);
        last = depth;
    }
    gb_scene_destroy(scene);
    struct gb_image *one = small_packing_paint(&packing_image, state);
    struct gb_image *two = small_packing_paint(&packing_image, state);
    g_assert_cmpint(memcmp(one->rgba, two->rgba, (size_t)800 * 600 * 4), ==, 0);
    gb_image_destroy(one);
    gb_image_destroy(two);
    gb_state_destroy(state);
}

/* Frames of a sequence keep the box, with room for punch and arrow, whatever they show. */
static void test_sequence(void)
{
    struct gb_state *state = make_die();
    struct gb_packing_image packing_image = page("corner");
    struct gb_caption_layout layout[2];
    const double extent[3] = {10.0, 10.0, 12.0};
    memcpy(packing_image.viewpoint.extent, extent, sizeof extent);
    struct gb_scene *pressed = small_packing_scene(&packing_image, state, &layout[0]);
    state->punch_height = (double)NAN;
    struct gb_scene *filled = small_packing_scene(&packing_image, state, &layout[1]);
    for (int k = 0; k < 2; k++) {
        g_assert_cmpfloat(pressed->view.low[k], ==, filled->view.low[k]);
        g_assert_cmpfloat(pressed->view.high[k], ==, filled->view.high[k]);
    }
    const struct gb_frame around = arrow_frame(pressed, 0);
    g_assert_cmpfloat(around.top, >=, layout[0].scene.top);
    gb_scene_destroy(filled);
    gb_scene_destroy(pressed);
    gb_state_destroy(state);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/picture/axes", test_axes);
    g_test_add_func("/draw/picture/arrow", test_arrow);
    g_test_add_func("/draw/picture/planar-arrow", test_planar_arrow);
    g_test_add_func("/draw/picture/die-arrow", test_die_arrow);
    g_test_add_func("/draw/picture/word-of-pressing", test_word);
    g_test_add_func("/draw/picture/walls", test_walls);
    g_test_add_func("/draw/picture/funnel", test_funnel);
    g_test_add_func("/draw/picture/order", test_order);
    g_test_add_func("/draw/picture/sequence", test_sequence);
    return g_test_run();
}
