/* Figures: axes as numbers, and ink at known places of the page. */
#include "draw/figure.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "draw/figure_curve.h"

enum { WIDE = 800, HIGH = 600, POINTS = 50 };

static const bool loose[2] = {false, false};

static void test_linear_axis(void)
{
    struct gb_figure_axis_scale scale;
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LINEAR, -0.013, 0.0498, 6, loose);
    g_assert_cmpfloat(scale.low, <=, -0.013);
    g_assert_cmpfloat(scale.high, >=, 0.0498);
    g_assert_cmpint(scale.ticks, >=, 4);
    for (int k = 0; k < scale.ticks; k++) {
        g_assert_cmpfloat(scale.tick[k], >=, scale.low - 1e-12);
        g_assert_cmpfloat(scale.tick[k], <=, scale.high + 1e-12);
    }
    /* the sign is a minus, not a hyphen */
    g_assert_cmpstr(scale.label[0], ==,
                    "\xe2\x88\x92"
                    "0.01");
    g_assert_cmpstr(scale.label[1], ==, "0.00");
}

static void test_powers(void)
{
    struct gb_figure_axis_scale scale;
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LINEAR, 0.0, 3.2e7, 6, loose);
    g_assert_cmpint(scale.power, ==, 6);
    g_assert_cmpstr(scale.label[1], ==, "5");
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LINEAR, 0.0, 4e-8, 6, loose);
    g_assert_cmpint(scale.power, ==, -9);
    g_assert_cmpstr(scale.label[scale.ticks - 1], ==, "40");
}

static void test_log_axis(void)
{
    struct gb_figure_axis_scale scale;
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LOG, 1.3e-9, 2e4, 8, loose);
    bool superscript = false;
    for (int k = 0; k < scale.ticks; k++) {
        superscript = superscript || strcmp(scale.label[k], "10<sup>\xe2\x88\x92"
                                                            "6</sup>") == 0;
    }
    g_assert_true(superscript);
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LOG, 1.0, 1000.0, 8, loose);
    scale.from = 0.0;
    scale.to = 300.0;
    g_assert_cmpfloat_with_epsilon(gb_figure_axis_position(&scale, 10.0), 100.0, 1e-9);
}

/* For any values an axis has finite ends in order and few enough ticks. */
static void test_odd_axes(void)
{
    static const double odd[][2] = {{NAN, NAN},
                                    {1.0, 1.0},
                                    {0.0, 0.0},
                                    {5.0, -5.0},
                                    {INFINITY, -INFINITY},
                                    {1e-300, 1e300},
                                    {-1e300, 1e300},
                                    {1e16, 1e16 + 4.0}};
    for (size_t k = 0; k < G_N_ELEMENTS(odd); k++) {
        for (int log = 0; log < 2; log++) {
            struct gb_figure_axis_scale scale;
            gb_figure_axis_fit(&scale,
                               log != 0 ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR,
                               odd[k][0], odd[k][1], 6, loose);
            g_assert_true(isfinite(scale.low) && isfinite(scale.high));
            g_assert_cmpfloat(scale.low, <, scale.high);
            g_assert_cmpint(scale.ticks, <=, GB_FIGURE_AXIS_TICKS);
            g_assert_true(log == 0 || scale.low > 0.0);
        }
    }
}

struct page {
    double x[POINTS], y[2][POINTS], error[POINTS];
    struct gb_figure_curve curve[3];
    struct gb_figure figure;
};

/* A straight line with a band, a flat one, and three points. */
static void make(struct page *page)
{
    *page = (struct page){0};
    for (int k = 0; k < POINTS; k++) {
        page->x[k] = k / (POINTS - 1.0);
        page->y[0][k] = 100.0 * page->x[k];
        page->y[1][k] = 20.0;
        page->error[k] = 6.0;
    }
    page->curve[0] = (struct gb_figure_curve){.label = "steep",
                                              .count = POINTS,
                                              .x = page->x,
                                              .y = page->y[0],
                                              .error = page->error};
    page->curve[1] = (struct gb_figure_curve){
        .label = "flat", .style = 1, .count = POINTS, .x = page->x, .y = page->y[1]};
    page->curve[2] = (struct gb_figure_curve){.label = "measured",
                                              .kind = GB_FIGURE_POINTS,
                                              .style = 2,
                                              .count = 3,
                                              .x = page->x + 30,
                                              .y = page->y[0] + 5};
    page->figure = (struct gb_figure){.title = "Title",
                                      .caption = "Caption",
                                      .x = {"density", false, NAN, NAN},
                                      .y = {"pressure (MPa)", false, NAN, NAN},
                                      .curve = page->curve,
                                      .count = 3};
}

