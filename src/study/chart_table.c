/* What a chart says: error against cost, the recommended setting, and the cells that a
 * standard error needs. */
#include "study/chart_table.h"

#include <glib.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/number.h"
#include "measure/average.h"
#include "measure/structure.h"
#include "pack/cell/particles.h"
#include "pack/structure/chain_growth.h"
#include "scene/model.h"
#include "study/chart.h"

/* --- errors against cost -------------------------------------------------------------- */

/* An error below this many standard errors is noise. */
static const double noise_limit = 2.0;

/* Cells of one setting and those of the reference. */
struct pairs {
    GArray *own, *reference; /* of struct gb_chart_run, same seeds */
};

static void gather(struct pairs *pairs, const struct gb_chart_log *log,
                   const struct gb_chart_setting *setting)
{
    const struct gb_chart_plan *plan = log->plan;
    pairs->own = g_array_new(FALSE, FALSE, sizeof(struct gb_chart_run));
    pairs->reference = g_array_new(FALSE, FALSE, sizeof(struct gb_chart_run));
    for (int s = 0; s < plan->seeds; s++) {
        const uint64_t seed = plan->params.seed + (uint64_t)s;
        const struct gb_chart_run *own = gb_chart_find(log, setting, seed);
        const struct gb_chart_run *reference =
            gb_chart_find(log, &plan->setting[0], seed);
        if (own && reference) {
            g_array_append_vals(pairs->own, own, 1);
            g_array_append_vals(pairs->reference, reference, 1);
        }
    }
}

static const struct gb_chart_run *run_at(const GArray *runs, guint i)
{
    return &g_array_index(runs, struct gb_chart_run, i);
}

/* Mean difference and its standard error; seed by seed where the cells are the same. */
static void compare(const double *own, const double *reference, size_t n, bool paired,
                    double *error, double *error_se)
{
    if (paired) {
        double difference[1024];
        for (size_t i = 0; i < n && i < G_N_ELEMENTS(difference); i++) {
            difference[i] = own[i] - reference[i];
        }
        gb_average_values(difference, MIN(n, G_N_ELEMENTS(difference)), error, error_se);
        return;
    }
    double mean[2], se[2];
    gb_average_values(own, n, &mean[0], &se[0]);
    gb_average_values(reference, n, &mean[1], &se[1]);
    *error = mean[0] - mean[1];
    *error_se = hypot(se[0], se[1]);
}

/* Means and errors at pressure k. */
static void fill_pressure(struct gb_chart_row *row, const struct pairs *pairs, int k,
                          bool paired)
{
    const guint n = pairs->own->len;
    double *value = g_new(double, 4 * (gsize)n + 1);
    double *own = value, *reference = value + n;
    double *contacts = value + 2 * n, *reference_contacts = value + 3 * n;
    for (guint i = 0; i < n; i++) {
        own[i] = run_at(pairs->own, i)->density[k];
        reference[i] = run_at(pairs->reference, i)->density[k];
        contacts[i] = run_at(pairs->own, i)->coordination[k];
        reference_contacts[i] = run_at(pairs->reference, i)->coordination[k];
    }
    double se = NAN;
    const size_t used = gb_average_values(own, n, &row->density[k], &se);
    row->scatter[k] = se * sqrt((double)used);
    compare(own, reference, n, paired, &row->error[k], &row->error_se[k]);
    compare(contacts, reference_contacts, n, paired, &row->coordination_error[k],
            &row->coordination_error_se[k]);
    if (used < n) { /* a cell does not reach the pressure */
        row->error[k] = row->error_se[k] = NAN;
    }
    g_free(value);
}

