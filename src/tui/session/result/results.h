#ifndef GB_TUI_SESSION_RESULT_RESULTS_H
#define GB_TUI_SESSION_RESULT_RESULTS_H

#include "tui/session/overlay/compaction_cache.h"
#include "tui/session/result/result_card.h"

/* The last result of each kind. */
enum gb_results_kind {
    GB_RESULTS_CALIBRATION,
    GB_RESULTS_REPLICAS,
    GB_RESULTS_MODULI,
    GB_RESULTS_CHART,
    GB_RESULTS_STABILITY,
    GB_RESULTS_PICTURE,
    GB_RESULTS_REPORT,
    GB_RESULTS_FIT,
    GB_RESULTS_KINDS
};

struct gb_results {
    struct gb_result_card card[GB_RESULTS_KINDS];
    enum gb_results_kind recent[GB_RESULTS_KINDS]; /* the newest first */
    int count;
    bool news;                       /* a job has ended since gb_results_take_news */
    struct gb_compaction_cache fits; /* of the card of fits */
};

void gb_results_finish(struct gb_results *results); /* zeroed is fine */

/* The result of a job that has ended well, by its name and the path of its result; a job
 * without a row leaves all as it is. */
void gb_results_take(struct gb_results *results, const struct gb_session *session,
                     const char *job, const char *path);
/* Makes the card of a kind from what the session shows; false: there is no result. */
bool gb_results_make(struct gb_results *results, const struct gb_session *session,
                     enum gb_results_kind kind);

/* Whether a job has ended since the last call. */
bool gb_results_take_news(struct gb_results *results);

/* The card that is `back` older than the newest; NULL: none. */
const struct gb_result_card *gb_results_at(const struct gb_results *results, int back);

#endif
