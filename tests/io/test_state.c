/* state.h5: what is written is read back bit for bit; what is damaged is refused in one
 * line; a disk that fails leaves the old file. */
#include "hdf/hdf.h"
#include "io/state.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/alloc.h"
#include "base/file.h"

static char *scratch;

static char *in_scratch(const char *name)
{
    return g_build_filename(scratch, name, NULL);
}

/* A made-up packing: values are arbitrary but all different. */
static struct gb_state *made_up(int64_t count, int64_t pair_count)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, count, pair_count, &err));
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 10.0 + 0.1 * k;
    }
    for (int64_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            state->position[3 * i + k] =
                fmod(0.7 * (double)(3 * i + k) + 1.0 / 3.0, 10.0);
        }
        state->radius[i] = 0.5 + 1e-3 * (double)(i % 7);
        state->contacts[i] = (int32_t)(i % 13);
    }
    for (int64_t i = 0; i < pair_count; i++) {
        state->pair[2 * i] = (int32_t)(i % count);
        state->pair[2 * i + 1] = (int32_t)((i + 1) % count);
        for (int k = 0; k < 3; k++) {
            state->pair_force[3 * i + k] = sin((double)(3 * i + k));
        }
        state->pair_normal[i] = cos((double)i);
        state->pair_bridged[i] = (uint8_t)(i % 2);
    }
    state->point = (struct gb_point){.branch = 1,
                                     .branch_from_pa = 1e8,
                                     .step = 321,
                                     .density = 0.512,
                                     .px_pa = 1e7,
                                     .py_pa = NAN,
                                     .pz_pa = 1e8,
                                     .p_pa = 1e8,
                                     .coordination = 5.5,
                                     .bridged = 0.3,
                                     .rattlers = 0.01,
                                     .residual = 1e-4,
                                     .iterations = 77,
                                     .evaluations = 99,
                                     .seconds = 1.5};
    g_assert_true(gb_state_allocate_walls(state, 3, &err));
    for (int k = 0; k < 3; k++) {
        state->wall[2 * k + 1] = k;
        state->wall_force[3 * k + 1] = 0.5 + k;
    }
    state->die_top = 1.25;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 3.82e11;
    state->seed = UINT64_MAX;
    g_strlcpy(state->preset, "Al₂O₃, 10 nm", sizeof state->preset);
    g_strlcpy(state->version, "0.1.0", sizeof state->version);
    return state;
}

static bool write_state(const char *path, int64_t count, int64_t pair_count)
{
    struct gb_error err = {0};
    struct gb_state *state = made_up(count, pair_count);
    const bool done = gb_state_write(state, NULL, path, &err);
    gb_state_destroy(state);
    return done;
}

static void assert_refused(const char *path, enum gb_status code, const char *part)
{
    struct gb_error err = {0};
    struct gb_state *state = NULL;
    g_assert_false(gb_state_read(&state, path, &err));
    g_assert_null(state);
    g_assert_cmpint(err.code, ==, code);
    g_assert_nonnull(strstr(err.text, path));
    if (strstr(err.text, part) == NULL) {
        g_error("\"%s\" does not say \"%s\"", err.text, part);
    }
    g_assert_null(strchr(err.text, '\n'));
}

static void assert_same(const void *a, const void *b, size_t bytes)
{
    g_assert_cmpint(memcmp(a, b, bytes), ==, 0);
}

