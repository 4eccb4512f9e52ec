#include "study/papers/papers_page.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

static const struct {
    const char *id, *title;
} papers[] = {
    {"P1", "P1: oxide nanopowders, quasi-static"},
    {"P2", "P2: discs at high rates"},
    {"P3", "P3: powder in a die"},
};

/* Decimals of a number here: by its error, or by that of the printed number. */
static int digits_of(const struct gb_papers_result *result)
{
    return gb_papers_verdict_digits(result->here.error > 0.0 ? result->here.error
                                                             : result->printed->error);
}

static void add_number(GString *text, double value, int digits)
{
    if (isfinite(value)) {
        g_string_append_printf(text, "%.*f", digits, value);
    }
}

static const char *sign_of(enum gb_papers_relation relation)
{
    return relation == GB_PAPERS_BELOW   ? "< "
           : relation == GB_PAPERS_ABOUT ? "about "
                                         : "";
}

static const char *unit_of(const struct gb_papers_printed *printed)
{
    return strcmp(printed->unit, "1") == 0 ? "" : printed->unit;
}

static void add_row(GString *text, const struct gb_papers_result *result)
{
    const struct gb_papers_printed *printed = result->printed;
    char *verdict = gb_papers_verdict_text(&result->verdict);
    const char *label = result->comparison->label;
    const bool explained = result->verdict.outcome == GB_PAPERS_OFF ||
                           result->verdict.outcome == GB_PAPERS_ABSENT;
    const char *why =
        explained && result->comparison->why != NULL ? result->comparison->why : "";
    g_string_append_printf(text, "| %s | %s | %s%s%s | ", printed->item,
                           printed->quantity, printed->condition,
                           label != NULL ? "; " : "", label != NULL ? label : "");
    add_number(text, result->here.value, digits_of(result));
    if (isfinite(result->here.value) && result->here.error > 0.0) {
        g_string_append(text, " \xc2\xb1 ");
        add_number(text, result->here.error, digits_of(result));
    }
    g_string_append_printf(text, " | %s%s | %s | ", sign_of(printed->relation),
                           printed->digits, unit_of(printed));
    if (result->here.cells > 0) {
        g_string_append_printf(text, "%zu", result->here.cells);
    }
    g_string_append_printf(text, " | %s%s%s |\n", verdict, *why != '\0' ? "; " : "", why);
    g_free(verdict);
}

static void add_paper(GString *text, const char *paper, const char *title,
                      const struct gb_papers_results *results)
{
    bool any = false;
    for (size_t k = 0; k < results->count; k++) {
        if (strcmp(results->result[k].printed->paper, paper) != 0) {
            continue;
        }
        if (!any) {
            g_string_append_printf(
                text,
                "\n## %s\n\n"
                "| where | quantity | condition | here | printed | unit | cells | "
                "verdict |\n|---|---|---|---|---|---|---|---|\n",
                title);
        }
        add_row(text, &results->result[k]);
        any = true;
    }
}

static void add_count(GString *text, const struct gb_papers_results *results)
{
    static const struct {
        enum gb_papers_outcome outcome;
        const char *words;
    } outcomes[] = {{GB_PAPERS_WITHIN, "within error"},
                    {GB_PAPERS_OFF, "off"},
                    {GB_PAPERS_UNJUDGED, "without an error"},
                    {GB_PAPERS_ABSENT, "not found in the runs"},
                    {GB_PAPERS_NOT_COMPUTED, "not computed"}};
    g_string_append_printf(text, "Comparisons: %zu, ", results->count);
    bool first = true;
    for (size_t o = 0; o < G_N_ELEMENTS(outcomes); o++) {
        size_t count = 0;
        for (size_t k = 0; k < results->count; k++) {
            count += results->result[k].verdict.outcome == outcomes[o].outcome;
        }
        if (count > 0) {
            g_string_append_printf(text, "%s%zu %s", first ? "" : ", ", count,
                                   outcomes[o].words);
            first = false;
        }
    }
    g_string_append(text, ".\n");
}

static void add_method(GString *text, const char *command)
{
    g_string_append_printf(
        text,
        "\nWritten by `%s`, greenbody " GB_VERSION ".\n\n"
        "Here: mean and standard error over cells that differ by their seed, by the "
        "jackknife where a\nnumber is fitted to all of them. Printed: digits of the paper. "
        "*Within error* is a difference of\nat most %g standard errors, the root of the "
        "summed squares of the error here, of the printed error,\nof the rounding of the "
        "printed digits (1/sqrt 12 of the last one; 10 %% of the value where the paper\n"
        "says \"about\"), and of the error of the paper's own mean where it says how many "
        "cells it averages,\nfrom the scatter of cells here. \"<\" is an upper bound of "
        "the magnitude. \"points\" are %% of theoretical\ndensity. Sources, line by "
        "line: `assets/data/papers.csv`.\n",
        command, GB_PAPERS_VERDICT_ERRORS);
}

