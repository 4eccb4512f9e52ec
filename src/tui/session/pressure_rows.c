#include "tui/session/pressure_rows.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "measure/average.h"
#include "run/cost.h"
#include "tui/session/previous.h"
#include "tui/term/paint.h"

/* Largest number of standard deviations of a difference that counts as chance (5 %). */
static const double verdict_deviations = 2.0;

static const struct gb_pressure_value none = {NAN, NAN};

static struct gb_pressure_row *add(struct gb_pressure_rows *rows,
                                   enum gb_pressure_row_kind kind,
                                   const struct gb_params *params)
{
    struct gb_pressure_row *row = &rows->row[rows->count++];
    *row = (struct gb_pressure_row){.kind = kind, .params = params};
    return row;
}

static void name(struct gb_pressure_row *row, const char *brief, const char *text)
{
    g_strlcpy(row->brief, brief, sizeof row->brief);
    g_strlcpy(row->name, text, sizeof row->name);
}

/* "a mu 0.2", "run dense"; cut with an ellipsis. */
static void name_after(struct gb_pressure_row *row, const char *brief, const char *text)
{
    char *whole =
        text[0] != '\0' ? g_strdup_printf("%s %s", brief, text) : g_strdup(brief);
    g_strlcpy(row->brief, brief, sizeof row->brief);
    gb_paint_fit_copy(row->name, sizeof row->name, whole);
    g_free(whole);
}

struct gb_pressure_row gb_pressure_rows_run(const struct gb_session *session)
{
    struct gb_pressure_row row = {.kind = GB_PRESSURE_ROW_RUN,
                                  .params = gb_runner_params(session->runner)};
    name_after(&row, "run", session->run_label.name);
    return row;
}

struct gb_pressure_row gb_pressure_rows_previous(const struct gb_session *session,
                                                 int index)
{
    const struct gb_previous_curve *previous = &session->previous[index];
    const char marker[2] = {previous->label.marker, '\0'};
    struct gb_pressure_row row = {.kind = GB_PRESSURE_ROW_PREVIOUS,
                                  .previous = index,
                                  .quick = previous->quick,
                                  .params = &previous->params};
    name_after(&row, marker, gb_previous_list_name(previous));
    return row;
}

void gb_pressure_rows_list(struct gb_pressure_rows *rows,
                           const struct gb_session *session, bool hide_previous)
{
    const struct gb_quick_cell *quick = &session->quick_cell;
    const struct gb_runset_view_group *group = gb_session_replicas(session);
    char text[64];
    rows->count = 0;
    if (session->runner != NULL) {
        rows->row[rows->count++] = gb_pressure_rows_run(session);
    }
    if (quick->runner != NULL && quick->points > 0) {
        struct gb_pressure_row *row =
            add(rows, GB_PRESSURE_ROW_QUICK, gb_runner_params(quick->runner));
        row->quick = true;
        name(row, "q", "q quick cell");
    }
    if (group != NULL) {
        snprintf(text, sizeof text, "R mean of %zu", group->members);
        name(add(rows, GB_PRESSURE_ROW_REPLICAS, &session->replica_band.params), "mean",
             text);
    }
    if (gb_session_measured(session) != NULL) {
        name(add(rows, GB_PRESSURE_ROW_MEASURED, NULL), "measured", "measured");
    }
    for (int i = session->previous_count - 1; i >= 0; i--) { /* the newest first */
        if (gb_previous_list_shown(&session->previous[i], hide_previous)) {
            rows->row[rows->count++] = gb_pressure_rows_previous(session, i);
        }
    }
}

static struct gb_pressure_value of_cell(const struct gb_params *params, double density)
{
    return (struct gb_pressure_value){density, gb_average_cell_scatter(params)};
}

static double of_previous(const struct gb_previous_curve *previous, double pressure_pa)
{
    double below = NAN; /* the last pressure of loading, if it is lower */
    double density = NAN;
    for (size_t i = 0; i < previous->count; i++) {
        const double p = previous->pressure_pa[i];
        if (!previous->loading[i] || isnan(p)) {
            continue;
        }
        if (p >= pressure_pa && below < pressure_pa) {
            const double share = (pressure_pa - below) / (p - below);
            return density + share * (previous->density[i] - density);
        }
        below = p;
        density = previous->density[i];
    }
    return NAN;
}

/* Nearest points on either side of the pressure, for points in any order. */
struct neighbours {
    size_t below, above; /* count: none */
};

static struct neighbours find(const double *pressure, const double *density, size_t count,
                              double pressure_pa)
{
    struct neighbours found = {count, count};
    for (size_t i = 0; i < count; i++) {
        const bool known = isfinite(density[i]) && pressure[i] > 0.0;
        if (known && pressure[i] <= pressure_pa &&
            (found.below == count || pressure[i] > pressure[found.below])) {
            found.below = i;
        }
        if (known && pressure[i] >= pressure_pa &&
            (found.above == count || pressure[i] < pressure[found.above])) {
            found.above = i;
        }
    }
    return found;
}

static struct gb_pressure_value between(const double *pressure, const double *density,
                                        const double *error, size_t count,
                                        double pressure_pa)
{
    const struct neighbours at = find(pressure, density, count, pressure_pa);
    if (at.below == count || at.above == count) {
        return none;
    }
    const double width = log(pressure[at.above] / pressure[at.below]);
    const double share =
        width > 0.0 ? log(pressure_pa / pressure[at.below]) / width : 0.0;
    return (struct gb_pressure_value){
        density[at.below] + share * (density[at.above] - density[at.below]),
        error[at.below] + share * (error[at.above] - error[at.below])};
}