static void assert_equal(const struct gb_state *a, const struct gb_state *b)
{
    const size_t n = (size_t)a->count;
    const size_t m = (size_t)a->pair_count;
    g_assert_cmpint(a->count, ==, b->count);
    g_assert_cmpint(a->pair_count, ==, b->pair_count);
    g_assert_cmpint(a->dimension, ==, b->dimension);
    assert_same(a->cell, b->cell, sizeof a->cell);
    assert_same(a->position, b->position, 24 * n);
    assert_same(a->radius, b->radius, 8 * n);
    assert_same(a->contacts, b->contacts, 4 * n);
    assert_same(a->pair, b->pair, 8 * m);
    assert_same(a->pair_force, b->pair_force, 24 * m);
    assert_same(a->pair_normal, b->pair_normal, 8 * m);
    assert_same(a->pair_bridged, b->pair_bridged, m);
    g_assert_cmpint(a->wall_count, ==, b->wall_count);
    assert_same(a->wall, b->wall, 8 * (size_t)a->wall_count);
    assert_same(a->wall_force, b->wall_force, 24 * (size_t)a->wall_count);
    g_assert_cmpfloat(a->die_top, ==, b->die_top);
    g_assert_cmpint(a->point.branch, ==, b->point.branch);
    g_assert_cmpint(a->point.step, ==, b->point.step);
    g_assert_cmpfloat(a->point.branch_from_pa, ==, b->point.branch_from_pa);
    g_assert_cmpfloat(a->point.density, ==, b->point.density);
    g_assert_true(isnan(b->point.py_pa));
    g_assert_cmpfloat(a->point.p_pa, ==, b->point.p_pa);
    g_assert_cmpfloat(a->point.seconds, ==, b->point.seconds);
    g_assert_cmpint(a->point.evaluations, ==, b->point.evaluations);
    g_assert_cmpfloat(a->metre_per_length, ==, b->metre_per_length);
    g_assert_cmpfloat(a->pascal_per_stress, ==, b->pascal_per_stress);
    g_assert_true(a->seed == b->seed);
    g_assert_cmpstr(a->preset, ==, b->preset);
    g_assert_cmpstr(a->version, ==, b->version);
}

static void test_round_trip(void)
{
    const int64_t sizes[][2] = {
        {1, 0}, {2, 1}, {1000, 3000}, {40000, 5}, {200000, 300000}};
    char *path = in_scratch("round.h5");
    for (size_t k = 0; k < G_N_ELEMENTS(sizes); k++) {
        struct gb_error err = {0};
        struct gb_state *back = NULL;
        struct gb_state *state = made_up(sizes[k][0], sizes[k][1]);
        g_assert_true(gb_state_write(state, NULL, path, &err));
        const bool read = gb_state_read(&back, path, &err);
        g_assert_cmpstr(err.text, ==, "");
        g_assert_true(read);
        assert_equal(state, back);
        gb_state_destroy(back);
        gb_state_destroy(state);
    }
    g_free(path);
}

static void test_same_bytes(void)
{
    char *path[2] = {in_scratch("one.h5"), in_scratch("two.h5")};
    char *text[2];
    gsize size[2];
    for (int k = 0; k < 2; k++) {
        g_assert_true(write_state(path[k], 50, 60));
        g_assert_true(g_file_get_contents(path[k], &text[k], &size[k], NULL));
    }
    g_assert_cmpuint(size[0], ==, size[1]);
    assert_same(text[0], text[1], size[0]);
    for (int k = 0; k < 2; k++) {
        g_free(text[k]);
        g_free(path[k]);
    }
}

/* Without the sync of g_file_set_contents, which takes most of the time of a test. */
static bool put_file(const char *path, const char *text, gsize size)
{
    return g_file_set_contents_full(path, text, (gssize)size, G_FILE_SET_CONTENTS_NONE,
                                    0644, NULL);
}

/* Cut anywhere, the file is refused; no cut gives a state. */
static void test_truncated(void)
{
    char *path = in_scratch("whole.h5");
    char *cut = in_scratch("cut.h5");
    char *text = NULL;
    gsize size = 0;
    g_assert_true(write_state(path, 50, 60));
    g_assert_true(g_file_get_contents(path, &text, &size, NULL));
    for (gsize length = 0; length < size; length += length + 98 < size ? 97 : 1) {
        g_assert_true(put_file(cut, text, length));
        g_test_message("cut to %zu of %zu bytes", (size_t)length, (size_t)size);
        assert_refused(cut, GB_ERR_INPUT, cut);
    }
    g_free(text);
    g_free(cut);
    g_free(path);
}

/* One flipped byte: refused, or outside of what is read; never a crash, and never a
 * particle that differs, because the data carries checksums. */
static void test_flipped(void)
{
    char *path = in_scratch("whole.h5");
    char *bad = in_scratch("bad.h5");
    char *text = NULL;
    gsize size = 0;
    struct gb_state *whole = made_up(50, 60);
    struct gb_error err = {0};
    g_assert_true(gb_state_write(whole, NULL, path, &err));
    g_assert_true(g_file_get_contents(path, &text, &size, NULL));
    for (gsize at = 0; at < size; at += 7) {
        struct gb_state *back = NULL;
        text[at] = (char)(text[at] ^ 0x41);
        g_assert_true(put_file(bad, text, size));
        text[at] = (char)(text[at] ^ 0x41);
        if (gb_state_read(&back, bad, &err)) {
            const size_t bytes = 24 * (size_t)whole->count;
            assert_same(back->position, whole->position, bytes);
            gb_state_destroy(back);
        } else {
            g_assert_nonnull(strstr(err.text, bad));
        }
    }
    gb_state_destroy(whole);
    g_free(text);
    g_free(bad);
    g_free(path);
}

