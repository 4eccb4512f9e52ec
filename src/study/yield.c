/* Yield surfaces of compacts: each cell is pressed, unloaded to half of its pressure and
 * probed along evenly spaced directions of the (p, q) plane.  Cells are measured by workers,
 * into files of their own (study/cells.h). */

#include "study/yield.h"

#include <glib.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/number.h"
#include "base/table.h"
#include "greenbody/status.h"
#include "many/pool.h"
#include "measure/average.h"
#include "measure/fit.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"
#include "scene/seed.h"
#include "study/cells.h"
#include "study/compact.h"
#include "study/study_text.h"

enum { MOST = GB_YIELD_DIRECTIONS_MAX };

const struct gb_yield_surface_row gb_yield_surface_rows[GB_YIELD_QUANTITIES] = {
    [GB_YIELD_CENTRE_P] = {"centre_p", "MPa", 1e-6},
    [GB_YIELD_CENTRE_Q] = {"centre_q", "MPa", 1e-6},
    [GB_YIELD_HALF_P] = {"half_axis_p", "MPa", 1e-6},
    [GB_YIELD_HALF_Q] = {"half_axis_q", "MPa", 1e-6},
    [GB_YIELD_TENSION] = {"p_tension", "MPa", 1e-6},
    [GB_YIELD_PRESSURE] = {"p_compression", "MPa", 1e-6},
    [GB_YIELD_SHIFT] = {"shift", "1", 1.0},
    [GB_YIELD_MISFIT] = {"misfit", "1", 1.0},
    [GB_YIELD_ANGLE_RMS] = {"flow_angle_rms", "degrees", 1.0},
    [GB_YIELD_ANGLE_NOISE] = {"flow_angle_noise", "degrees", 1.0},
    [GB_YIELD_FLOW_DEVIATION] = {"flow_deviation", "degrees", 1.0},
    [GB_YIELD_DILATANCY_COMPRESSION] = {"dilatancy_compression", "1", 1.0},
    [GB_YIELD_DILATANCY_EXTENSION] = {"dilatancy_extension", "1", 1.0},
};

/* What the points of some cells say. */
struct summary {
    struct gb_yield_point mean[MOST];
    double angle[MOST], dilatancy[MOST];
    double quantity[GB_YIELD_QUANTITIES];
};

static bool is_there(const struct gb_yield_surface_data *data, int cell, int direction)
{
    return isfinite(data->point[cell * data->directions + direction].p_pa);
}

static int count_cells(const struct gb_yield_surface_data *data, int direction)
{
    int count = 0;
    for (int c = 0; c < data->cells; c++) {
        count += is_there(data, c, direction);
    }
    return count;
}

static bool counts(const struct gb_yield_surface_data *data, int direction)
{
    return 2 * count_cells(data, direction) >= data->cells;
}

/* Mean over the cells but one (-1: over all). */
static struct gb_yield_point mean_without(const struct gb_yield_surface_data *data,
                                          int direction, int without)
{
    struct gb_yield_point mean = {.p_error_pa = NAN, .q_error_pa = NAN};
    double count = 0.0;
    for (int c = 0; c < data->cells; c++) {
        if (c != without && is_there(data, c, direction)) {
            const struct gb_yield_point *point =
                &data->point[c * data->directions + direction];
            mean.density += point->density;
            mean.p_pa += point->p_pa;
            mean.q_pa += point->q_pa;
            mean.flow_volume += point->flow_volume;
            mean.flow_shear += point->flow_shear;
            mean.direction = point->direction;
            count++;
        }
    }
    mean.density /= count;
    mean.p_pa /= count;
    mean.q_pa /= count;
    mean.flow_volume /= count;
    mean.flow_shear /= count;
    return mean;
}

/* Degrees from -180 to 180. */
static double difference(double a, double b)
{
    return remainder(a - b, 2.0 * M_PI) * 180.0 / M_PI;
}

static void read_ellipse(struct summary *summary, const struct gb_ellipse *ellipse)
{
    double *quantity = summary->quantity;
    quantity[GB_YIELD_CENTRE_P] = ellipse->centre_p;
    quantity[GB_YIELD_CENTRE_Q] = ellipse->centre_q;
    quantity[GB_YIELD_HALF_P] = ellipse->half_p;
    quantity[GB_YIELD_HALF_Q] = ellipse->half_q;
    quantity[GB_YIELD_TENSION] = ellipse->centre_p - ellipse->half_p;
    quantity[GB_YIELD_PRESSURE] = ellipse->centre_p + ellipse->half_p;
    quantity[GB_YIELD_SHIFT] = ellipse->centre_p / ellipse->half_p;
    quantity[GB_YIELD_MISFIT] = ellipse->misfit;
}

/* 1 or -1 for loading towards +q or -q; 0 along the p axis. */
static double side_of(double direction)
{
    const double q = sin(direction);
    return fabs(q) < 1e-9 ? 0.0 : copysign(1.0, q);
}

