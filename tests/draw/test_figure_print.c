/* Figures at the width of a column: nothing is cut at an edge of the page, nothing written over
 * something else, and the frame keeps most of the width. */
#include <glib.h>
#include <math.h>
#include <stdlib.h>

#include "draw/figure.h"
#include "draw/image.h"

enum { POINTS = 60, CURVES = 6, WIDE = 945, HIGH = 709, PER_INCH = 300 }; /* 8 cm */

struct page {
    double x[POINTS], y[CURVES][POINTS];
    struct gb_figure_curve curve[CURVES];
    struct gb_figure figure;
};

/* Lines all over the frame: no room for a legend in it. */
static void make(struct page *page, const char *label)
{
    *page = (struct page){0};
    for (int i = 0; i < CURVES; i++) {
        for (int k = 0; k < POINTS; k++) {
            page->x[k] = k / (POINTS - 1.0);
            page->y[i][k] = 50.0 + 50.0 * sin(40.0 * page->x[k] + i);
        }
        page->curve[i] = (struct gb_figure_curve){
            .label = label, .style = i, .count = POINTS, .x = page->x, .y = page->y[i]};
    }
    page->figure = (struct gb_figure){.per_inch = PER_INCH,
                                      .x = {"density", false, NAN, NAN},
                                      .y = {"pressure (MPa)", false, NAN, NAN},
                                      .curve = page->curve,
                                      .count = CURVES};
}

static struct gb_image *paint(const struct gb_figure *figure,
                              struct gb_figure_layout *layout)
{
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_figure_render(&image, figure, WIDE, HIGH, layout, &err));
    g_assert_cmpint(image->width, ==, WIDE);
    g_assert_cmpint(image->height, >=, HIGH);
    return image;
}

static bool is_blank(const struct gb_image *image, double left, double top, double right,
                     double bottom)
{
    for (int y = (int)fmax(top, 0.0); y < (int)fmin(bottom, image->height); y++) {
        for (int x = (int)fmax(left, 0.0); x < (int)fmin(right, image->width); x++) {
            const uint8_t *at = &image->rgba[4 * (y * image->width + x)];
            if (at[0] + at[1] + at[2] < 750) {
                return false;
            }
        }
    }
    return true;
}

/* The edges of the page, 2 pixels wide, are blank: no letter goes beyond. */
static void assert_nothing_cut(const struct gb_image *image)
{
    const double w = image->width, h = image->height;
    g_assert_true(is_blank(image, 0.0, 0.0, w, 2.0));
    g_assert_true(is_blank(image, 0.0, h - 2.0, w, h));
    g_assert_true(is_blank(image, 0.0, 0.0, 2.0, h));
    g_assert_true(is_blank(image, w - 2.0, 0.0, w, h));
}

static void test_wide_legend(void)
{
    static const char *const labels[] = {
        "d = 10.4 nm, alpha = 0.37, mu = 0.13", "m = 0.05, 1480 MPa",
        "diameter 10.4 nm, alpha 0.37, mu 0.13, bridge length 0.008 d"};
    for (size_t k = 0; k < G_N_ELEMENTS(labels); k++) {
        struct page page;
        struct gb_figure_layout layout;
        make(&page, labels[k]);
        struct gb_image *image = paint(&page.figure, &layout);
        assert_nothing_cut(image);
        g_assert_cmpfloat(layout.frame[2] - layout.frame[0], >, 0.6 * WIDE);
        g_assert_cmpfloat(layout.frame[3] - layout.frame[1], >, 0.35 * WIDE);
        g_assert_cmpfloat(layout.legend[0], >=, 0.0);
        g_assert_cmpfloat(layout.legend[2], <=, WIDE);
        g_assert_cmpfloat(layout.legend[1], >, layout.frame[3]);
        g_assert_cmpfloat(layout.legend[3], <=, image->height);
        /* a sample of each curve in its colour, and letters */
        g_assert_false(is_blank(image, layout.legend[0], layout.legend[1],
                                layout.legend[2], layout.legend[3]));
        gb_image_destroy(image);
    }
}

