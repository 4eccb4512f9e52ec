#include "base/text/nearest_word.h"

#include <glib.h>

static void test_edits(void)
{
    static const struct {
        const char *a, *b;
        int edits;
    } rows[] = {{"", "", 0},          {"", "abc", 3},      {"abc", "abc", 0},
                {"abc", "abd", 1},    {"abc", "ac", 1},    {"abc", "abxc", 1},
                {"abc", "bac", 1},    {"abcd", "badc", 2}, {"rnu", "run", 1},
                {"kitten", "sitting", 3}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_cmpint(gb_nearest_word_edits(rows[i].a, rows[i].b), ==, rows[i].edits);
        g_assert_cmpint(gb_nearest_word_edits(rows[i].b, rows[i].a), ==, rows[i].edits);
    }
    char *const whole = g_strnfill(40, 'x'), *const beyond = g_strnfill(41, 'x');
    g_assert_cmpint(gb_nearest_word_edits(whole, whole), ==, 0);
    g_assert_cmpint(gb_nearest_word_edits(whole, beyond), >, 2);
    g_free(whole);
    g_free(beyond);
}

/* One word is near enough, or none is named. */
static void test_word(void)
{
    static const struct {
        const char *name, *hint;
    } rows[] = {{"rnu", "did you mean run? "},
                {"densificaton", "did you mean densification? "},
                {"runs", ""}, /* run and rune are as near */
                {"ru", ""},   /* too short for any edit */
                {"densest", ""},
                {"", ""}};
    char buffer[64];
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_cmpstr(gb_nearest_word_in(rows[i].name, "run, densification, rune, time",
                                           buffer, sizeof buffer),
                        ==, rows[i].hint);
    }
    char *const none[] = {NULL};
    g_assert_cmpstr(gb_nearest_word("run", none, buffer, sizeof buffer), ==, "");
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/nearest_word/edits", test_edits);
    g_test_add_func("/nearest_word/word", test_word);
    return g_test_run();
}
