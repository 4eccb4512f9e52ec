/* The table of elastic moduli: a row for each probed state.
 *
 * Column names come first, then how a row is filled, the states of a run or of the files of
 * a run directory, and means over replicas. */
#include "run/moduli_table.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/table.h"
#include "measure/elastic.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/record/kept_states.h"
#include "run/record/run_recorder.h"
#include "scene/loading_kind.h"

static const char *const names[] = {"density",
                                    "p_MPa",
                                    "probe_strain",
                                    "C11_GPa",
                                    "C12_GPa",
                                    "C13_GPa",
                                    "C22_GPa",
                                    "C23_GPa",
                                    "C33_GPa",
                                    "C44_GPa",
                                    "C55_GPa",
                                    "C66_GPa",
                                    "px_MPa",
                                    "py_MPa",
                                    "pz_MPa",
                                    "K_GPa",
                                    "G_GPa",
                                    "E_GPa",
                                    "nu",
                                    "K_voigt_GPa",
                                    "K_reuss_GPa",
                                    "G_voigt_GPa",
                                    "G_reuss_GPa",
                                    "axial_C11_GPa",
                                    "axial_C12_GPa",
                                    "axial_C13_GPa",
                                    "axial_C33_GPa",
                                    "axial_C44_GPa",
                                    "axial_misfit",
                                    "vp_z_m_s",
                                    "vp_x_m_s",
                                    "vs_z_m_s",
                                    "vs_x_m_s",
                                    "elastic_range",
                                    "sizes_differ",
                                    "residual",
                                    "moved_rms_d",
                                    "moved_most_d",
                                    "C14_GPa",
                                    "C15_GPa",
                                    "C16_GPa",
                                    "C21_GPa",
                                    "C24_GPa",
                                    "C25_GPa",
                                    "C26_GPa",
                                    "C31_GPa",
                                    "C32_GPa",
                                    "C34_GPa",
                                    "C35_GPa",
                                    "C36_GPa",
                                    "C45_GPa",
                                    "C46_GPa",
                                    "C56_GPa",
                                    "C41_GPa",
                                    "C42_GPa",
                                    "C43_GPa",
                                    "evaluations",
                                    "iterations",
                                    "fallbacks",
                                    "pyz_MPa",
                                    "pxz_MPa",
                                    "pxy_MPa",
                                    "step"};
_Static_assert(sizeof names / sizeof names[0] == GB_MODULI_TABLE_COLUMNS,
               "a name for every column");

/* Name of a column, with its unit; the first twelve are density, p_MPa, probe_strain and
 * nine elements of C. */
static const char *column_name(int column)
{
    return names[column];
}

int gb_moduli_table_find(const char *name)
{
    for (int k = 0; k < GB_MODULI_TABLE_COLUMNS; k++) {
        if (strcmp(names[k], name) == 0) {
            return k;
        }
    }
    return -1;
}

static void put(struct gb_moduli_table_row *row, const char *name, double value)
{
    row->value[gb_moduli_table_find(name)] = value;
}

/* Elements of C by their names, "C12_GPa". */
static void fill_matrix(struct gb_moduli_table_row *row)
{
    for (int k = 0; k < GB_MODULI_TABLE_COLUMNS; k++) {
        if (names[k][0] == 'C') {
            row->value[k] = row->c_gpa[names[k][1] - '1'][names[k][2] - '1'];
        }
    }
}

static void fill_averages(struct gb_moduli_table_row *row)
{
    const struct gb_elastic_averages of =
        gb_elastic_average((const double(*)[6])row->c_gpa);
    put(row, "K_GPa", of.bulk);
    put(row, "G_GPa", of.shear);
    put(row, "E_GPa", of.young);
    put(row, "nu", of.poisson);
    put(row, "K_voigt_GPa", of.bulk_voigt);
    put(row, "K_reuss_GPa", of.bulk_reuss);
    put(row, "G_voigt_GPa", of.shear_voigt);
    put(row, "G_reuss_GPa", of.shear_reuss);
}

/* In 2D the plane has four constants; there is nothing to project. */
static struct gb_elastic_axial axial_of(const double c[6][6], int dimension)
{
    if (dimension == 3) {
        return gb_elastic_project(c);
    }
    return (struct gb_elastic_axial){.c11 = c[0][0],
                                     .c12 = NAN,
                                     .c13 = 0.5 * (c[0][2] + c[2][0]),
                                     .c33 = c[2][2],
                                     .c44 = c[4][4],
                                     .misfit = NAN};
}

