#include "base/words.h"

#include <glib.h>
#include <stdint.h>
#include <string.h>

static void test_edits(void)
{
    static const struct {
        const char *a, *b;
        int edits;
    } rows[] = {{"", "", 0},       {"", "abc", 3},
                {"abc", "abc", 0}, {"abc", "abd", 1},
                {"abc", "ac", 1},  {"abc", "abxc", 1},
                {"abc", "bac", 1}, {"abcd", "badc", 2},
                {"rnu", "run", 1}, {"kitten", "sitting", 3}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_cmpint(gb_words_edits(rows[i].a, rows[i].b), ==, rows[i].edits);
        g_assert_cmpint(gb_words_edits(rows[i].b, rows[i].a), ==, rows[i].edits);
    }
    char *const whole = g_strnfill(40, 'x'), *const beyond = g_strnfill(41, 'x');
    g_assert_cmpint(gb_words_edits(whole, whole), ==, 0);
    g_assert_cmpint(gb_words_edits(whole, beyond), >, 2);
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
        g_assert_cmpstr(gb_words_nearest_in(rows[i].name,
                                            "run, densification, rune, time", buffer,
                                            sizeof buffer),
                        ==, rows[i].hint);
    }
    char *const none[] = {NULL};
    g_assert_cmpstr(gb_words_nearest("run", none, buffer, sizeof buffer), ==, "");
}

/* Words are whole or counted. */
static void test_join(void)
{
    static const struct {
        const char *words[5];
        size_t bytes;
        const char *text;
    } rows[] = {
        {{NULL}, 100, ""},
        {{"alpha", NULL}, 5, "alpha"},
        {{"alpha", NULL}, 4, ""},
        {{"alpha", "beta", "gamma", NULL}, 100, "alpha, beta, gamma"},
        {{"alpha", "beta", "gamma", NULL}, 37, "alpha, beta, gamma"},
        {{"alpha", "beta", "gamma", NULL}, 34, "alpha and 2 more"},
        {{"a word of 30 bytes, no more   ", "beta", "gamma", NULL},
         40,
         "beta, gamma and 1 more"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text =
            gb_words_join((char *const *)(uintptr_t)rows[i].words, rows[i].bytes);
        g_assert_cmpstr(text, ==, rows[i].text);
        g_free(text);
    }
}

/* Never longer than asked for, and no word is lost. */
static void test_length(void)
{
    char *const words[] = {(char[]){"one"},  (char[]){"two words"},  (char[]){"three"},
                           (char[]){"four"}, (char[]){"fifth word"}, NULL};
    for (size_t bytes = 0; bytes < 80; bytes++) {
        char *text = gb_words_join(words, bytes);
        g_assert_cmpuint(strlen(text), <=, bytes);
        int whole = 0, more = 0;
        for (int i = 0; words[i] != NULL; i++) {
            whole += strstr(text, words[i]) != NULL;
        }
        const char *count = strstr(text, " and ");
        more = count != NULL ? (int)g_ascii_strtoll(count + 5, NULL, 10) : 0;
        g_assert_true(*text == '\0' || whole + more == 5);
        g_free(text);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/words/edits", test_edits);
    g_test_add_func("/words/word", test_word);
    g_test_add_func("/words/join", test_join);
    g_test_add_func("/words/length", test_length);
    return g_test_run();
}