static struct gb_pressure_value of_replicas(const struct gb_replica_band *band,
                                            double pressure_pa)
{
    const struct gb_runset_view_group *group = gb_job_replicas_group(band);
    return group == NULL ? none
                         : between(band->runset.level_pa, group->mean, group->error,
                                   band->runset.levels, pressure_pa);
}

struct gb_pressure_value gb_pressure_rows_at(const struct gb_session *session,
                                             const struct gb_pressure_row *row,
                                             double pressure_pa)
{
    const struct gb_measured *measured = session->measured;
    const struct gb_runner *quick = session->quick_cell.runner;
    struct gb_params small;
    switch (row->kind) {
    case GB_PRESSURE_ROW_RUN:
        return of_cell(row->params,
                       gb_measured_density_at(gb_runner_curve(session->runner),
                                              session->points, pressure_pa));
    case GB_PRESSURE_ROW_QUICK:
        return of_cell(row->params,
                       gb_measured_density_at(gb_runner_curve(quick),
                                              session->quick_cell.points, pressure_pa));
    case GB_PRESSURE_ROW_PREVIOUS:
        return of_cell(row->quick && gb_cost_quick(row->params, &small) ? &small
                                                                        : row->params,
                       of_previous(&session->previous[row->previous], pressure_pa));
    case GB_PRESSURE_ROW_REPLICAS:
        return of_replicas(&session->replica_band, pressure_pa);
    case GB_PRESSURE_ROW_MEASURED:
        return between(measured->pressure_pa, measured->density, measured->density_error,
                       measured->count, pressure_pa);
    }
    return none;
}

double gb_pressure_rows_limit(const struct gb_pressure_row *row,
                              struct gb_pressure_value value,
                              const struct gb_pressure_row *base,
                              struct gb_pressure_value base_value)
{
    return row->quick == base->quick
               ? verdict_deviations * hypot(value.error, base_value.error)
               : (double)NAN;
}

enum gb_pressure_verdict gb_pressure_rows_verdict(const struct gb_pressure_row *row,
                                                  struct gb_pressure_value value,
                                                  const struct gb_pressure_row *base,
                                                  struct gb_pressure_value base_value)
{
    const double limit = gb_pressure_rows_limit(row, value, base, base_value);
    const double difference = fabs(value.density - base_value.density);
    if (isnan(limit) || isnan(difference)) {
        return GB_PRESSURE_VERDICT_NONE;
    }
    return difference > limit ? GB_PRESSURE_VERDICT_BEYOND : GB_PRESSURE_VERDICT_WITHIN;
}

/* Has the run reached the pressure, or without a run any previous curve or quick cell? */
static bool reached(const struct gb_session *session, double pressure_pa)
{
    struct gb_pressure_rows rows;
    gb_pressure_rows_list(&rows, session, false);
    for (int i = 0; i < rows.count; i++) {
        const bool here =
            isfinite(gb_pressure_rows_at(session, &rows.row[i], pressure_pa).density);
        if (here || rows.row[i].kind == GB_PRESSURE_ROW_RUN) {
            return here;
        }
    }
    return false;
}

double gb_pressure_rows_usual(const struct gb_session *session, double typed_pa)
{
    static const double round_pa[] = {100e6, 50e6, 10e6, 1e6};
    if (typed_pa > 0.0) {
        return typed_pa;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(round_pa); i++) {
        if (reached(session, round_pa[i])) {
            return round_pa[i];
        }
    }
    return round_pa[0];
}

double gb_pressure_rows_misfit(const struct gb_session *session,
                               const struct gb_pressure_row *row)
{
    const struct gb_measured *measured = gb_session_measured(session);
    double squares = 0.0;
    int reached_points = 0;
    if (measured == NULL || row->kind == GB_PRESSURE_ROW_MEASURED) {
        return NAN;
    }
    for (size_t i = 0; i < measured->count; i++) {
        const double difference =
            gb_pressure_rows_at(session, row, measured->pressure_pa[i]).density -
            measured->density[i];
        if (isfinite(difference)) {
            squares += difference * difference;
            reached_points++;
        }
    }
    return reached_points > 0 ? sqrt(squares / reached_points) : (double)NAN;
}

char *gb_pressure_rows_write(struct gb_pressure_value value, char *text, size_t size)
{
    if (isnan(value.density)) {
        g_strlcpy(text, "-", size);
    } else {
        snprintf(text, size, "%.4f", value.density);
    }
    return text;
}

enum gb_pressure_verdict gb_pressure_rows_write_difference(
    const struct gb_pressure_row *row, struct gb_pressure_value value,
    const struct gb_pressure_row *base, struct gb_pressure_value base_value, char *text,
    size_t size)
{
    static const char sign[] = {[GB_PRESSURE_VERDICT_NONE] = ' ',
                                [GB_PRESSURE_VERDICT_WITHIN] = '~',
                                [GB_PRESSURE_VERDICT_BEYOND] = '!'};
    const double difference = value.density - base_value.density;
    const enum gb_pressure_verdict verdict =
        gb_pressure_rows_verdict(row, value, base, base_value);
    if (isfinite(difference)) {
        snprintf(text, size, "%+.4f%c", difference, sign[verdict]);
    } else {
        g_strlcpy(text, "", size);
    }
    return verdict;
}
