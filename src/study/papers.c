/* Comparison with the papers: the printed numbers, verdicts, and the page. */
#include "study/papers.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/listing.h"
#include "base/number.h"
#include "base/units.h"
#include "greenbody/status.h"
#include "io/lab/lab_grid.h"
#include "io/preset_folders.h"
#include "study/papers_comparisons.h"

/* --- printed numbers ------------------------------------------------------------------ */

/* Differences up to so many standard errors are within error. */
#define GB_PAPERS_VERDICT_ERRORS 2.0

/* The numbers that the papers print, assets/data/papers.csv; its comment lines describe the
 * columns. */

enum { BYTES_MAX = 1 << 20 };

/* A number printed with "about" may be off by this share of it. */
static const double about = 0.1;

enum column {
    ID,
    PAPER,
    ITEM,
    QUANTITY,
    CONDITION,
    VALUE,
    ERROR,
    UNIT,
    RELATION,
    CELLS,
    FIGURE,
    X,
    Y,
    SERIES,
    SOURCE,
    WITHOUT,
    COLUMNS,
    NEEDED = SOURCE + 1 /* the last one may be empty, and is cut off then */
};

static const char *const names[COLUMNS] = {[PAPER] = "paper",
                                           [ITEM] = "item",
                                           [ID] = "id",
                                           [QUANTITY] = "quantity",
                                           [CONDITION] = "condition",
                                           [VALUE] = "value",
                                           [ERROR] = "error",
                                           [UNIT] = "unit",
                                           [RELATION] = "relation",
                                           [CELLS] = "cells",
                                           [FIGURE] = "figure",
                                           [X] = "x",
                                           [Y] = "y",
                                           [SERIES] = "series",
                                           [SOURCE] = "source",
                                           [WITHOUT] = "without"};

/* A row that is being read. */
struct reader {
    const struct gb_papers_numbers *numbers;
    const struct gb_lab_grid_row *row;
    size_t index;
    struct gb_error *err;
};

static const char *cell(const struct reader *reader, enum column column)
{
    return gb_lab_grid_cell(&reader->numbers->grid, reader->index, (size_t)column).text;
}

static bool refuse(const struct reader *reader, enum column column, const char *accepted)
{
    return gb_error_set(reader->err, GB_ERR_INPUT, "%.200s:%d: %s \"%.60s\": expected %s",
                        reader->numbers->path, reader->row->line, names[column],
                        cell(reader, column), accepted);
}

/* An empty cell is NaN. */
static bool read_number(const struct reader *reader, enum column column, double *value)
{
    const char *text = cell(reader, column);
    const char *end = NULL;
    *value = NAN;
    return *text == '\0' ||
           (gb_units_number(text, &end, value) && *end == '\0' && isfinite(*value)) ||
           refuse(reader, column, "a number");
}

/* Standard deviation of what was rounded to these digits: a uniform distribution over one
 * unit of the last digit. */
static double rounding(const char *digits)
{
    const char *point = strchr(digits, '.');
    const size_t behind = point != NULL ? strspn(point + 1, "0123456789") : 0;
    return pow(10.0, -(double)behind) / sqrt(12.0);
}

static bool read_relation(const struct reader *reader, enum gb_papers_relation *relation)
{
    static const char signs[] = "=~<";
    const char *text = cell(reader, RELATION);
    const char *found =
        text[0] != '\0' && text[1] == '\0' ? strchr(signs, text[0]) : NULL;
    *relation =
        found != NULL ? (enum gb_papers_relation)(found - signs) : GB_PAPERS_EQUAL;
    return found != NULL || refuse(reader, RELATION, "=, ~ or <");
}

static bool read_error(const struct reader *reader, struct gb_papers_printed *printed)
{
    double given = NAN;
    if (!read_number(reader, ERROR, &given)) {
        return false;
    }
    if (given < 0.0) {
        return refuse(reader, ERROR, "0 or more");
    }
    printed->error = hypot(isnan(given) ? 0.0 : given, rounding(printed->digits));
    if (printed->relation == GB_PAPERS_ABOUT) {
        printed->error = hypot(printed->error, about * fabs(printed->value));
    }
    return true;
}

