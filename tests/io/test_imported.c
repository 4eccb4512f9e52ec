/* Packings from files: what is exported reads back to the bit of its format, what other
 * programs write is understood, and what is wrong is refused by its line. */

#include <float.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "io/export.h"
#include "scene/imported/imported.h"

enum { COUNT = 40 };

/* Positions and diameters of full length, in the cell 7 x 6 x 9. */
static struct gb_state *make_state(bool one_size, bool planar, bool tilted)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    GRand *random = g_rand_new_with_seed(5);
    g_assert_true(gb_state_create(&state, COUNT, 0, &err));
    state->dimension = planar ? 2 : 3;
    state->cell[0] = 7.0 + 1.0 / 3.0;
    state->cell[1] = planar ? 1.0 : 6.1;
    state->cell[2] = 9.0 + 1.0 / 7.0;
    state->tilt[0] = tilted && !planar ? 2.0 + 1.0 / 7.0 : 0.0;
    state->tilt[1] = tilted ? -1.0 / 3.0 : 0.0;
    state->tilt[2] = tilted && !planar ? 1.7 : 0.0;
    for (int i = 0; i < COUNT; i++) {
        double part[3];
        for (int c = 0; c < 3; c++) {
            part[c] = g_rand_double(random);
            state->position[3 * i + c] = part[c] * state->cell[c];
        }
        state->position[3 * i] += part[1] * state->tilt[0] + part[2] * state->tilt[1];
        state->position[3 * i + 1] += part[2] * state->tilt[2];
        state->position[3 * i + 1] *= planar ? 0.0 : 1.0;
        state->radius[i] = one_size ? 0.5 : 0.3 + 0.4 * g_rand_double(random);
    }
    state->metre_per_length = 9.7e-9;
    state->pascal_per_stress = 400e9;
    g_rand_free(random);
    return state;
}

static GString *export_state(const struct gb_state *state, const char *format)
{
    struct gb_error err = {0};
    GString *text = g_string_new(NULL);
    g_assert_true(
        gb_export_add(gb_export_find(format, &err), state, 3990.0, 0, text, NULL, &err));
    return text;
}

static char *file_of(const GString *text)
{
    char *path = NULL;
    const int fd = g_file_open_tmp("packing-XXXXXX", &path, NULL);
    g_assert_cmpint(fd, >=, 0);
    close(fd);
    g_assert_true(g_file_set_contents(path, text->str, (gssize)text->len, NULL));
    return path;
}

static const struct gb_imported *load(const GString *text, struct gb_error *err)
{
    char *path = file_of(text);
    const struct gb_imported *packing = gb_imported_load(path, err);
    unlink(path);
    g_free(path);
    return packing;
}

static const struct gb_imported *load_text(const char *text, struct gb_error *err)
{
    GString *string = g_string_new(text);
    const struct gb_imported *packing = load(string, err);
    g_string_free(string, TRUE);
    return packing;
}

/* A packing that is read, in the place of the state that was written. */
static void put(const struct gb_imported *packing, struct gb_state *state)
{
    /* a plane is as thick as its d */
    const double thickness = state->cell[1] * state->metre_per_length / packing->unit_m;
    state->metre_per_length = packing->unit_m;
    memcpy(state->cell, packing->edges, sizeof packing->edges);
    memcpy(state->tilt, packing->tilts, sizeof packing->tilts);
    state->cell[1] = packing->planar ? thickness : state->cell[1];
    memcpy(state->position, packing->position, 3 * COUNT * sizeof(double));
    for (int i = 0; i < COUNT; i++) {
        state->radius[i] = 0.5 * packing->diameter[i];
    }
}

/* Word by word; numbers may differ by a share. */
static void compare_texts(const char *before, const char *after, double share)
{
    char **a = g_strsplit_set(before, " ,\n\"", -1);
    char **b = g_strsplit_set(after, " ,\n\"", -1);
    g_assert_cmpuint(g_strv_length(a), ==, g_strv_length(b));
    for (guint i = 0; i < g_strv_length(a); i++) {
        const double x = g_ascii_strtod(a[i], NULL), y = g_ascii_strtod(b[i], NULL);
        if (share == 0.0 || !isfinite(x) || x == 0.0) { /* nano is not a number */
            g_assert_cmpstr(a[i], ==, b[i]);
        } else {
            g_assert_cmpfloat(fabs(x - y), <=, share * fabs(x));
        }
    }
    g_strfreev(a);
    g_strfreev(b);
}

