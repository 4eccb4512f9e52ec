#ifndef GB_TUI_SESSION_RESULT_RESULT_FILLS_H
#define GB_TUI_SESSION_RESULT_RESULT_FILLS_H

#include "tui/session/result/result_card.h"

/* What the cards show, by file; as gb_result_kind.fill. */

/* result_calibration.c: values with intervals, correlations, what the data cannot tell. */
bool gb_result_calibration_fill(struct gb_result_card *card,
                                const struct gb_session *session);
/* result_replicas.c: mean densities with intervals, cells that failed. */
bool gb_result_replicas_fill(struct gb_result_card *card,
                             const struct gb_session *session);
/* result_moduli.c: averages and constants of the last state. */
bool gb_result_moduli_fill(struct gb_result_card *card, const struct gb_session *session);
/* result_chart.c: the recommended setting, its error and cost. */
bool gb_result_chart_fill(struct gb_result_card *card, const struct gb_session *session);
/* result_stability.c: the least margin of each method, with its pressure. */
bool gb_result_stability_fill(struct gb_result_card *card,
                              const struct gb_session *session);
/* result_files.c: size of the picture; pages and files of the report. */
bool gb_result_files_picture(struct gb_result_card *card,
                             const struct gb_session *session);
bool gb_result_files_report(struct gb_result_card *card,
                            const struct gb_session *session);
/* result_fit.c: parameters of the best equation with intervals, what it is compared
 * with. */
bool gb_result_fit_fill(struct gb_result_card *card, const struct gb_session *session);

#endif