/* A coordinate is a number or the value itself, which has an error. */
static bool read_coordinate(const struct reader *reader, enum column column,
                            const struct gb_papers_printed *printed, double *at,
                            double *error)
{
    *error = NAN;
    if (strcmp(cell(reader, column), "value") == 0) {
        *at = printed->value;
        *error = printed->error;
        return true;
    }
    return read_number(reader, column, at) &&
           (*printed->figure == '\0' || isfinite(*at) ||
            refuse(reader, column, "a number or value, for a figure"));
}

static bool read_row(const struct reader *reader, struct gb_papers_printed *printed)
{
    *printed = (struct gb_papers_printed){.paper = cell(reader, PAPER),
                                          .item = cell(reader, ITEM),
                                          .id = cell(reader, ID),
                                          .quantity = cell(reader, QUANTITY),
                                          .condition = cell(reader, CONDITION),
                                          .digits = cell(reader, VALUE),
                                          .unit = cell(reader, UNIT),
                                          .figure = cell(reader, FIGURE),
                                          .series = cell(reader, SERIES),
                                          .source = cell(reader, SOURCE),
                                          .without = cell(reader, WITHOUT),
                                          .line = reader->row->line};
    static const enum column needed[] = {PAPER, ITEM, ID, QUANTITY, VALUE, UNIT, SOURCE};
    for (size_t k = 0; k < G_N_ELEMENTS(needed); k++) {
        if (*cell(reader, needed[k]) == '\0') {
            return refuse(reader, needed[k], "a text");
        }
    }
    return read_number(reader, VALUE, &printed->value) &&
           read_relation(reader, &printed->relation) && read_error(reader, printed) &&
           read_number(reader, CELLS, &printed->cells) &&
           read_coordinate(reader, X, printed, &printed->x, &printed->x_error) &&
           read_coordinate(reader, Y, printed, &printed->y, &printed->y_error);
}

static bool check_header(const struct reader *reader)
{
    for (int k = 0; k < COLUMNS; k++) {
        if (strcmp(cell(reader, (enum column)k), names[k]) != 0) {
            return refuse(reader, (enum column)k, names[k]);
        }
    }
    return true;
}

static bool check_id(const struct reader *reader, const char *id)
{
    return gb_papers_printed_find(reader->numbers, id) == NULL ||
           refuse(reader, ID, "each id once");
}

static bool read_rows(struct gb_papers_numbers *numbers, struct gb_error *err)
{
    const size_t rows = gb_lab_grid_rows(&numbers->grid);
    struct reader reader = {.numbers = numbers, .err = err};
    bool header = false;
    numbers->row = g_new0(struct gb_papers_printed, rows + 1);
    for (; reader.index < rows; reader.index++) {
        struct gb_papers_printed printed;
        reader.row = gb_lab_grid_row(&numbers->grid, reader.index);
        if (reader.row->comment) {
            continue;
        }
        if (!header) {
            header = true;
            if (!check_header(&reader)) {
                return false;
            }
            continue;
        }
        if (!read_row(&reader, &printed) || !check_id(&reader, printed.id)) {
            return false;
        }
        numbers->row[numbers->count++] = printed;
    }
    return header || gb_error_set(err, GB_ERR_INPUT, "%.300s: no header", numbers->path);
}

bool gb_papers_printed_read(struct gb_papers_numbers *numbers, const char *path,
                            struct gb_error *err)
{
    *numbers = (struct gb_papers_numbers){0};
    numbers->path =
        path != NULL ? g_strdup(path) : gb_preset_folders_find_data("papers.csv");
    if (numbers->path == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE,
                            "papers.csv, the printed numbers: not found among the "
                            "installed files");
    }
    char *text = NULL;
    size_t length = 0;
    const bool good =
        gb_file_read(numbers->path, BYTES_MAX, &text, &length, err) &&
        gb_lab_grid_init(&numbers->grid, numbers->path, text, length, ',', err) &&
        read_rows(numbers, err);
    gb_alloc_free(text);
    return good;
}

void gb_papers_printed_finish(struct gb_papers_numbers *numbers)
{
    gb_lab_grid_finish(&numbers->grid);
    g_free(numbers->row);
    g_free(numbers->path);
    *numbers = (struct gb_papers_numbers){0};
}

