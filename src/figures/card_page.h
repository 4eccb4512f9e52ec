#ifndef GB_FIGURES_CARD_PAGE_H
#define GB_FIGURES_CARD_PAGE_H

#include "study/card.h"

/* The folder of a card: card.csv, card_points.csv, card_uniaxial.csv, card.inp, the figures
 * surfaces.png and uniaxial.png with their data, and the page over them as HTML and
 * Markdown.
 *
 * command  the command line, for the head of every file
 * No folder remains after an error.  Errors: GB_ERR_INPUT when the folder exists,
 * GB_ERR_MACHINE, GB_ERR_MEMORY. */
bool gb_card_page_write(const struct gb_card_study *study, const struct gb_params *preset,
                        const char *command, const char *output, struct gb_error *err);
/* The check of the target before the work. */
bool gb_card_page_check(const char *output, struct gb_error *err);

#endif
