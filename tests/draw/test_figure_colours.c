/* The colours of curves are told apart with normal colour vision, with the three common kinds
 * of dichromatic vision, and beside the black of measured points: computed. */
#include "draw/figure.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>

enum { COLOURS = GB_FIGURE_COLOURS + 1 }; /* with black */

/* Least CIEDE2000 difference of any two.  2.3 is just noticeable side by side; thin lines at
 * a distance need several times that.  The palette of Okabe and Ito without yellow has
 * 10.9. */
static const double least_difference = 13.9;
static const double least_contrast = 2.8; /* with white */

/* Linear sRGB as seen: Machado, Oliveira, Fernandes, IEEE Trans. Vis. Comput. Graph. 15
 * (2009) 1291, severity 1. */
static const struct {
    const char *name;
    double matrix[3][3];
} visions[] = {
    {"normal", {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
    {"protanopia",
     {{0.152286, 1.052583, -0.204868},
      {0.114503, 0.786281, 0.099216},
      {-0.003882, -0.048116, 1.051998}}},
    {"deuteranopia",
     {{0.367322, 0.860646, -0.227968},
      {0.280085, 0.672501, 0.047413},
      {-0.011820, 0.042940, 0.968881}}},
    {"tritanopia",
     {{1.255528, -0.076749, -0.178779},
      {-0.078411, 0.930809, 0.147602},
      {0.004733, 0.691367, 0.303900}}},
};

static const uint8_t *colour(int k)
{
    return k < GB_FIGURE_COLOURS ? gb_figure_colours[k] : gb_figure_colours_black;
}

static void linear(const uint8_t rgb[3], double out[3])
{
    for (int c = 0; c < 3; c++) {
        const double value = rgb[c] / 255.0;
        out[c] = value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
    }
}

static void multiply(const double matrix[3][3], const double in[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = 0.0;
        for (int j = 0; j < 3; j++) {
            out[i] += matrix[i][j] * in[j];
        }
    }
}

/* CIELAB of linear sRGB under D65. */
static void lab_of(const double rgb[3], double lab[3])
{
    static const double to_xyz[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                        {0.2126729, 0.7151522, 0.0721750},
                                        {0.0193339, 0.1191920, 0.9503041}};
    static const double white[3] = {0.95047, 1.0, 1.08883};
    double shown[3], xyz[3], f[3];
    for (int c = 0; c < 3; c++) {
        shown[c] = fmin(fmax(rgb[c], 0.0), 1.0);
    }
    multiply(to_xyz, shown, xyz);
    for (int c = 0; c < 3; c++) {
        const double t = xyz[c] / white[c];
        f[c] = t > 216.0 / 24389.0 ? cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

static double degrees(double angle)
{
    return angle * 180.0 / M_PI;
}

static double cos_deg(double angle)
{
    return cos(angle * M_PI / 180.0);
}

static double power7_share(double chroma)
{
    const double power = pow(chroma, 7.0);
    return sqrt(power / (power + pow(25.0, 7.0)));
}

static double hue_of(double a, double b)
{
    const double hue = degrees(atan2(b, a));
    return hue < 0.0 ? hue + 360.0 : hue;
}

/* CIEDE2000: Sharma, Wu, Dalal, Color Res. Appl. 30 (2005) 21. */
static double difference(const double one[3], const double two[3])
{
    const double g =
        0.5 * (1.0 - power7_share(0.5 * (hypot(one[1], one[2]) + hypot(two[1], two[2]))));
    const double a[2] = {one[1] * (1.0 + g), two[1] * (1.0 + g)};
    const double chroma[2] = {hypot(a[0], one[2]), hypot(a[1], two[2])};
    const double hue[2] = {hue_of(a[0], one[2]), hue_of(a[1], two[2])};
    const bool grey = chroma[0] * chroma[1] == 0.0;
    const double hue_step = hue[1] - hue[0];
    const double d_hue = grey ? 0.0 : hue_step - 360.0 * rint(hue_step / 360.0);
    const double d_l = two[0] - one[0];
    const double d_c = chroma[1] - chroma[0];
    const double d_h =
        2.0 * sqrt(chroma[0] * chroma[1]) * sin(0.5 * d_hue * M_PI / 180.0);
    const double l = 0.5 * (one[0] + two[0]);
    const double c = 0.5 * (chroma[0] + chroma[1]);
    const double h = grey ? hue[0] + hue[1] : hue[0] + 0.5 * d_hue;
    const double t = 1.0 - 0.17 * cos_deg(h - 30.0) + 0.24 * cos_deg(2.0 * h) +
                     0.32 * cos_deg(3.0 * h + 6.0) - 0.2 * cos_deg(4.0 * h - 63.0);
    const double h_positive = h < 0.0 ? h + 360.0 : h;
    const double rotation = 30.0 * exp(-pow((h_positive - 275.0) / 25.0, 2.0));
    const double s_l = 1.0 + 0.015 * pow(l - 50.0, 2.0) / sqrt(20.0 + pow(l - 50.0, 2.0));
    const double by_l = d_l / s_l;
    const double by_c = d_c / (1.0 + 0.045 * c);
    const double by_h = d_h / (1.0 + 0.015 * c * t);
    const double r_t = -sin(2.0 * rotation * M_PI / 180.0) * 2.0 * power7_share(c);
    return sqrt(by_l * by_l + by_c * by_c + by_h * by_h + r_t * by_c * by_h);
}

/* Pairs of the table of Sharma, Wu and Dalal. */
static void test_formula(void)
{
    static const struct {
        double one[3], two[3], difference;
    } table[] = {
        {{50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}, 2.0425},
        {{50.0, -0.001, 2.49}, {50.0, 0.0011, -2.49}, 4.7461},
        {{50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}, 27.1492},
        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        {{22.7233, 20.0904, -46.694}, {23.0331, 14.973, -42.5619}, 2.0373},
        {{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(table); k++) {
        g_assert_cmpfloat_with_epsilon(difference(table[k].one, table[k].two),
                                       table[k].difference, 1e-4);
    }
}

static void test_apart(void)
{
    for (size_t v = 0; v < G_N_ELEMENTS(visions); v++) {
        double lab[COLOURS][3];
        double least = INFINITY;
        for (int k = 0; k < COLOURS; k++) {
            double rgb[3], seen[3];
            linear(colour(k), rgb);
            multiply(visions[v].matrix, rgb, seen);
            lab_of(seen, lab[k]);
            for (int j = 0; j < k; j++) {
                const double apart = difference(lab[j], lab[k]);
                least = fmin(least, apart);
                if (apart < least_difference) {
                    g_test_message("%s: colours %d and %d differ by %.1f",
                                   visions[v].name, j + 1, k + 1, apart);
                }
            }
        }
        g_test_message("%s: least difference %.1f", visions[v].name, least);
        g_assert_cmpfloat(least, >=, least_difference);
    }
}

static void test_contrast(void)
{
    for (int k = 0; k < GB_FIGURE_COLOURS; k++) {
        double rgb[3];
        linear(colour(k), rgb);
        const double light = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        g_assert_cmpfloat(1.05 / (light + 0.05), >=, least_contrast);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/figure-colours/formula", test_formula);
    g_test_add_func("/figure-colours/apart", test_apart);
    g_test_add_func("/figure-colours/contrast", test_contrast);
    return g_test_run();
}