/* Replaces a dataset of a good file by another of the given type and shape. */
static void replace_set(const char *path, const char *name, hid_t type, int rank,
                        hsize_t rows, hsize_t columns)
{
    const hsize_t shape[2] = {rows, columns};
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    g_assert_cmpint(H5Ldelete(file, name, H5P_DEFAULT), >=, 0);
    if (rank > 0) {
        const hid_t space = H5Screate_simple(rank, shape, NULL);
        const hid_t set =
            H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        g_assert_cmpint(set, >=, 0);
        H5Dclose(set);
        H5Sclose(space);
    }
    g_assert_cmpint(H5Fclose(file), >=, 0);
}

static void test_wrong_shape(void)
{
    char *path = in_scratch("shape.h5");
    const struct {
        const char *name;
        hid_t type;
        int rank;
        hsize_t rows, columns;
        const char *says;
    } wrong[] = {
        {"/position", H5T_IEEE_F32LE, 2, 50, 3, "type"},
        {"/position", H5T_STD_I64LE, 2, 50, 3, "type"},
        {"/position", H5T_IEEE_F64LE, 2, 50, 2, "shape"},
        {"/position", H5T_IEEE_F64LE, 1, 150, 1, "shape"},
        {"/position", H5T_IEEE_F64LE, 2, 0, 3, "rows"},
        {"/radius", H5T_IEEE_F64LE, 0, 0, 0, "missing"},
        {"/radius", H5T_IEEE_F64LE, 1, 200000000, 1, "shorter"},
        {"/contacts", H5T_STD_U32LE, 1, 50, 1, "type"},
        {"/pair", H5T_STD_I32LE, 2, 0, 2, "rows"},
        {"/pair_bridged", H5T_STD_I8LE, 1, 60, 1, "type"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        g_assert_true(write_state(path, 50, 60));
        replace_set(path, wrong[k].name, wrong[k].type, wrong[k].rank, wrong[k].rows,
                    wrong[k].columns);
        assert_refused(path, GB_ERR_INPUT, wrong[k].says);
    }
    g_free(path);
}

static void test_links(void)
{
    char *path = in_scratch("link.h5");
    g_assert_true(write_state(path, 50, 60));
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "/radius", H5P_DEFAULT);
    H5Lcreate_external("/etc/passwd", "/", file, "/radius", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    assert_refused(path, GB_ERR_INPUT, "link");

    const hsize_t rows = 50;
    g_assert_true(write_state(path, 50, 60));
    file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "/radius", H5P_DEFAULT);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(create, "/etc/passwd", 0, 400);
    const hid_t space = H5Screate_simple(1, &rows, NULL);
    const hid_t set = H5Dcreate2(file, "/radius", H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                 create, H5P_DEFAULT);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(create);
    H5Fclose(file);
    assert_refused(path, GB_ERR_INPUT, "another file");
    g_free(path);
}

#define AT(member) offsetof(struct gb_state, member)

/* A wrong value: of a member, or of an element of the array that a member points to. */
static const struct wrong_value {
    const char *says;
    size_t offset;
    enum { MEMBER, ELEMENT } where;
    size_t index; /* of the element, or of the member where it is an array */
    enum { REAL, INTEGER, MEMBER_INT, BYTE } type;
    double value;
} wrong_values[] = {
    {"/position", AT(position), ELEMENT, 5, REAL, (double)NAN},
    {"/position", AT(position), ELEMENT, 5, REAL, 1e9},
    {"/radius", AT(radius), ELEMENT, 7, REAL, 0.0},
    {"/radius", AT(radius), ELEMENT, 7, REAL, (double)INFINITY},
    {"/contacts", AT(contacts), ELEMENT, 7, INTEGER, -1.0},
    {"/pair", AT(pair), ELEMENT, 3, INTEGER, -1.0},
    {"/pair", AT(pair), ELEMENT, 3, INTEGER, 50.0},
    {"/pair", AT(pair), ELEMENT, 3, INTEGER, 1.0}, /* the first of the pair as well */
    {"/pair_force", AT(pair_force), ELEMENT, 3, REAL, (double)NAN},
    {"/pair_normal", AT(pair_normal), ELEMENT, 3, REAL, (double)INFINITY},
    {"dimension", AT(dimension), MEMBER, 0, MEMBER_INT, 4.0},
    {"cell_d", AT(cell), MEMBER, 1, REAL, 0.0},
    {"cell_d", AT(cell), MEMBER, 2, REAL, (double)NAN},
    {"metre_per", AT(metre_per_length), MEMBER, 0, REAL, -1.0},
    {"pascal_per", AT(pascal_per_stress), MEMBER, 0, REAL, 0.0},
    {"p_pa", AT(point.p_pa), MEMBER, 0, REAL, (double)INFINITY},
    {"branch", AT(point.branch), MEMBER, 0, MEMBER_INT, GB_BRANCH_LEAST - 1},
    {"branch", AT(point.branch), MEMBER, 0, MEMBER_INT, -1000.0},
    {"/pair_bri", AT(pair_bridged), ELEMENT, 3, BYTE, 2.0},
};