static struct gb_image *paint(const struct gb_figure *figure,
                              struct gb_figure_layout *layout)
{
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    const bool done = gb_figure_render(&image, figure, WIDE, HIGH, layout, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(done);
    return image;
}

static const uint8_t *pixel(const struct gb_image *image,
                            const struct gb_figure_layout *layout, double x, double y)
{
    const int px = (int)floor(gb_figure_axis_position(&layout->x, x));
    const int py = (int)floor(gb_figure_axis_position(&layout->y, y));
    return &image->rgba[4 * (py * image->width + px)];
}

static double distance_to(const uint8_t *rgba, int style)
{
    double rgb[3];
    double sum = 0.0;
    gb_figure_curve_colour(style, rgb);
    for (int k = 0; k < 3; k++) {
        sum += fabs(rgba[k] / 255.0 - rgb[k]);
    }
    return sum;
}

static void test_ink(void)
{
    struct page page;
    struct gb_figure_layout layout;
    make(&page);
    struct gb_image *image = paint(&page.figure, &layout);
    /* the line where it is, its band pale beside it, nothing beyond */
    g_assert_cmpfloat(distance_to(pixel(image, &layout, 0.5, 50.0), 0), <, 0.3);
    const uint8_t *band = pixel(image, &layout, 0.5, 54.0);
    g_assert_cmpint(band[0], <, 235);
    g_assert_cmpint(band[2], >, band[0]);
    g_assert_cmpint(pixel(image, &layout, 0.5, 70.0)[0], ==, 255);
    /* a point is a filled mark on top */
    g_assert_cmpfloat(distance_to(pixel(image, &layout, page.x[31], page.y[0][6]), 2), <,
                      0.05);
    gb_image_destroy(image);
}

/* No ink of a curve under the legend: painted alone, curves leave its place white. */
static void test_legend(void)
{
    struct page page;
    struct gb_figure_layout with;
    struct gb_figure_layout without;
    make(&page);
    gb_image_destroy(paint(&page.figure, &with));
    g_assert_cmpfloat(with.legend[2], >, 0.0);
    g_assert_cmpfloat(with.legend[2], <=, with.frame[2]);
    for (int k = 0; k < 3; k++) {
        page.curve[k].label = NULL;
    }
    struct gb_image *image = paint(&page.figure, &without);
    g_assert_cmpfloat(without.legend[2], ==, 0.0);
    for (int y = (int)with.legend[1]; y < (int)with.legend[3]; y++) {
        for (int x = (int)with.legend[0]; x < (int)with.legend[2]; x++) {
            const uint8_t *at = &image->rgba[4 * (y * WIDE + x)];
            g_assert_cmpint(at[0] + at[1] + at[2], ==, 765);
        }
    }
    gb_image_destroy(image);
}

static bool is_white(const struct gb_image *image, int x, int y)
{
    const uint8_t *at = &image->rgba[4 * (y * WIDE + x)];
    return at[0] + at[1] + at[2] == 765;
}

/* A part of the axis drawn larger stands where nothing else does, and has its own ink. */
static void test_inset(void)
{
    struct page page;
    struct gb_figure_layout with;
    struct gb_figure_layout without;
    make(&page);
    struct gb_image *plain = paint(&page.figure, &without);
    g_assert_cmpfloat(without.inset[2], ==, 0.0);
    gb_image_destroy(plain);
    page.figure.inset[0] = 0.1;
    page.figure.inset[1] = 0.3;
    struct gb_image *image = paint(&page.figure, &with);
    const double *box = with.inset;
    g_assert_cmpfloat(box[2], >, box[0]);
    g_assert_cmpfloat(box[2] - box[0], <, 0.6 * (with.frame[2] - with.frame[0]));
    g_assert_true(box[0] > with.frame[0] && box[1] > with.frame[1] &&
                  box[2] < with.frame[2] && box[3] < with.frame[3]);
    int ink = 0;
    for (int y = (int)box[1]; y < (int)box[3]; y++) {
        for (int x = (int)box[0]; x < (int)box[2]; x++) {
            ink += distance_to(&image->rgba[4 * (y * WIDE + x)], 0) < 0.1;
        }
    }
    g_assert_cmpint(ink, >, 100); /* the steep line */
    gb_image_destroy(image);
    for (int k = 0; k < 3; k++) {
        page.curve[k].label = NULL;
    }
    page.figure.inset[1] = page.figure.inset[0];
    image = paint(&page.figure, &without);
    for (int y = (int)box[1]; y < (int)box[3]; y++) {
        for (int x = (int)box[0]; x < (int)box[2]; x++) {
            g_assert_true(is_white(image, x, y));
        }
    }
    gb_image_destroy(image);
}

static int ink_in(const struct gb_image *image, int left, int top, int right, int bottom)
{
    int ink = 0;
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            ink += !is_white(image, x, y);
        }
    }
    return ink;
}

