#include "greenbody/status.h"

#include <string.h>

#include <glib.h>

static void test_one_line(void)
{
    struct gb_error err = {0};
    g_assert_false(gb_error_set(&err, GB_ERR_INPUT, "a%cb\n\x1b[2J%s", 7, "c\r\xff\xfe"));
    g_assert_cmpstr(err.text, ==, "a\\x07b\\x0a\\x1b[2Jc\\x0d\\xff\\xfe");
    gb_error_set(&err, GB_ERR_INPUT, "%s", "x\xc2\x9by"); /* C1 control in UTF-8 */
    g_assert_cmpstr(err.text, ==, "x\\u009by");
    gb_error_set(&err, GB_ERR_INPUT, "%s", "5 \xc2\xb5m");
    g_assert_cmpstr(err.text, ==, "5 \xc2\xb5m");
    g_assert_false(gb_error_set(NULL, GB_ERR_INPUT, "no caller"));
}

/* A cut in the middle of a character leaves valid UTF-8. */
static void test_long(void)
{
    char text[1024] = "";
    for (int i = 0; i < 500; i++) {
        g_strlcat(text, "\xc2\xb5", sizeof text);
    }
    struct gb_error err = {0};
    for (int shift = 0; shift < 2; shift++) {
        gb_error_set(&err, GB_ERR_MACHINE, "%s%s", shift ? "x" : "", text);
        g_assert_true(g_utf8_validate(err.text, -1, NULL));
        g_assert_cmpuint(strlen(err.text), ==, sizeof err.text - 2 + (gsize)shift);
    }
}

/* A message may quote the one it replaces. */
static void test_nested(void)
{
    struct gb_error err = {0};
    gb_error_set(&err, GB_ERR_INPUT, "inner");
    gb_error_set(&err, err.code, "file:3: %s", err.text);
    g_assert_cmpstr(err.text, ==, "file:3: inner");
}

static void test_exit_codes(void)
{
    static const int want[][2] = {{GB_OK, 0},
                                  {GB_ERR_INPUT, 2},
                                  {GB_ERR_MACHINE, 3},
                                  {GB_ERR_MEMORY, 3},
                                  {GB_ERR_GUARD, 1},
                                  {GB_ERR_NOT_CONVERGED, 1},
                                  {GB_ERR_CANCELLED, 130}};
    for (size_t i = 0; i < G_N_ELEMENTS(want); i++) {
        g_assert_cmpint(gb_status_exit_code((enum gb_status)want[i][0]), ==, want[i][1]);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/status/one-line", test_one_line);
    g_test_add_func("/status/long", test_long);
    g_test_add_func("/status/nested", test_nested);
    g_test_add_func("/status/exit-codes", test_exit_codes);
    return g_test_run();
}
