#ifndef GB_TUI_APP_DIALOG_FORMS_H
#define GB_TUI_APP_DIALOG_FORMS_H

#include "tui/app/dialog.h"

/* The families of dialogs. */
extern const struct gb_dialog_form gb_dialog_forms_help;     /* the key table */
extern const struct gb_dialog_form gb_dialog_forms_presets;  /* list with a preview */
extern const struct gb_dialog_form gb_dialog_forms_prompt;   /* one line to type */
extern const struct gb_dialog_form gb_dialog_forms_command;  /* text to copy */
extern const struct gb_dialog_form gb_dialog_forms_question; /* y or n */

#endif
