#ifndef GB_IO_LAB_LAB_GRID_H
#define GB_IO_LAB_LAB_GRID_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A text cut into rows and cells (RFC 4180): cells in double quotes may hold separators,
 * line ends and doubled quotes; lines end with LF, CRLF or CR.  Blanks around cells and
 * empty cells at the end of a row are dropped, and empty rows. */
struct gb_lab_grid_row {
    size_t first, count; /* cells */
    int line;            /* of the file, from 1 */
    bool comment;        /* begins with '#', which is dropped */
};

struct gb_lab_grid_cell {
    const char *text;
    bool quoted;
};

struct gb_lab_grid {
    char *text;    /* owned */
    GArray *cells; /* struct gb_lab_grid_cell */
    GArray *rows;  /* struct gb_lab_grid_row */
};

/* separator   a character, or ' ' for runs of blanks and tabs
 * Errors: GB_ERR_INPUT (a quote that is not closed, too many columns), with the line. */
bool gb_lab_grid_init(struct gb_lab_grid *grid, const char *path, const char *text,
                      size_t length, char separator, struct gb_error *err);
void gb_lab_grid_finish(struct gb_lab_grid *grid); /* zeroed is fine */

size_t gb_lab_grid_rows(const struct gb_lab_grid *grid);
const struct gb_lab_grid_row *gb_lab_grid_row(const struct gb_lab_grid *grid, size_t row);

/* The cell of a column; one without text behind the end of the row. */
struct gb_lab_grid_cell gb_lab_grid_cell(const struct gb_lab_grid *grid, size_t row,
                                         size_t column);

#endif
