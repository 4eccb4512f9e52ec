/* The tables of greenbody papers and its rule for verdicts. */
#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "study/papers.h"
#include "study/papers_comparisons.h"

static struct gb_papers_numbers numbers;

/* --- verdicts ---------------------------------------------------------------------------- */

static struct gb_papers_verdict judge(struct gb_papers_printed printed,
                                      struct gb_papers_here here)
{
    return gb_papers_verdict_of(&printed, &here);
}

static void check_text(const struct gb_papers_verdict *verdict, const char *text)
{
    char *made = gb_papers_verdict_text(verdict);
    g_assert_cmpstr(made, ==, text);
    g_free(made);
}

/* 2 sqrt(0.03^2 + 0.04^2) = 0.1 */
static void test_within(void)
{
    const struct gb_papers_printed printed = {.value = 5.0, .error = 0.04, .cells = NAN};
    struct gb_papers_verdict verdict =
        judge(printed, (struct gb_papers_here){5.0999, 0.03, 10, false, 0.0});
    g_assert_cmpint(verdict.outcome, ==, GB_PAPERS_WITHIN);
    check_text(&verdict, "within error");
    verdict = judge(printed, (struct gb_papers_here){4.8999, 0.03, 10, false, 0.0});
    g_assert_cmpint(verdict.outcome, ==, GB_PAPERS_OFF);
    g_assert_cmpfloat_with_epsilon(verdict.error, 0.05, 1e-15);
    check_text(&verdict, "off by -0.100 (2.0 standard errors)");
    verdict = judge(printed, (struct gb_papers_here){5.5, 0.03, 10, false, 0.0});
    check_text(&verdict, "off by 0.500 (10.0 standard errors)");
}

/* The paper's mean of four cells scatters as those of here: 0.1 sqrt(16 / 4) = 0.2. */
static void test_scatter_of_the_paper(void)
{
    const struct gb_papers_printed printed = {.value = 1.0, .error = 0.0, .cells = 4};
    const struct gb_papers_verdict verdict =
        judge(printed, (struct gb_papers_here){1.4, 0.1, 16, false, 0.0});
    g_assert_cmpfloat_with_epsilon(verdict.error, hypot(0.1, 0.2), 1e-15);
    g_assert_cmpint(verdict.outcome, ==, GB_PAPERS_WITHIN);
    /* cells of an eighth of the paper's particles scatter sqrt 8 times as much */
    g_assert_cmpfloat_with_epsilon(
        judge(printed, (struct gb_papers_here){1.4, 0.1, 16, false, 0.125}).error,
        hypot(0.1, 0.2 / sqrt(8.0)), 1e-15);
}

static void test_bound(void)
{
    const struct gb_papers_printed printed = {
        .value = 1.0, .cells = NAN, .relation = GB_PAPERS_BELOW};
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){-0.7, 0.1, 9, false, 0.0}).outcome, ==,
        GB_PAPERS_WITHIN);
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){1.1, 0.1, 9, false, 0.0}).outcome, ==,
        GB_PAPERS_WITHIN);
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){-1.5, 0.1, 9, false, 0.0}).outcome, ==,
        GB_PAPERS_OFF);
}

static void test_no_verdict(void)
{
    const struct gb_papers_printed printed = {.value = 1.0, .error = 0.1, .cells = 1};
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){1.0, NAN, 1, false, 0.0}).outcome, ==,
        GB_PAPERS_UNJUDGED);
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){NAN, NAN, 3, false, 0.0}).outcome, ==,
        GB_PAPERS_ABSENT);
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){NAN, NAN, 0, false, 0.0}).outcome, ==,
        GB_PAPERS_NOT_COMPUTED);
    /* a law has no error of its own */
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){1.15, NAN, 0, true, 0.0}).outcome, ==,
        GB_PAPERS_WITHIN);
    g_assert_cmpint(
        judge(printed, (struct gb_papers_here){1.25, NAN, 0, true, 0.0}).outcome, ==,
        GB_PAPERS_OFF);
}

/* --- the file of printed numbers --------------------------------------------------------- */

static const char header[] = "id,paper,item,quantity,condition,value,error,unit,relation,"
                             "cells,figure,x,y,series,source,without\n";

static bool read_text(struct gb_papers_numbers *out, const char *rows,
                      struct gb_error *err)
{
    char *name = NULL;
    const int file = g_file_open_tmp("papers-XXXXXX.csv", &name, NULL);
    g_assert_cmpint(file, >=, 0);
    char *text = g_strconcat("# a comment\n", header, rows, NULL);
    g_assert_true(g_file_set_contents(name, text, -1, NULL));
    const bool good = gb_papers_printed_read(out, name, err);
    g_assert_true(g_close(file, NULL));
    g_unlink(name);
    g_free(text);
    g_free(name);
    return good;
}

