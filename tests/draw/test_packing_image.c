/* Pictures: a few spheres at known places, looked up in the pixels. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <png.h>
#include <string.h>

#include "draw/caption/caption.h"
#include "draw/image/palette.h"
#include "draw/image/png.h"
#include "draw/image/print_size.h"
#include "draw/packing_image.h"
#include "draw/style/picture_colours.h"
#include "draw/style/picture_style_parse.h"

enum { SIDE = 400 };

/* One sphere in front of another, and one aside; the box is large. */
static struct gb_state *packing(int dimension)
{
    static const double centre[3][3] = {
        {5.0, 2.0, 5.0}, {5.0, 8.0, 5.0}, {2.0, 5.0, 8.0}};
    static const int contacts[3] = {2, 12, 7};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, 3, 0, &err));
    state->dimension = dimension;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = dimension == 2 && k == 1 ? 1.0 : 10.0;
        memcpy(&state->position[3 * k], centre[k], sizeof centre[k]);
        state->radius[k] = k == 1 ? 0.9 : 1.0;
        state->contacts[k] = contacts[k];
        if (dimension == 2) {
            state->position[3 * k] = 2.0 + 3.0 * k;
            state->position[3 * k + 1] = 0.0;
        }
    }
    state->point.density = 0.5123;
    state->point.p_pa = 1e8;
    state->metre_per_length = 1e-8;
    state->seed = 42;
    g_strlcpy(state->preset, "Al₂O₃ test", sizeof state->preset);
    return state;
}

static struct gb_packing_image front(void)
{
    struct gb_packing_image packing_image;
    gb_packing_image_init(&packing_image);
    packing_image.width = packing_image.height = SIDE;
    packing_image.annotated = false;
    g_assert_true(gb_view_parse("front", &packing_image.viewpoint, NULL));
    return packing_image;
}

static struct gb_image *paint(const struct gb_packing_image *packing_image,
                              const struct gb_state *state)
{
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    const bool done = gb_packing_image_render(&image, packing_image, state, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(done);
    return image;
}

static const uint8_t *at(const struct gb_image *image, double x, double y)
{
    return &image->rgba[4 *
                        ((size_t)lround(y) * (size_t)image->width + (size_t)lround(x))];
}

/* The scene and the page of a picture. */
static struct gb_scene *scene_of(const struct gb_packing_image *packing_image,
                                 const struct gb_state *state,
                                 struct gb_caption_layout *layout)
{
    const struct gb_frame page = {0.0, 0.0, SIDE, SIDE};
    struct gb_picture_style *style = NULL;
    struct gb_scene *scene = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_picture_style_create(&style, state, &packing_image->style, &err));
    g_assert_true(gb_scene_create(&scene, state, style, &packing_image->viewpoint, &page,
                                  packing_image->background, &err));
    gb_packing_image_arrange(packing_image, style, scene, layout);
    gb_picture_style_destroy(style);
    return scene;
}

/* Where the camera of a picture sees a particle. */
static const uint8_t *particle(const struct gb_image *image,
                               const struct gb_packing_image *packing_image,
                               const struct gb_state *state, int index)
{
    struct gb_caption_layout layout;
    struct gb_scene *scene = scene_of(packing_image, state, &layout);
    double pixel[2];
    const float *ball = &scene->sphere[4 * index];
    gb_view_pixel(&scene->view, (const double[3]){ball[0], ball[1], ball[2]}, pixel);
    gb_scene_destroy(scene);
    return at(image, pixel[0], pixel[1]);
}

