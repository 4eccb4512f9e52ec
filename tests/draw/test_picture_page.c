/* The page of a picture: crop, colour bar, scale bar, sizes in print. */
#include "small_packing.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/caption.h"
#include "draw/image.h"
#include "draw/picture_colours.h"

static void test_colour_bar(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image;
    struct gb_caption_layout layout;
    gb_packing_image_init(&packing_image);
    packing_image.width = 800;
    packing_image.height = 600;
    struct gb_image *image = small_packing_paint(&packing_image, state);
    gb_scene_destroy(small_packing_scene(&packing_image, state, &layout));
    const double step = layout.bar.height / (GB_IMAGE_MAP_CONTACTS + 1);
    for (int k = 0; k <= GB_IMAGE_MAP_CONTACTS; k++) {
        uint8_t rgb[3];
        const double y = layout.bar.top + layout.bar.height - (k + 0.5) * step;
        gb_image_map_colour(NULL, (double)k / GB_IMAGE_MAP_CONTACTS, rgb);
        const uint8_t *pixel =
            small_packing_pixel(image, layout.bar.left + 0.5 * layout.bar.width, y);
        g_assert_cmpint(memcmp(pixel, rgb, 3), ==, 0);
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* Particles of one size: a bar of one colour, that of the particles. */
static void test_one_value(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image;
    struct gb_caption_layout layout;
    uint8_t rgb[3];
    gb_packing_image_init(&packing_image);
    packing_image.width = 800;
    packing_image.height = 600;
    packing_image.style.particles = gb_picture_colours_find("size");
    for (int i = 0; i < 3; i++) {
        state->radius[i] = 1.0;
    }
    struct gb_image *image = small_packing_paint(&packing_image, state);
    gb_scene_destroy(small_packing_scene(&packing_image, state, &layout));
    gb_image_map_colour(NULL, 0.5, rgb);
    for (double part = 0.05; part < 1.0; part += 0.1) {
        const uint8_t *pixel =
            small_packing_pixel(image, layout.bar.left + 0.5 * layout.bar.width,
                                layout.bar.top + part * layout.bar.height);
        g_assert_cmpint(memcmp(pixel, rgb, 3), ==, 0);
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void test_scale_bar(void)
{
    char label[64];
    g_assert_cmpfloat_with_epsilon(gb_caption_bar_length(7e-8, label, sizeof label), 5e-8,
                                   1e-20);
    g_assert_cmpstr(label, ==, "50 nm");
    g_assert_cmpfloat_with_epsilon(gb_caption_bar_length(1e-6, label, sizeof label), 1e-6,
                                   1e-20);
    g_assert_cmpfloat_with_epsilon(gb_caption_bar_length(4.9e-9, label, sizeof label),
                                   2e-9, 1e-20);
}

/* On the page of a panel 4 cm wide the text of the scale bar ends before the axes. */
static void test_scale_bar_text(void)
{
    struct gb_state *state = small_packing_make(3);
    struct gb_packing_image packing_image;
    struct gb_caption_layout layout;
    gb_packing_image_init(&packing_image);
    packing_image.per_inch = 150;
    packing_image.width = 236;
    packing_image.height = 220;
    struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
    struct gb_image *image = small_packing_paint(&packing_image, state);
    g_assert_cmpfloat(layout.unit, >, 0.0);
    const int row = image->height - (int)(1.4 * layout.unit);
    int text = 0;
    for (int y = row - (int)(0.5 * layout.unit); y < row + (int)(0.5 * layout.unit);
         y++) {
        for (int x = 0; x < image->width; x++) {
            const bool ink = small_packing_pixel(image, x, y)[0] < 128;
            text += ink && x < (int)layout.axes.left;
            g_assert_false(ink && fabs(x - layout.axes.left) < 2.0);
        }
    }
    g_assert_cmpint(text, >, 100);
    gb_image_destroy(image);
    gb_scene_destroy(scene);
    gb_state_destroy(state);
}

/* A column that is four times as high as wide, and the other way round. */
static struct gb_state *column(double width, double height)
{
    struct gb_state *state = small_packing_make(3);
    state->cell[0] = state->cell[1] = width;
    state->cell[2] = height;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            state->position[3 * i + k] *= state->cell[k] / 10.0;
        }
    }
    return state;
}

/* Empty rows or columns of pixels at a side of an image: 0 left, 1 right, 2 top, 3 bottom. */
static int margin_at(const struct gb_image *image, int side)
{
    const int lines = side < 2 ? image->width : image->height;
    const int along = side < 2 ? image->height : image->width;
    for (int k = 0; k < lines; k++) {
        const int line = side % 2 == 0 ? k : lines - 1 - k;
        for (int j = 0; j < along; j++) {
            const uint8_t *pixel = side < 2 ? small_packing_pixel(image, line, j)
                                            : small_packing_pixel(image, j, line);
            if (pixel[0] != 255 || pixel[1] != 255 || pixel[2] != 255) {
                return k;
            }
        }
    }
    return lines;
}

/* A cropped picture has no empty margin on any side, whatever the shape of the packing; in
 * print its width stays.  Between packing and bar the gap is that of the bar's title. */
static void test_crop(void)
{
    static const double shapes[][2] = {{3.0, 12.0}, {10.0, 10.0}, {20.0, 5.0}};
    static const char *const views[] = {"corner", "front,flat", "top", "-20,60"};
    for (size_t k = 0; k < 3 * G_N_ELEMENTS(views); k++) {
        struct gb_state *state = column(shapes[k % 3][0], shapes[k % 3][1]);
        struct gb_packing_image packing_image;
        gb_packing_image_init(&packing_image);
        packing_image.width = 400;
        packing_image.height = 300;
        packing_image.crop = GB_CAPTION_CROP_BOTH;
        g_assert_true(gb_view_parse(views[k / 3], &packing_image.viewpoint, NULL));
        struct gb_caption_layout layout;
        struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
        const double unit = layout.unit;
        struct gb_image *image = small_packing_paint(&packing_image, state);
        g_assert_cmpint(image->width, <=, 400);
        g_assert_cmpint(image->height, <=, 300);
        for (int side = 0; side < 4; side++) {
            g_assert_cmpint(margin_at(image, side), <=, (int)(2.5 * unit));
        }
        /* the outline meets its room on two sides */
        const double wide =
            scene->view.focal * (scene->view.high[0] - scene->view.low[0]);
        const double high =
            scene->view.focal * (scene->view.high[1] - scene->view.low[1]);
        g_assert_cmpfloat_with_epsilon(wide, layout.scene.width, 1.0);
        g_assert_cmpfloat(layout.bar.left - layout.scene.left - wide, <, 3.0 * unit);
        g_assert_true(high > layout.scene.height - 1.0 ||
                      layout.scene.height < 12.5 * unit);
        gb_image_destroy(image);
        gb_scene_destroy(scene);
        packing_image.width = 315;
        packing_image.height = 300;
        packing_image.per_inch = 100;
        packing_image.crop = GB_CAPTION_CROP_HEIGHT;
        image = small_packing_paint(&packing_image, state);
        g_assert_cmpint(image->width, ==, 315);
        g_assert_cmpint(image->height, <=, (int)(1.25 * 315) + 1);
        for (int side = 2; side < 4; side++) {
            g_assert_cmpint(margin_at(image, side), <=, (int)(2.5 * 10.3));
        }
        gb_image_destroy(image);
        gb_state_destroy(state);
    }
}

/* Letters of captions and figures have their size in print, whatever the resolution. */
static void test_print_size(void)
{
    static const char *const widths[] = {"8cm", "80 mm", "3.149606in"};
    for (size_t i = 0; i < G_N_ELEMENTS(widths); i++) {
        for (int per_inch = 150; per_inch <= 600; per_inch *= 2) {
            struct gb_image_print size;
            struct gb_caption_layout layout;
            struct gb_error err = {0};
            g_assert_true(gb_image_parse_print(widths[i], per_inch, &size, &err));
            g_assert_cmpint(size.width, ==, (int)round(8.0 / 2.54 * per_inch));
            g_assert_cmpint(size.height, ==, (int)round(0.75 * size.width));
            const struct gb_caption_page page = {.width = size.width,
                                                 .height = size.height,
                                                 .per_inch = per_inch,
                                                 .annotated = true,
                                                 .bar = true,
                                                 .aspect = 0.5};
            gb_caption_arrange(&page, &layout);
            const double point = per_inch / 72.0;
            g_assert_cmpfloat(layout.unit, >=, 7.0 * point);
            g_assert_cmpfloat(0.85 * layout.unit, >=, 6.0 * point); /* the smallest */
            g_assert_cmpfloat(layout.bar.left + layout.bar.width, <, size.width);
        }
    }
}

/* Rows of ink in some columns of an image, one below the other: the shortest run, pixels. */
static int shortest_glyph(const struct gb_image *image, double left, double right,
                          double top, double bottom)
{
    int shortest = 10000, run = 0, glyphs = 0;
    for (int y = (int)top; y < (int)bottom; y++) {
        bool ink = false;
        for (int x = (int)left; x < (int)right; x++) {
            ink = ink || small_packing_pixel(image, x, y)[0] < 128;
        }
        if (!ink && run > 0) {
            shortest = run < shortest ? run : shortest;
            glyphs++;
        }
        run = ink ? run + 1 : 0;
    }
    g_assert_cmpint(glyphs, >, 0);
    return shortest;
}

/* Digits of a picture that is 8 cm wide are those of letters of at least 6 points: they are
 * 0.729 of their size high. */
static void test_glyph_height(void)
{
    static const double digit = 0.729;
    struct gb_state *state = small_packing_make(3);
    state->pressed[2] = 1.0;
    for (int per_inch = 300; per_inch <= 600; per_inch += 300) {
        struct gb_packing_image packing_image;
        struct gb_image_print size;
        struct gb_caption_layout layout;
        struct gb_error err = {0};
        gb_packing_image_init(&packing_image);
        g_assert_true(gb_image_parse_print("8cm", per_inch, &size, &err));
        packing_image.width = size.width;
        packing_image.height = size.height;
        packing_image.per_inch = per_inch;
        packing_image.crop = GB_CAPTION_CROP_HEIGHT;
        struct gb_image *image = small_packing_paint(&packing_image, state);
        struct gb_scene *scene = small_packing_scene(&packing_image, state, &layout);
        const double ticks = layout.bar.left + layout.bar.width + 0.5 * layout.unit;
        const int heights[] = {shortest_glyph(image, ticks, ticks + 0.9 * layout.unit,
                                              layout.bar.top,
                                              layout.bar.top + layout.bar.height),
                               shortest_glyph(image, 1.4 * layout.unit, layout.axes.left,
                                              image->height - 3.8 * layout.unit,
                                              image->height - 2.1 * layout.unit)};
        for (size_t k = 0; k < G_N_ELEMENTS(heights); k++) {
            g_test_message("%d pixels: %.2f points", heights[k],
                           heights[k] / digit * 72.0 / per_inch);
            g_assert_cmpfloat((heights[k] + 1) / digit * 72.0 / per_inch, >=, 6.0);
        }
        gb_scene_destroy(scene);
        gb_image_destroy(image);
    }
    gb_state_destroy(state);
}

/* Columns of journals by name, and what those without one and a half columns lack. */
static void test_print_size_columns(void)
{
    static const struct {
        const char *name;
        double mm;
    } columns[] = {{"elsevier", 90.0}, {"elsevier-1.5", 140.0}, {"elsevier-2", 190.0},
                   {"aps", 86.0},      {"nature-2", 183.0},     {"rsc", 83.0}};
    struct gb_error err = {0};
    struct gb_image_print size;
    for (size_t i = 0; i < G_N_ELEMENTS(columns); i++) {
        g_assert_true(gb_image_parse_print(columns[i].name, 600, &size, &err));
        g_assert_cmpint(size.width, ==, (int)round(columns[i].mm / 25.4 * 600.0));
    }
    for (const struct gb_image_journal *row = gb_image_journals; row->name != NULL;
         row++) {
        char *middle = g_strconcat(row->name, "-1.5", NULL);
        g_assert_true(gb_image_parse_print(row->name, 300, &size, &err));
        g_assert_cmpint(gb_image_parse_print(middle, 300, &size, NULL), ==,
                        row->middle_mm > 0.0);
        g_assert_cmpfloat(row->single_mm, <, row->double_mm);
        g_free(middle);
    }
}

static void test_print_size_refused(void)
{
    static const struct {
        const char *width;
        int per_inch;
        const char *text;
    } wrong[] = {
        {"8", 300, "8cm, 80mm, 3.3in"},      {"8 m", 300, "2.54 and 50 cm"},
        {"1mm", 300, "2.54 and 50 cm"},      {"8cm", 50, "100 and 1200"},
        {"elsevier-3", 300, "elsevier-1.5"}, {"rsc-1.5", 300, "plot --help lists"},
        {"elsevier90", 300, "elsevier-1.5"}, {"", 300, "8cm"},
        {"-8cm", 300, "2.54 and 50 cm"},     {"50cm", 1200, "16384"}};
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        struct gb_image_print size;
        struct gb_error err = {0};
        g_assert_false(
            gb_image_parse_print(wrong[i].width, wrong[i].per_inch, &size, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (!strstr(err.text, wrong[i].text)) {
            g_error("%s: without %s", err.text, wrong[i].text);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/snapshot/colour-bar", test_colour_bar);
    g_test_add_func("/draw/snapshot/one-value", test_one_value);
    g_test_add_func("/draw/snapshot/scale-bar", test_scale_bar);
    g_test_add_func("/draw/snapshot/scale-bar-text", test_scale_bar_text);
    g_test_add_func("/draw/snapshot/crop", test_crop);
    g_test_add_func("/draw/snapshot/print-size", test_print_size);
    g_test_add_func("/draw/snapshot/glyph-height", test_glyph_height);
    g_test_add_func("/draw/snapshot/print-size-columns", test_print_size_columns);
    g_test_add_func("/draw/snapshot/print-size-refused", test_print_size_refused);
    return g_test_run();
}