/* One unit of the last digit over sqrt 12; a printed error; a tenth for "about". */
static void test_errors_of_digits(void)
{
    struct gb_papers_numbers read;
    struct gb_error err = {0};
    g_assert_true(
        read_text(&read,
                  "a,P,f,q,\"one, two\",0.387,,1,=,,densification,value,100,s,t\n"
                  "b,P,f,q,c,4.0062,0.0007,1,=,10,,,,,t\n"
                  "c,P,f,q,c,10,,points,~,,,,,,t,why\n"
                  "d,P,f,q,c,13,,GPa,<,,,,,,t\n",
                  &err));
    g_assert_cmpuint(read.count, ==, 4);
    g_assert_cmpstr(read.row[0].condition, ==, "one, two");
    g_assert_cmpfloat_with_epsilon(read.row[0].error, 0.001 / sqrt(12.0), 1e-15);
    g_assert_cmpfloat(read.row[0].x, ==, 0.387);
    g_assert_cmpfloat(read.row[0].x_error, ==, read.row[0].error);
    g_assert_cmpfloat(read.row[0].y, ==, 100.0);
    g_assert_true(isnan(read.row[0].y_error) && isnan(read.row[0].cells));
    g_assert_cmpfloat_with_epsilon(read.row[1].error, hypot(0.0007, 1e-4 / sqrt(12.0)),
                                   1e-15);
    g_assert_cmpfloat_with_epsilon(read.row[2].error, hypot(1.0, 1.0 / sqrt(12.0)),
                                   1e-15);
    g_assert_cmpstr(read.row[2].without, ==, "why");
    g_assert_cmpint(read.row[3].relation, ==, GB_PAPERS_BELOW);
    gb_papers_printed_finish(&read);
}

static void test_refused_files(void)
{
    static const char *const bad[] = {
        "a,P,f,q,c,x,,1,=,,,,,,t\n",     /* a value that is no number */
        "a,P,f,q,c,1,-1,1,=,,,,,,t\n",   /* an error below 0 */
        "a,P,f,q,c,1,,1,>,,,,,,t\n",     /* an unknown relation */
        "a,P,f,q,c,1,,1,=,,fig,,2,,t\n", /* a figure without x */
        "a,P,f,q,c,1,,1,=,,,,,,\n",      /* no source */
        "a,P,f,q,c,1,,1,=,,,,,,t\na,P,f,q,c,1,,1,=,,,,,,t\n", /* an id twice */
    };
    for (size_t k = 0; k < G_N_ELEMENTS(bad); k++) {
        struct gb_papers_numbers read;
        struct gb_error err = {0};
        g_assert_false(read_text(&read, bad[k], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, "expected"));
        gb_papers_printed_finish(&read);
    }
}

/* --- the tables -------------------------------------------------------------------------- */

static void test_experiments(void)
{
    const struct gb_papers_experiment *row = gb_papers_plan_table();
    g_assert_cmpuint(gb_papers_plan_count(), <=, GB_PAPERS_EXPERIMENTS_MOST);
    for (; row->name != NULL; row++) {
        for (int size = 0; size <= GB_PAPERS_SIZES; size++) {
            struct gb_params params;
            struct gb_error err = {0};
            if (!gb_papers_plan_params(row, (enum gb_papers_size)size, 0, &params,
                                       &err) ||
                !gb_params_check(&params, &err)) {
                g_error("%s: %s", row->name, err.text);
            }
        }
    }
}

static size_t points_of(const char *experiment)
{
    struct gb_axes axes;
    struct gb_error err = {0};
    const size_t index = gb_papers_plan_index(experiment);
    g_assert_cmpuint(index, <, gb_papers_plan_count());
    g_assert_true(gb_papers_plan_axes(&gb_papers_plan_table()[index], &axes, &err));
    const size_t points = gb_param_sweep_points(&axes);
    gb_param_sweep_axes_finish(&axes);
    return points;
}

static void test_comparisons(void)
{
    const struct gb_papers_comparison *row = gb_papers_comparisons_table();
    for (; row->id != NULL; row++) {
        const struct gb_papers_printed *printed =
            gb_papers_printed_find(&numbers, row->id);
        g_test_message("%s", row->id);
        g_assert_nonnull(printed);
        g_assert_cmpstr(printed->without, ==, "");
        g_assert_true(g_str_has_prefix(row->id, printed->paper));
        g_assert_nonnull(row->measure);
        for (int e = 0; e < GB_PAPERS_USED && row->experiment[e] != NULL; e++) {
            g_assert_cmpuint(row->point, <, points_of(row->experiment[e]));
            g_assert_cmpuint(row->other, <, points_of(row->experiment[e]));
            g_assert_true(g_str_has_prefix(row->experiment[e], printed->paper));
        }
        g_assert_true((row->read != NULL) ==
                      (row->measure == gb_papers_comparisons_mean ||
                       row->measure == gb_papers_comparisons_difference));
    }
}

/* Every printed number is compared, or says why it is not. */
static void test_numbers(void)
{
    g_assert_cmpuint(numbers.count, >, 50);
    for (size_t k = 0; k < numbers.count; k++) {
        const struct gb_papers_comparison *row = gb_papers_comparisons_table();
        while (row->id != NULL && strcmp(row->id, numbers.row[k].id) != 0) {
            row++;
        }
        g_test_message("%s", numbers.row[k].id);
        g_assert_true((row->id != NULL) == (*numbers.row[k].without == '\0'));
    }
}