/* Short labels stand in columns. */
static void test_columns(void)
{
    struct page page;
    struct gb_figure_layout one, two;
    make(&page, "fire, N = 1000");
    page.curve[0].label = "steepest, N = 1000";
    gb_image_destroy(paint(&page.figure, &two));
    make(&page, "d = 10.4 nm, alpha = 0.37, mu = 0.13");
    gb_image_destroy(paint(&page.figure, &one));
    const double ratio =
        (two.legend[3] - two.legend[1]) / (one.legend[3] - one.legend[1]);
    g_assert_cmpfloat(ratio, <, 0.6);
}

/* Names of axes that are longer than their axes. */
static void test_long_names(void)
{
    struct page page;
    struct gb_figure_layout layout;
    make(&page, NULL);
    page.figure.x.label = "processor time of one cell on one core of one machine (s)";
    page.figure.y.label = "density error (% of theoretical density)";
    page.figure.top = (struct gb_figure_second_axis){
        "indentation over the smaller diameter <i>h</i> / 2<i>r</i> (%)", 2.0};
    page.figure.right = (struct gb_figure_second_axis){
        "pressure <i>F</i> / 4<i>R</i><sup>2</sup>, of the mean force (MPa)", 3.0};
    struct gb_image *image = paint(&page.figure, &layout);
    assert_nothing_cut(image);
    gb_image_destroy(image);
}

/* A text at the uppermost point lies within the frame, as does one at the lowest. */
static void test_annotations(void)
{
    static const struct gb_figure_annotation notes[] = {
        {0.3, 99.0, "<i>C</i>", GB_FIGURE_ABOVE_LEFT},
        {0.6, 0.5, "<i>D</i>", GB_FIGURE_BELOW_LEFT}};
    struct page page;
    struct gb_figure_layout layout;
    make(&page, NULL);
    page.figure.annotation = notes;
    page.figure.annotations = 2;
    struct gb_image *image = paint(&page.figure, &layout);
    const double *f = layout.frame;
    const double line = 11.5 * layout.unit; /* height of the text and its distance */
    g_assert_cmpfloat(gb_figure_axis_position(&layout.y, 99.0) - line, >, f[1]);
    g_assert_cmpfloat(gb_figure_axis_position(&layout.y, 0.5) + line, <, f[3]);
    g_assert_true(is_blank(image, f[0], f[1] - 15.0, f[2], f[1] - 3.0));
    gb_image_destroy(image);
}

/* Names of two panels do not meet. */
static void test_panels(void)
{
    struct page page;
    struct gb_figure_layout layout;
    make(&page, NULL);
    page.figure.y.label = "relative density, of the theoretical one (%)";
    page.figure.below_y =
        (struct gb_figure_axis){"residual, of the same (%)", false, NAN, NAN};
    page.figure.below = page.curve;
    page.figure.below_count = 1;
    struct gb_image *image = paint(&page.figure, &layout);
    const double between = 0.5 * (layout.frame[3] + layout.below[1]);
    g_assert_true(is_blank(image, 0.0, between - 1.0, 22.0 * layout.unit, between + 1.0));
    assert_nothing_cut(image);
    gb_image_destroy(image);
}

/* The page keeps its shape where its frame has enough of it. */
static void test_shape(void)
{
    struct page page;
    struct gb_figure_layout layout;
    make(&page, NULL);
    struct gb_image *image = paint(&page.figure, &layout);
    g_assert_cmpint(image->height, ==, HIGH);
    gb_image_destroy(image);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/draw/figure-print/wide-legend", test_wide_legend);
    g_test_add_func("/draw/figure-print/columns", test_columns);
    g_test_add_func("/draw/figure-print/long-names", test_long_names);
    g_test_add_func("/draw/figure-print/annotations", test_annotations);
    g_test_add_func("/draw/figure-print/panels", test_panels);
    g_test_add_func("/draw/figure-print/shape", test_shape);
    return g_test_run();
}