static void fill_axial(struct gb_moduli_table_row *row, double mass_density,
                       int dimension)
{
    const struct gb_elastic_axial of =
        axial_of((const double(*)[6])row->c_gpa, dimension);
    const struct gb_elastic_waves speed =
        gb_elastic_wave_speeds(&of, 1e-9 * mass_density);
    put(row, "axial_C11_GPa", of.c11);
    put(row, "axial_C12_GPa", of.c12);
    put(row, "axial_C13_GPa", of.c13);
    put(row, "axial_C33_GPa", of.c33);
    put(row, "axial_C44_GPa", of.c44);
    put(row, "axial_misfit", of.misfit);
    put(row, "vp_z_m_s", speed.p_along);
    put(row, "vp_x_m_s", speed.p_across);
    put(row, "vs_z_m_s", speed.s_along);
    put(row, "vs_x_m_s", speed.s_across);
}

static void fill_state(struct gb_moduli_table_row *row, const struct gb_moduli *moduli,
                       double mpa, int dimension)
{
    const double(*p)[3] = (const double(*)[3])moduli->pressure;
    put(row, "density", moduli->density);
    put(row, "p_MPa", mpa * (p[0][0] + p[1][1] + p[2][2]) / dimension);
    put(row, "px_MPa", mpa * p[0][0]);
    put(row, "py_MPa", mpa * p[1][1]);
    put(row, "pz_MPa", mpa * p[2][2]);
    put(row, "pyz_MPa", mpa * 0.5 * (p[1][2] + p[2][1]));
    put(row, "pxz_MPa", mpa * 0.5 * (p[0][2] + p[2][0]));
    put(row, "pxy_MPa", mpa * 0.5 * (p[0][1] + p[1][0]));
    put(row, "probe_strain", moduli->strain);
    put(row, "elastic_range", moduli->elastic_range);
    put(row, "sizes_differ", moduli->agreement);
    put(row, "residual", moduli->residual);
    put(row, "moved_rms_d", moduli->moved_rms);
    put(row, "moved_most_d", moduli->moved_most);
    put(row, "evaluations", (double)moduli->evaluations);
    put(row, "iterations", (double)moduli->iterations);
    put(row, "fallbacks", (double)moduli->fallbacks);
}

/* In GPa, MPa, m/s; all columns but `step`, which is of the run. */
static void fill(struct gb_moduli_table_row *row, const struct gb_moduli *moduli,
                 const struct gb_params *params)
{
    *row = (struct gb_moduli_table_row){.range_open = moduli->range_open};
    for (int k = 0; k < 36; k++) {
        row->c_gpa[k / 6][k % 6] = 1e-9 * params->young_pa * moduli->c[k / 6][k % 6];
    }
    fill_matrix(row);
    fill_averages(row);
    fill_axial(row, params->density_kg_m3 * moduli->density, params->dimension);
    fill_state(row, moduli, 1e-6 * params->young_pa, params->dimension);
}

/* A walk's sink, and the row that was given to it last. */
struct probing {
    const struct gb_moduli_table_sink *sink;
    struct gb_moduli_table_row row;
};

static bool probe(void *data, const struct gb_experiment *experiment, unsigned what,
                  struct gb_error *err)
{
    struct probing *probing = data;
    const struct gb_moduli_table_sink *sink = probing->sink;
    const struct gb_moduli_options options = {
        .range = sink->range, .cancelled = sink->cancelled, .data = sink->cancel_data};
    struct gb_moduli moduli;
    if (what & GB_KEEP_WALK_VISITED) {
        probing->row.what = what;
        return sink->row(sink->data, &probing->row, err);
    }
    if (!gb_moduli_measure(&moduli, gb_experiment_world(experiment), &options, err)) {
        return false;
    }
    fill(&probing->row, &moduli, gb_experiment_params(experiment));
    put(&probing->row, "step", (double)gb_experiment_point(experiment)->step);
    probing->row.what = what;
    return sink->row(sink->data, &probing->row, err);
}

bool gb_moduli_table_run(const struct gb_params *params,
                         const struct gb_keep_points *points,
                         const struct gb_moduli_table_sink *sink, int *missed,
                         struct gb_error *err)
{
    struct probing probing = {.sink = sink};
    const struct gb_keep_walk walk = {points, probe, &probing, sink->cancelled,
                                      sink->cancel_data};
    return gb_kept_states_run(params, &walk, missed, err);
}

bool gb_moduli_table_file(const char *directory, const char *name,
                          const struct gb_moduli_table_sink *sink, struct gb_error *err)
{
    struct gb_params params;
    struct gb_record record = {0};
    struct gb_experiment *experiment = NULL;
    struct probing probing = {.sink = sink};
    bool done = gb_run_recorder_read(directory, name, &params, &record, err) &&
                gb_loading_kind_check_cell(&params, "moduli", err);
    if (done &&
        (!sink->wanted || sink->wanted(sink->data, gb_checkpoint_step(&record) - 1))) {
        done = gb_experiment_resume(&experiment, &params, &record, err) &&
               probe(&probing, experiment, 0, err);
    }
    gb_experiment_destroy(experiment);
    gb_record_finish(&record);
    return done;
}