static void measure_angles(struct summary *summary,
                           const struct gb_yield_surface_data *data,
                           const struct gb_ellipse *ellipse)
{
    double squares = 0.0, count = 0.0, deviation = 0.0, sided = 0.0;
    for (int d = 0; d < data->directions; d++) {
        const struct gb_yield_point *mean = &summary->mean[d];
        const double side = side_of(mean->direction);
        if (counts(data, d)) {
            summary->angle[d] = difference(
                atan2(mean->flow_shear, mean->flow_volume),
                gb_yield_point_ellipse_normal(ellipse, mean->p_pa, mean->q_pa));
            squares += summary->angle[d] * summary->angle[d];
            count++;
            deviation -= side * summary->angle[d];
            sided += fabs(side);
        }
    }
    summary->quantity[GB_YIELD_ANGLE_RMS] = sqrt(squares / count);
    summary->quantity[GB_YIELD_FLOW_DEVIATION] = deviation / sided;
}

static void fill_nan(double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        value[i] = NAN;
    }
}

/* Fitted in MPa: of the size of 1 to 1000. */
static void fit(struct summary *summary, const struct gb_yield_surface_data *data)
{
    double p[MOST], q[MOST];
    size_t count = 0;
    struct gb_ellipse ellipse;
    struct gb_error ignored = {0};
    for (int d = 0; d < data->directions; d++) {
        if (counts(data, d)) {
            p[count] = 1e-6 * summary->mean[d].p_pa;
            q[count++] = 1e-6 * summary->mean[d].q_pa;
        }
    }
    if (!gb_yield_point_ellipse(&ellipse, p, q, count, &ignored)) {
        return;
    }
    ellipse.centre_p *= 1e6;
    ellipse.centre_q *= 1e6;
    ellipse.half_p *= 1e6;
    ellipse.half_q *= 1e6;
    read_ellipse(summary, &ellipse);
    measure_angles(summary, data, &ellipse);
}

static void summarise(struct summary *summary, const struct gb_yield_surface_data *data,
                      int without)
{
    fill_nan(summary->angle, MOST);
    fill_nan(summary->dilatancy, MOST);
    fill_nan(summary->quantity, GB_YIELD_QUANTITIES);
    for (int d = 0; d < data->directions; d++) {
        summary->mean[d] = mean_without(data, d, without);
        if (counts(data, d)) {
            summary->dilatancy[d] =
                -summary->mean[d].flow_volume / fabs(summary->mean[d].flow_shear);
        }
    }
    const int quarter = data->directions / 4;
    summary->quantity[GB_YIELD_DILATANCY_COMPRESSION] = summary->dilatancy[quarter];
    summary->quantity[GB_YIELD_DILATANCY_EXTENSION] = summary->dilatancy[3 * quarter];
    fit(summary, data);
}

static struct gb_fit_value value_with(double value, double error, int cells)
{
    const double quantile =
        cells > 1 ? gsl_cdf_tdist_Pinv(0.975, cells - 1.0) : (double)NAN;
    return (struct gb_fit_value){value, error, value - quantile * error,
                                 value + quantile * error};
}

/* A number of the summary (at `offset` bytes) with its error over the summaries without one
 * cell each. */
static struct gb_fit_value jackknife(const struct summary *all,
                                     const struct summary *without, int cells,
                                     size_t offset)
{
    double value[GB_YIELD_REPLICAS_MAX];
    for (int c = 0; c < cells; c++) {
        const char *at = (const char *)&without[c] + offset;
        value[c] = *(const double *)(const void *)at;
    }
    const char *at = (const char *)all + offset;
    return value_with(
        *(const double *)(const void *)at,
        cells > 1 ? gb_average_jackknife(value, (size_t)cells) : (double)NAN, cells);
}

#define AT(member, index)                                                                \
    (offsetof(struct summary, member) +                                                  \
     (size_t)(index) * sizeof((struct summary){0}.member[0]))

static void fill_direction(struct gb_yield_surface_direction *direction, int d,
                           const struct gb_yield_surface_data *data,
                           const struct summary *all, const struct summary *without)
{
    const size_t at = AT(mean, d);
    const int cells = data->cells;
    direction->mean = all->mean[d];
    direction->cells = count_cells(data, d);
    direction->mean.p_error_pa =
        jackknife(all, without, cells, at + offsetof(struct gb_yield_point, p_pa)).error;
    direction->mean.q_error_pa =
        jackknife(all, without, cells, at + offsetof(struct gb_yield_point, q_pa)).error;
    direction->angle = jackknife(all, without, cells, AT(angle, d));
    direction->dilatancy = jackknife(all, without, cells, AT(dilatancy, d));
}

/* rms of the errors of the angles. */
static double noise_of(const struct gb_yield_surface *surface)
{
    double squares = 0.0, count = 0.0;
    for (int d = 0; d < surface->directions; d++) {
        const double error = surface->direction[d].angle.error;
        if (isfinite(error)) {
            squares += error * error;
            count++;
        }
    }
    return sqrt(squares / count);
}

static struct gb_fit_value over_cells(const double *value, int cells)
{
    double mean, error;
    const size_t count = gb_average_values(value, (size_t)cells, &mean, &error);
    return value_with(mean, error, (int)count);
}