static void fill(struct gb_chart_row *row, const struct gb_chart_log *log, bool reference)
{
    struct pairs pairs;
    gather(&pairs, log, &row->setting);
    row->seeds = (int)pairs.own->len;
    row->bound = NAN;
    for (guint i = 0; i < pairs.own->len; i++) {
        row->failed += run_at(pairs.own, i)->failed;
        row->evaluations += run_at(pairs.own, i)->evaluations / (double)row->seeds;
        row->cpu_s += run_at(pairs.own, i)->cpu_s / (double)row->seeds;
    }
    const bool paired = row->setting.count == log->plan->setting[0].count;
    bool known = row->seeds > 1 && row->failed == 0 && !reference;
    double bound = 0.0;
    row->noise_limited = known;
    for (int k = 0; k < log->plan->pressures; k++) {
        fill_pressure(row, &pairs, k, paired);
        bound = fmax(bound, fabs(row->error[k]) + row->error_se[k]);
        known = known && isfinite(row->error[k]) && isfinite(row->error_se[k]);
        row->noise_limited =
            row->noise_limited && !(fabs(row->error[k]) > noise_limit * row->error_se[k]);
    }
    row->bound = known ? bound : (double)NAN;
    g_array_free(pairs.own, TRUE);
    g_array_free(pairs.reference, TRUE);
}

/* Same size of the cell and as many seeds as the reference has. */
static bool competes(const struct gb_chart_table *table, const struct gb_chart_row *row)
{
    return isfinite(row->bound) && row->seeds == table->row[0].seeds &&
           row->setting.count == table->row[0].setting.count;
}

static void mark_pareto(struct gb_chart_table *table)
{
    for (size_t i = 0; i < table->rows; i++) {
        struct gb_chart_row *row = &table->row[i];
        row->pareto = competes(table, row);
        for (size_t j = 0; j < table->rows && row->pareto; j++) {
            const struct gb_chart_row *other = &table->row[j];
            row->pareto = !(competes(table, other) && other->cpu_s < row->cpu_s &&
                            other->bound < row->bound);
        }
    }
}

static void pool_scatter(struct gb_chart_table *table, int pressures)
{
    for (int k = 0; k < GB_CHART_PRESSURES; k++) {
        double sum = 0.0, weight = 0.0;
        for (size_t i = 0; i < table->rows && k < pressures; i++) {
            const struct gb_chart_row *row = &table->row[i];
            if (row->setting.count == table->row[0].setting.count && row->seeds > 1 &&
                isfinite(row->scatter[k])) {
                sum += (row->seeds - 1) * row->scatter[k] * row->scatter[k];
                weight += row->seeds - 1;
            }
        }
        table->scatter[k] = weight > 0.0 ? sqrt(sum / weight) : (double)NAN;
    }
}

static bool is_within_limit(const struct gb_chart_table *table,
                            const struct gb_chart_row *row, int pressures)
{
    bool good = competes(table, row);
    for (int k = 0; k < pressures && good; k++) {
        const double allowed =
            isfinite(table->allowed) ? table->allowed : table->scatter[k];
        good = fabs(row->error[k]) + row->error_se[k] <= allowed;
    }
    return good;
}

static void choose(struct gb_chart_table *table, int pressures)
{
    struct gb_chart_row *best = NULL;
    for (size_t i = 0; i < table->rows; i++) {
        struct gb_chart_row *row = &table->row[i];
        if (is_within_limit(table, row, pressures) &&
            (!best || row->cpu_s < best->cpu_s)) {
            best = row;
        }
    }
    if (best) {
        best->chosen = true;
    }
}

void gb_chart_table_init(struct gb_chart_table *table, const struct gb_chart_log *log,
                         double allowed)
{
    const struct gb_chart_plan *plan = log->plan;
    *table = (struct gb_chart_table){.rows = plan->settings, .allowed = allowed};
    table->row = g_new0(struct gb_chart_row, plan->settings);
    for (size_t i = 0; i < plan->settings; i++) {
        table->row[i].setting = plan->setting[i];
        fill(&table->row[i], log, i == 0);
    }
    pool_scatter(table, plan->pressures);
    mark_pareto(table);
    choose(table, plan->pressures);
}

void gb_chart_table_finish(struct gb_chart_table *table)
{
    g_free(table->row);
    *table = (struct gb_chart_table){0};
}

const struct gb_chart_row *gb_chart_table_chosen(const struct gb_chart_table *table)
{
    for (size_t i = 0; i < table->rows; i++) {
        if (table->row[i].chosen) {
            return &table->row[i];
        }
    }
    return NULL;
}