const struct gb_papers_printed *
gb_papers_printed_find(const struct gb_papers_numbers *numbers, const char *id)
{
    for (size_t k = 0; k < numbers->count; k++) {
        if (strcmp(numbers->row[k].id, id) == 0) {
            return &numbers->row[k];
        }
    }
    return NULL;
}

/* --- verdicts ------------------------------------------------------------------------- */

static double difference_of(const struct gb_papers_printed *printed, double value)
{
    return printed->relation == GB_PAPERS_BELOW ? fmax(fabs(value) - printed->value, 0.0)
                                                : value - printed->value;
}

/* NaN: unknown. */
static double error_of(const struct gb_papers_printed *printed,
                       const struct gb_papers_here *here)
{
    const double own = here->exact ? 0.0 : here->error;
    const double size = here->size > 0.0 ? here->size : 1.0;
    const double sampled = isfinite(printed->cells) && !here->exact
                               ? own * sqrt(size * (double)here->cells / printed->cells)
                               : 0.0;
    return hypot(hypot(own, sampled), printed->error);
}

struct gb_papers_verdict gb_papers_verdict_of(const struct gb_papers_printed *printed,
                                              const struct gb_papers_here *here)
{
    struct gb_papers_verdict verdict = {GB_PAPERS_NOT_COMPUTED, NAN, NAN};
    if (here->cells == 0 && !here->exact) {
        return verdict;
    }
    if (!isfinite(here->value)) {
        verdict.outcome = GB_PAPERS_ABSENT;
        return verdict;
    }
    verdict.difference = difference_of(printed, here->value);
    verdict.error = error_of(printed, here);
    if (!isfinite(verdict.error)) {
        verdict.outcome = GB_PAPERS_UNJUDGED;
    } else if (fabs(verdict.difference) <= GB_PAPERS_VERDICT_ERRORS * verdict.error) {
        verdict.outcome = GB_PAPERS_WITHIN;
    } else {
        verdict.outcome = GB_PAPERS_OFF;
    }
    return verdict;
}

/* Decimals that show two digits of an error. */
static int papers_verdict_digits(double error)
{
    return error > 0.0 ? (int)fmin(fmax(1.0 - floor(log10(error)), 0.0), 9.0) : 4;
}

char *gb_papers_verdict_text(const struct gb_papers_verdict *verdict)
{
    switch (verdict->outcome) {
    case GB_PAPERS_WITHIN:
        return g_strdup("within error");
    case GB_PAPERS_OFF:
        return g_strdup_printf("off by %.*f (%.1f standard errors)",
                               papers_verdict_digits(verdict->error), verdict->difference,
                               fabs(verdict->difference) / verdict->error);
    case GB_PAPERS_UNJUDGED:
        return g_strdup_printf("differs by %.2g, without an error", verdict->difference);
    case GB_PAPERS_ABSENT:
        return g_strdup("not found in the runs");
    default:
        return g_strdup("not computed");
    }
}

/* --- all comparisons ------------------------------------------------------------------ */

/* Ids and names of experiments begin with the paper: "P1-". */
static bool is_of_paper(const char *name, const char *id)
{
    const size_t length = strcspn(id, "-");
    return strncmp(name, id, length) == 0 && name[length] == '-';
}

bool gb_papers_selected_paper(const char *id, const struct gb_papers_plan *plan)
{
    const struct gb_papers_experiment *table = gb_papers_plan_table();
    for (size_t e = 0; table[e].name != NULL; e++) {
        if (plan->selected[e] && is_of_paper(table[e].name, id)) {
            return true;
        }
    }
    return false;
}

/* Is an experiment of the comparison among the selected ones?  Laws belong to every
 * selection with an experiment of their paper. */
static bool papers_selected(const struct gb_papers_comparison *comparison,
                            const struct gb_papers_plan *plan)
{
    const char *experiment = comparison->experiment[0];
    return experiment != NULL ? plan->selected[gb_papers_plan_index(experiment)]
                              : gb_papers_selected_paper(comparison->id, plan);
}

