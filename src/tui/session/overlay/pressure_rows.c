#include "tui/session/overlay/pressure_rows.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "measure/cell_scatter.h"
#include "run/quick.h"

/* Standard deviations of a difference that chance is taken to exceed no more: 5 %. */
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

static void list_previous(struct gb_pressure_rows *rows, const struct gb_session *session)
{
    for (int i = session->previous_count - 1; i >= 0; i--) {
        const struct gb_previous_curve *previous = &session->previous[i];
        struct gb_pressure_row *row =
            add(rows, GB_PRESSURE_ROW_PREVIOUS, &previous->params);
        row->previous = i;
        row->quick = previous->quick;
        snprintf(row->brief, sizeof row->brief, "%c", previous->marker);
        snprintf(row->name, sizeof row->name, "%c %.60s", previous->marker,
                 previous->difference);
    }
}

void gb_pressure_rows_list(struct gb_pressure_rows *rows,
                           const struct gb_session *session, bool hide_previous)
{
    const struct gb_quick_cell *quick = &session->quick_cell;
    const struct gb_runset_view_group *group = gb_session_replicas(session);
    char text[64];
    rows->count = 0;
    if (session->runner != NULL) {
        name(add(rows, GB_PRESSURE_ROW_RUN, gb_runner_params(session->runner)), "run",
             "run");
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
    if (!hide_previous) {
        list_previous(rows, session);
    }
}

static struct gb_pressure_value of_cell(const struct gb_params *params, double density)
{
    return (struct gb_pressure_value){density, gb_cell_scatter(params)};
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

/* Points in any order: the nearest on either side of the pressure. */
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
    const struct gb_runset_view_group *group = gb_replica_band_group(band);
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
        return of_cell(row->quick && gb_quick_params(row->params, &small) ? &small
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

enum gb_pressure_verdict gb_pressure_rows_verdict(const struct gb_pressure_row *row,
                                                  struct gb_pressure_value value,
                                                  const struct gb_pressure_row *base,
                                                  struct gb_pressure_value base_value)
{
    const double error = hypot(value.error, base_value.error);
    const double difference = fabs(value.density - base_value.density);
    if (row->quick != base->quick || isnan(error) || isnan(difference)) {
        return GB_PRESSURE_VERDICT_NONE;
    }
    return difference > verdict_deviations * error ? GB_PRESSURE_VERDICT_BEYOND
                                                   : GB_PRESSURE_VERDICT_WITHIN;
}
