#ifndef GB_STUDY_PAPERS_PAPERS_PAGE_H
#define GB_STUDY_PAPERS_PAPERS_PAGE_H

#include <glib.h>

#include "study/papers/papers.h"

/* A figure of the page. */
struct gb_papers_figure {
    const char *file;  /* beside the page; NULL: could not be drawn */
    const char *title; /* Markdown */
    char *command;     /* that draws it alone; owned */
    char *why;         /* it could not be drawn; owned */
};

/* papers.md: a table per paper with every comparison, numbers without one, figures, and how
 * it was computed.  Depends on the results alone.  Caller frees. */
GString *gb_papers_page_text(const struct gb_papers_results *results,
                             const struct gb_papers_numbers *numbers,
                             const struct gb_papers_plan *plan,
                             const struct gb_papers_figure *figures, size_t count,
                             const char *command);

/* papers.csv: a row per comparison.  Caller frees. */
GString *gb_papers_page_table(const struct gb_papers_results *results);

#endif