/* Particles of a cell over those of the full experiment, which are the paper's. */
static double size_of(const struct gb_papers_comparison *comparison,
                      const struct gb_papers_data *data)
{
    struct gb_params full;
    if (comparison->experiment[0] == NULL) {
        return 1.0;
    }
    const size_t index = gb_papers_plan_index(comparison->experiment[0]);
    const struct gb_runset *set = &data->experiment[index].set;
    return set->count > 0 && gb_papers_plan_params(&gb_papers_plan_table()[index],
                                                   GB_PAPERS_SIZES, 0, &full, NULL)
               ? (double)set->run[0].params.count / (double)full.count
               : 1.0;
}

static bool evaluate(struct gb_papers_result *result,
                     const struct gb_papers_comparison *comparison,
                     const struct gb_papers_numbers *numbers,
                     const struct gb_papers_data *data, struct gb_error *err)
{
    *result = (struct gb_papers_result){
        .printed = gb_papers_printed_find(numbers, comparison->id),
        .comparison = comparison};
    if (result->printed == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: %s is missing", numbers->path,
                            comparison->id);
    }
    result->here.exact = comparison->experiment[0] == NULL;
    result->here.cells = gb_papers_comparisons_value(
        comparison, data, &result->here.value, &result->here.error);
    result->here.size = size_of(comparison, data);
    result->verdict = gb_papers_verdict_of(result->printed, &result->here);
    return true;
}

bool gb_papers_evaluate(struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers,
                        const struct gb_papers_plan *plan, struct gb_error *err)
{
    const struct gb_papers_comparison *table = gb_papers_comparisons_table();
    struct gb_papers_data data;
    size_t rows = 0;
    while (table[rows].id != NULL) {
        rows++;
    }
    *results =
        (struct gb_papers_results){.result = g_new0(struct gb_papers_result, rows + 1)};
    bool good = gb_papers_plan_read(&data, plan, err);
    for (size_t k = 0; k < rows && good; k++) {
        if (papers_selected(&table[k], plan)) {
            good = evaluate(&results->result[results->count], &table[k], numbers, &data,
                            err);
            results->count += good;
        }
    }
    gb_papers_plan_data_finish(&data);
    return good;
}

void gb_papers_finish(struct gb_papers_results *results)
{
    g_free(results->result);
    *results = (struct gb_papers_results){0};
}

/* --- page and table ------------------------------------------------------------------- */

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
    return papers_verdict_digits(result->here.error > 0.0 ? result->here.error
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
        "prints \"about\"), and of the error of the paper's own mean where it states how many "
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

GString *gb_papers_text(const struct gb_papers_results *results,
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

GString *gb_papers_table(const struct gb_papers_results *results)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "id,paper,item,quantity,condition,comparison");
    gb_listing_columns(listing, "", "here,here_error,cells");
    gb_listing_columns(listing, "%s", "relation,printed");
    gb_listing_columns(listing, "", "printed_error");
    gb_listing_columns(listing, "%s", "unit");
    gb_listing_columns(listing, "", "difference,difference_error");
    gb_listing_columns(listing, "%s", "verdict,reason");
    for (size_t k = 0; k < results->count; k++) {
        const struct gb_papers_result *result = &results->result[k];
        const struct gb_papers_printed *printed = result->printed;
        const char relation[] = {"=~<"[printed->relation], '\0'};
        char *verdict = gb_papers_verdict_text(&result->verdict);
        gb_listing_text(listing, printed->id);
        gb_listing_text(listing, printed->paper);
        gb_listing_text(listing, printed->item);
        gb_listing_text(listing, printed->quantity);
        gb_listing_text(listing, printed->condition);
        gb_listing_text(listing, result->comparison->label);
        gb_listing_number(listing, result->here.value);
        gb_listing_number(listing, result->here.error);
        gb_listing_whole(listing, result->here.cells);
        gb_listing_text(listing, relation);
        gb_listing_text(listing, printed->digits);
        gb_listing_number(listing, printed->error);
        gb_listing_text(listing, printed->unit);
        gb_listing_number(listing, result->verdict.difference);
        gb_listing_number(listing, result->verdict.error);
        gb_listing_text(listing, verdict);
        gb_listing_text(listing, result->comparison->why);
        g_free(verdict);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}
