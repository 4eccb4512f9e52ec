#include "base/text/text_list.h"

#include <stdint.h>
#include <string.h>

#include <glib.h>

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
            gb_text_list_join((char *const *)(uintptr_t)rows[i].words, rows[i].bytes);
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
        char *text = gb_text_list_join(words, bytes);
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
    g_test_add_func("/text_list/join", test_join);
    g_test_add_func("/text_list/length", test_length);
    return g_test_run();
}
