#include "tui/session/result/results.h"

#include <string.h>

#include "tui/session/result/result_fills.h"

static const struct gb_result_kind kinds[GB_RESULTS_KINDS] = {
    [GB_RESULTS_CALIBRATION] = {"calibration", "calibration", "use the values",
                                gb_result_calibration_fill},
    [GB_RESULTS_REPLICAS] = {"replicas", "replicas", NULL, gb_result_replicas_fill},
    [GB_RESULTS_MODULI] = {"moduli", "elastic moduli", NULL, gb_result_moduli_fill},
    [GB_RESULTS_CHART] = {"chart", "accuracy against cost", "use the setting",
                          gb_result_chart_fill},
    [GB_RESULTS_STABILITY] = {"stability", "stability of the methods", NULL,
                              gb_result_stability_fill},
    [GB_RESULTS_PICTURE] = {"picture", "picture", NULL, gb_result_files_picture},
    [GB_RESULTS_REPORT] = {"report", "report", NULL, gb_result_files_report},
    [GB_RESULTS_FIT] = {NULL, "equations of compaction", NULL, gb_result_fit_fill},
};

void gb_results_finish(struct gb_results *results)
{
    for (int k = 0; k < GB_RESULTS_KINDS; k++) {
        gb_result_card_finish(&results->card[k]);
    }
    gb_compaction_cache_finish(&results->fits);
    memset(results, 0, sizeof *results);
}

static void put_first(struct gb_results *results, enum gb_results_kind kind)
{
    int at = 0;
    while (at < results->count && results->recent[at] != kind) {
        at++;
    }
    results->count = MAX(results->count, at + 1);
    memmove(results->recent + 1, results->recent, (size_t)at * sizeof results->recent[0]);
    results->recent[0] = kind;
}

static bool make(struct gb_results *results, const struct gb_session *session,
                 enum gb_results_kind kind, const char *path)
{
    struct gb_result_card card;
    gb_result_card_init(&card, &kinds[kind], path);
    if (!kinds[kind].fill(&card, session)) {
        gb_result_card_finish(&card);
        return false;
    }
    gb_result_card_finish(&results->card[kind]);
    results->card[kind] = card;
    put_first(results, kind);
    return true;
}

bool gb_results_make(struct gb_results *results, const struct gb_session *session,
                     enum gb_results_kind kind)
{
    const char *path = results->card[kind].path;
    char *kept = g_strdup(path);
    const bool made = make(results, session, kind, kept);
    g_free(kept);
    return made;
}

void gb_results_take(struct gb_results *results, const struct gb_session *session,
                     const char *job, const char *path)
{
    for (int k = 0; k < GB_RESULTS_KINDS; k++) {
        if (g_strcmp0(kinds[k].job, job) == 0 &&
            make(results, session, (enum gb_results_kind)k, path)) {
            results->news = true;
        }
    }
}

bool gb_results_take_news(struct gb_results *results)
{
    const bool news = results->news;
    results->news = false;
    return news;
}

const struct gb_result_card *gb_results_at(const struct gb_results *results, int back)
{
    return back >= 0 && back < results->count ? &results->card[results->recent[back]]
                                              : NULL;
}
