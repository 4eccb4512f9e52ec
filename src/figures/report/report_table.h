#ifndef GB_FIGURES_REPORT_REPORT_TABLE_H
#define GB_FIGURES_REPORT_REPORT_TABLE_H

#include "figures/report/report.h"

/* A table of the page and of a CSV file. */
enum { GB_REPORT_TABLE_COLUMNS = 12 };

struct gb_report_table {
    const char *heads[GB_REPORT_TABLE_COLUMNS];
    guint columns;
    int markup;       /* column of cells with <i>, <sub>, <sup>; -1: none */
    GPtrArray *cells; /* row by row */
};

/* heads: NULL at the end, not copied. */
void gb_report_table_begin(struct gb_report_table *table, const char *const *heads);
/* Appends a cell. */
void gb_report_table_put(struct gb_report_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* "mean ± error"; without error when it is NaN, empty when the mean is. */
void gb_report_table_put_mean(struct gb_report_table *table, double mean, double error,
                              int decimals);
/* Adds it to the page, with the next number before its caption, and to tables/NAME.csv;
 * a table without cells is in neither.  Frees it. */
bool gb_report_table_end(struct gb_report *report, struct gb_report_table *table,
                         const char *name, const char *caption, struct gb_error *err);

/* Differences of a group to the others, or its title where there are none or they are long.
 * g_free. */
char *gb_report_table_scene(const struct gb_runset *set, size_t group);

#endif