/* Axes on the top and on the right make the frame smaller and write beside it. */
static void test_second_axes(void)
{
    struct page page;
    struct gb_figure_layout with;
    struct gb_figure_layout without;
    make(&page);
    struct gb_image *plain = paint(&page.figure, &without);
    page.figure.top = (struct gb_figure_second_axis){"top (%)", 100.0};
    page.figure.right = (struct gb_figure_second_axis){"right (MPa)", 1e-9};
    struct gb_image *image = paint(&page.figure, &with);
    const double *f = with.frame;
    g_assert_cmpfloat(f[1], >, without.frame[1] + 20.0);
    g_assert_cmpfloat(f[2], <, without.frame[2] - 20.0);
    g_assert_cmpfloat(f[0], ==, without.frame[0]);
    g_assert_cmpfloat(f[3], ==, without.frame[3]);
    g_assert_cmpint(ink_in(image, (int)f[0], 0, (int)f[2], (int)f[1] - 2), >, 100);
    g_assert_cmpint(ink_in(image, (int)f[2] + 3, (int)f[1], WIDE, (int)f[3]), >, 100);
    const double *g = without.frame;
    g_assert_cmpint(ink_in(plain, (int)g[2] + 3, 0, WIDE, HIGH / 2), ==, 0);
    gb_image_destroy(plain);
    gb_image_destroy(image);
}

/* After as many curves as there are colours, lines carry marks: with a colour and a dash
 * alone they would be those of others without colours. */
static void test_rounds(void)
{
    struct page page;
    struct gb_figure_layout layout;
    int ink[2] = {0, 0};
    make(&page);
    page.figure.count = 1;
    page.curve[0].error = NULL;
    for (int k = 0; k < 2; k++) {
        page.curve[0].style = 3 + k * GB_FIGURE_STYLES;
        page.curve[0].label = NULL;
        struct gb_image *image = paint(&page.figure, &layout);
        for (int y = (int)layout.frame[1] + 20; y < (int)layout.frame[3] - 20; y++) {
            for (int x = (int)layout.frame[0] + 20; x < (int)layout.frame[2] - 20; x++) {
                ink[k] += !is_white(image, x, y);
            }
        }
        gb_image_destroy(image);
    }
    g_assert_cmpint(ink[1], >, ink[0] + 100);
}

/* A frame full of points: the legend stands beside it. */
static void test_full(void)
{
    static double x[2500];
    static double y[2500];
    struct page page;
    struct gb_figure_layout layout;
    make(&page);
    for (int k = 0; k < 2500; k++) {
        x[k] = k % 50;
        y[k] = k / 50;
    }
    page.curve[0] = (struct gb_figure_curve){
        .label = "everywhere", .kind = GB_FIGURE_POINTS, .count = 2500, .x = x, .y = y};
    page.figure.count = 1;
    gb_image_destroy(paint(&page.figure, &layout));
    g_assert_cmpfloat(layout.legend[0], >=, layout.frame[2]);
    g_assert_cmpfloat(layout.legend[2], <=, WIDE);
}

static void test_nothing(void)
{
    struct page page;
    struct gb_figure_layout layout;
    make(&page);
    page.figure.count = 0;
    gb_image_destroy(paint(&page.figure, &layout));
    make(&page);
    for (int k = 0; k < POINTS; k++) {
        page.y[0][k] = NAN;
        page.y[1][k] = -1.0;
    }
    page.figure.y.log = true;
    gb_image_destroy(paint(&page.figure, &layout));
}

static gsize size_of(const char *path, char **text)
{
    gsize size = 0;
    g_assert_true(g_file_get_contents(path, text, &size, NULL));
    return size;
}

