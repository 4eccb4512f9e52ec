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
        "%s%s: %s to %.2f times its step (%.4g MPa)", row->method,
        row->in_use ? ", in use" : "", row->stable ? "stable" : "only stable",
        table->margin[i], table->p_mpa[i]);
}

bool gb_result_stability_fill(struct gb_result_card *card,
                              const struct gb_session *session)
{
    const struct gb_stability_csv *table = session->stability;
    if (table == NULL || table->count == 0 ||
        g_strcmp0(session->chart_job.directory, card->path) != 0) {
        return false;
    }
    for (size_t i = 0; i < table->count; i++) {
        if (is_least(table, i)) {
            add_method(card, table, i);
        }
    }
    const size_t weakest = gb_stability_csv_weakest(table);
    if (!table->in_time && weakest < table->count && !table->row[weakest].stable) {
        gb_result_card_add(card, GB_RESULT_NOTE,
                           "it shortens its step there, and takes more evaluations");
    }
    gb_result_card_add(card, GB_RESULT_NOTE, "by pressure in view T; Enter applies there");
    return true;
}
