#ifndef GB_FIGURES_REPORT_REPORT_REFERENCES_H
#define GB_FIGURES_REPORT_REPORT_REFERENCES_H

#include "figures/report/report.h"

/* Papers in full: authors, title, journal, year.  A paper is known by its tag, as sources of
 * keys and figures have it ("P1 (3), V"), or by the name of a normal law or of an equation of
 * compaction. */

/* Cites the papers whose tags stand in a source. */
void gb_report_references_cite(struct gb_report *report, const char *source);
/* Cites the paper of a normal law or of an equation; fallback: its text where the table has
 * none, NULL: not cited then. */
void gb_report_references_cite_name(struct gb_report *report, const char *name,
                                    const char *fallback);

#endif