static void check_round_trip(const char *format, bool one_size, bool planar, bool tilted)
{
    struct gb_error err = {0};
    struct gb_state *state = make_state(one_size, planar, tilted);
    GString *before = export_state(state, format);
    const struct gb_imported *packing = load(before, &err);
    if (packing == NULL) {
        g_error("%s: %s", format, err.text);
    }
    g_assert_cmpint(packing->count, ==, COUNT);
    g_assert_cmpint(packing->one_size, ==, one_size);
    g_assert_cmpint(packing->planar, ==, planar);
    for (int i = 0; one_size && i < 3 * COUNT; i++) {
        g_assert_cmpfloat_with_epsilon(packing->position[i], state->position[i], 1e-14);
    }
    put(packing, state);
    GString *after = export_state(state, format);
    /* the mean of unequal sizes is another unit, which costs the last bit */
    if (strcmp(format, "vtkhdf") != 0) {
        /* so do the bounds of a dump, of the box around a tilted cell */
        const bool exact = one_size && !(tilted && strcmp(format, "lammps-dump") == 0);
        compare_texts(before->str, after->str, exact ? 0.0 : 2.0 * DBL_EPSILON);
    } else if (one_size && !planar) {
        g_assert_true(g_string_equal(before, after));
    }
    g_string_free(before, TRUE);
    g_string_free(after, TRUE);
    gb_state_destroy(state);
}

static void test_round_trip(void)
{
    static const char *const formats[] = {"extxyz", "lammps-dump", "lammps-data", "csv",
                                          "vtkhdf"};
    for (size_t k = 0; k < G_N_ELEMENTS(formats); k++) {
        for (unsigned what = 0; what < 8; what++) {
            check_round_trip(formats[k], what & 1, what & 2, what & 4);
        }
    }
}

/* The table of a run directory gives the bits of the packing. */
static void test_own_table(void)
{
    struct gb_error err = {0};
    struct gb_state *state = make_state(false, false, false);
    GString *text = export_state(state, "csv");
    const struct gb_imported *packing = load(text, &err);
    char *own = gb_imported_text(packing);
    const struct gb_imported *again = load_text(own, &err);
    g_assert_nonnull(again);
    g_assert_true(again == packing); /* one of a checksum is kept */
    g_free(own);
    g_string_free(text, TRUE);
    gb_state_destroy(state);
}

/* The last frame of a trajectory. */
static void test_last_frame(void)
{
    struct gb_error err = {0};
    struct gb_state *first = make_state(true, false, false),
                    *last = make_state(true, false, false);
    first->cell[2] = 12.0;
    for (int k = 0; k < 2; k++) {
        const char *format = k == 0 ? "extxyz" : "lammps-dump";
        GString *both = export_state(first, format), *two = export_state(last, format);
        g_string_append_len(both, two->str, (gssize)two->len);
        const struct gb_imported *packing = load(both, &err);
        g_assert_nonnull(packing);
        g_assert_cmpint(packing->count, ==, COUNT);
        g_assert_cmpfloat_with_epsilon(packing->edges[2], 9.0 + 1.0 / 7.0, 1e-14);
        g_string_free(both, TRUE);
        g_string_free(two, TRUE);
    }
    gb_state_destroy(first);
    gb_state_destroy(last);
}

/* Two particles of diameter 2 (files without a unit) or 2 um, at (1, 2, 3), (4, 5, 6) in
 * a cell of 10 x 12 x 14. */
