#ifndef GB_IO_STATUS_STAGE_TEXT_H
#define GB_IO_STATUS_STAGE_TEXT_H

#include <stddef.h>

#include "greenbody/stage.h"

/* Words for the stages of a run, for screens and status.json. */

/* "filling", "coming to rest", ...; "" without a stage.  Settling has one word under both
 * gravities. */
const char *gb_stage_text_name(enum gb_stage stage);
/* "particles poured", "kinetic energy over its limit", ...; "" without a measure. */
const char *gb_stage_text_quantity(enum gb_stage_measure measure);

/* The first stage of a word and the measure of a quantity; none for other words. */
enum gb_stage gb_stage_text_find(const char *name);
enum gb_stage_measure gb_stage_text_find_quantity(const char *quantity);

/* "812 of 1751", "35 x limit", "12.3 MPa of 50 MPa"; "" without a measure.  Returns text. */
char *gb_stage_text_value(const struct gb_stage_report *report, char *text, size_t size);
/* "filling: particles poured 812 of 1751", "pressing: 12.3 MPa of 50 MPa".  Returns text. */
char *gb_stage_text_line(const struct gb_stage_report *report, char *text, size_t size);

#endif
