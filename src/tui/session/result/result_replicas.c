#include "tui/session/result/result_fills.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/number.h"
#include "base/units.h"
#include "tui/session/session.h"

/* Those of the table of densities, and the last one reached. */
static const double wanted_pa[] = {10e6, 50e6, 100e6, 500e6};

static void add_density(struct gb_result_card *card,
                        const struct gb_runset_view_group *group, size_t level,
                        double pressure_pa)
{
    const size_t cells = group->reached[level];
    const double mean = group->mean[level];
    const double error = group->error[level];
    char pressure[32];
    char number[GB_NUMBER_ERROR_MAX];
    gb_units_format_short(pressure_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    if (cells < 2 || !isfinite(error)) {
        gb_result_card_add(card, GB_RESULT_VALUE,
                           "density at %s: %.4f, one cell, no interval", pressure, mean);
        return;
    }
    const double half = error * gsl_cdf_tdist_Pinv(0.975, (double)cells - 1.0);
    gb_number_error(mean, error, 2, " +- ", number);
    gb_result_card_add(card, GB_RESULT_VALUE,
                       "density at %s: %s, 95 %%: %.4f to %.4f (%zu cells)", pressure,
                       number, mean - half, mean + half, cells);
}

static bool is_level(const struct gb_runset_view *runset, size_t level,
                     double pressure_pa)
{
    return fabs(runset->level_pa[level] / pressure_pa - 1.0) < 1e-6;
}

/* What --until-se asked for. */
static void add_target(struct gb_result_card *card, const struct gb_replica_band *band,
                       const struct gb_runset_view_group *group)
{
    const size_t level = gb_runset_view_nearest(&band->runset, band->target_pa);
    const double error = group->error[level];
    char pressure[32];
    if (!(band->target > 0.0) || !(error > band->target)) {
        return;
    }
    gb_units_format_short(band->target_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    gb_result_card_add(card, GB_RESULT_WARNING,
                       "standard error %.2g at %s is above %.2g: more cells reduce it",
                       error, pressure, band->target);
}

static void add_missing(struct gb_result_card *card, const struct gb_runset_view *runset)
{
    if (runset->done < runset->runs) {
        gb_result_card_add(card, GB_RESULT_WARNING,
                           "%zu of %zu cells did not end: the others alone count",
                           runset->runs - runset->done, runset->runs);
    }
}

bool gb_result_replicas_fill(struct gb_result_card *card,
                             const struct gb_session *session)
{
    const struct gb_replica_band *band = &session->replica_band;
    const struct gb_runset_view *runset = &band->runset;
    const struct gb_runset_view_group *group = gb_replica_band_group(band);
    if (group == NULL || g_strcmp0(band->directory, card->path) != 0) {
        return false;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(wanted_pa); k++) {
        const size_t level = gb_runset_view_nearest(runset, wanted_pa[k]);
        if (is_level(runset, level, wanted_pa[k]) && group->reached[level] > 0) {
            add_density(card, group, level, wanted_pa[k]);
        }
    }
    size_t last = runset->levels;
    while (last > 0 && group->reached[last - 1] < group->members) {
        last--;
    }
    if (card->lines->len == 0 && last > 0) {
        add_density(card, group, last - 1, runset->level_pa[last - 1]);
    }
    add_target(card, band, group);
    add_missing(card, runset);
    return card->lines->len > 0;
}
