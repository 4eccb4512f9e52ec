/* Colours of the themes, computed: contrast with the background, and that no two series look
 * alike, also with the three common kinds of colour blindness. */
#include "tui/term/term.h"

#include <glib.h>
#include <math.h>

#include "tui/term/settings.h"

struct colour {
    double c[3]; /* linear RGB, or L*, a*, b* */
};

static double linear(int value)
{
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

/* Of the colour cube and the greys of terminals with 256 colours. */
static struct colour of_256(int index)
{
    static const int step[] = {0, 95, 135, 175, 215, 255};
    const int grey = 8 + 10 * (index - 232);
    const int cube = index - 16;
    const int value[3] = {step[MIN(cube, 215) / 36], step[MIN(cube, 215) / 6 % 6],
                          step[MIN(cube, 215) % 6]};
    struct colour colour;
    g_assert_cmpint(index, >=, 16);
    for (int k = 0; k < 3; k++) {
        colour.c[k] = linear(index >= 232 ? grey : value[k]);
    }
    return colour;
}

static double luminance(struct colour rgb)
{
    return 0.2126 * rgb.c[0] + 0.7152 * rgb.c[1] + 0.0722 * rgb.c[2];
}

static double contrast(int index, double background)
{
    const double own = luminance(of_256(index));
    return (MAX(own, background) + 0.05) / (MIN(own, background) + 0.05);
}

/* Machado, Oliveira and Fernandes 2009, severity 1: none, protanopia, deuteranopia,
 * tritanopia. */
static const double vision[4][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0.152286, 1.052583, -0.204868},
     {0.114503, 0.786281, 0.099216},
     {-0.003882, -0.048116, 1.051998}},
    {{0.367322, 0.860646, -0.227968},
     {0.280085, 0.672501, 0.047413},
     {-0.011820, 0.042940, 0.968881}},
    {{1.255528, -0.076749, -0.178779},
     {-0.078411, 0.930809, 0.147602},
     {0.004733, 0.691367, 0.303900}},
};

static struct colour times(const double matrix[3][3], struct colour v)
{
    struct colour product;
    for (int i = 0; i < 3; i++) {
        product.c[i] = matrix[i][0] * v.c[0] + matrix[i][1] * v.c[1] + matrix[i][2] * v.c[2];
    }
    return product;
}

static double root(double t)
{
    return t > 0.008856 ? cbrt(t) : 7.787 * t + 16.0 / 116.0;
}

/* CIELAB of what is seen. */
static struct colour seen(int index, int kind)
{
    static const double xyz_of_rgb[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    struct colour rgb = times(vision[kind], of_256(index));
    for (int k = 0; k < 3; k++) {
        rgb.c[k] = CLAMP(rgb.c[k], 0.0, 1.0);
    }
    const struct colour xyz = times(xyz_of_rgb, rgb);
    const double x = root(xyz.c[0] / 0.95047);
    const double y = root(xyz.c[1]);
    const double z = root(xyz.c[2] / 1.08883);
    return (struct colour){{116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)}};
}

static double distance(int one, int other, int kind)
{
    const struct colour a = seen(one, kind);
    const struct colour b = seen(other, kind);
    return sqrt(pow(a.c[0] - b.c[0], 2) + pow(a.c[1] - b.c[1], 2) +
                pow(a.c[2] - b.c[2], 2));
}

static void test_told_apart(void)
{
    for (int theme = GB_THEME_AUTO; theme <= GB_THEME_CONTRAST; theme++) {
        const struct gb_term_theme *row = gb_term_theme_row(theme);
        for (int i = 0; i < GB_TERM_THEME_SERIES; i++) {
            for (int k = 0; k < i; k++) {
                for (int kind = 0; kind < 4; kind++) {
                    const double apart = distance(row->series[i], row->series[k], kind);
                    g_test_message("theme %d, series %d and %d, vision %d: %.1f", theme, i,
                                   k, kind, apart);
                    g_assert_cmpfloat(apart, >=, 15.0);
                }
            }
        }
    }
}

static void test_contrast(void)
{
    static const struct {
        int theme;
        double on_white, on_black;
    } least[] = {{GB_THEME_AUTO, 2.4, 3.2},
                 {GB_THEME_LIGHT, 3.0, 0.0},
                 {GB_THEME_DARK, 0.0, 5.0},
                 {GB_THEME_CONTRAST, 0.0, 7.0}};
    for (size_t t = 0; t < G_N_ELEMENTS(least); t++) {
        const struct gb_term_theme *row = gb_term_theme_row(least[t].theme);
        for (int i = 0; i < GB_TERM_THEME_SERIES; i++) {
            g_assert_cmpfloat(contrast(row->series[i], 1.0), >=, least[t].on_white);
            g_assert_cmpfloat(contrast(row->series[i], 0.0), >=, least[t].on_black);
        }
        g_assert_cmpfloat(contrast(row->grey, 1.0), >=, least[t].on_white);
        g_assert_cmpfloat(contrast(row->grey, 0.0), >=, least[t].on_black);
        /* the background is the terminal's unless there is contrast to ask for */
        g_assert_cmpint(row->background < 0, ==, least[t].theme != GB_THEME_CONTRAST);
        g_assert_cmpint(row->background < 0, ==, row->background_16 < 0);
    }
}

static void test_resolve(void)
{
    static const struct {
        const char *given;
        int theme;
    } rows[] = {{NULL, GB_THEME_AUTO},          {"", GB_THEME_AUTO},
                {"15;0", GB_THEME_DARK},        {"0;15", GB_THEME_LIGHT},
                {"0;7", GB_THEME_LIGHT},        {"12;8", GB_THEME_DARK},
                {"0;default;15", GB_THEME_LIGHT}, {"0;default", GB_THEME_AUTO},
                {"7;99", GB_THEME_AUTO}};
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        g_assert_cmpint(gb_term_theme_resolve(GB_THEME_AUTO, rows[k].given), ==,
                        rows[k].theme);
        g_assert_cmpint(gb_term_theme_resolve(GB_THEME_CONTRAST, rows[k].given), ==,
                        GB_THEME_CONTRAST);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/theme/told-apart", test_told_apart);
    g_test_add_func("/theme/contrast", test_contrast);
    g_test_add_func("/theme/resolve", test_resolve);
    return g_test_run();
}
