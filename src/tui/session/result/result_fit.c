#include "tui/session/result/result_fills.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "tui/session/session.h"

/* Equations whose AICc differs by less are not told apart. Source: K. P. Burnham,
 * D. R. Anderson, Sociol. Methods Res. 33, 261 (2004). */
static const double delta_alike = 2.0;

enum { OTHERS = 2 };

static void add_parameters(struct gb_result_card *card,
                           const struct gb_compaction_fits *fits, size_t index)
{
    char number[GB_NUMBER_ERROR_MAX];
    for (size_t k = 0; k < gb_compaction_fits_values(fits, index); k++) {
        const struct gb_compaction_value value = gb_compaction_fits_value(fits, index, k);
        const char *unit = strcmp(value.unit, "1") != 0 ? value.unit : "";
        gb_number_error(value.value.value, value.value.error, 2, " +- ", number);
        gb_result_card_add(card, GB_RESULT_VALUE, "%s %s = %s%s%s, 95 %%: %.4g to %.4g",
                           fits->fit[index].equation->title, value.name, number,
                           *unit != '\0' ? " " : "", unit, value.value.low,
                           value.value.high);
    }
}

static void add_yield(struct gb_result_card *card, const struct gb_compaction_fits *fits)
{
    const struct gb_fit_value *yield = &fits->yield;
    char number[GB_NUMBER_ERROR_MAX];
    if (fits->heckel.equation != NULL) {
        gb_number_error(yield->value, yield->error, 2, " +- ", number);
        gb_result_card_add(card, GB_RESULT_VALUE,
                           "Heckel 1/K = %s MPa, 95 %%: %.4g to %.4g", number, yield->low,
                           yield->high);
    }
}

/* What the fit is worth beside the others. */
static void add_ranking(struct gb_result_card *card,
                        const struct gb_compaction_fits *fits)
{
    const struct gb_equation_fit *best = &fits->fit[0].all;
    gb_result_card_add(card, GB_RESULT_NOTE,
                       "RMS residual %.2g of relative density, %zu points", best->rms,
                       best->points);
    for (size_t i = 1; i < fits->fitted && i <= OTHERS; i++) {
        const bool alike = fits->fit[i].delta < delta_alike;
        gb_result_card_add(card, alike ? GB_RESULT_WARNING : GB_RESULT_NOTE,
                           "%s: AICc %.3g higher%s", fits->fit[i].equation->title,
                           fits->fit[i].delta,
                           alike ? ", the points do not tell them apart" : "");
    }
    if (best->correlation > 2.0) {
        gb_result_card_add(card, GB_RESULT_NOTE,
                           "residuals are correlated: %.0f points count as one",
                           best->correlation);
    }
}

bool gb_result_fit_fill(struct gb_result_card *card, const struct gb_session *session)
{
    const struct gb_compaction_cache *cache = &session->results.fits;
    const struct gb_compaction_fits *fits = &cache->fits;
    const struct gb_runner *runner = session->runner;
    if (!cache->fitted) {
        return false;
    }
    add_parameters(card, fits, 0);
    if (fits->fit[0].equation != fits->heckel.equation) {
        add_yield(card, fits);
    }
    add_ranking(card, fits);
    g_free(card->path);
    card->path = g_strdup(runner != NULL ? gb_runner_directory(runner) : NULL);
    return true;
}
