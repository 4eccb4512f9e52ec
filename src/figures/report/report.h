#ifndef GB_FIGURES_REPORT_REPORT_H
#define GB_FIGURES_REPORT_REPORT_H

#include "figures/report/page.h"
#include "many/runset.h"

/* What is handed in about some runs: a folder with figures, pictures, tables, presets and
 * where all comes from, and a page over it as HTML and Markdown. */
struct gb_report {
    const struct gb_runset *set;
    const char *folder; /* there already, ours alone */
    const char *data;   /* experimental points; NULL: none */
    struct gb_page page;
    GString *left_out; /* figures that could not be made, with the reason */
};

/* Fills the folder.  Errors: GB_ERR_MACHINE, GB_ERR_MEMORY; a figure for which the runs
 * have no data is left out and told in the page. */
bool gb_report_write(struct gb_report *report, struct gb_error *err);

#endif
