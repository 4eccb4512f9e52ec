#ifndef GB_TESTS_EXACT_H
#define GB_TESTS_EXACT_H

#include <math.h>
#include <string.h>

#include <glib.h>

/* Laws against tables of exact values, and against their own derivatives. */

static inline void assert_close(double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want))) {
        g_test_message("got %.17g, want %.17g", got, want);
        g_test_fail();
    }
}

/* Value behind "name=" in the text; fallback when there is none. */
static inline double exact_number(const char *text, const char *name, double fallback)
{
    const char *at = strstr(text, name);
    while (at && at != text && at[-1] != ' ') {
        at = strstr(at + 1, name);
    }
    return at ? g_ascii_strtod(at + strlen(name), NULL) : fallback;
}

/* What the laws give for a row of the table; NaN for an unknown law. */
typedef double exact_evaluate(const char *law, const char *words, const char *input);

/* Holds every row "law,parameters,input,value,unit" of a file against the laws; the
 * number of rows. */
static inline int exact_rows(const char *path, double tolerance, exact_evaluate *evaluate)
{
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    char **lines = g_strsplit(text, "\n", -1);
    int rows = 0;
    for (int i = 0; lines[i]; i++) {
        char **cells = g_strsplit(lines[i], ",", -1);
        if (lines[i][0] != '#' && g_strv_length(cells) == 5 &&
            strcmp(cells[0], "law") != 0) {
            g_test_message("%s", lines[i]);
            assert_close(evaluate(cells[0], cells[1], cells[2]),
                         g_ascii_strtod(cells[3], NULL), tolerance);
            rows++;
        }
        g_strfreev(cells);
    }
    g_strfreev(lines);
    g_free(text);
    return rows;
}

/* df/dx by central difference, fourth order. */
static inline double exact_slope(double (*f)(const void *, double), const void *law,
                                 double x, double step)
{
    return (8.0 * (f(law, x + step) - f(law, x - step)) -
            (f(law, x + 2.0 * step) - f(law, x - 2.0 * step))) /
           (12.0 * step);
}

#endif
