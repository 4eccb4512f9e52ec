#include "base/visible.h"

#include <stdlib.h>
#include <string.h>

static void test_text(void)
{
    static const char *const cases[][2] = {
        {"", ""},
        {"a b\\", "a b\\"},
        {"\x1b]0;x\x07", "\\x1b]0;x\\x07"},
        {"a\rb\nc\td\x7f", "a\\x0db\nc\td\\x7f"},
        {"\xc2\x80\xc2\x9b\xc2\x9f\xc2\xa0", "\\u0080\\u009b\\u009f\xc2\xa0"},
        {"\x9b\xff", "\\x9b\\xff"},
        {"\xe7\xb2\x89 \xc2\xb5m \xf0\x9f\x98\x80",
         "\xe7\xb2\x89 \xc2\xb5m \xf0\x9f\x98\x80"},
        {"\xe7\xb2", "\\xe7\\xb2"},                            /* cut off */
        {"\xc0\x9b\xed\xa0\x80", "\\xc0\\x9b\\xed\\xa0\\x80"}, /* overlong, surrogate */
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        char *shown = gb_visible_text(cases[i][0], "\n\t");
        g_assert_cmpstr(shown, ==, cases[i][1]);
        g_free(shown);
    }
}

/* Escapes and characters are whole or absent. */
static void test_copy(void)
{
    char text[16];
    for (size_t size = 1; size < sizeof text; size++) {
        memset(text, 'x', sizeof text);
        gb_visible_copy(text, size, "\n\xe7\xb2\x89\xc2\x9b");
        const size_t fits = size > 13 ? 13 : size > 7 ? 7 : size > 4 ? 4 : 0;
        g_assert_cmpuint(strlen(text), ==, fits);
        g_assert_true(strncmp(text, "\\x0a\xe7\xb2\x89\\u009b", fits) == 0);
    }
}

/* What a file stream gets. */
static void test_print(void)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    g_assert_true(gb_visible_put(to, "a\x1b\n"));
    g_assert_true(gb_visible_print(to, "%s\t%d\n", "b\r", 1));
    g_assert_true(gb_visible_line(to, "%s", "c\nd"));
    gb_visible_rewrite(to, 3, "e\x07");
    gb_visible_rewrite(to, 3, "");
    g_assert_cmpint(fclose(to), ==, 0);
    g_assert_cmpstr(text, ==, "a\\x1b\nb\\x0d\t1\nc\\x0ad\n\re\\x07\r   \r");
    free(text);
}

/* No cell is a formula, however a spreadsheet cuts the line. */
static void test_cell(void)
{
    static const struct {
        const char *text, *cell, *comment;
    } rows[] = {{"=1+1", "'=1+1", "=1+1"},
                {"+a", "'+a", "+a"},
                {"-a", "'-a", "-a"},
                {"@a", "'@a", "@a"},
                {" =a", " '=a", " =a"},
                {"-1.5", "-1.5", "-1.5"},
                {"+2e-3, -4", "+2e-3, -4", "+2e-3, -4"},
                {"a,=b", "a,'=b", "a,'=b"},
                {"a; \"=b\"", "a; \"'=b\"", "a; \"'=b\""},
                {"a\t@b", "a\t'@b", "a\t'@b"},
                {"a=b", "a=b", "a=b"},
                {"", "", ""}};
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        GString *cell = g_string_new(NULL), *comment = g_string_new("# ");
        gb_visible_add_cell(cell, rows[k].text, true);
        gb_visible_add_cell(comment, rows[k].text, false);
        g_assert_cmpstr(cell->str, ==, rows[k].cell);
        g_assert_cmpstr(comment->str + 2, ==, rows[k].comment);
        g_string_free(cell, TRUE);
        g_string_free(comment, TRUE);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/visible/text", test_text);
    g_test_add_func("/visible/copy", test_copy);
    g_test_add_func("/visible/print", test_print);
    g_test_add_func("/visible/cell", test_cell);
    return g_test_run();
}