static void fill(struct gb_yield_surface *surface,
                 const struct gb_yield_surface_data *data, const struct summary *all,
                 const struct summary *without)
{
    double density[GB_YIELD_REPLICAS_MAX];
    for (int c = 0; c < data->cells; c++) {
        density[c] = data->point[c * data->directions].density;
    }
    surface->cells = data->cells;
    surface->directions = data->directions;
    surface->density = over_cells(density, data->cells);
    surface->top_p = over_cells(data->top_p, data->cells);
    surface->top_q = over_cells(data->top_q, data->cells);
    for (int d = 0; d < data->directions; d++) {
        fill_direction(&surface->direction[d], d, data, all, without);
    }
    for (int k = 0; k < GB_YIELD_QUANTITIES; k++) {
        surface->quantity[k] = jackknife(all, without, data->cells, AT(quantity, k));
    }
    surface->quantity[GB_YIELD_ANGLE_NOISE] =
        (struct gb_fit_value){noise_of(surface), NAN, NAN, NAN};
}

bool gb_yield_surface_measure(struct gb_yield_surface *surface,
                              const struct gb_yield_surface_data *data,
                              struct gb_error *err)
{
    struct summary *summary =
        gb_alloc_array((size_t)data->cells + 1, sizeof *summary, err);
    if (summary == NULL) {
        return false;
    }
    for (int c = -1; c < data->cells; c++) {
        summarise(&summary[c + 1], data, c);
    }
    fill(surface, data, &summary[0], &summary[1]);
    gb_alloc_free(summary);
    return true;
}

/* --- options -------------------------------------------------------------------------- */

static const double offsets[GB_YIELD_OFFSETS] = {0.5, 1.0, 2.0};

void gb_yield_options_init(struct gb_yield_options *options)
{
    *options = (struct gb_yield_options){
        .marks = {.count = 2, .point = {{true, 0.5}, {true, 0.55}}},
        .replicas = 8,
        .directions = 12,
        .inside = 0.5,
        .offset = 1e-3,
        .step = 5e-5,
        .strain_most = 0.03,
        .tolerance = 1e-3,
    };
}

static bool refuse(struct gb_error *err, const char *name, double value,
                   const char *accepted)
{
    return gb_error_set(err, GB_ERR_INPUT, "--%s %g: must be %s", name, value, accepted);
}

static bool check_marks(const struct gb_keep_points *marks, struct gb_error *err)
{
    if (marks->count == 0 || marks->every > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at: expected densities and pressures, as in 'density = "
                            "0.5; 100 MPa'");
    }
    for (int i = 0; i < marks->count; i++) {
        if (marks->point[i].by_density && !(marks->point[i].value < 0.95)) {
            return refuse(err, "density", marks->point[i].value, "below 0.95");
        }
    }
    return true;
}

/* Errors: GB_ERR_INPUT naming the option and what is expected. */
static bool yield_cell_check(const struct gb_yield_options *options, struct gb_error *err)
{
    if (options->replicas < 1 || options->replicas > GB_YIELD_REPLICAS_MAX) {
        return refuse(err, "replicas", options->replicas, "between 1 and 1000");
    }
    if (options->directions < 8 || options->directions > GB_YIELD_DIRECTIONS_MAX ||
        options->directions % 4 != 0) {
        return refuse(err, "directions", options->directions,
                      "between 8 and 72, a multiple of 4");
    }
    if (!(options->inside > 0.0 && options->inside < 1.0)) {
        return refuse(err, "inside", options->inside, "between 0 and 1");
    }
    if (!(options->offset >= 1e-4 && options->offset <= 0.02)) {
        return refuse(err, "offset", 100.0 * options->offset, "between 0.01 and 2 %");
    }
    return check_marks(&options->marks, err);
}

static double direction_of(const struct gb_yield_options *options, int index)
{
    return 2.0 * G_PI * index / options->directions;
}

/* --- one cell, in a worker ------------------------------------------------------------ */

/* Members that a worker needs. */
static const struct gb_cells_number numbers[] = {
    {"inside", offsetof(struct gb_yield_options, inside)},
    {"offset", offsetof(struct gb_yield_options, offset)},
    {"step", offsetof(struct gb_yield_options, step)},
    {"strain_most", offsetof(struct gb_yield_options, strain_most)},
    {"tolerance", offsetof(struct gb_yield_options, tolerance)},
};

/* For the question of a cell (study/cells.h) and back. */
static void yield_cell_write(const struct gb_yield_options *options,
                             const struct gb_keep_point *mark, GString *text)
{
    g_string_append_printf(text, "directions=%d\n", options->directions);
    gb_cells_write(text, mark, options, numbers, G_N_ELEMENTS(numbers));
}

static void yield_options_read(struct gb_yield_options *options,
                               struct gb_keep_point *mark, GKeyFile *question)
{
    gb_yield_options_init(options);
    options->directions = (int)gb_cells_option(question, "directions");
    gb_cells_read(question, mark, options, numbers, G_N_ELEMENTS(numbers));
}

/* Plastic strain at which the flow has been measured, in offsets. */
static const double flow_end = 1.5;