/* The coordination number whose colour has the hue nearest to a lit pixel. */
static int nearest_contacts(const uint8_t *pixel)
{
    int best = -1;
    double closest = 1e9;
    const double size = hypot(hypot(pixel[0], pixel[1]), pixel[2]);
    for (int k = 0; k <= GB_PALETTE_CONTACTS; k++) {
        uint8_t rgb[3];
        gb_palette_contacts(k, rgb);
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
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
    struct gb_image *image = paint(&packing_image, state);
    g_assert_cmpint(abs(nearest_contacts(particle(image, &packing_image, state, 0)) - 2),
                    <=, 1);
    g_assert_cmpint(abs(nearest_contacts(particle(image, &packing_image, state, 2)) - 7),
                    <=, 1);
    const uint8_t white[4] = {255, 255, 255, 255};
    g_assert_cmpint(memcmp(at(image, 2, 2), white, 4), ==, 0);
    gb_image_destroy(image);
    /* from the other side it is the other way round */
    g_assert_true(gb_view_parse("90,0,flat", &packing_image.viewpoint, NULL));
    image = paint(&packing_image, state);
    g_assert_cmpint(nearest_contacts(particle(image, &packing_image, state, 1)), >=, 11);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* The silhouette is a disc of the right area: antialiased coverage, transparent ground.
 */
static void test_silhouette(void)
{
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
    struct gb_caption_layout layout;
    double covered = 0.0;
    double inked = 0.0;
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    packing_image.background = GB_BACKGROUND_TRANSPARENT;
    struct gb_image *image = paint(&packing_image, state);
    struct gb_scene *scene = scene_of(&packing_image, state, &layout);
    const double scale = gb_view_scale(&scene->view);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            const double alpha = at(image, x, y)[3] / 255.0;
            const bool inside = x > 30 && y > 30 && x < SIDE - 30 && y < SIDE - 30;
            covered += inside ? alpha : 0.0;
            inked += inside ? 0.0 : alpha;
        }
    }
    /* two discs: the third is hidden */
    g_assert_cmpfloat_with_epsilon(covered / (2.0 * G_PI * scale * scale), 1.0, 0.01);
    g_assert_cmpfloat(inked, >, SIDE); /* the box */
    gb_scene_destroy(scene);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void test_same_bits(void)
{
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image;
    gb_packing_image_init(&packing_image);
    packing_image.width = 640;
    packing_image.height = 480;
    struct gb_image *one = paint(&packing_image, state);
    struct gb_image *two = paint(&packing_image, state);
    g_assert_cmpint(memcmp(one->rgba, two->rgba, (size_t)640 * 480 * 4), ==, 0);
    gb_image_destroy(one);
    gb_image_destroy(two);
    gb_state_destroy(state);
}

/* A picture wider than a tile has no seam: it is the same picture. */
static void test_tiles(void)
{
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
    packing_image.width = 2100; /* two tiles */
    packing_image.height = 300;
    struct gb_image *image = paint(&packing_image, state);
    /* the middle column crosses the nearest sphere: its row must be as smooth there */
    const int y = 150;
    for (int x = 1030; x < 1070; x++) {
        for (int c = 0; c < 3; c++) {
            g_assert_cmpint(abs(at(image, x, y)[c] - at(image, x + 1, y)[c]), <=, 12);
        }
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

static void test_colour_bar(void)
{
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image;
    struct gb_caption_layout layout;
    gb_packing_image_init(&packing_image);
    packing_image.width = 800;
    packing_image.height = 600;
    struct gb_image *image = paint(&packing_image, state);
    gb_scene_destroy(scene_of(&packing_image, state, &layout));
    const double step = layout.bar.height / (GB_PALETTE_CONTACTS + 1);
    for (int k = 0; k <= GB_PALETTE_CONTACTS; k++) {
        uint8_t rgb[3];
        const double y = layout.bar.top + layout.bar.height - (k + 0.5) * step;
        gb_palette_contacts(k, rgb);
        const uint8_t *pixel = at(image, layout.bar.left + 0.5 * layout.bar.width, y);
        g_assert_cmpint(memcmp(pixel, rgb, 3), ==, 0);
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* Particles of one size: a bar of one colour, that of the particles. */
static void test_one_value(void)
{
    struct gb_state *state = packing(3);
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
    struct gb_image *image = paint(&packing_image, state);
    gb_scene_destroy(scene_of(&packing_image, state, &layout));
    gb_palette_field(0.5, rgb);
    for (double part = 0.05; part < 1.0; part += 0.1) {
        const uint8_t *pixel = at(image, layout.bar.left + 0.5 * layout.bar.width,
                                  layout.bar.top + part * layout.bar.height);
        g_assert_cmpint(memcmp(pixel, rgb, 3), ==, 0);
    }
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* A column that is four times as high as wide, and the other way round. */
static struct gb_state *column(double width, double height)
{
    struct gb_state *state = packing(3);
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
            const uint8_t *pixel = side < 2 ? at(image, line, j) : at(image, j, line);
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
        packing_image.crop = GB_CAPTION_LAYOUT_CROP_BOTH;
        g_assert_true(gb_view_parse(views[k / 3], &packing_image.viewpoint, NULL));
        struct gb_caption_layout layout;
        struct gb_scene *scene = scene_of(&packing_image, state, &layout);
        const double unit = layout.unit;
        struct gb_image *image = paint(&packing_image, state);
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
        packing_image.crop = GB_CAPTION_LAYOUT_CROP_HEIGHT;
        image = paint(&packing_image, state);
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
            struct gb_print_size size;
            struct gb_caption_layout layout;
            struct gb_error err = {0};
            g_assert_true(gb_print_size_parse(widths[i], per_inch, &size, &err));
            g_assert_cmpint(size.width, ==, (int)round(8.0 / 2.54 * per_inch));
            g_assert_cmpint(size.height, ==, (int)round(0.75 * size.width));
            const struct gb_caption_page page = {.width = size.width,
                                                 .height = size.height,
                                                 .per_inch = per_inch,
                                                 .annotated = true,
                                                 .bar = true,
                                                 .aspect = 0.5};
            gb_caption_layout_arrange(&page, &layout);
            const double point = per_inch / 72.0;
            g_assert_cmpfloat(layout.unit, >=, 7.0 * point);
            g_assert_cmpfloat(0.85 * layout.unit, >=, 6.0 * point); /* the smallest */
            g_assert_cmpfloat(layout.bar.left + layout.bar.width, <, size.width);
        }
    }
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
    struct gb_print_size size;
    for (size_t i = 0; i < G_N_ELEMENTS(columns); i++) {
        g_assert_true(gb_print_size_parse(columns[i].name, 600, &size, &err));
        g_assert_cmpint(size.width, ==, (int)round(columns[i].mm / 25.4 * 600.0));
    }
    for (const struct gb_print_size_journal *row = gb_print_size_journals;
         row->name != NULL; row++) {
        char *middle = g_strconcat(row->name, "-1.5", NULL);
        g_assert_true(gb_print_size_parse(row->name, 300, &size, &err));
        g_assert_cmpint(gb_print_size_parse(middle, 300, &size, NULL), ==,
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
    } wrong[] = {{"8", 300, "8cm, 80mm, 3.3in"}, {"8 m", 300, "2.54 to 50 cm"},
                 {"1mm", 300, "2.54 to 50 cm"},  {"8cm", 50, "100 to 1200"},
                 {"elsevier-3", 300, "elsevier-1.5"}, {"rsc-1.5", 300, "plot --help lists"},
                 {"elsevier90", 300, "elsevier-1.5"}, {"", 300, "8cm"},
                 {"-8cm", 300, "2.54 to 50 cm"}, {"50cm", 1200, "accepted 16384"}};
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        struct gb_print_size size;
        struct gb_error err = {0};
        g_assert_false(
            gb_print_size_parse(wrong[i].width, wrong[i].per_inch, &size, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (!strstr(err.text, wrong[i].text)) {
            g_error("%s: without %s", err.text, wrong[i].text);
        }
    }
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

static void test_planar(void)
{
    struct gb_state *state = packing(2);
    struct gb_packing_image packing_image = front();
    struct gb_image *image = paint(&packing_image, state);
    g_assert_cmpint(nearest_contacts(particle(image, &packing_image, state, 1)), >=, 11);
    g_assert_cmpint(abs(nearest_contacts(particle(image, &packing_image, state, 0)) - 2),
                    <=, 1);
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* Every allowed shape of image, however odd, is painted. */
static void test_odd_sizes(void)
{
    static const int sizes[][2] = {
        {16, 16}, {16, 3000}, {3000, 16}, {17, 243}, {241, 240}};
    struct gb_state *state = packing(3);
    for (size_t k = 0; k < G_N_ELEMENTS(sizes); k++) {
        struct gb_packing_image packing_image;
        gb_packing_image_init(&packing_image);
        packing_image.width = sizes[k][0];
        packing_image.height = sizes[k][1];
        gb_image_destroy(paint(&packing_image, state));
    }
    gb_state_destroy(state);
}

/* Two particles one behind the other, pressed: seen from the side the rod between them
 * has its colour; seen along it the nearer particle hides it. */
static void test_forces(void)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    struct gb_packing_image packing_image = front();
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
    struct gb_image *image = paint(&packing_image, state);
    const uint8_t *middle = at(image, 0.5 * SIDE, 0.5 * SIDE);
    g_assert_cmpint(middle[2], >, middle[0] + 40); /* blue: pressed */
    gb_image_destroy(image);
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    image = paint(&packing_image, state);
    middle = at(image, 0.5 * SIDE, 0.5 * SIDE);
    g_assert_cmpint(middle[0], >, middle[2] + 40); /* yellow: 12 contacts */
    gb_image_destroy(image);
    gb_state_destroy(state);
}

/* The colour of a value does not depend on the depth: no fog, which would add 70 to red. */
static void test_no_fog(void)
{
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
    g_assert_true(gb_view_parse("front,flat", &packing_image.viewpoint, NULL));
    for (int i = 0; i < 3; i++) { /* at three depths, none in the shadow of another */
        state->position[3 * i] = 2.0 + 3.0 * i;
        state->position[3 * i + 1] = 1.0 + 4.0 * i;
        state->position[3 * i + 2] = 2.0 + 3.0 * i;
        state->radius[i] = 1.0;
        state->contacts[i] = 6;
    }
    struct gb_image *image = paint(&packing_image, state);
    const uint8_t *near = particle(image, &packing_image, state, 0);
    for (int i = 1; i < 3; i++) {
        const uint8_t *far = particle(image, &packing_image, state, i);
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
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
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
    struct gb_scene *scene = scene_of(&packing_image, state, &layout);
    struct gb_image *image = paint(&packing_image, state);
    g_assert_cmpuint(scene->count, ==, 2);
    const double scale = gb_view_scale(&scene->view);
    const uint8_t *face = NULL;
    for (int i = 0; i < 2; i++) {
        const float *ball = &scene->sphere[4 * i];
        const double section = sqrt(1.0 - (depth[i] - 5.0) * (depth[i] - 5.0));
        double pixel[2];
        gb_view_pixel(&scene->view, (const double[3]){ball[0], ball[1], ball[2]}, pixel);
        face = face != NULL ? face : at(image, pixel[0], pixel[1]);
        for (int k = 0; k < 16; k++) {
            const double x = scale * section * cos(G_PI * k / 8.0);
            const double y = scale * section * sin(G_PI * k / 8.0);
            const uint8_t *inside = at(image, pixel[0] + 0.9 * x, pixel[1] + 0.9 * y);
            const uint8_t *outside = at(image, pixel[0] + 1.08 * x, pixel[1] + 1.08 * y);
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

/* Dark or coloured pixels of a column of the image around a row. */
static int thickness(const struct gb_image *image, double x, double y)
{
    int count = 0;
    for (int side = -1; side <= 1; side += 2) {
        for (int k = side > 0 ? 0 : 1; k < 60 && at(image, x, y + side * k)[0] < 200; k++) {
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
    struct gb_packing_image packing_image = front();
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
    struct gb_image *image = paint(&packing_image, state);
    struct gb_scene *scene = scene_of(&packing_image, state, &layout);
    for (int end = 0; end < 2; end++) {
        double one[2];
        const float *rod = &scene->rod[4 * end];
        gb_view_pixel(&scene->view, (const double[3]){rod[0], rod[1], rod[2]}, one);
        pixel[0] += 0.5 * one[0];
        pixel[1] += 0.5 * one[1];
    }
    const int shown = thickness(image, pixel[0], pixel[1]);
    g_assert_cmpint(shown, >, 10);
    const double step = GB_CAPTION_LAYOUT_LEGEND_LINE * layout.unit;
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
    struct gb_state *state = packing(3);
    struct gb_packing_image packing_image = front();
    struct gb_error err = {0};
    packing_image.preset = "[scene]\ntitle = Al₂O₃\n";
    g_assert_true(gb_packing_image_write(&packing_image, state, path, &err));
    char *preset = NULL;
    g_assert_true(gb_png_read_text(path, "Preset", &preset, &err));
    g_assert_cmpstr(preset, ==, packing_image.preset);
    g_free(preset);
    g_assert_false(gb_png_read_text(path, "Nothing", &preset, &err));
    g_assert_nonnull(strstr(err.text, "no text chunk Nothing"));

    FILE *file = fopen(path, "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_textp text = NULL;
    int count = 0;
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    g_assert_cmpint((int)png_get_image_width(png, info), ==, SIDE);
    g_assert_cmpint((int)png_get_image_height(png, info), ==, SIDE);
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
    g_test_add_func("/draw/snapshot/colour-bar", test_colour_bar);
    g_test_add_func("/draw/snapshot/one-value", test_one_value);
    g_test_add_func("/draw/snapshot/scale-bar", test_scale_bar);
    g_test_add_func("/draw/snapshot/crop", test_crop);
    g_test_add_func("/draw/snapshot/print-size", test_print_size);
    g_test_add_func("/draw/snapshot/print-size-columns", test_print_size_columns);
    g_test_add_func("/draw/snapshot/print-size-refused", test_print_size_refused);
    g_test_add_func("/draw/snapshot/planar", test_planar);
    g_test_add_func("/draw/snapshot/odd-sizes", test_odd_sizes);
    g_test_add_func("/draw/snapshot/forces", test_forces);
    g_test_add_func("/draw/snapshot/no-fog", test_no_fog);
    g_test_add_func("/draw/snapshot/cut-faces", test_cut_faces);
    g_test_add_func("/draw/snapshot/rod-scale", test_rod_scale);
    g_test_add_func("/draw/snapshot/file", test_file);
    return g_test_run();
}
