#ifndef GB_IO_LAB_LAB_PRIVATE_H
#define GB_IO_LAB_LAB_PRIVATE_H

#include "io/lab/lab_grid.h"
#include "io/lab/lab_number.h"
#include "io/lab/lab_reader.h"
#include "io/lab/lab_text.h"

/* A file while it is read: the steps are lab_layout (separator, head), lab_columns (which
 * column is what), lab_decimal, lab_rows (numbers), lab_needs (what they need), lab_press
 * (pressure and density), lab_branch (unloading), lab_reader (all of them, and the line that says it). */
enum { GB_LAB_NONE = -1, GB_LAB_REASONS = 8 };

/* Rows that were left out for one reason. */
struct gb_lab_reason {
    const char *text;
    size_t rows;
    int line; /* of the first */
};

struct gb_lab_column {
    int index; /* from 0; GB_LAB_NONE: the file has none */
    const struct gb_lab_unit *unit;
    bool guessed;   /* not given by an option */
    bool unit_said; /* the unit was taken for granted or read from the cells */
    bool percent;   /* percent signs in the cells, which name the unit */
    bool plain;     /* cells without one */
};

struct gb_lab_reading {
    const char *path;
    struct gb_lab_options *options; /* a copy: keys are added to it */
    struct gb_lab_report *report;
    struct gb_error *err;
    struct gb_lab_text text;
    struct gb_lab_grid grid;
    char separator;
    bool separator_guessed;
    size_t first;                   /* row of the first data */
    size_t columns;                 /* of the data */
    int names;                      /* row of the heads; GB_LAB_NONE */
    int units;                      /* row of units below them; GB_LAB_NONE */
    struct gb_lab_heading *heading; /* columns */
    struct gb_lab_column column[GB_LAB_ROLES];
    struct gb_lab_column key[GB_LAB_OPTIONS_KEYS];
    char decimal; /* 0: no number needs one */
    bool decimal_guessed;
    /* rows of numbers */
    size_t count;
    int *line;
    const char **word;           /* of branch or series; NULL: none */
    double *value[GB_LAB_ROLES]; /* as in the cells */
    double *key_value[GB_LAB_OPTIONS_KEYS];
    double *pressure, *density; /* MPa; relative */
    struct gb_lab_reason reason[GB_LAB_REASONS];
    int reasons;
    GString *said; /* further guesses */
};

/* Text of the head of a column; "" without one. */
const char *gb_lab_layout_head(const struct gb_lab_reading *reading, size_t column);
/* "column 2 'Druck'" into a buffer. */
enum { GB_LAB_LAYOUT_COLUMN = GB_LAB_TEXT_SHOWN + 24 };
const char *gb_lab_layout_column(const struct gb_lab_reading *reading, int column,
                                 char buffer[GB_LAB_LAYOUT_COLUMN]);
/* All of them, by their heads or their first cells: "1 'Zeit', 2 'Druck', ..."; g_free. */
char *gb_lab_layout_list(const struct gb_lab_reading *reading);

/* The separator that was given, that of a first line "sep=;", which *text then passes, or
 * the one that makes a table of the text. */
enum gb_lab_outcome gb_lab_separator_find(struct gb_lab_reading *reading,
                                          const char **text);
/* The first row of the data: one of two numbers or more before another one or at the end;
 * without such a pair the first of all.  False: there is none. */
bool gb_lab_separator_first(const struct gb_lab_grid *grid, size_t *first);

/* Cuts the text into cells and finds the table in it. */
enum gb_lab_outcome gb_lab_layout_find(struct gb_lab_reading *reading);

/* Fills `column` by the options and the heads. */
enum gb_lab_outcome gb_lab_columns_assign(struct gb_lab_reading *reading);

/* Fills `decimal` by the cells that are to be read. */
enum gb_lab_outcome gb_lab_decimal_find(struct gb_lab_reading *reading);

/* Fills count, line, word, value and key_value. */
enum gb_lab_outcome gb_lab_rows_read(struct gb_lab_reading *reading);
void gb_lab_rows_leave_out(struct gb_lab_reading *reading, const char *reason, int line);
/* Keeps the rows that are marked; the others have been noted by gb_lab_rows_leave_out. */
void gb_lab_rows_keep(struct gb_lab_reading *reading, const bool *kept);

/* Puts the words of branches and series in order. */
void gb_lab_words_settle(struct gb_lab_reading *reading);

/* Units of densities, and the numbers that force, travel and mass densities need. */
enum gb_lab_outcome gb_lab_needs_check(struct gb_lab_reading *reading);

/* Fills pressure and density, and drops rows without pressure. */
enum gb_lab_outcome gb_lab_press_convert(struct gb_lab_reading *reading);

/* Drops the rows of unloading, unless a column tells the branches. */
void gb_lab_branch_drop(struct gb_lab_reading *reading);

/* Fills report->told; empty where nothing was guessed and no row left out. */
void gb_lab_told_write(struct gb_lab_reading *reading);

/* --- questions (lab_question.c) --- */

enum gb_lab_outcome gb_lab_question_ask(struct gb_lab_reading *reading,
                                        const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Adds an answer: what was given, the columns that were found, and the items of `more`. */
void gb_lab_question_choice(struct gb_lab_reading *reading, const char *more);
enum gb_lab_outcome gb_lab_question_fail(struct gb_lab_reading *reading,
                                         const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