/* A cell at work. */
struct cell {
    struct gb_yield_options options;
    struct gb_keep_point mark;
    const struct gb_pool_callbacks *callbacks;
    struct gb_compact top, inside;
    struct gb_compact_elastic elastic;
    struct gb_yield_point chosen[GB_YIELD_DIRECTIONS_MAX]; /* at the chosen offset */
    struct gb_listing *points, *paths;
};

/* Index of the direction and of the offset, state of the compact, the point. */
static void add_point(struct cell *cell, int direction, int offset,
                      const struct gb_compact_probe *probe)
{
    const double none = (double)NAN;
    const double size = offsets[offset] * cell->options.offset;
    struct gb_yield_point point = {
        .p_pa = none, .q_pa = none, .flow_volume = none, .flow_shear = none};
    const struct gb_compact_state top = gb_compact_state_of(&cell->top.point);
    gb_compact_probe_point(probe, size, flow_end, &point);
    if (offset == GB_YIELD_OFFSET_CHOSEN) {
        cell->chosen[direction] = point;
        cell->chosen[direction].density = cell->top.point.density;
        cell->chosen[direction].direction = direction_of(&cell->options, direction);
    }
    const double number[] = {
        direction,  offset,     cell->top.point.density, top.p,           top.q,
        point.p_pa, point.q_pa, point.flow_volume,       point.flow_shear};
    gb_listing_numbers(cell->points, number, G_N_ELEMENTS(number));
}

static void add_path(struct cell *cell, int direction,
                     const struct gb_compact_probe *probe)
{
    if (probe->outcome == GB_COMPACT_STOPPED) {
        char *note =
            g_strdup_printf("direction %d stopped: %s", direction, probe->why.text);
        gb_listing_note(cell->paths, note);
        g_free(note);
    }
    for (guint i = 0; i < probe->state->len; i++) {
        const struct gb_compact_state *state =
            &g_array_index(probe->state, struct gb_compact_state, i);
        const double number[] = {direction, 1e-6 * state->p, 1e-6 * state->q,
                                 state->volume, state->shear};
        gb_listing_numbers(cell->paths, number, G_N_ELEMENTS(number));
    }
}

static bool probe_one(struct cell *cell, int direction, struct gb_error *err)
{
    struct gb_compact_probe probe = {0};
    /* the largest offset, with the rest of the way over which its flow is measured */
    const struct gb_compact_probe_steps steps = {
        .step = cell->options.step,
        .strain_most = cell->options.strain_most,
        .enough = flow_end * cell->options.offset * offsets[GB_YIELD_OFFSETS - 1]};
    const bool good = gb_compact_probe_run(
        &probe, &cell->inside, direction_of(&cell->options, direction),
        &cell->elastic.plane, &steps, cell->callbacks, err);
    for (int i = 0; i < GB_YIELD_OFFSETS && good; i++) {
        add_point(cell, direction, i, &probe);
    }
    if (good) {
        add_path(cell, direction, &probe);
    }
    gb_compact_probe_finish(&probe);
    return good;
}

static bool probe_all(struct cell *cell, struct gb_error *err)
{
    gb_listing_columns(cell->points, "%.10g",
                       "direction,offset,density,top_p_Pa,top_q_Pa,p_Pa,q_Pa,flow_volume,"
                       "flow_shear");
    gb_listing_columns(cell->paths, "%.9g", "direction,p_MPa,q_MPa,volume,shear");
    for (int i = 0; i < cell->options.directions; i++) {
        if (!probe_one(cell, i, err)) {
            return false;
        }
    }
    return true;
}

static bool measure(struct cell *cell, const struct gb_params *params,
                    struct gb_error *err)
{
    if (!gb_compact_press(&cell->top, params, &cell->mark, cell->callbacks, err)) {
        return false;
    }
    cell->top.tolerance = cell->options.tolerance;
    const double pressure =
        cell->options.inside * gb_compact_state_of(&cell->top.point).p;
    return gb_compact_unload(&cell->top, pressure, cell->callbacks, &cell->inside, err) &&
           gb_compact_elastic(&cell->elastic, &cell->inside, cell->callbacks, err) &&
           probe_all(cell, err);
}

static void cell_init(struct cell *cell, const struct gb_pool_callbacks *callbacks)
{
    *cell = (struct cell){
        .callbacks = callbacks, .points = gb_listing_new(), .paths = gb_listing_new()};
}

static void cell_finish(struct cell *cell)
{
    gb_compact_finish(&cell->inside);
    gb_compact_finish(&cell->top);
    gb_listing_free(cell->points);
    gb_listing_free(cell->paths);
}

bool gb_yield_measure(struct gb_yield_point point[GB_YIELD_DIRECTIONS_MAX],
                      double top_pa[2], const struct gb_params *params,
                      const struct gb_keep_point *mark,
                      const struct gb_yield_options *options,
                      const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct cell cell;
    cell_init(&cell, callbacks);
    cell.options = *options;
    cell.mark = *mark;
    const bool good = measure(&cell, params, err);
    const struct gb_compact_state top = gb_compact_state_of(&cell.top.point);
    memcpy(point, cell.chosen, sizeof cell.chosen);
    top_pa[0] = top.p;
    top_pa[1] = top.q;
    cell_finish(&cell);
    return good;
}