#undef AT

static void put_wrong_value(struct gb_state *state, const struct wrong_value *wrong)
{
    char *member = (char *)state + wrong->offset;
    void *at = wrong->where == ELEMENT ? *(void **)(void *)member : member;
    switch (wrong->type) {
    case REAL:
        ((double *)at)[wrong->index] = wrong->value;
        break;
    case INTEGER:
        ((int32_t *)at)[wrong->index] = (int32_t)wrong->value;
        break;
    case MEMBER_INT:
        ((int *)at)[wrong->index] = (int)wrong->value;
        break;
    case BYTE:
        ((uint8_t *)at)[wrong->index] = (uint8_t)wrong->value;
        break;
    }
}

/* A wrong value in a made-up packing: the message names its dataset. */
static void test_wrong_values(void)
{
    char *path = in_scratch("value.h5");
    for (size_t k = 0; k < G_N_ELEMENTS(wrong_values); k++) {
        struct gb_error err = {0};
        struct gb_state *state = made_up(50, 60);
        put_wrong_value(state, &wrong_values[k]);
        g_assert_true(gb_state_write(state, NULL, path, &err));
        assert_refused(path, GB_ERR_INPUT, wrong_values[k].says);
        gb_state_destroy(state);
    }
    g_free(path);
}

static void test_hostile_text(void)
{
    char *path = in_scratch("text.h5");
    struct gb_error err = {0};
    struct gb_state *back = NULL;
    struct gb_state *state = made_up(3, 2);
    g_strlcpy(state->preset,
              "a\033[2Jb\xc2\x9b"
              "c\xff\xfe",
              sizeof state->preset);
    g_assert_true(gb_state_write(state, NULL, path, &err));
    g_assert_true(gb_state_read(&back, path, &err));
    g_assert_cmpstr(back->preset, ==, "a?[2Jb??c");
    gb_state_destroy(back);
    gb_state_destroy(state);
    g_free(path);
}

