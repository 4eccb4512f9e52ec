#ifndef GB_STUDY_PAPERS_PAPERS_H
#define GB_STUDY_PAPERS_PAPERS_H

#include "study/papers/papers_comparisons.h"
#include "study/papers/papers_verdict.h"

/* All comparisons with the papers whose experiments are selected. */
struct gb_papers_result {
    const struct gb_papers_printed *printed;
    const struct gb_papers_comparison *comparison;
    struct gb_papers_here here;
    struct gb_papers_verdict verdict;
};

struct gb_papers_results {
    struct gb_papers_result *result;
    size_t count;
};

/* Every comparison of the runs of a plan that are done, in the order of the table.
 * gb_papers_finish is due in any case.  Errors: a comparison whose number is not printed
 * (GB_ERR_INPUT), those of gb_papers_sample_read. */
bool gb_papers_evaluate(struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers,
                        const struct gb_papers_plan *plan, struct gb_error *err);
void gb_papers_finish(struct gb_papers_results *results); /* zeroed is fine */

/* Is an experiment of the comparison among the selected ones?  Laws belong to every
 * selection with an experiment of their paper. */
bool gb_papers_selected(const struct gb_papers_comparison *comparison,
                        const struct gb_papers_plan *plan);

/* Is an experiment of the paper that an id, "P1-...", belongs to? */
bool gb_papers_selected_paper(const char *id, const struct gb_papers_plan *plan);

#endif
