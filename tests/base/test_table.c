#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "base/listing.h"
#include "base/table.h"

static char *path;

static void write_text(const char *text, gssize length)
{
    g_assert_true(g_file_set_contents(path, text, length, NULL));
}

static void test_good(void)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    write_text("\xef\xbb\xbf# by hand\n#\nbranch, density ,p_MPa\r\nload,0.5,1e1\r\n"
               "\n# between\nunload:100MPa, -.25 ,\nload,+1,2.5",
               -1);
    g_assert_true(gb_table_read(&table, path, "branch", &err));
    g_assert_cmpuint(gb_table_rows(table), ==, 3);
    const double *density = gb_table_column(table, "density", &err);
    const double *p = gb_table_column(table, "p_MPa", &err);
    g_assert_true(density[0] == 0.5 && density[1] == -0.25 && density[2] == 1.0);
    g_assert_true(p[0] == 10.0 && isnan(p[1]) && p[2] == 2.5);
    g_assert_cmpstr(gb_table_word(table, 1), ==, "unload:100MPa");
    g_assert_null(gb_table_column(table, "time_ns", &err));
    g_assert_nonnull(strstr(err.text, "no column time_ns; there are branch, density"));
    gb_table_destroy(table);

    /* units beside the words are skipped, alone they are no numbers */
    write_text("quantity,value,unit\ncentre,2,MPa\nshift,3,1\n", -1);
    g_assert_true(gb_table_read(&table, path, "quantity", &err));
    g_assert_cmpstr(gb_table_word(table, 1), ==, "shift");
    g_assert_true(gb_table_column(table, "value", &err)[0] == 2.0);
    gb_table_destroy(table);
    g_assert_false(gb_table_read(&table, path, NULL, &err));

    write_text("a\n", -1);
    g_assert_true(gb_table_read(&table, path, NULL, &err));
    g_assert_cmpuint(gb_table_rows(table), ==, 0);
    g_assert_nonnull(gb_table_column(table, "a", NULL));
    gb_table_destroy(table);
    gb_table_destroy(NULL);
}

/* Seeds, which doubles would round. */
static void test_whole(void)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    write_text("seed,x\n9007199254740993,1\n18446744073709551615,2\n", -1);
    g_assert_true(gb_table_read_whole(&table, path, NULL, "seed", &err));
    g_assert_cmpuint(gb_table_whole(table)[0], ==, UINT64_C(9007199254740993));
    g_assert_cmpuint(gb_table_whole(table)[1], ==, UINT64_MAX);
    g_assert_true(gb_table_column(table, "x", &err)[1] == 2.0);
    gb_table_destroy(table);
    g_assert_true(gb_table_read_whole(&table, path, NULL, "other", &err));
    g_assert_null(gb_table_whole(table));
    gb_table_destroy(table);
    static const char *const no_number[] = {"seed\n18446744073709551616\n", "seed\n-1\n",
                                            "seed\n1.5\n", "seed,x\n,1\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(no_number); i++) {
        write_text(no_number[i], -1);
        g_assert_false(gb_table_read_whole(&table, path, NULL, "seed", &err));
        g_assert_nonnull(strstr(err.text, ":2: seed = '"));
    }
}

static const char *const refused[][2] = {
    {"", "no header row"},
    {"# only\n\n", "no header row"},
    {"a,b\n1\n", ":2: 1 cells: must be 2"},
    {"a,b\n1,2,3\n", ":2: 3 cells: must be 2"},
    {"a,b\n1,2\n# x\n1,nan\n", ":4: b = 'nan': must be a number"},
    {"a,b\n1,inf\n", "b = 'inf'"},
    {"a,b\n1,0x10\n", "b = '0x10'"},
    {"a,b\n1,1e999\n", "b = '1e999'"},
    {"a,b\n1,2 3\n", "b = '2 3'"},
    {"a,b\n1,\"2\"\n", "b = '\"2\"'"},
    {"a,b\n1,\x1b[2J\n", "b = '\\x1b[2J'"},
    {"a,b\n1,\xff\xfe\n", "b = '\\xff\\xfe'"},
    {"a,a\n", ":1: column 2: name 'a' must be unique"},
    {"a,,b\n", ":1: column 2: name '' must be unique"},
    {"a,\"b\"\n", "without quotes"},
};

static void expect_refused(const char *said)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    g_assert_false(gb_table_read(&table, path, "branch", &err));
    g_test_message("%s", err.text);
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, said));
    g_assert_null(table);
}

static void test_hostile(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(refused); i++) {
        write_text(refused[i][0], -1);
        expect_refused(refused[i][1]);
    }
    write_text("a\n1\0002\n", 6);
    expect_refused("NUL bytes");
    GString *wide = g_string_new("x0");
    for (int i = 1; i < 300; i++) {
        g_string_append_printf(wide, ",x%d", i);
    }
    write_text(wide->str, (gssize)wide->len);
    expect_refused("more than 256 columns");
    /* many short lines under many columns ask for more memory than the file has */
    g_string_truncate(wide, 0);
    for (int i = 0; i < 200; i++) {
        g_string_append_printf(wide, "%sx%d", i > 0 ? "," : "", i);
    }
    for (int i = 0; i < 200000; i++) {
        g_string_append_c(wide, '\n');
    }
    write_text(wide->str, (gssize)wide->len);
    expect_refused("more than 33554432 cells");
    g_string_free(wide, TRUE);
}

