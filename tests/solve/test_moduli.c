#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mat.h"
#include "common/scene.h"
#include "pack/cell/world.h"
#include "solve/moduli/moduli.h"
#include "solve/moduli/probe.h"

/* Exact moduli of Bravais lattices, written from the laws and not from the program: the
 * particles move affinely and do not turn.  Contacts along unit vectors n at distance r,
 * force f, stiffness k_n = -df/dr, tangential stiffness k_t: a strain changes the force by
 * dF = -k_n (n.du) n - (k_t - f/r) du_t, du = eps.(r n), and sigma = -(1/V) sum F l. */
struct lattice_case {
    const char *kind, *count;
    double overlap, diameter_nm, alpha;
    double share;            /* of (4) that the relative motion sees: 0, 1/2 or 1 */
    const char *more;        /* an assignment */
    double p, c11, c12, c44; /* GPa; 0: from the closed form only */
};

static const double young_gpa = 382.0, poisson = 0.25;

static int dimension_of(const char *kind)
{
    return strcmp(kind, "square") == 0 || strcmp(kind, "hexagonal") == 0 ? 2 : 3;
}

/* Square or hexagonal, in the x-z plane. */
static int plane_neighbours(const char *kind, double n[6][3])
{
    const int count = kind[0] == 's' ? 2 : 3;
    for (int k = 0; k < count; k++) {
        const double angle = k * M_PI / count;
        n[k][0] = cos(angle);
        n[k][1] = 0.0;
        n[k][2] = sin(angle);
    }
    return count;
}