/* Every writer gives its kind of file, twice the same bytes. */
static void test_files(void)
{
    static const struct {
        const char *name, *start;
        gb_figure_writer *write;
    } kinds[] = {{"x.png", "\x89PNG", gb_figure_write_png},
                 {"x.svg", "<?xml", gb_figure_write_svg},
                 {"x.pdf", "%PDF", gb_figure_write_pdf}};
    char *folder = g_dir_make_tmp("greenbody-figure-XXXXXX", NULL);
    struct page page;
    struct gb_error err = {0};
    make(&page);
    for (size_t k = 0; k < G_N_ELEMENTS(kinds); k++) {
        char *path = g_build_filename(folder, kinds[k].name, NULL);
        char *text[2];
        gsize size[2];
        for (int i = 0; i < 2; i++) {
            g_assert_true(kinds[k].write(&page.figure, WIDE, HIGH, NULL, 0, path, &err));
            size[i] = size_of(path, &text[i]);
            g_remove(path);
        }
        g_assert_true(g_str_has_prefix(text[0], kinds[k].start));
        /* cairo counts the surfaces of a process in its SVG */
        const bool counts = strcmp(kinds[k].name, "x.svg") == 0;
        g_assert_true(counts ||
                      (size[0] == size[1] && memcmp(text[0], text[1], size[0]) == 0));
        g_free(text[0]);
        g_free(text[1]);
        g_free(path);
    }
    char *lost = g_build_filename(folder, "no", "x.pdf", NULL);
    g_assert_false(gb_figure_write_pdf(&page.figure, WIDE, HIGH, NULL, 0, lost, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
    g_assert_nonnull(strstr(err.text, lost));
    g_rmdir(folder);
    g_free(lost);
    g_free(folder);
}

/* In grey all styles that have one dash differ in lightness from paper, and no two share
 * colour and dash. */
static void test_styles(void)
{
    for (int a = 0; a < GB_FIGURE_STYLES; a++) {
        double one[3];
        gb_figure_curve_colour(a, one);
        g_assert_cmpfloat(0.299 * one[0] + 0.587 * one[1] + 0.114 * one[2], <, 0.75);
        for (int b = 0; b < a; b++) {
            double two[3];
            gb_figure_curve_colour(b, two);
            g_assert_cmpfloat(fabs(one[0] - two[0]) + fabs(one[1] - two[1]) +
                                  fabs(one[2] - two[2]),
                              >, 0.3);
        }
    }
}

/* The colours of gb_figure_colours, the markers of all styles also in black. */
static void test_black(void)
{
    for (int k = 0; k < 2 * GB_FIGURE_STYLES; k++) {
        double coloured[3], black[3];
        gb_figure_curve_colour(k, coloured);
        gb_figure_curve_colour(gb_figure_black(k), black);
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat_with_epsilon(
                255.0 * coloured[c], gb_figure_colours[k % GB_FIGURE_STYLES][c], 1e-9);
            g_assert_cmpfloat_with_epsilon(255.0 * black[c], gb_figure_colours_black[c],
                                           1e-9);
        }
        g_assert_cmpint(gb_figure_curve_shape(gb_figure_black(k)), ==,
                        gb_figure_curve_shape(k));
        g_assert_cmpint(gb_figure_curve_round(gb_figure_black(k)), ==,
                        gb_figure_curve_round(k));
    }
}

/* In a column of a journal a legend without space takes that of the inset, and not half of
 * the page. */
static void test_column(void)
{
    struct page page;
    struct gb_figure_layout layout;
    struct gb_error err = {0};
    struct gb_image *image = NULL;
    make(&page);
    for (int k = 0; k < POINTS; k++) {
        page.y[0][k] = 600.0 * pow(page.x[k], 3.0);
    }
    page.figure.title = NULL;
    page.figure.inset[0] = 0.0;
    page.figure.inset[1] = 0.3;
    page.figure.per_inch = 300;
    page.curve[0].label = "alumina 10 nm, set II";
    page.curve[0].kind = GB_FIGURE_BOTH;
    page.curve[1] = page.curve[2];
    page.curve[1].label = "Laboratory A";
    page.curve[1].x = page.x + 12;
    page.curve[2].label = "Laboratory B";
    g_assert_true(gb_figure_render(&image, &page.figure, 945, 709, &layout, &err));
    g_assert_cmpfloat(layout.frame[2] - layout.frame[0], >, 0.65 * 945.0);
    if (layout.inset[2] > layout.inset[0]) {
        g_assert_cmpfloat(layout.inset[2] - layout.inset[0], >, 80.0 * layout.unit);
    }
    gb_image_destroy(image);
}

enum { MANY = 90000, PIECE = 15000 };

/* A noisy curve, or a cloud, of many points with bars. */
static void fill_many(double *x, double *y, double *error, bool cloud)
{
    GRand *random = g_rand_new_with_seed(5);
    for (int k = 0; k < MANY; k++) {
        const double noise = g_rand_double(random) - 0.5;
        x[k] = cloud ? g_rand_double(random) : (double)k / MANY;
        y[k] = cloud ? 0.5 + 0.9 * noise : 0.3 + 0.4 * x[k] * x[k] + 0.02 * noise;
        error[k] = k % 1000 == 7 ? 0.1 * g_rand_double(random) : 0.001;
    }
    g_rand_free(random);
}

/* A figure of many points is one of few: a small file, with the same ink as its pieces, of
 * which none has points to leave out. */
static void test_many(void)
{
    double *x = g_new(double, MANY), *y = g_new(double, MANY),
           *error = g_new(double, MANY);
    char *path = g_build_filename(g_get_tmp_dir(), "figure-many.svg", NULL);
    for (int kind = GB_FIGURE_LINE; kind <= GB_FIGURE_ARROWS; kind++) {
        for (int cloud = 0; cloud < (kind == GB_FIGURE_POINTS ? 2 : 1); cloud++) {
            const bool bars = kind == GB_FIGURE_POINTS && !cloud;
            struct gb_figure_curve whole = {
                .kind = (enum gb_figure_kind)kind, .count = MANY, .x = x, .y = y};
            struct gb_figure_curve piece[MANY / PIECE];
            struct gb_image *image[2] = {NULL, NULL};
            struct gb_figure_layout layout;
            struct gb_error err = {0};
            GStatBuf info;
            fill_many(x, y, error, cloud);
            whole.error = bars ? error : NULL;
            for (int k = 0; kind == GB_FIGURE_ARROWS && k < MANY; k++) {
                y[k] = k % 3 == 2 ? (double)NAN : y[k];
            }
            for (size_t p = 0; p < G_N_ELEMENTS(piece); p++) {
                piece[p] = whole;
                piece[p].x += p * PIECE;
                piece[p].y += p * PIECE;
                piece[p].error = bars ? error + p * PIECE : NULL;
                piece[p].count = PIECE + (p + 1 < G_N_ELEMENTS(piece));
            }
            struct gb_figure figure = {.x = {"x", false, 0.0, 1.0},
                                       .y = {"y", false, 0.0, 1.0},
                                       .curve = &whole,
                                       .count = 1};
            g_assert_true(
                gb_figure_render(&image[0], &figure, WIDE, HIGH, &layout, &err));
            g_assert_true(gb_figure_write_svg(&figure, WIDE, HIGH, NULL, 0, path, &err));
            figure.curve = piece;
            figure.count = G_N_ELEMENTS(piece);
            g_assert_true(
                gb_figure_render(&image[1], &figure, WIDE, HIGH, &layout, &err));
            g_assert_cmpint(g_stat(path, &info), ==, 0);
            int different = 0;
            for (int k = 0; k < 4 * WIDE * HIGH; k++) {
                different += abs(image[0]->rgba[k] - image[1]->rgba[k]) > 48;
            }
            g_test_message("kind %d, cloud %d: %d kB, %d differ", kind, cloud,
                           (int)(info.st_size / 1024), different);
            g_assert_cmpint((int)(info.st_size >> 20), <, 4);
            if (kind != GB_FIGURE_STEPS) { /* pieces are closed at their ends */
                g_assert_cmpint(different, <, 4 * WIDE * HIGH / 200);
            }
            gb_image_destroy(image[0]);
            gb_image_destroy(image[1]);
        }
    }
    g_unlink(path);
    g_free(path);
    g_free(x);
    g_free(y);
    g_free(error);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/figure/linear-axis", test_linear_axis);
    g_test_add_func("/draw/figure/powers", test_powers);
    g_test_add_func("/draw/figure/log-axis", test_log_axis);
    g_test_add_func("/draw/figure/odd-axes", test_odd_axes);
    g_test_add_func("/draw/figure/ink", test_ink);
    g_test_add_func("/draw/figure/legend", test_legend);
    g_test_add_func("/draw/figure/inset", test_inset);
    g_test_add_func("/draw/figure/second-axes", test_second_axes);
    g_test_add_func("/draw/figure/rounds", test_rounds);
    g_test_add_func("/draw/figure/full", test_full);
    g_test_add_func("/draw/figure/nothing", test_nothing);
    g_test_add_func("/draw/figure/files", test_files);
    g_test_add_func("/draw/figure/styles", test_styles);
    g_test_add_func("/draw/figure/black", test_black);
    g_test_add_func("/draw/figure/column", test_column);
    g_test_add_func("/draw/figure/many", test_many);
    return g_test_run();
}