/* One compact of one cell, as the work of a pool: pressed, unloaded to a point inside, and
 * probed along all directions.
 *
 * path  of the cell without ending: PATH.ini is the question (study/yield.h),
 *       PATH.csv receives a row per direction and offset, PATH.paths.csv the states of all
 *       probes */
static bool yield_cell_work(const struct gb_params *params, const char *path,
                            const struct gb_pool_callbacks *callbacks,
                            struct gb_error *err)
{
    GKeyFile *question = NULL;
    struct cell cell;
    struct gb_lock lock;
    if (!gb_cells_question(&question, &lock, path, err)) {
        return false;
    }
    cell_init(&cell, callbacks);
    yield_options_read(&cell.options, &cell.mark, question);
    g_key_file_free(question);
    const bool good = measure(&cell, params, err) &&
                      gb_cells_table(path, ".paths.csv", cell.paths, err) &&
                      gb_cells_table(path, ".csv", cell.points, err);
    cell_finish(&cell);
    gb_lock_release(&lock);
    return good;
}

/* --- all cells ------------------------------------------------------------------------ */

/* The answers of one compact: points by offset, cell and direction. */
struct answers {
    struct gb_yield_point *point;
    double *top_p, *top_q;
    int cells, directions;
};

static void answers_init(struct answers *answers, const struct gb_yield_options *options)
{
    const int cells = options->replicas, directions = options->directions;
    const int count = GB_YIELD_OFFSETS * cells * directions;
    answers->cells = cells;
    answers->directions = directions;
    answers->point = g_new0(struct gb_yield_point, (gsize)count);
    answers->top_p = g_new(double, (gsize)cells);
    answers->top_q = g_new(double, (gsize)cells);
    for (int i = 0; i < count; i++) {
        answers->point[i].p_pa = answers->point[i].density = (double)NAN;
    }
    for (int c = 0; c < cells; c++) {
        answers->top_p[c] = answers->top_q[c] = (double)NAN;
    }
}

static void answers_finish(struct answers *answers)
{
    g_free(answers->point);
    g_free(answers->top_p);
    g_free(answers->top_q);
}

static struct gb_yield_point *answers_at(const struct answers *answers, int offset,
                                         int cell, int direction)
{
    return &answers->point[(offset * answers->cells + cell) * answers->directions +
                           direction];
}

enum { COLUMNS = 9 };