static void expect_printed(const struct gb_listing *listing,
                           enum gb_listing_format format, const char *expected)
{
    GString *text = gb_listing_print(listing, format);
    g_assert_cmpstr(text->str, ==, expected);
    g_string_free(text, TRUE);
}

/* One filled listing in every format; the reader takes its CSV. */
static void test_listing(void)
{
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "`%s`", "name");
    gb_listing_column(listing, "%.3g", "p_%s", "MPa");
    gb_listing_columns(listing, "", "x");
    gb_listing_columns(listing, "%.0f", "seed");
    gb_listing_comment(listing, "first\n\nsecond");
    gb_listing_comment(listing, NULL);
    gb_listing_text(listing, "load");
    gb_listing_numbers(listing, (const double[]){0.00012345, 0.1}, 2);
    gb_listing_whole(listing, UINT64_MAX);
    gb_listing_note(listing, "between");
    gb_listing_text(listing, "µ");
    gb_listing_numbers(listing, (const double[]){INFINITY, 2e-30, NAN}, 3);
    gb_listing_note(listing, "last");
    expect_printed(listing, GB_LISTING_CSV,
                   "# first\n# second\nname,p_MPa,x,seed\n"
                   "load,0.000123,0.1,18446744073709551615\n"
                   "# between\nµ,,2e-30,\n# last\n");
    expect_printed(
        listing, GB_LISTING_JSON,
        "{\n  \"rows\" : [\n    {\n      \"name\" : \"load\",\n"
        "      \"p_MPa\" : 0.00012300000000000001,\n      \"x\" : 0.10000000000000001,\n"
        "      \"seed\" : 18446744073709551615\n    },\n    {\n"
        "      \"name\" : \"µ\",\n      \"p_MPa\" : null,\n"
        "      \"x\" : 2.0000000000000002e-30,\n      \"seed\" : null\n"
        "    }\n  ]\n}\n");
    expect_printed(listing, GB_LISTING_MARKDOWN,
                   "| name | p_MPa | x | seed |\n|---|---|---|---|\n"
                   "| `load` | 0.000123 | 0.1 | 18446744073709551615 |\n"
                   "| `µ` |  | 2e-30 |  |\n");
    expect_printed(listing, GB_LISTING_TEXT,
                   "name     p_MPa      x                  seed\n"
                   "load  0.000123    0.1  18446744073709551615\n"
                   "µ            -  2e-30                     -\n");
    gb_listing_free(listing);
    char *folder = g_path_get_dirname(path);
    listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "name");
    gb_listing_columns(listing, "%.17g", "x,seed");
    gb_listing_text(listing, "a");
    gb_listing_number(listing, 0.1);
    gb_listing_whole(listing, UINT64_MAX);
    g_assert_true(gb_listing_store(listing, folder, "curve.csv", &err));
    g_assert_true(gb_table_read_whole(&table, path, "name", "seed", &err));
    g_assert_true(gb_table_column(table, "x", &err)[0] == 0.1);
    g_assert_cmpuint(gb_table_whole(table)[0], ==, UINT64_MAX);
    gb_table_destroy(table);
    g_free(folder);
}

/* What a spreadsheet or a parser could take for the end of a cell. */
static void test_listing_escapes(void)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "a");
    gb_listing_columns(listing, "\"%s\"", "b");
    gb_listing_text(listing, "1,\"2\"\n\x01");
    gb_listing_text(listing, "plain");
    gb_listing_text(listing, "");
    gb_listing_text(listing, NULL);
    expect_printed(listing, GB_LISTING_CSV, "a,b\n\"1,\"\"2\"\"\n\x01\",\"plain\"\n,\n");
    expect_printed(listing, GB_LISTING_JSON,
                   "{\n  \"rows\" : [\n    {\n      \"a\" : \"1,\\\"2\\\"\\n\\u0001\",\n"
                   "      \"b\" : \"plain\"\n    },\n    {\n      \"a\" : null,\n"
                   "      \"b\" : null\n    }\n  ]\n}\n");
    gb_listing_quote(listing);
    expect_printed(listing, GB_LISTING_CSV,
                   "\"a\",\"b\"\n\"1,\"\"2\"\"\n\x01\",\"plain\"\n\"\",\"\"\n");
    gb_listing_free(listing);
    listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "a");
    expect_printed(listing, GB_LISTING_CSV, "a\n");
    expect_printed(listing, GB_LISTING_JSON, "{\n  \"rows\" : []\n}\n");
    gb_listing_free(listing);
    gb_listing_free(NULL);
}

static void test_no_file(void)
{
    g_remove(path);
    expect_refused("No such file");
    g_assert_cmpint(mkfifo(path, 0600), ==, 0);
    expect_refused("not a regular file");
    g_remove(path);
    g_assert_cmpint(g_mkdir(path, 0700), ==, 0);
    expect_refused("not a regular file");
    g_rmdir(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    char *folder = g_dir_make_tmp("table-XXXXXX", NULL);
    path = g_build_filename(folder, "curve.csv", NULL);
    g_test_add_func("/table/good", test_good);
    g_test_add_func("/table/whole", test_whole);
    g_test_add_func("/table/hostile", test_hostile);
    g_test_add_func("/table/listing", test_listing);
    g_test_add_func("/table/listing-escapes", test_listing_escapes);
    g_test_add_func("/table/no-file", test_no_file);
    const int status = g_test_run();
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return status;
}