static bool is_shown(const struct gb_papers_results *results, const char *paper)
{
    for (size_t k = 0; k < results->count; k++) {
        if (strcmp(results->result[k].printed->paper, paper) == 0) {
            return true;
        }
    }
    return false;
}

static void add_without(GString *text, const struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers)
{
    bool any = false;
    for (size_t k = 0; k < numbers->count; k++) {
        const struct gb_papers_printed *printed = &numbers->row[k];
        if (*printed->without == '\0' || !is_shown(results, printed->paper)) {
            continue;
        }
        g_string_append(text, any ? ""
                                  : "\n## Printed numbers without a comparison\n\n"
                                    "| where | quantity | condition | printed | unit | "
                                    "why |\n|---|---|---|---|---|---|\n");
        g_string_append_printf(text, "| %s, %s | %s | %s | %s%s | %s | %s |\n",
                               printed->paper, printed->item, printed->quantity,
                               printed->condition, sign_of(printed->relation),
                               printed->digits, unit_of(printed), printed->without);
        any = true;
    }
}

static void add_figures(GString *text, const struct gb_papers_figure *figures,
                        size_t count)
{
    if (count > 0) {
        g_string_append(text,
                        "\n## Figures\n\nHollow marks are printed numbers. Commands are "
                        "for the directory of this page.\n");
    }
    for (size_t k = 0; k < count; k++) {
        g_string_append_printf(text, "\n%s: `%s`\n\n", figures[k].title,
                               figures[k].command);
        if (figures[k].file != NULL) {
            g_string_append_printf(text, "![%s](%s)\n", figures[k].title,
                                   figures[k].file);
        } else {
            g_string_append_printf(text, "Not drawn: %s\n", figures[k].why);
        }
    }
}

static void add_runs(GString *text, const struct gb_papers_plan *plan)
{
    size_t done = 0;
    for (size_t k = 0; k < plan->count; k++) {
        done += plan->ensemble.run[k].ended && plan->ensemble.run[k].error.code == GB_OK;
    }
    g_string_append_printf(text, "Runs done: %zu of %zu. ", done, plan->count);
}

GString *gb_papers_page_text(const struct gb_papers_results *results,
                             const struct gb_papers_numbers *numbers,
                             const struct gb_papers_plan *plan,
                             const struct gb_papers_figure *figures, size_t count,
                             const char *command)
{
    GString *text =
        g_string_new("# The printed numbers of the three papers, computed\n\n");
    add_runs(text, plan);
    add_count(text, results);
    add_method(text, command);
    for (size_t p = 0; p < G_N_ELEMENTS(papers); p++) {
        add_paper(text, papers[p].id, papers[p].title, results);
    }
    add_without(text, results, numbers);
    add_figures(text, figures, count);
    return text;
}

static void add_cell(GString *text, const char *cell)
{
    const bool quoted = strpbrk(cell, ",\"\n") != NULL;
    char **parts = g_strsplit(cell, "\"", -1);
    char *joined = g_strjoinv("\"\"", parts);
    g_string_append_printf(text, quoted ? "\"%s\"," : "%s,", joined);
    g_free(joined);
    g_strfreev(parts);
}

static void add_value(GString *text, double value)
{
    char buffer[GB_NUMBER_MAX];
    g_string_append_printf(text, "%s,",
                           isfinite(value) ? gb_number_write(value, buffer) : "");
}

GString *gb_papers_page_table(const struct gb_papers_results *results)
{
    GString *text = g_string_new("id,paper,item,quantity,condition,comparison,here,"
                                 "here_error,cells,relation,printed,printed_error,unit,"
                                 "difference,difference_error,verdict,reason\n");
    for (size_t k = 0; k < results->count; k++) {
        const struct gb_papers_result *result = &results->result[k];
        const struct gb_papers_printed *printed = result->printed;
        const char *label = result->comparison->label, *why = result->comparison->why;
        char *verdict = gb_papers_verdict_text(&result->verdict);
        const char *const words[] = {printed->id,        printed->paper,
                                     printed->item,      printed->quantity,
                                     printed->condition, label != NULL ? label : ""};
        for (size_t w = 0; w < G_N_ELEMENTS(words); w++) {
            add_cell(text, words[w]);
        }
        add_value(text, result->here.value);
        add_value(text, result->here.error);
        g_string_append_printf(text, "%zu,%c,%s,", result->here.cells,
                               "=~<"[printed->relation], printed -> digits);
        add_value(text, printed->error);
        add_cell(text, printed->unit);
        add_value(text, result->verdict.difference);
        add_value(text, result->verdict.error);
        add_cell(text, verdict);
        add_cell(text, why != NULL ? why : "");
        text->str[text->len - 1] = '\n';
        g_free(verdict);
    }
    return text;
}