/* Laws need no run: P1's 1 J/m2, P2's T and v1, P3's constants and onset of yield. */
static void test_laws(void)
{
    const struct gb_papers_data none = {0};
    const struct gb_papers_comparison *row = gb_papers_comparisons_table();
    size_t within = 0, off = 0;
    for (; row->id != NULL; row++) {
        struct gb_papers_here here = {.exact = true};
        if (row->experiment[0] == NULL) {
            here.cells =
                gb_papers_comparisons_value(row, &none, &here.value, &here.error);
            const struct gb_papers_verdict verdict =
                gb_papers_verdict_of(gb_papers_printed_find(&numbers, row->id), &here);
            g_test_message("%s: %g", row->id, here.value);
            g_assert_cmpuint(here.cells, ==, 0);
            g_assert_true(isfinite(here.value) && isnan(here.error));
            within += verdict.outcome == GB_PAPERS_WITHIN;
            off += verdict.outcome == GB_PAPERS_OFF;
            if (strcmp(row->id, "P3-sigma0-0.05") == 0) { /* P3 against its own rule */
                g_assert_cmpint(verdict.outcome, ==, GB_PAPERS_OFF);
                g_assert_cmpfloat_with_epsilon(here.value, 1049.0, 0.5);
            }
        }
    }
    g_assert_cmpuint(within, ==, 14);
    g_assert_cmpuint(off, ==, 2); /* and the softest model of Fig. 11 */
}

/* --- errors ------------------------------------------------------------------------------ */

/* Of a mean over the cells the jackknife gives sd / sqrt n; cells of equal seed go together
 * in a difference, so that what they share drops out. */
static double number_of(const struct gb_runset_run *run,
                        const struct gb_papers_comparison *row)
{
    (void)row;
    return run->params.mu;
}

static void test_jackknife(void)
{
    enum { CELLS = 4 };
    static const double shared[CELLS] = {0.1, 0.7, 0.2, 0.4};
    static const double extra[CELLS] = {0.01, 0.02, 0.03, 0.04};
    struct gb_papers_data data = {0};
    const size_t index = gb_papers_plan_index("P1-fig5");
    struct gb_papers_cells *cells = &data.experiment[index];
    struct gb_runset_run run[2 * CELLS] = {0};
    size_t point[2 * CELLS], cell[2 * CELLS];
    for (size_t k = 0; k < 2 * CELLS; k++) {
        point[k] = k / CELLS;
        cell[k] = k % CELLS;
        run[k].params.mu = shared[k % CELLS] + (k < CELLS ? 0.0 : extra[k % CELLS]);
    }
    *cells = (struct gb_papers_cells){.set = {.run = run, .count = 2 * CELLS},
                                      .point = point,
                                      .cell = cell,
                                      .most = CELLS};
    struct gb_papers_comparison row = {.experiment = {"P1-fig5"},
                                       .measure = gb_papers_comparisons_mean,
                                       .read = number_of,
                                       .scale = 10.0};
    double value, error;
    g_assert_cmpuint(gb_papers_comparisons_value(&row, &data, &value, &error), ==, CELLS);
    g_assert_cmpfloat_with_epsilon(value, 3.5, 1e-12);
    g_assert_cmpfloat_with_epsilon(error, 10.0 * sqrt(0.21 / 3.0 / CELLS), 1e-12);
    row.measure = gb_papers_comparisons_difference;
    row.point = 1;
    gb_papers_comparisons_value(&row, &data, &value, &error);
    g_assert_cmpfloat_with_epsilon(value, 0.25, 1e-12);
    g_assert_cmpfloat_with_epsilon(error, 10.0 * sqrt(5e-4 / 3.0 / CELLS), 1e-12);
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    g_test_init(&argc, &argv, NULL);
    if (!gb_papers_printed_read(&numbers, GB_TEST_DATA "/papers.csv", &err)) {
        g_error("%s", err.text);
    }
    g_test_add_func("/papers/verdict/within", test_within);
    g_test_add_func("/papers/verdict/scatter-of-the-paper", test_scatter_of_the_paper);
    g_test_add_func("/papers/verdict/bound", test_bound);
    g_test_add_func("/papers/verdict/none", test_no_verdict);
    g_test_add_func("/papers/numbers/errors", test_errors_of_digits);
    g_test_add_func("/papers/numbers/refused", test_refused_files);
    g_test_add_func("/papers/tables/experiments", test_experiments);
    g_test_add_func("/papers/tables/comparisons", test_comparisons);
    g_test_add_func("/papers/tables/numbers", test_numbers);
    g_test_add_func("/papers/laws", test_laws);
    g_test_add_func("/papers/jackknife", test_jackknife);
    const int status = g_test_run();
    gb_papers_printed_finish(&numbers);
    return status;
}
