#include "study/chart/chart_table.h"

#include <gsl/gsl_statistics.h>
#include <math.h>

#include "measure/fit/average.h"

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
        const struct gb_chart_run *own = gb_chart_log_find(log, setting, seed);
        const struct gb_chart_run *reference =
            gb_chart_log_find(log, &plan->setting[0], seed);
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

static void add_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.8g", value);
    }
}

static void add_head(GString *text, const struct gb_chart_plan *plan)
{
    static const char *const each[] = {"density",
                                       "error",
                                       "error_se",
                                       "scatter",
                                       "coordination_error",
                                       "coordination_error_se"};
    g_string_append(text, "relaxer,particles,step,tolerance,cutoff_d,bits,time_step_T,"
                          "step_error,reference,seeds,failed,evaluations,cpu_s,bound,"
                          "noise_limited,front,chosen");
    for (int k = 0; k < plan->pressures; k++) {
        for (size_t i = 0; i < G_N_ELEMENTS(each); i++) {
            g_string_append_printf(text, ",%s_%.6gMPa", each[i],
                                   plan->pressure_pa[k] / 1e6);
        }
    }
    g_string_append_c(text, '\n');
}

static void add_row(GString *text, const struct gb_chart_row *row, bool reference,
                    int pressures)
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
    g_string_append(text, c->relaxer);
    for (size_t i = 0; i < G_N_ELEMENTS(number); i++) {
        add_number(text, number[i]);
    }
    for (int k = 0; k < pressures; k++) {
        add_number(text, row->density[k]);
        add_number(text, row->error[k]);
        add_number(text, row->error_se[k]);
        add_number(text, row->scatter[k]);
        add_number(text, row->coordination_error[k]);
        add_number(text, row->coordination_error_se[k]);
    }
    g_string_append_c(text, '\n');
}

GString *gb_chart_table_csv(const struct gb_chart_table *table,
                            const struct gb_chart_plan *plan, const char *comment)
{
    GString *text = g_string_new("# greenbody " GB_VERSION "\n");
    char **lines = g_strsplit(comment, "\n", -1);
    for (int i = 0; lines[i]; i++) {
        if (lines[i][0] != '\0') {
            g_string_append_printf(text, "# %s\n", lines[i]);
        }
    }
    g_strfreev(lines);
    add_head(text, plan);
    for (size_t i = 0; i < table->rows; i++) {
        if (table->row[i].seeds > 0) {
            add_row(text, &table->row[i], i == 0, plan->pressures);
        }
    }
    return text;
}
