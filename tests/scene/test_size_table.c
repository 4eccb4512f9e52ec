#include "scene/size/size_table.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "scene/tolerances.h"

static char *path; /* scratch file */

static void write_text(const char *text)
{
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static void test_line(void)
{
    struct gb_sizetable table = {0};
    struct gb_error err = {0};
    char text[GB_PARAMS_VALUE_MAX];
    g_assert_true(
        gb_size_table_read(&table, "number: 0.5um 0.25;1 um 0.5; 2 um 0.25;", &err));
    g_assert_cmpint(table.count, ==, 3);
    g_assert_false(table.by_volume);
    g_assert_true(table.row[0].diameter_m == 0.5e-6 && table.row[1].fraction == 0.5);
    g_assert_cmpstr(gb_size_table_write(&table, text, sizeof text), ==,
                    "number: 500 nm 0.25; 1 um 0.5; 2 um 0.25");
    g_assert_true(gb_size_table_read(&table, "volume: 1 um 1", &err));
    g_assert_true(table.by_volume && table.count == 1);
    g_assert_cmpstr(gb_size_table_write(&table, text, sizeof text), ==, "volume: 1 um 1");
    g_assert_true(gb_size_table_read(&table, "", &err));
    g_assert_cmpint(table.count, ==, 0);
    g_assert_cmpstr(gb_size_table_write(&table, text, sizeof text), ==, "");
}

/* The longest table there can be fits the buffer and reads back to the same bits. */
static void test_round_trip(void)
{
    struct gb_sizetable table = {.count = GB_SIZES_MAX, .by_volume = true}, back;
    struct gb_error err = {0};
    char text[GB_PARAMS_VALUE_MAX];
    for (int i = 0; i < GB_SIZES_MAX; i++) {
        table.row[i].diameter_m = 1.0e-9 / 3.0 * (3.0 + i * G_PI * 1e-3);
        table.row[i].fraction =
            i % 2 ? 2.0 / (GB_SIZES_MAX * (1.0 + 1e-13 * i)) : 1e-300 / (i + 3.0);
    }
    gb_size_table_write(&table, text, sizeof text);
    g_assert_cmpuint(strlen(text), <, sizeof text - 1);
    g_assert_true(gb_size_table_read(&back, text, &err));
    g_assert_cmpint(back.count, ==, table.count);
    for (int i = 0; i < GB_SIZES_MAX; i++) {
        g_assert_true(back.row[i].diameter_m == table.row[i].diameter_m);
        g_assert_true(back.row[i].fraction == table.row[i].fraction);
    }
}

static void test_csv(void)
{
    struct gb_sizetable a = {0}, b = {0};
    struct gb_error err = {0};
    write_text("# by hand\nclass,share_volume,diameter_um\n1,0.3,1.3\n2,0.7,8.9\n");
    g_assert_true(gb_size_table_read(&a, path, &err));
    g_assert_true(a.by_volume && a.count == 2 && a.row[0].diameter_m == 1.3e-6);
    write_text("\xef\xbb\xbf"
               "diameter,share_volume\r\n1.3 um,0.3\r\n8900 nm,0.7\r\n");
    g_assert_true(gb_size_table_read(&b, path, &err));
    g_assert_true(b.by_volume && b.count == 2);
    for (int i = 0; i < 2; i++) {
        g_assert_true(a.row[i].diameter_m == b.row[i].diameter_m);
        g_assert_true(a.row[i].fraction == b.row[i].fraction);
    }
}

static const char *const refused_files[][2] = {
    {"", "no header row"},
    {"size,share_number\n", "no column of diameters; must be diameter, or diameter_um"},
    {"diameter_um,share\n1,1\n", "no column of shares; must be share_number or"},
    {"diameter_um,share_number,share_volume\n1,1,1\n", "must be one of them"},
    {"diameter_um,diameter_nm,share_number\n1,1,1\n", "diameter_um and diameter_nm"},
    {"diameter_um,share_number\n", "0 rows: must be between 1 and 128"},
    {"diameter_parsec,share_number\n1,1\n", ":2: '1 parsec': unit must be one of: nm"},
    {"diameter,share_number\n1.5 MPa,1\n", ":2: '1.5 MPa': unit must be one of: nm"},
    {"diameter,share_number\n1.5,1\n", ":2: '1.5': unit must be one of: nm"},
    {"diameter_um,share_number\n1,0.5\n# x\n1,0.5\n",
     ":4: diameter 1 um: must be above 1 um"},
    {"diameter_um,share_number\n2,0.5\n1,0.5\n", ":3: diameter 1 um: must be above 2 um"},
    {"diameter_um,share_number\n-1,1\n", ":2: diameter -1 um: must be above 0"},
    {"diameter_um,share_number\n0,1\n", ":2: diameter 0"},
    {"diameter_um,share_number\n,1\n", ":2: 'nan um'"},
    {"diameter_um,share_number\n1,\n", ":2: share nan: must be between 0 and 1"},
    {"diameter_um,share_number\n1,-0.5\n2,1.5\n",
     ":2: share -0.5: must be between 0 and 1"},
    {"diameter_um,share_number\n1,0.5\n2,0.4\n", ":3: the shares sum to 0.9: must be 1"},
    {"diameter_um,share_number\n1,50\n2,50\n", ":2: share 50"},
    {"diameter_um,share_number\n1,1e999\n", "1e999"},
    {"diameter_um,share_number\n1,one\n", "share_number = 'one'"},
};

static const char *const refused_lines[][2] = {
    {"number:", "must be followed by sizes"},
    {"number: ;", "must be followed by sizes"},
    {"number: 1 um", "1 um: must be a diameter and a share, as in 1.5 um 0.25"},
    {"number: 1 um 0.5; 2 um x", "2 um x: must be"},
    {"number: 1 um 0.5; 2 0.5", "2 0.5: must be"},
    {"number: 1 um 0.5; 2 um 0.6", "the shares sum to 1.1: must be 1 within 0.002"},
    {"volume: 2 um 0.5; 1 um 0.5", "size 2: diameter 1 um: must be above 2 um"},
    {"no-such-file.csv", "no-such-file.csv: "},
    {"/", "/: is not a regular file"},
};

static void test_refused(void)
{
    struct gb_sizetable table = {.count = 7};
    for (size_t i = 0; i < G_N_ELEMENTS(refused_files); i++) {
        struct gb_error err = {0};
        write_text(refused_files[i][0]);
        g_assert_false(gb_size_table_read(&table, path, &err));
        g_test_message("%s", err.text);
        g_assert_nonnull(strstr(err.text, refused_files[i][1]));
        g_assert_nonnull(strstr(err.text, path));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(refused_lines); i++) {
        struct gb_error err = {0};
        g_assert_false(gb_size_table_read(&table, refused_lines[i][0], &err));
        g_test_message("%s", err.text);
        g_assert_nonnull(strstr(err.text, refused_lines[i][1]));
    }
    g_assert_cmpint(table.count, ==, 7); /* untouched */
}

static void test_too_many(void)
{
    struct gb_sizetable table;
    struct gb_error err = {0};
    GString *csv = g_string_new("diameter_um,share_number\n");
    GString *line = g_string_new("number:");
    for (int i = 0; i <= GB_SIZES_MAX; i++) {
        g_string_append_printf(csv, "%d,0.01\n", i + 1);
        g_string_append_printf(line, " %d um 0.01;", i + 1);
    }
    write_text(csv->str);
    g_assert_false(gb_size_table_read(&table, path, &err));
    g_assert_nonnull(strstr(err.text, "129 rows: must be between 1 and 128"));
    g_assert_false(gb_size_table_read(&table, line->str, &err));
    g_assert_nonnull(strstr(err.text, "must be at most 128 sizes"));
    g_string_free(csv, TRUE);
    g_string_free(line, TRUE);
}

/* Any bytes: an answer or an error, nothing else. */
static void test_noise(void)
{
    static const char alphabet[] = "numberve: ;,.\n#0123456789eE+-umdiatrsh_\"\xff\x01";
    const int rounds = 5000;
    for (int round = 0; round < rounds; round++) {
        struct gb_sizetable table;
        char text[120] = "number: ";
        const int start = round % 2 ? 0 : 8, length = g_test_rand_int_range(0, 100);
        for (int i = 0; i < length; i++) {
            text[start + i] = alphabet[g_test_rand_int_range(0, sizeof alphabet - 1)];
        }
        text[start + length] = '\0';
        if (gb_size_table_read(&table, text, NULL)) {
            g_assert_true(gb_size_table_check(&table, NULL, NULL));
        }
        if (round % 20 == 0) {
            write_text(text);
            g_assert_false(gb_size_table_read(&table, path, NULL));
        }
    }
}

static void test_check(void)
{
    struct gb_sizetable table = {.count = GB_SIZES_MAX + 1};
    int row = 5;
    g_assert_false(gb_size_table_check(&table, &row, NULL));
    g_assert_cmpint(row, ==, -1);
    table.count = -1;
    g_assert_false(gb_size_table_check(&table, NULL, NULL));
    table.count = 2;
    table.row[0] = (struct gb_sizetable_row){1e-6, 0.5};
    table.row[1] = (struct gb_sizetable_row){INFINITY, 0.5};
    g_assert_false(gb_size_table_check(&table, &row, NULL));
    g_assert_cmpint(row, ==, 1);
    table.row[1].diameter_m = 2e-6;
    g_assert_true(gb_size_table_check(&table, NULL, NULL));
    table.row[1].fraction += 0.99 * GB_SIZE_FRACTIONS_TOLERANCE;
    g_assert_true(gb_size_table_check(&table, NULL, NULL));
    table.row[1].fraction += 0.02 * GB_SIZE_FRACTIONS_TOLERANCE;
    g_assert_false(gb_size_table_check(&table, NULL, NULL));
}

/* What gb_params_check says of sizes. */
static void test_params(void)
{
    static const char *const cases[][4] = {
        {"particles.distribution=lognormal", "scene.dimension=2", NULL, NULL},
        {"particles.distribution=table", NULL, NULL,
         "particles.table: must not be empty"},
        {"particles.distribution=lognormal", "particles.median=14 nm",
         "particles.least=14 nm", "particles.least = 14 nm: must be below the median"},
        {"particles.distribution=lognormal", "particles.largest=9 nm", NULL,
         "particles.largest = 9 nm: must be above the median, 10 nm"},
        {"particles.table=number: 1 um 1", NULL, NULL, NULL}, /* not used: fine */
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        struct gb_params p;
        struct gb_error err = {0};
        gb_params_init(&p);
        for (int k = 0; k < 3 && cases[i][k]; k++) {
            g_assert_true(gb_params_assign(&p, cases[i][k], &err));
        }
        const bool good = gb_params_check(&p, &err);
        g_test_message("%s", err.text);
        g_assert_true(good == (cases[i][3] == NULL));
        g_assert_true(good || strstr(err.text, cases[i][3]));
    }
    struct gb_params p;
    struct gb_error err = {0};
    gb_params_init(&p);
    g_assert_false(gb_params_assign(&p, "particles.table=number: 1 m 1", &err));
    g_assert_nonnull(strstr(err.text, "particles.table = number: 1 m 1: must be"));
    g_assert_nonnull(strstr(err.text, "between 1 nm and 1 mm"));
    g_assert_false(gb_params_assign(&p, "particles.table=number: 1 um 2", &err));
    g_assert_nonnull(strstr(err.text, "particles.table: size 1: share 2"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    char *folder = g_dir_make_tmp("gb-sizetable-XXXXXX", NULL);
    path = g_build_filename(folder, "sizes.csv", NULL);
    g_test_add_func("/sizetable/line", test_line);
    g_test_add_func("/sizetable/round-trip", test_round_trip);
    g_test_add_func("/sizetable/csv", test_csv);
    g_test_add_func("/sizetable/refused", test_refused);
    g_test_add_func("/sizetable/too-many", test_too_many);
    g_test_add_func("/sizetable/noise", test_noise);
    g_test_add_func("/sizetable/check", test_check);
    g_test_add_func("/sizetable/params", test_params);
    const int status = g_test_run();
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return status;
}