enum { COLUMNS = GB_MODULI_TABLE_COLUMNS };

void gb_moduli_table_add(struct gb_moduli_state *state,
                         const struct gb_moduli_table_row *row)
{
    state->count++;
    state->range_open = state->range_open || row->range_open;
    for (int k = 0; k < COLUMNS; k++) {
        state->sum[k] += row->value[k];
        state->squares[k] += row->value[k] * row->value[k];
    }
    for (int k = 0; k < 36; k++) {
        state->c_gpa[k / 6][k % 6] += row->c_gpa[k / 6][k % 6];
    }
}

double gb_moduli_table_mean(const struct gb_moduli_state *state, int column)
{
    return state->sum[column] / state->count;
}

double gb_moduli_table_error(const struct gb_moduli_state *state, int column)
{
    const double n = state->count, mean = gb_moduli_table_mean(state, column);
    const double variance = (state->squares[column] - n * mean * mean) / (n - 1.0);
    return n > 1.0 ? sqrt(fmax(variance, 0.0) / n) : (double)NAN;
}

static const struct gb_moduli_state *state_at(const GArray *states, guint k)
{
    return &g_array_index(states, struct gb_moduli_state, k);
}

struct gb_listing *gb_moduli_table_listing(const GArray *states, const char *comment)
{
    bool errors = false;
    for (guint s = 0; s < states->len; s++) {
        errors = errors || state_at(states, s)->count + state_at(states, s)->missing > 1;
    }
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    for (int k = 0; k < COLUMNS; k++) {
        gb_listing_columns(listing, "%.10g", column_name(k));
    }
    gb_listing_columns(listing, "%.10g", errors ? "replicas,missing" : "replicas");
    for (int k = 0; k < COLUMNS && errors; k++) {
        gb_listing_column(listing, "%.10g", "error_%s", column_name(k));
    }
    for (guint s = 0; s < states->len; s++) {
        const struct gb_moduli_state *state = state_at(states, s);
        for (int k = 0; k < COLUMNS; k++) {
            gb_listing_number(listing, gb_moduli_table_mean(state, k));
        }
        gb_listing_number(listing, state->count);
        if (errors) {
            gb_listing_number(listing, state->missing);
        }
        for (int k = 0; k < COLUMNS && errors; k++) {
            gb_listing_number(listing, gb_moduli_table_error(state, k));
        }
    }
    return listing;
}

static bool read_columns(const struct gb_table *table, const double *column[COLUMNS],
                         struct gb_error *err)
{
    const double *replicas = gb_table_column(table, "replicas", err);
    for (int k = 0; k < COLUMNS && replicas != NULL; k++) {
        column[k] = gb_table_column(table, column_name(k), err);
        if (column[k] == NULL) {
            return false;
        }
    }
    for (size_t row = 0; replicas != NULL && row < gb_table_rows(table); row++) {
        if (replicas[row] != 1.0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%s:%d: replicas %g: a table of one run has 1; choose "
                                "another directory",
                                gb_table_path(table), gb_table_line(table, row),
                                replicas[row]);
        }
    }
    return replicas != NULL;
}

bool gb_moduli_table_read(GArray *states, const char *path, struct gb_error *err)
{
    struct gb_table *table = NULL;
    const double *column[COLUMNS];
    const bool good =
        gb_table_read(&table, path, NULL, err) && read_columns(table, column, err);
    for (size_t row = 0; good && row < gb_table_rows(table); row++) {
        struct gb_moduli_state state = {.count = 1};
        for (int k = 0; k < COLUMNS; k++) {
            state.sum[k] = column[k][row];
            state.squares[k] = column[k][row] * column[k][row];
        }
        g_array_append_val(states, state);
    }
    gb_table_destroy(table);
    return good;
}

static double step_of(const struct gb_moduli_state *state)
{
    return gb_moduli_table_mean(state, gb_moduli_table_find("step"));
}

bool gb_moduli_table_has(const GArray *states, int64_t step)
{
    for (guint k = 0; k < states->len; k++) {
        if (step_of(state_at(states, k)) == (double)step) {
            return true;
        }
    }
    return false;
}

static int by_step(const void *a, const void *b)
{
    const double x = step_of(a), y = step_of(b);
    return (x > y) - (x < y);
}

void gb_moduli_table_sort(GArray *states)
{
    g_array_sort(states, by_step);
}