static struct gb_listing *new_listing(const struct gb_chart_plan *plan,
                                      const char *comment)
{
    static const char *const each[] = {"density",
                                       "error",
                                       "error_se",
                                       "scatter",
                                       "coordination_error",
                                       "coordination_error_se"};
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, "greenbody " GB_VERSION);
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%s", "relaxer");
    gb_listing_columns(
        listing, "%.8g",
        "particles,step,tolerance,cutoff_d,bits,time_step_T,step_error,"
        "reference,seeds,failed,evaluations,cpu_s,bound,noise_limited,front,"
        "chosen");
    for (int k = 0; k < plan->pressures; k++) {
        for (size_t i = 0; i < G_N_ELEMENTS(each); i++) {
            gb_listing_column(listing, "%.8g", "%s_%.6gMPa", each[i],
                              plan->pressure_pa[k] / 1e6);
        }
    }
    return listing;
}

static void add_row(struct gb_listing *listing, const struct gb_chart_row *row,
                    bool reference, int pressures)
{
    const struct gb_chart_setting *c = &row->setting;
    const double number[] = {(double)c->count,    c->strain_step,
                             c->tolerance,        c->cutoff,
                             gb_chart_bits(c),    c->time_step,
                             c->step_error,       (double)reference,
                             row->seeds,          row->failed,
                             row->evaluations,    row->cpu_s,
                             row->bound,          (double)row->noise_limited,
                             (double)row->pareto, (double)row->chosen};
    gb_listing_text(listing, c->relaxer);
    gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
    for (int k = 0; k < pressures; k++) {
        const double each[] = {row->density[k],
                               row->error[k],
                               row->error_se[k],
                               row->scatter[k],
                               row->coordination_error[k],
                               row->coordination_error_se[k]};
        gb_listing_numbers(listing, each, G_N_ELEMENTS(each));
    }
}