static const struct {
    const char *name, *text;
    double unit_m;
} foreign[] = {
    {"Yade, format in a comment",
     "#format x_y_z_r\n# cell: 10 12 14\n1 2\t3 1\n4 5\t6 1\n", NAN},
    {"four columns", "# cell: 10 12 14\n1 2 3 1\n4 5 6 1\n", NAN},
    {"tomograph, semicolons, units in brackets",
     "# cell, um: 10 12 14\n\"Label\";\"X (um)\";\"Y (um)\";\"Z (um)\";\"EqDiameter "
     "(um)\"\n7;1;2;3;2\n8;4;5;6;2\n",
     2e-6},
    {"ParaView",
     "# cell, um: 10 12 14\n\"Points:0\",\"Points:1\",\"Points:2\",radius_um\n1,2,"
     "3,1\n4,5,6,1\n",
     2e-6},
    {"tabs",
     "# cell, um: 10 12 14\nx [um]\ty [um]\tz [um]\tdiameter [um]\n1\t2\t3\t2\n4\t5"
     "\t6\t2\n",
     2e-6},
    {"LAMMPS dump from the centre, unwrapped",
     "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-5 5\n-6 6\n-7 "
     "7\nITEM: ATOMS id type xu yu zu diameter\n2 1 -4 -4 -4 2\n1 1 -1 -1 13 2\n",
     NAN},
    {"LAMMPS data, units in the title, image flags",
     "LAMMPS data file via write_data, version 1, timestep = 0, units = micro\n\n2 atoms\n1 "
     "atom types\n\n0 10 xlo xhi\n0 12 ylo yhi\n0 14 zlo zhi\n\nAtoms # sphere\n\n1 1 2 1 1 2 "
     "3 0 0 0\n2 1 2 1 4 5 6 0 0 0\n\nVelocities\n\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n",
     2e-6},
    {"ASE",
     "2\nLattice=\"10 0 0 0 12 0 0 0 14\" Properties=species:S:1:pos:R:3:radius:R:1 "
     "pbc=\"T T T\"\nX 1 2 3 1\nX 4 5 6 1\n",
     NAN},
};

/* The cell 10 x 12 x 14 with tilts 2, 1, 0.5 around diameters of 2, as LAMMPS writes it: tilts
 * before the bounds, and a dump, whose bounds are those of the box around it. */
static void test_tilted(void)
{
    static const char *const texts[] = {
        "title\n\n2 atoms\n2 1 0.5 xy xz yz\n-5 5 xlo xhi\n-6 6 ylo yhi\n-7 7 zlo zhi\n\n"
        "Atoms # sphere\n\n1 1 2 1 -3 -3 -3\n2 1 2 1 0 0 0\n",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
        "-5 8 2\n-6 6.5 1\n-7 7 0.5\nITEM: ATOMS id x y z radius\n1 -3 -3 -3 1\n"
        "2 0 0 0 1\n"};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        struct gb_error err = {0};
        const struct gb_imported *packing = load_text(texts[k], &err);
        if (packing == NULL) {
            g_error("%s", err.text);
        }
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat(packing->edges[c], ==, 5.0 + c);
            g_assert_cmpfloat(packing->tilts[c], ==, 1.0 / (1 << c));
            g_assert_cmpfloat(packing->position[c], ==, 1.0 + 0.5 * c);
        }
    }
}

static void test_foreign(void)
{
    static const double edges[3] = {5.0, 6.0, 7.0};
    static const double position[6] = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0};
    for (size_t k = 0; k < G_N_ELEMENTS(foreign); k++) {
        struct gb_error err = {0};
        const struct gb_imported *packing = load_text(foreign[k].text, &err);
        if (packing == NULL) {
            g_error("%s: %s", foreign[k].name, err.text);
        }
        g_test_message("%s", foreign[k].name);
        g_assert_cmpint(packing->count, ==, 2);
        g_assert_true(packing->one_size);
        for (int c = 0; c < 3; c++) {
            g_assert_cmpfloat(packing->edges[c], ==, edges[c]);
        }
        for (int c = 0; c < 6; c++) {
            g_assert_cmpfloat(packing->position[c], ==, position[c]);
        }
        g_assert_cmpint(isnan(packing->unit_m), ==, isnan(foreign[k].unit_m));
        g_assert_true(isnan(packing->unit_m) ||
                      fabs(packing->unit_m - foreign[k].unit_m) < 1e-20);
    }
}

