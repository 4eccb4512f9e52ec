#ifndef GB_IO_LAB_LAB_READER_H
#define GB_IO_LAB_LAB_READER_H

#include "base/table.h"
#include "io/lab/lab_options.h"

/* Measured compaction from a file as laboratories have it: an export of a spreadsheet or of
 * a testing machine.  The result is a table as gb_table_read gives it, with the columns
 * p_MPa and density (relative), density_error and p_MPa_error where the file has them,
 * `branch` or `series` (words), and columns of keys as particles.diameter_nm.
 *
 * A file in the format of this program (commas, decimal points, columns p_MPa or
 * pressure_MPa and density or density_percent) is read by gb_table_read, without a word,
 * unless options are given.  Of any other, what was not given is recognised and said in
 * one line; what can be read in two ways is a question. */
enum gb_lab_outcome {
    GB_LAB_READ,
    GB_LAB_QUESTION, /* the file can be read in several ways: report->question */
    GB_LAB_FAILED
};

enum { GB_LAB_READER_CHOICES = 4, GB_LAB_READER_CHOICE = 256 };

struct gb_lab_report {
    char told[GB_EVENT_TEXT - 40]; /* how the file was read; "": nothing was guessed */
    char question[400];            /* one line */
    /* answers, as gb_lab_options_parse takes them; '?' stands for what is missing */
    char choice[GB_LAB_READER_CHOICES][GB_LAB_READER_CHOICE];
    int choices;
};

/* also   names of columns of which two make a file one of this program as well, NULL at
 *        the end; NULL: none
 * Errors, one line with file and line of the file: GB_ERR_INPUT, GB_ERR_MACHINE,
 * GB_ERR_MEMORY.  *out is for gb_table_destroy. */
enum gb_lab_outcome gb_lab_reader_read(struct gb_table **out, const char *path,
                                       const struct gb_lab_options *options,
                                       const char *const *also,
                                       struct gb_lab_report *report,
                                       struct gb_error *err);

#endif