/* Vectors to half of the nearest neighbours, in their distance; returns their number. */
static int neighbours(const char *kind, double n[6][3])
{
    if (dimension_of(kind) == 2) {
        return plane_neighbours(kind, n);
    }
    static const double sc[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const double fcc[][3] = {{1, 1, 0},  {1, -1, 0}, {1, 0, 1},
                                    {1, 0, -1}, {0, 1, 1},  {0, 1, -1}};
    static const double bcc[][3] = {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    const int count = kind[0] == 's' ? 3 : kind[0] == 'f' ? 6 : 4;
    for (int k = 0; k < count; k++) {
        memcpy(n[k],
               kind[0] == 's'   ? sc[k]
               : kind[0] == 'f' ? fcc[k]
                                : bcc[k],
               sizeof n[k]);
        gb_vec_scale(n[k], 1.0 / gb_vec_length(n[k]));
    }
    return count;
}

/* Volume of a particle at the nearest distance r, d^3; a plane is d thick. */
static double particle_volume(const char *kind, double r)
{
    if (dimension_of(kind) == 2) {
        return (kind[0] == 's' ? 1.0 : sqrt(0.75)) * r * r;
    }
    return (kind[0] == 's'   ? 1.0
            : kind[0] == 'f' ? sqrt(0.5)
                             : 4.0 / (3.0 * sqrt(3.0))) *
           r * r * r;
}

struct contact {
    double f, k_n, k_t;
};

/* Laws of P1 (1), (3), (4) in E and d. */
static struct contact contact_of(const struct lattice_case *of)
{
    const double h = of->overlap, nu = poisson, d0 = 0.392 / of->diameter_nm;
    const double m = (1.0 - nu) / ((1.0 - 2.0 * nu) * (1.0 + nu));
    const double epsilon =
        1224.0 * 1.380649e-23 / (young_gpa * 1e9 * pow(of->diameter_nm * 1e-9, 3.0));
    const double s = 1.0 + of->alpha * d0;
    const double adhesion =
        M_PI * M_PI / 3.0 * 2.0 * epsilon / (s * s * s * pow(s * s - 1.0, 2.0));
    return (struct contact){
        .f = pow(h, 1.5) / (3.0 * (1.0 - nu * nu)) -
             0.25 * M_PI * m * (h + log(1.0 - h)) - adhesion,
        .k_n = sqrt(h) / (2.0 * (1.0 - nu * nu)) + 0.25 * M_PI * m * h / (1.0 - h),
        .k_t = of->share * 4.0 * (0.5 * sqrt(h)) / ((2.0 - nu) * (1.0 + nu)),
    };
}

/* Voigt components of the symmetric part. */
static double voigt(const double t[3][3], int k)
{
    static const int a[] = {0, 1, 2, 1, 0, 0}, b[] = {0, 1, 2, 2, 2, 1};
    return 0.5 * (t[a[k]][b[k]] + t[b[k]][a[k]]);
}

/* Pressure and C, GPa. */
static double closed_form(const struct lattice_case *of, double c[6][6])
{
    const struct contact contact = contact_of(of);
    const double r = 1.0 - of->overlap;
    const double volume = particle_volume(of->kind, r);
    const int dimension = dimension_of(of->kind);
    double n[6][3], pressure = 0.0;
    const int count = neighbours(of->kind, n);
    for (int k = 0; k < count; k++) {
        pressure += contact.f * r / (dimension * volume) * young_gpa;
    }
    for (int e = 0; e < 6; e++) {
        double strain[3][3], sigma[3][3] = {{0.0}};
        gb_moduli_strain(e, 1.0, strain);
        for (int k = 0; k < count; k++) {
            double du[3], along[3] = {0.0}, force[3];
            gb_mat_apply((const double(*)[3])strain, n[k], du);
            gb_vec_scale(du, r);
            gb_vec_add(along, gb_vec_dot(du, n[k]), n[k]);
            for (int a = 0; a < 3; a++) {
                force[a] = -contact.k_n * along[a] -
                           (contact.k_t - contact.f / r) * (du[a] - along[a]);
            }
            for (int a = 0; a < 3; a++) {
                gb_vec_add(sigma[a], -force[a] * r / volume, n[k]);
                gb_vec_add(sigma[a], -contact.f * n[k][a] / volume, du);
            }
        }
        for (int m = 0; m < 6; m++) {
            const bool in_plane = dimension == 3 || (m % 2 == 0 && e % 2 == 0);
            c[m][e] = in_plane ? young_gpa * voigt((const double(*)[3])sigma, m) +
                                     (e < 3 && m < 3 ? pressure : 0.0)
                               : 0.0;
        }
    }
    return pressure;
}

static struct gb_moduli probe(const struct lattice_case *of)
{
    char text[6][64];
    struct gb_error err = {0};
    struct gb_moduli moduli;
    const struct gb_moduli_options options = {.range = false};
    snprintf(text[0], sizeof text[0], "structure.kind=%s", of->kind);
    snprintf(text[1], sizeof text[1], "structure.overlap=%.17g", of->overlap);
    snprintf(text[2], sizeof text[2], "particles.count=%s", of->count);
    snprintf(text[3], sizeof text[3], "particles.diameter=%.17g nm", of->diameter_nm);
    snprintf(text[4], sizeof text[4], "contact.alpha=%.17g", of->alpha);
    snprintf(text[5], sizeof text[5], "%s", of->more);
    struct gb_params params =
        scene_params(text[0], text[1], text[2], text[3], text[4], text[5], NULL);
    if (of->share == 0.0) {
        g_assert_true(gb_params_assign(&params, "contact.mu=0", &err));
        g_assert_true(gb_params_assign(&params, "contact.bridge_length=1 d", &err));
    }
    if (!gb_params_check(&params, &err)) {
        g_error("%s", err.text);
    }
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    scene_evaluate(world);
    const uint64_t before = gb_world_hash(world);
    if (!gb_moduli_measure(&moduli, world, &options, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(gb_world_hash(world), ==, before);
    gb_world_destroy(world);
    return moduli;
}

static void check_near(double value, double exact, double scale)
{
    if (!(fabs(value - exact) <= 1e-6 * scale)) {
        g_error("%.12g instead of %.12g", value, exact);
    }
}

static void check_case(const struct lattice_case *of)
{
    double exact[6][6], apart = 0.0;
    const double pressure = closed_form(of, exact);
    const struct gb_moduli moduli = probe(of);
    check_near(young_gpa * moduli.pressure[0][0], pressure, fabs(pressure));
    for (int k = 0; k < 36; k++) {
        const int a = k / 6, b = k % 6;
        const double value = young_gpa * moduli.c[a][b];
        const double size = a == b || (a < 3 && b < 3) ? fabs(exact[a][b]) : exact[0][0];
        apart = fmax(apart, fabs(value - exact[a][b]) / size);
        check_near(value, exact[a][b], size);
    }
    if (of->p > 0.0) {
        check_near(pressure, of->p, of->p);
        check_near(exact[0][0], of->c11, of->c11);
        check_near(exact[0][1], of->c12, of->c12);
        check_near(exact[3][3], of->c44, of->c44);
    }
    g_test_message("%s %g %s: error %.1e, strain %.0e, sizes agree to %.1e", of->kind,
                   of->overlap, of->more, apart, moduli.strain, moduli.agreement);
}

static void test_lattices(void)
{
    static const struct lattice_case cases[] = {
        {"fcc", "256", 0.03, 10.0, 0.24, 0.5, "scene.title=set II", 1.7091654, 110.925215,
         13.928325, 54.6080246},
        {"fcc", "256", 0.03, 10.0, 0.24, 0.0, "scene.title=bare", 1.7091654, 66.8271842,
         35.9773402, 32.5590094},
        {"sc", "64", 0.03, 10.0, 0.24, 0.5, "scene.title=set II", 0.604281222, 47.8582363,
         0.604281222, 14.9867269},
        {"bcc", "128", 0.05, 10.0, 0.37, 0.5, "scene.title=set II", 3.56854384,
         84.2850103, 20.2290928, 48.6885077},
        {"fcc", "256", 0.005, 38.0, 0.24, 0.5, "contact.mu=0.4", 0, 0, 0, 0},
        {"fcc", "256", 0.03, 9.7, 0.24, 1.0, "contact.relative_motion=full", 0, 0, 0, 0},
        {"sc", "125", 0.1, 21.0, 0.5, 0.5, "contact.bridge_length=1 d", 0, 0, 0, 0},
        {"sc", "64", 0.02, 16.0, 0.3, 0.0, "scene.title=bare", 0, 0, 0, 0},
        {"bcc", "54", 0.01, 16.0, 0.3, 0.5, "contact.bridge_length=0.002 d", 0, 0, 0, 0},
        {"bcc", "128", 0.1, 10.0, 0.37, 0.0, "scene.title=bare", 0, 0, 0, 0},
        {"hexagonal", "100", 0.03, 10.0, 0.24, 0.5, "scene.dimension=2", 0, 0, 0, 0},
        {"square", "64", 0.02, 10.0, 0.24, 0.5, "scene.dimension=2", 0, 0, 0, 0},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        check_case(&cases[k]);
    }
}

/* A lattice squeezed along z, then stretched, in steps of 0.002; it stays affine. */
struct pressed_case {
    const char *kind, *count;
    const char *more[3]; /* assignments */
    int squeezes, stretches;
    bool slides; /* in the last step, to be sure */
};

static struct gb_moduli press_and_probe(const struct pressed_case *of,
                                        const char *precision)
{
    char text[4][64];
    struct gb_error err = {0};
    struct gb_moduli moduli;
    const struct gb_moduli_options options = {.range = false};
    snprintf(text[0], sizeof text[0], "structure.kind=%s", of->kind);
    snprintf(text[1], sizeof text[1], "particles.count=%s", of->count);
    snprintf(text[2], sizeof text[2], "structure.overlap=0.01");
    snprintf(text[3], sizeof text[3], "numerics.precision=%s", precision);
    struct gb_params params =
        scene_params(text[0], text[1], text[2], text[3], of->more[0], of->more[1],
                     of->more[1] ? of->more[2] : NULL, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    g_assert_true(model.numerics.single == (precision[0] == 's'));
    scene_evaluate(world);
    for (int k = 0; k < of->squeezes + of->stretches; k++) {
        scene_squeeze(world, k < of->squeezes ? 0.002 : -0.002);
        scene_evaluate(world);
    }
    g_assert_true(!of->slides || gb_world_tally(world)->sliding > 0);
    const uint64_t before = gb_world_hash(world);
    if (!gb_moduli_measure(&moduli, world, &options, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(gb_world_hash(world), ==, before);
    gb_world_destroy(world);
    return moduli;
}

/* Springs at their caps and bridges at their strength, at their deepest overlap or peeling:
 * a strain makes them slide one way and stick the other in both precisions.  Positions are
 * exact in single precision where the count is 4 x 4^3, and rounded elsewhere. */
static void test_precisions(void)
{
    static const char none[] = "contact.bridge_length=1 d";
    static const struct pressed_case cases[] = {
        {"fcc", "256", {none, "contact.mu=0.05"}, 10, 0, true},
        {"fcc", "256", {none, "contact.mu=0.05"}, 40, 0, true},
        {"fcc", "108", {none, "contact.mu=0.3"}, 60, 0, true},
        {"fcc", "108", {none, "contact.mu=0.05"}, 40, 1, false},
        {"fcc", "500", {none, "contact.mu=0.05"}, 40, 5, true},
        {"fcc", "108", {none, "contact.mu=0.02", "contact.mu_pivot=0.1"}, 30, 0, true},
        {"bcc", "54", {none, "contact.mu=0.05"}, 20, 0, true},
        {"bcc", "54", {none, "contact.mu=0.3"}, 60, 0, true},
        {"bcc", "128", {none, "contact.normal=hertz"}, 60, 0, true},
        {"sc", "125", {none, "contact.mu=0.1"}, 30, 0, false},
        {"sc", "216", {"contact.mu=0.1"}, 30, 3, false},
        {"fcc", "108", {"contact.shear_strength=200 MPa"}, 20, 0, true},
        {"fcc", "256", {"contact.shear_strength=2 GPa"}, 40, 0, true},
        {"fcc", "108", {"contact.shear_strength=20 GPa"}, 40, 0, false},
        {"bcc", "54", {"contact.shear_strength=2 GPa"}, 40, 0, true},
        {"bcc", "54", {"contact.bridge_length=0.003 d"}, 40, 4, false},
        {"fcc", "108", {"contact.bridge_length=0.003 d"}, 40, 4, false},
        {"fcc", "108", {"contact.bridge_radius=current"}, 60, 0, true},
        {"bcc", "128", {"contact.relative_motion=full"}, 60, 0, true},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        const struct gb_moduli exact = press_and_probe(&cases[k], "double");
        const struct gb_moduli rounded = press_and_probe(&cases[k], "single");
        double most = 0.0, apart = 0.0, stress = 0.0, stressed = 0.0;
        for (int n = 0; n < 36; n++) {
            const double c = exact.c[n / 6][n % 6];
            most = fmax(most, fabs(c));
            apart = fmax(apart, fabs(rounded.c[n / 6][n % 6] - c));
        }
        for (int n = 0; n < 9; n++) {
            const double p = exact.pressure[n / 3][n % 3];
            stress = fmax(stress, fabs(p));
            stressed = fmax(stressed, fabs(rounded.pressure[n / 3][n % 3] - p));
        }
        g_test_message("%s %s %s: C differs by %.1e, pressure by %.1e; sizes %.1e",
                       cases[k].kind, cases[k].count, cases[k].more[0], apart / most,
                       stressed / stress, exact.agreement);
        g_assert_cmpfloat(apart, <=, 1e-5 * most);
        g_assert_cmpfloat(stressed, <=, 1e-5 * stress);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/moduli/precisions", test_precisions);
    g_test_add_func("/moduli/lattices", test_lattices);
    return g_test_run();
}