GString *gb_chart_table_csv(const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan, const char *comment)
{
    struct gb_listing *listing = new_listing(plan, comment);
    for (size_t i = 0; i < table->rows; i++) {
        if (table->row[i].seeds > 0) {
            add_row(listing, &table->row[i], i == 0, plan->pressures);
        }
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* --- size and number of cells --------------------------------------------------------- */

/* A g(r) whose ripple is below this counts as 1.  At density 0.24 the ripple is 0.02 from
 * 2.6 to 3.6 d, and 0.004 from 3.5 to 4.5 d, which is mostly noise. */
static const double flat = 0.01;
static const double bin_width = 0.05;
enum { STRUCTURES = 8 };

/* Adds g(r) up to half the shortest edge of one initial structure. */
static bool add_g(const struct gb_model *model, double half, int bins, double *sum,
                  struct gb_error *err)
{
    struct gb_cell cell;
    gb_particles_cell(model, &cell);
    double *position = gb_alloc_array(3 * (size_t)model->count, sizeof *position, err);
    double *g = gb_alloc_array((size_t)bins, sizeof *g, err);
    const bool done = position && g &&
                      gb_chain_growth_fill(model, NULL, NULL, position, err) &&
                      gb_structure_rdf(&cell, model->count, position, half, bins, g, err);
    for (int k = 0; k < bins && done; k++) {
        sum[k] += g[k];
    }
    gb_alloc_free(position);
    gb_alloc_free(g);
    return done;
}

/* Mean g(r) over the first initial structures. */
static bool measure_g(struct gb_chart_size *size, const struct gb_chart_plan *plan,
                      const struct gb_chart_setting *setting, struct gb_error *err)
{
    struct gb_params params = plan->params;
    struct gb_model model;
    struct gb_cell cell;
    gb_chart_apply(&params, setting);
    if (!gb_model_init(&model, &params, err)) {
        return false;
    }
    gb_particles_cell(&model, &cell);
    size->half_edge = 0.5 * gb_cell_shortest(&cell);
    const int bins = (int)ceil(size->half_edge / bin_width);
    const int seeds = plan->seeds < STRUCTURES ? plan->seeds : STRUCTURES;
    double *g = gb_alloc_array((size_t)bins, sizeof *g, err);
    bool done = g != NULL;
    for (int s = 0; s < seeds && done; s++) {
        model.seed = plan->params.seed + (uint64_t)s;
        done = add_g(&model, size->half_edge, bins, g, err);
    }
    for (int k = 0; k < bins && done; k++) {
        g[k] /= seeds;
    }
    if (done) {
        size->g_end = gb_structure_rdf_end(model.dimension, size->half_edge, bins, g,
                                           &size->ripple);
        size->large_enough = size->ripple < flat;
    }
    gb_alloc_free(g);
    return done;
}

/* The standard error decreases with the square root of the number of cells. */
static double cells_for(const struct gb_chart_size *size, int pressures,
                        double standard_error)
{
    double most = 0.0;
    for (int k = 0; k < pressures; k++) {
        const double ratio = size->scatter[k] / standard_error;
        most = isfinite(ratio) ? fmax(most, ceil(ratio * ratio)) : most;
    }
    return most > 0.0 ? most : (double)NAN;
}

static bool differs_in_size_only(const struct gb_chart_setting *a,
                                 const struct gb_chart_setting *b)
{
    struct gb_chart_setting same = *a;
    same.count = b->count;
    return gb_chart_same(&same, b);
}

static int by_count(const void *a, const void *b)
{
    const struct gb_chart_size *x = a, *y = b;
    return (x->count > y->count) - (x->count < y->count);
}

bool gb_chart_table_advise(struct gb_chart_advice *advice,
                           const struct gb_chart_table *table,
                           const struct gb_chart_plan *plan, double standard_error,
                           struct gb_error *err)
{
    *advice = (struct gb_chart_advice){.standard_error = standard_error};
    const struct gb_chart_setting *own = &plan->setting[1];
    for (size_t i = 1; i < table->rows && advice->sizes < GB_CHART_SIZES; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->seeds < 2 || !differs_in_size_only(&row->setting, own)) {
            continue;
        }
        struct gb_chart_size *size = &advice->size[advice->sizes++];
        *size = (struct gb_chart_size){.count = row->setting.count, .cpu_s = row->cpu_s};
        /* pooled over many rows for the preset's size, from one row for another */
        memcpy(size->scatter, i == 1 ? table->scatter : row->scatter,
               sizeof size->scatter);
        size->cells = cells_for(size, plan->pressures, standard_error);
        if (!measure_g(size, plan, &row->setting, err)) {
            return false;
        }
    }
    qsort(advice->size, (size_t)advice->sizes, sizeof advice->size[0], by_count);
    return true;
}

/* --- text ----------------------------------------------------------------------------- */

enum { DESCRIPTION = 160 };

static void add_pressure_heads(GString *text, const struct gb_chart_plan *plan)
{
    for (int k = 0; k < plan->pressures; k++) {
        char head[32];
        snprintf(head, sizeof head, "at %.4g MPa", plan->pressure_pa[k] / 1e6);
        g_string_append_printf(text, "  %-16s", head);
    }
    g_string_append_c(text, '\n');
}

/* Properties of a row, one letter each. */
static void add_marks(GString *text, const struct gb_chart_table *table, size_t i)
{
    const struct gb_chart_row *row = &table->row[i];
    g_string_append_printf(text, "%c%c%c%c ",
                           i == 0   ? 'R'
                           : i == 1 ? 'P'
                                    : ' ',
                           row->pareto ? 'F' : ' ', row->noise_limited ? 'n' : ' ',
                           row->chosen ? '*' : ' ');
}

static void add_errors(GString *text, const struct gb_chart_row *row, int pressures,
                       bool reference)
{
    for (int k = 0; k < pressures; k++) {
        char cell[48] = "";
        if (reference && isfinite(row->density[k])) {
            snprintf(cell, sizeof cell, "density %.4f", row->density[k]);
        } else if (row->failed > 0) {
            snprintf(cell, sizeof cell, "%d of %d failed", row->failed, row->seeds);
        } else if (isfinite(row->error[k]) && isfinite(row->error_se[k])) {
            snprintf(cell, sizeof cell, "%+.4f ± %.4f", row->error[k], row->error_se[k]);
        } else if (row->seeds < 2) {
            snprintf(cell, sizeof cell, "needs 2 seeds");
        } else {
            snprintf(cell, sizeof cell, "not reached");
        }
        const int wide = (int)(strlen(cell) - (size_t)g_utf8_strlen(cell, -1));
        g_string_append_printf(text, "  %-*s", 16 + wide, cell);
    }
}

static void add_table(GString *text, const struct gb_chart_table *table,
                      const struct gb_chart_plan *plan)
{
    g_string_append(text, "       CPU s  evaluations  seeds");
    add_pressure_heads(text, plan);
    for (size_t i = 0; i < table->rows; i++) {
        const struct gb_chart_row *row = &table->row[i];
        if (row->seeds == 0) {
            continue;
        }
        char setting[DESCRIPTION];
        add_marks(text, table, i);
        g_string_append_printf(text, "%7.3g  %11.4g  %5d", row->cpu_s, row->evaluations,
                               row->seeds);
        add_errors(text, row, plan->pressures, i == 0);
        g_string_append_printf(text, "  %s\n",
                               gb_chart_describe(&row->setting, setting, sizeof setting));
    }
    g_string_append(
        text, "R reference, P the preset's own, F Pareto-optimal in cost and error,\n"
              "n limited by noise (no error above two standard errors), "
              "* recommended;\n"
              "CPU s and evaluations of one cell\n");
}

static void add_recommended(GString *text, const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan)
{
    char setting[DESCRIPTION], scatter[GB_NUMBER_MAX];
    g_string_append(text, "\nscatter of one cell:");
    for (int k = 0; k < plan->pressures; k++) {
        g_string_append_printf(text, " %s at %.4g MPa%s",
                               gb_number_shown("%.4f", table->scatter[k], scatter),
                               plan->pressure_pa[k] / 1e6,
                               k + 1 < plan->pressures ? "," : "\n");
    }
    const struct gb_chart_row *chosen = gb_chart_table_chosen(table);
    if (chosen) {
        g_string_append_printf(
            text, "cheapest setting with a smaller error: %s (%.3g CPU s)\n",
            gb_chart_describe(&chosen->setting, setting, sizeof setting), chosen->cpu_s);
    } else {
        g_string_append(
            text, "no setting is known to have a smaller error; more seeds reduce the "
                  "uncertainty\n");
    }
}

static void add_advice(GString *text, const struct gb_chart_advice *advice, int pressures)
{
    if (advice->sizes == 0) {
        return;
    }
    g_string_append_printf(text,
                           "\na standard error of %.4g in density needs\n"
                           "particles  half edge  g(r) there, ripple  scatter  cells  "
                           "CPU s\n",
                           advice->standard_error);
    for (int i = 0; i < advice->sizes; i++) {
        const struct gb_chart_size *size = &advice->size[i];
        double scatter = NAN;
        for (int k = 0; k < pressures; k++) {
            scatter = fmax(scatter, size->scatter[k]);
        }
        g_string_append_printf(
            text, "%9lld  %7.3g d      %.3f    %.3f  %7.4f  %5.0f  %5.3g%s\n",
            (long long)size->count, size->half_edge, size->g_end, size->ripple, scatter,
            size->cells, size->cells * size->cpu_s,
            size->large_enough ? "" : "  too small: g(L/2) is not 1");
    }
}

GString *gb_chart_table_text(const struct gb_chart_table *table,
                             const struct gb_chart_plan *plan)
{
    GString *text = g_string_new(NULL);
    add_table(text, table, plan);
    return text;
}

GString *gb_chart_table_results(const struct gb_chart_table *table,
                                const struct gb_chart_plan *plan,
                                const struct gb_chart_advice *advice)
{
    GString *text = g_string_new(NULL);
    add_recommended(text, table, plan);
    add_advice(text, advice, plan->pressures);
    return text;
}