static bool find_columns(const struct gb_table *table, const double *column[COLUMNS],
                         struct gb_error *err)
{
    static const char *const names[COLUMNS] = {"direction", "offset",      "density",
                                               "top_p_Pa",  "top_q_Pa",    "p_Pa",
                                               "q_Pa",      "flow_volume", "flow_shear"};
    for (int k = 0; k < COLUMNS; k++) {
        column[k] = gb_table_column(table, names[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    return true;
}

static bool read_rows(struct answers *answers, int cell, const struct gb_table *table,
                      const struct gb_yield_options *options, struct gb_error *err)
{
    const double *column[COLUMNS];
    if (!find_columns(table, column, err)) {
        return false;
    }
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const int direction = (int)column[0][i], offset = (int)column[1][i];
        if (direction < 0 || direction >= answers->directions || offset < 0 ||
            offset >= GB_YIELD_OFFSETS) {
            return gb_error_set(err, GB_ERR_INPUT, "%s:%d: no such direction or offset",
                                gb_table_path(table), gb_table_line(table, i));
        }
        answers->top_p[cell] = column[3][i];
        answers->top_q[cell] = column[4][i];
        *answers_at(answers, offset, cell, direction) = (struct gb_yield_point){
            column[2][i], column[5][i], column[6][i],
            column[7][i], column[8][i], (double)NAN,
            (double)NAN,  cell + 1,     direction_of(options, direction)};
    }
    return true;
}

static bool read_cell(struct answers *answers, int cell, const struct gb_cells *cells,
                      const struct gb_cells_item *item,
                      const struct gb_yield_options *options, struct gb_error *err)
{
    char *file = g_strconcat(item->name, ".csv", NULL);
    char *path = g_build_filename(cells->directory, file, NULL);
    struct gb_table *table = NULL;
    const bool good = gb_table_read(&table, path, NULL, err) &&
                      read_rows(answers, cell, table, options, err);
    gb_table_destroy(table);
    g_free(path);
    g_free(file);
    return good;
}

static void keep_points(struct gb_yield_study *study, const struct answers *answers)
{
    for (int c = 0; c < answers->cells; c++) {
        for (int d = 0; d < answers->directions; d++) {
            const struct gb_yield_point *point =
                answers_at(answers, GB_YIELD_OFFSET_CHOSEN, c, d);
            if (isfinite(point->p_pa)) {
                g_array_append_vals(study->point, point, 1);
            }
        }
    }
}

static bool measure_surfaces(struct gb_yield_study *study, const struct answers *answers,
                             const struct gb_keep_point *mark, struct gb_error *err)
{
    for (int o = 0; o < GB_YIELD_OFFSETS; o++) {
        struct gb_yield_surface *surface = g_new0(struct gb_yield_surface, 1);
        const struct gb_yield_surface_data data = {answers_at(answers, o, 0, 0),
                                                   answers->top_p, answers->top_q,
                                                   answers->cells, answers->directions};
        surface->mark = *mark;
        surface->offset = study->options.offset * offsets[o];
        g_ptr_array_add(study->surface, surface);
        if (!gb_yield_surface_measure(surface, &data, err)) {
            return false;
        }
    }
    keep_points(study, answers);
    return true;
}

/* The cells of one mark follow each other in the list. */
static bool conclude_mark(struct gb_yield_study *study, const struct gb_cells *cells,
                          int mark, struct gb_error *err)
{
    struct answers answers;
    size_t there = 0;
    bool good = true;
    answers_init(&answers, &study->options);
    for (int c = 0; c < answers.cells && good; c++) {
        const struct gb_cells_item *item = g_ptr_array_index(
            cells->list, (guint)(c * study->options.marks.count + mark));
        if (item->done) {
            there++;
            good = read_cell(&answers, c, cells, item, &study->options, err);
        }
    }
    good = good && (there > 0 || gb_cells_check(cells, err)) &&
           measure_surfaces(study, &answers, &study->options.marks.point[mark], err);
    answers_finish(&answers);
    return good;
}

static void count_failed(struct gb_yield_study *study, const struct gb_cells *cells)
{
    for (guint i = 0; i < cells->list->len; i++) {
        const struct gb_cells_item *item = g_ptr_array_index(cells->list, i);
        study->failed += !item->done;
    }
    gb_cells_check(cells, &study->why);
}

static bool conclude(struct gb_yield_study *study, const struct gb_cells *cells,
                     struct gb_error *err)
{
    for (int m = 0; m < study->options.marks.count; m++) {
        if (!conclude_mark(study, cells, m, err)) {
            return false;
        }
    }
    count_failed(study, cells);
    return true;
}

/* Cell by cell, so that all marks have as many when the command is stopped. */
static void add_cells(struct gb_cells *cells, const struct gb_params *params,
                      const struct gb_yield_options *options)
{
    struct gb_params own = *params;
    own.threads = 1;
    for (int c = 0; c < options->replicas; c++) {
        own.seed = params->seed + (uint64_t)c;
        for (int m = 0; m < options->marks.count; m++) {
            GString *text = g_string_new("study=yield\n");
            yield_cell_write(options, &options->marks.point[m], text);
            gb_cells_add(cells, &own, gb_cells_name(&options->marks.point[m], c),
                         text->str);
            g_string_free(text, TRUE);
        }
    }
}

bool gb_yield_run(struct gb_yield_study *study, const struct gb_params *preset,
                  const struct gb_yield_options *options, const char *directory, int jobs,
                  const struct gb_cells_callbacks *callbacks, struct gb_error *err)
{
    struct gb_cells cells = {0};
    struct gb_params params;
    *study = (struct gb_yield_study){
        .options = *options,
        .surface = g_ptr_array_new_with_free_func(g_free),
        .point = g_array_new(FALSE, FALSE, sizeof(struct gb_yield_point)),
    };
    if (!yield_cell_check(options, err) ||
        !gb_seed_check_cells(preset, (size_t)options->replicas, err) ||
        !gb_compact_params(&params, preset, err) ||
        !gb_cells_init(&cells, directory, err)) {
        gb_cells_finish(&cells);
        return false;
    }
    add_cells(&cells, &params, options);
    const bool good = gb_cells_work(&cells, jobs, yield_cell_work, callbacks, err) &&
                      conclude(study, &cells, err);
    gb_cells_finish(&cells);
    return good;
}

void gb_yield_finish(struct gb_yield_study *study)
{
    if (study->surface != NULL) {
        g_ptr_array_unref(study->surface);
        g_array_unref(study->point);
    }
    memset(study, 0, sizeof *study);
}

const struct gb_yield_surface *gb_yield_study_surface(const struct gb_yield_study *study,
                                                      int mark, int offset)
{
    return g_ptr_array_index(study->surface, (guint)(mark * GB_YIELD_OFFSETS + offset));
}

/* --- tables and page ------------------------------------------------------------------ */

/* The tables and the page of a study; stresses in MPa, angles in degrees. */

static void add_direction(struct gb_listing *listing,
                          const struct gb_yield_surface *surface, int d)
{
    const struct gb_yield_surface_direction *direction = &surface->direction[d];
    const struct gb_yield_point *mean = &direction->mean;
    const double number[] = {surface->density.value,
                             100.0 * surface->offset,
                             mean->direction * 180.0 / G_PI,
                             direction->cells,
                             1e-6 * mean->p_pa,
                             1e-6 * mean->p_error_pa,
                             1e-6 * mean->q_pa,
                             1e-6 * mean->q_error_pa,
                             mean->flow_volume,
                             mean->flow_shear,
                             direction->angle.value,
                             direction->angle.error,
                             direction->dilatancy.value,
                             direction->dilatancy.error};
    gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
}

GString *gb_yield_points(const struct gb_yield_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(
        listing, "%.8g",
        "density,offset_percent,direction_deg,cells,p_MPa,p_error_MPa,q_MPa,"
        "q_error_MPa,flow_volume,flow_shear,angle_deg,angle_error_deg,dilatancy,"
        "dilatancy_error");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        for (int d = 0; d < surface->directions; d++) {
            if (surface->direction[d].cells > 0) {
                add_direction(listing, surface, d);
            }
        }
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* yield_cells.csv: the points of every cell at the chosen offset. */
static GString *yield_files_cells(const struct gb_yield_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%.8g",
                       "density,cell,direction_deg,p_MPa,q_MPa,flow_volume,flow_shear");
    for (guint i = 0; i < study->point->len; i++) {
        const struct gb_yield_point *point =
            &g_array_index(study->point, struct gb_yield_point, i);
        const double number[] = {
            point->density,     point->replica,     point->direction * 180.0 / G_PI,
            1e-6 * point->p_pa, 1e-6 * point->q_pa, point->flow_volume,
            point->flow_shear};
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static void add_quantity(struct gb_listing *listing,
                         const struct gb_yield_surface *surface, const char *name,
                         const struct gb_fit_value *value, const char *unit,
                         double factor)
{
    const double number[] = {surface->density.value, 100.0 * surface->offset,
                             factor * value->value,  factor * value->error,
                             factor * value->low,    factor * value->high};
    gb_listing_text(listing, name);
    gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
    gb_listing_text(listing, unit);
}

GString *gb_yield_fit(const struct gb_yield_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%s", "quantity");
    gb_listing_columns(listing, "%.8g", "density,offset_percent,value,error,low,high");
    gb_listing_columns(listing, "%s", "unit");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        add_quantity(listing, surface, "compact_p", &surface->top_p, "MPa", 1e-6);
        add_quantity(listing, surface, "compact_q", &surface->top_q, "MPa", 1e-6);
        for (int k = 0; k < GB_YIELD_QUANTITIES; k++) {
            const struct gb_yield_surface_row *row = &gb_yield_surface_rows[k];
            add_quantity(listing, surface, row->name, &surface->quantity[k], row->unit,
                         row->factor);
        }
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* --- the page ---------------------------------------------------------------------- */

static const struct gb_fit_value *quantity(const struct gb_yield_surface *surface,
                                           enum gb_yield_surface_quantity which)
{
    return &surface->quantity[which];
}

static void add_listing(GString *text, struct gb_listing *listing)
{
    GString *rows = gb_listing_end(listing, GB_LISTING_MARKDOWN);
    g_string_append(text, rows->str);
    g_string_free(rows, TRUE);
}

static void add_surfaces(GString *text, const struct gb_yield_study *study)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%.4f", "density");
    gb_listing_columns(listing, "%s", "pressed to p (MPa)");
    gb_listing_columns(listing, "%g", "offset (%)");
    gb_listing_columns(listing, "%s", "centre p (MPa),centre q,half axis p,half axis q");
    gb_listing_columns(listing, "%s", "misfit");
    for (guint i = 0; i < study->surface->len; i++) {
        const struct gb_yield_surface *surface = g_ptr_array_index(study->surface, i);
        char number[GB_NUMBER_MAX];
        gb_listing_number(listing, surface->density.value);
        gb_study_text_mean(listing, &surface->top_p, 1e-6);
        gb_listing_number(listing, 100.0 * surface->offset);
        for (int k = GB_YIELD_CENTRE_P; k <= GB_YIELD_HALF_Q; k++) {
            gb_study_text_mean(listing, &surface->quantity[k], 1e-6);
        }
        gb_listing_text(
            listing,
            gb_number_shown("%.3f", quantity(surface, GB_YIELD_MISFIT)->value, number));
    }
    g_string_append(text, "\n## Ellipses\n\n");
    add_listing(text, listing);
}

/* Whether the interval holds zero. */
static const char *verdict(const struct gb_fit_value *value)
{
    if (!isfinite(value->low)) {
        return "without an error";
    }
    return value->low > 0.0    ? "above 0"
           : value->high < 0.0 ? "below 0"
                               : "0 within its error";
}

/* Directions whose angle differs from 0 by more than its 95 % interval. */
static int count_angles(const struct gb_yield_surface *surface, int *all)
{
    int count = 0;
    *all = 0;
    for (int d = 0; d < surface->directions; d++) {
        const struct gb_fit_value *angle = &surface->direction[d].angle;
        *all += isfinite(angle->value);
        count += angle->low > 0.0 || angle->high < 0.0;
    }
    return count;
}

static void add_statements_on(GString *text, const struct gb_yield_surface *surface)
{
    int all = 0;
    char number[GB_NUMBER_MAX];
    const int different = count_angles(surface, &all);
    const struct gb_fit_value *centre = quantity(surface, GB_YIELD_CENTRE_P);
    const struct gb_fit_value *loaded = quantity(surface, GB_YIELD_DILATANCY_COMPRESSION);
    const struct gb_fit_value *pulled = quantity(surface, GB_YIELD_DILATANCY_EXTENSION);
    g_string_append_printf(text,
                           "\nDensity %.4f, offset %g %%:\n\n- centre of the ellipse",
                           surface->density.value, 100.0 * surface->offset);
    gb_study_text_value(text, " at p = ", centre, 1e-6);
    g_string_append_printf(text, " MPa, %s: shift over half axis", verdict(centre));
    gb_study_text_value(text, " ", quantity(surface, GB_YIELD_SHIFT), 1.0);
    gb_study_text_value(
        text, "\n- dilatancy -dv/|dw| under shear at constant p: ", loaded, 1.0);
    g_string_append_printf(text, " (%s) in compression", verdict(loaded));
    gb_study_text_value(text, ", ", pulled, 1.0);
    g_string_append_printf(text, " (%s) in extension", verdict(pulled));
    gb_study_text_value(text, "\n- angle of the flow from the normal: rms ",
                        quantity(surface, GB_YIELD_ANGLE_RMS), 1.0);
    g_string_append_printf(
        text,
        " degrees (flow along the normal would show %s by the errors); in %d of %d "
        "directions its 95 %% interval leaves out 0\n",
        gb_number_shown("%.1f", quantity(surface, GB_YIELD_ANGLE_NOISE)->value, number),
        different, all);
    gb_study_text_value(text, "- mean deviation of the flow from the normal towards +p: ",
                        quantity(surface, GB_YIELD_FLOW_DEVIATION), 1.0);
    g_string_append_printf(text, " degrees, %s\n",
                           verdict(quantity(surface, GB_YIELD_FLOW_DEVIATION)));
}

static void add_directions(GString *text, const struct gb_yield_study *study)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%.4f", "density");
    gb_listing_columns(listing, "%.0f", "direction (deg),cells");
    gb_listing_columns(listing, "%s", "p (MPa),q (MPa),angle to normal (deg),dilatancy");
    for (int m = 0; m < study->options.marks.count; m++) {
        const struct gb_yield_surface *surface =
            gb_yield_study_surface(study, m, GB_YIELD_OFFSET_CHOSEN);
        for (int d = 0; d < surface->directions; d++) {
            const struct gb_yield_surface_direction *at = &surface->direction[d];
            const struct gb_fit_value p = {.value = at->mean.p_pa,
                                           .error = at->mean.p_error_pa};
            const struct gb_fit_value q = {.value = at->mean.q_pa,
                                           .error = at->mean.q_error_pa};
            gb_listing_number(listing, surface->density.value);
            gb_listing_number(listing, direction_of(&study->options, d) * 180.0 / G_PI);
            gb_listing_number(listing, at->cells);
            gb_study_text_mean(listing, &p, 1e-6);
            gb_study_text_mean(listing, &q, 1e-6);
            gb_study_text_mean(listing, &at->angle, 1.0);
            gb_study_text_mean(listing, &at->dilatancy, 1.0);
        }
    }
    g_string_append(text, "\n## Points at the chosen offset\n\n");
    add_listing(text, listing);
}

/* The page: what was done, the fitted surfaces, and the three statements on each compact:
 * shift of the ellipse, dilatancy under shear, flow against normal. */
static GString *yield_files_page(const struct gb_yield_study *study, const char *title,
                                 const char *command)
{
    const struct gb_yield_options *options = &study->options;
    GString *text = g_string_new(NULL);
    g_string_append_printf(
        text,
        "# Yield surface: %s\n\n`%s`\n\n%d cells. Each compact is unloaded to p = %g of "
        "its pressure at q = 0 and loaded from there in %d directions of the (p, q) "
        "plane, until the plastic strain reaches the offset: the total less the elastic "
        "strain, by the elastic constants of the unloaded compact (`greenbody moduli`). "
        "Strain steps of %g, relaxed to %g. Means with standard errors over the "
        "cells.\n",
        title, command, options->replicas, options->inside, options->directions,
        options->step, options->tolerance);
    if (study->failed > 0) {
        g_string_append_printf(text, "\nIncomplete: %s\n", study->why.text);
    }
    add_surfaces(text, study);
    g_string_append(text, "\n## Statements\n");
    for (guint i = 0; i < study->surface->len; i++) {
        add_statements_on(text, g_ptr_array_index(study->surface, i));
    }
    add_directions(text, study);
    return text;
}

bool gb_yield_write(const struct gb_yield_study *study, const char *directory,
                    const char *title, const char *command, struct gb_error *err)
{
    char *comment = g_strdup_printf(
        "preset: %s\ncommand: %s\np = tr/3, q = p_z - (p_x + p_y)/2, compression positive; "
        "flow: plastic strain increments; angle: of the flow from the outward normal of "
        "the fitted ellipse; errors: standard, over the cells",
        title, command);
    const struct gb_study_text_file file[] = {
        {"yield.csv", gb_yield_points(study, comment)},
        {"yield_cells.csv", yield_files_cells(study, comment)},
        {"yield_fit.csv", gb_yield_fit(study, comment)},
        {"yield.md", yield_files_page(study, title, command)}};
    g_free(comment);
    return gb_study_text_write(file, G_N_ELEMENTS(file), directory, err);
}