static void test_not_a_state(void)
{
    char *missing = in_scratch("missing.h5");
    char *text = in_scratch("text.txt");
    char *other = in_scratch("other.h5");
    assert_refused(missing, GB_ERR_MACHINE, "No such file");
    assert_refused(scratch, GB_ERR_INPUT, "regular");
    assert_refused("/dev/zero", GB_ERR_INPUT, "regular");
    g_assert_true(g_file_set_contents(text, "density,pressure\n", -1, NULL));
    assert_refused(text, GB_ERR_INPUT, "HDF5");
    H5Fclose(H5Fcreate(other, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    assert_refused(other, GB_ERR_INPUT, "layout");
    g_free(other);
    g_free(text);
    g_free(missing);
}

static unsigned files_in_scratch(void)
{
    unsigned count = 0;
    GDir *folder = g_dir_open(scratch, 0, NULL);
    while (g_dir_read_name(folder) != NULL) {
        count++;
    }
    g_dir_close(folder);
    return count;
}

static void test_bad_target(void)
{
    char *plain = in_scratch("plain");
    char *below = in_scratch("plain/state.h5");
    char *nowhere = in_scratch("nowhere/state.h5");
    struct gb_error err = {0};
    g_assert_true(g_file_set_contents(plain, "x", 1, NULL));
    const char *targets[] = {below, nowhere, "/dev/full", "/proc/state.h5", ""};
    for (size_t k = 0; k < G_N_ELEMENTS(targets); k++) {
        struct gb_state *state = made_up(3, 2);
        g_assert_false(gb_state_write(state, NULL, targets[k], &err));
        g_assert_true(err.code == GB_ERR_MACHINE || err.code == GB_ERR_INPUT);
        gb_state_destroy(state);
    }
    struct stat info;
    g_assert_cmpint(stat("/dev/full", &info), ==, 0);
    g_assert_true(S_ISCHR(info.st_mode));
    g_free(nowhere);
    g_free(below);
    g_free(plain);
}

/* The disk is full after k bytes, for several k: the old state stays and nothing is left
 * lying about. */
static void full_disk(int64_t count, int64_t pairs, rlim_t step)
{
    char *path = in_scratch("full.h5");
    struct rlimit whole;
    struct stat info;
    g_assert_true(write_state(path, count, pairs));
    g_assert_cmpint(stat(path, &info), ==, 0);
    g_assert_true(write_state(path, 50, 60));
    const unsigned before = files_in_scratch();
    getrlimit(RLIMIT_FSIZE, &whole);
    signal(SIGXFSZ, SIG_IGN);
    for (rlim_t k = 0; k < (rlim_t)info.st_size; k += step) {
        const struct rlimit tight = {.rlim_cur = k, .rlim_max = whole.rlim_max};
        g_assert_cmpint(setrlimit(RLIMIT_FSIZE, &tight), ==, 0);
        struct gb_error err = {0};
        struct gb_state *state = made_up(count, pairs);
        const bool done = gb_state_write(state, NULL, path, &err);
        setrlimit(RLIMIT_FSIZE, &whole);
        g_assert_false(done);
        g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
        g_assert_nonnull(strstr(err.text, "cannot be written: File too large"));
        gb_state_destroy(state);
        struct gb_state *back = NULL;
        g_assert_true(gb_state_read(&back, path, &err));
        g_assert_cmpint(back->count, ==, 50);
        gb_state_destroy(back);
        g_assert_cmpuint(files_in_scratch(), ==, before);
    }
    g_free(path);
}

static void test_full_disk(void)
{
    full_disk(60, 70, 2003);
}

/* Of a state that is built in its temporary file. */
static void test_full_disk_large(void)
{
    full_disk(200000, 300000, 3000017);
}

static void test_no_memory(void)
{
    char *path = in_scratch("memory.h5");
    g_assert_true(write_state(path, 50, 60));
    const size_t before = gb_alloc_bytes();
    bool done = false;
    for (long k = 1; !done && k < 100; k++) {
        struct gb_error err = {0};
        struct gb_state *back = NULL;
        gb_alloc_fail_after(k);
        done = gb_state_read(&back, path, &err) && gb_state_write(back, NULL, path, &err);
        gb_alloc_fail_after(0);
        g_assert_true(done || err.code == GB_ERR_MEMORY);
        gb_state_destroy(back);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_true(done);
    g_free(path);
}

static void remove_scratch(void)
{
    GDir *folder = g_dir_open(scratch, 0, NULL);
    const char *name = NULL;
    while ((name = g_dir_read_name(folder)) != NULL) {
        char *path = in_scratch(name);
        g_remove(path);
        g_free(path);
    }
    g_dir_close(folder);
    g_rmdir(scratch);
    g_free(scratch);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gb_hdf_skip_exit(); /* a file that a full disk ended stays open there */
    scratch = g_dir_make_tmp("greenbody-state-XXXXXX", NULL);
    g_test_add_func("/run/state/round-trip", test_round_trip);
    g_test_add_func("/run/state/same-bytes", test_same_bytes);
    g_test_add_func("/run/state/truncated", test_truncated);
    g_test_add_func("/run/state/flipped", test_flipped);
    g_test_add_func("/run/state/wrong-shape", test_wrong_shape);
    g_test_add_func("/run/state/links", test_links);
    g_test_add_func("/run/state/wrong-values", test_wrong_values);
    g_test_add_func("/run/state/hostile-text", test_hostile_text);
    g_test_add_func("/run/state/not-a-state", test_not_a_state);
    g_test_add_func("/run/state/bad-target", test_bad_target);
    g_test_add_func("/run/state/full-disk", test_full_disk);
    g_test_add_func("/run/state/full-disk-large", test_full_disk_large);
    g_test_add_func("/run/state/no-memory", test_no_memory);
    const int failed = g_test_run();
    remove_scratch();
    return failed;
}
