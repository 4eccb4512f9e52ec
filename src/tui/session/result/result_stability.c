#include "tui/session/result/result_fills.h"

#include <string.h>

#include "tui/session/session.h"

/* Whether row i has the least margin of its method. */
static bool is_least(const struct gb_stability_csv *table, size_t i)
{
    for (size_t k = 0; k < table->count; k++) {
        const bool same = strcmp(table->row[k].method, table->row[i].method) == 0;
        if (same && (table->margin[k] < table->margin[i] ||
                     (table->margin[k] <= table->margin[i] && k < i))) {
            return false;
        }
    }
    return true;
}

static void add_method(struct gb_result_card *card, const struct gb_stability_csv *table,
                       size_t i)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    gb_result_card_add(
        card, row->in_use && !row->stable ? GB_RESULT_WARNING : GB_RESULT_VALUE,
        "%s%s: %s to %.2f times its step (%.3g MPa)", row->method,
        row->in_use ? ", in use" : "", row->stable ? "stable" : "only stable",
        table->margin[i], table->p_mpa[i]);
}

/* What replaces a method that is not stable: the time step, or the relaxer with most
 * margin. */
static void offer(struct gb_result_card *card, const struct gb_session *session,
                  size_t best)
{
    const struct gb_stability_csv *table = session->stability;
    const size_t weakest = gb_stability_csv_weakest(table);
    const struct gb_params *own = gb_preset_params(session->preset);
    struct gb_params *changed = g_memdup2(own, sizeof *own);
    struct gb_error err = {0};
    char text[64];
    if (weakest < table->count && !table->row[weakest].stable &&
        gb_stability_csv_apply(table, best, changed, text, sizeof text, &err)) {
        gb_result_card_add(card, GB_RESULT_NOTE, "stable: %s", text);
        gb_result_card_offer_changes(card, own, changed);
    }
    g_free(changed);
}

bool gb_result_stability_fill(struct gb_result_card *card,
                              const struct gb_session *session)
{
    const struct gb_stability_csv *table = session->stability;
    size_t best = 0;
    bool some = false;
    if (table == NULL || table->count == 0 ||
        g_strcmp0(session->chart_job.directory, card->path) != 0) {
        return false;
    }
    for (size_t i = 0; i < table->count; i++) {
        if (is_least(table, i)) {
            add_method(card, table, i);
            best = !some || table->margin[i] > table->margin[best] ? i : best;
            some = true;
        }
    }
    offer(card, session, best);
    gb_result_card_add(card, GB_RESULT_NOTE, "by pressure in view T; Enter applies there");
    return true;
}
