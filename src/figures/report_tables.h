#ifndef GB_FIGURES_REPORT_REPORT_TABLES_H
#define GB_FIGURES_REPORT_REPORT_TABLES_H

#include "figures/report.h"
#include "many/runset.h"

/* A table of the page and of a CSV file. */
enum { GB_REPORT_TABLE_COLUMNS = 12 };

struct gb_report_table {
    const char *heads[GB_REPORT_TABLE_COLUMNS];
    guint columns;
    int markup;       /* column of cells with <i>, <sub>, <sup>; -1: none */
    GPtrArray *cells; /* row by row */
};

/* heads: NULL at the end, not copied. */
void gb_report_tables_begin(struct gb_report_table *table, const char *const *heads);

/* Appends a cell. */
void gb_report_tables_put(struct gb_report_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Adds it to the page, with the next number before its caption, and to tables/NAME.csv;
 * a table without cells is in neither.  Frees it. */
bool gb_report_tables_end(struct gb_report *report, struct gb_report_table *table,
                          const char *name, const char *caption, struct gb_error *err);

/* "Conditions: alumina; ...", of all groups, for a caption: a condition in which more than
 * three groups differ refers to the table.  g_free. */
char *gb_report_tables_conditions(const struct gb_runset *set);

/* Cites the papers whose tags stand in a source. */
void gb_report_tables_cite(struct gb_report *report, const char *source);

/* Parts of the report. */
gb_report_part_function gb_report_tables_results;
gb_report_part_function gb_report_tables_densities;
gb_report_part_function gb_report_tables_fits;
gb_report_part_function gb_report_tables_keys;
gb_report_part_function gb_report_tables_references;

#endif
