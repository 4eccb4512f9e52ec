#ifndef GB_TUI_APP_DIALOG_DIALOG_FORMS_H
#define GB_TUI_APP_DIALOG_DIALOG_FORMS_H

#include "tui/app/dialog/dialog.h"

/* The kinds of dialogs. */
extern const struct gb_dialog_form gb_dialog_forms_help;      /* the key table */
extern const struct gb_dialog_form gb_dialog_forms_densities; /* the table */
extern const struct gb_dialog_form gb_dialog_forms_curves;    /* run and previous ones */
extern const struct gb_dialog_form gb_dialog_forms_presets;   /* list with a preview */
extern const struct gb_dialog_form gb_dialog_forms_finder;    /* search of a parameter */
extern const struct gb_dialog_form gb_dialog_forms_legs;      /* legs of a loading path */
extern const struct gb_dialog_form gb_dialog_forms_prompt;    /* input line */
extern const struct gb_dialog_form gb_dialog_forms_picture;   /* rows of choices */
extern const struct gb_dialog_form gb_dialog_forms_command;   /* shell command */
extern const struct gb_dialog_form gb_dialog_forms_question;  /* y or n */
extern const struct gb_dialog_form gb_result_form_cards;      /* result_form.c: cards */
extern const struct gb_dialog_form gb_result_form_picture;    /* pixels */

#endif
