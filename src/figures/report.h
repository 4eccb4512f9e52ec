#ifndef GB_FIGURES_REPORT_REPORT_H
#define GB_FIGURES_REPORT_REPORT_H

#include "base/table.h"
#include "figures/page.h"
#include "many/runset.h"

/* Report of some runs: a folder with figures, tables, pictures and presets, and a page over
 * them as HTML and Markdown. */
struct gb_report {
    const struct gb_runset *set;
    const char *folder;
    const struct gb_table *data; /* measured points; NULL: none */
    struct gb_page page;
    char *conditions;    /* of the captions */
    int figures, tables; /* numbered so far */
    GPtrArray *cited;    /* papers, in the order of their citation */
    GString *sums;       /* lines of SHA256SUMS */
};

/* A part of the report: a heading and a function that fills it.  A part is a
 * function and a row in report.c. */
typedef bool gb_report_part_function(struct gb_report *report, struct gb_error *err);

struct gb_report_part {
    const char *name;
    const char *heading;
    const char *doc;
    gb_report_part_function *write;
};

/* In their order; the last row has no name. */
const struct gb_report_part *gb_report_parts(void);

/* Creates the folder `output` with the report; no folder remains after an error.  What the
 * runs have no data for is left out.  The file of the measured points is copied.  Errors: GB_ERR_INPUT when the
 * folder exists, GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_report_write(const struct gb_runset *set, const struct gb_table *data,
                     const char *output, struct gb_error *err);

#endif
