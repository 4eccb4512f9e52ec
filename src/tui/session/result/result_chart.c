#include "tui/session/result/result_fills.h"

#include <math.h>

#include "tui/session/session.h"

enum { DESCRIPTION = 160 };

/* The fields that the setting changes. */
static void offer_changes(struct gb_result_card *card, const struct gb_session *session)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    const struct gb_params *own = gb_preset_params(session->preset);
    struct gb_params *changed = g_memdup2(own, sizeof *own);
    gb_chart_csv_apply(session->chart, session->chart->chosen, changed);
    for (size_t i = 0; i < count; i++) {
        if (!gb_params_diff_same(own, changed, &field[i])) {
            gb_result_card_offer(card, &field[i], changed);
        }
    }
    g_free(changed);
}

static void add_chosen(struct gb_result_card *card, const struct gb_chart_csv *chart)
{
    char text[DESCRIPTION];
    const size_t i = chart->chosen;
    gb_result_card_add(card, GB_RESULT_VALUE, "cheapest within the scatter: %s",
                       gb_chart_describe(&chart->setting[i], text, sizeof text));
    gb_result_card_add(card, GB_RESULT_VALUE, "error of density below %.2g, %.3g CPU s",
                       chart->error[i], chart->seconds[i]);
    if (isfinite(chart->reference_s) && chart->seconds[i] > 0.0) {
        gb_result_card_add(card, GB_RESULT_NOTE, "the reference takes %.3g times as long",
                           chart->reference_s / chart->seconds[i]);
    }
    if (chart->noise[i]) {
        gb_result_card_add(card, GB_RESULT_WARNING,
                           "its error is within the noise: more cells tell more");
    }
}

bool gb_result_chart_fill(struct gb_result_card *card, const struct gb_session *session)
{
    const struct gb_chart_csv *chart = session->chart;
    if (chart == NULL || g_strcmp0(session->chart_job.directory, card->path) != 0) {
        return false;
    }
    if (chart->chosen < chart->count) {
        add_chosen(card, chart);
        offer_changes(card, session);
    } else {
        gb_result_card_add(card, GB_RESULT_WARNING,
                           "no setting is known to have an error below the scatter: "
                           "more cells or CPU time tell more");
    }
    gb_result_card_add(card, GB_RESULT_NOTE, "%zu of %zu settings measured, view 0",
                       chart->known + (isfinite(chart->reference_s) ? 1U : 0U), chart->count);
    return true;
}