static const struct {
    const char *text, *message;
} wrong[] = {
    {"", "0 particles: must be 2 or more"},
    {"# cell: 9 9 9\nx,y,z,mass\n1,2,3,4\n", ":2: no column diameter or radius"},
    {"# cell: 9 9 9\nx,y,z,r\n1,2,3,1\n1,2,nan,1\n", ":4: z is nan"},
    {"# cell: 9 9 9\nx,y,z,r\n1,2,3,1\n1,2,3,-1\n", ":4: radius is -1: must be above 0"},
    {"# cell: 9 9 9\nx;y;z;r\n1;2;3;0,5\n", ":3: radius is 0,5"},
    {"# cell: 9 9 9\nx,y,z,r\n1,2,3\n", ":3: 3 columns: must be at least 4"},
    {"# cell: 9 9\nx,y,z,r\n1,2,3,1\n", ":1: a cell of 2 edges"},
    {"x,y,z,r\n1,2,3,1\n4,5,6,1\n", "no periodic cell"},
    {"1 2 3 1 7\n", ":1: 5 columns without names"},
    {"3\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=pos:R:3:radius:R:1\n1 2 3 1\n",
     "must have 3 particles, has 1"},
    {"1\nLattice=\"9 1 0 1 9 0 0 0 9\" Properties=pos:R:3:radius:R:1\n1 2 3 1\n",
     ":2: Lattice: cell vectors must be (Lx 0 0), (xy Ly 0), (xz yz Lz)"},
    {"# cell: 9 9 9 tilt xy xz yz: 1 2\nx,y,z,r\n1,2,3,1\n", ":1: 2 tilts of the cell"},
    {"ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y z\n1 1 2 3\n",
     ":3: no column diameter or radius"},
    {"ITEM: TIMESTEP\n0\n", "no ITEM: ATOMS"},
    {"ITEM: BOX BOUNDS abc origin p p p\n9 0 0 0\n1 9 0 0\n0 0 9 0\n",
     ":1: a cell by vectors and origin: must be bounds with xy xz yz"},
    {"t\n\n1 atoms\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms # atomic\n\n1 1 1 2 3\n",
     "atoms of style atomic: must be sphere"},
};

static void test_wrong(void)
{
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        struct gb_error err = {0};
        g_assert_null(load_text(wrong[k].text, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (strstr(err.text, wrong[k].message) == NULL) {
            g_error("%s: expected %s", err.text, wrong[k].message);
        }
    }
}

/* Keys that follow from the packing, and those that contradict it. */
static void test_params(void)
{
    struct gb_params params;
    struct gb_error err = {0};
    struct gb_state *state = make_state(false, false, false);
    GString *text = export_state(state, "csv");
    char *path = file_of(text);
    char *key = g_strconcat("structure.from=", path, NULL);
    gb_params_init(&params);
    g_assert_true(gb_params_assign(&params, "particles.distribution=lognormal", &err));
    g_assert_true(gb_params_assign(&params, "particles.sigma=0.1", &err));
    g_assert_true(gb_params_assign(&params, key, &err));
    g_assert_cmpint(params.count, ==, COUNT);
    g_assert_cmpint(params.distribution, ==, GB_DISTRIBUTION_MONO);
    g_assert_cmpfloat_with_epsilon(params.diameter_m, 9.7e-9, 2e-9);
    g_assert_true(gb_params_assign(&params, "particles.count=41", &err));
    g_assert_false(gb_params_check(&params, &err));
    g_assert_nonnull(strstr(err.text, "particles.count = 41: must be 40"));
    g_assert_true(gb_params_assign(&params, "particles.count=40", &err));
    g_assert_true(gb_params_assign(&params, "scene.dimension=2", &err));
    g_assert_false(gb_params_check(&params, &err));
    g_assert_nonnull(strstr(err.text, "scene.dimension = 2: must be 3"));
    g_assert_true(gb_params_assign(&params, "structure.from=", &err));
    g_assert_false(gb_imported_given(&params));
    unlink(path);
    g_free(key);
    g_free(path);
    g_string_free(text, TRUE);
    gb_state_destroy(state);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/imported/round_trip", test_round_trip);
    g_test_add_func("/imported/own_table", test_own_table);
    g_test_add_func("/imported/last_frame", test_last_frame);
    g_test_add_func("/imported/foreign", test_foreign);
    g_test_add_func("/imported/tilted", test_tilted);
    g_test_add_func("/imported/wrong", test_wrong);
    g_test_add_func("/imported/params", test_params);
    return g_test_run();
}
