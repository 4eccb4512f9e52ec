#ifndef GB_TUI_APP_DIALOG_H
#define GB_TUI_APP_DIALOG_H

#include "tui/app/keys.h"
#include "tui/app/preset_browser.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* What lies over the panes: help, the list of presets, a line to type (the name to save
 * under, the file of an experiment, a what-if), the command that repeats what is shown,
 * the questions before quitting and before a run that takes long.  One at a time. */
enum gb_dialog_kind {
    GB_DIALOG_NONE,
    GB_DIALOG_HELP,
    GB_DIALOG_OPEN,
    GB_DIALOG_SAVE,
    GB_DIALOG_DATA,
    GB_DIALOG_FORK,
    GB_DIALOG_FIND,
    GB_DIALOG_CELLS,
    GB_DIALOG_FIT,
    GB_DIALOG_COMMAND,
    GB_DIALOG_QUIT,
    GB_DIALOG_COSTLY
};

struct gb_dialog {
    enum gb_dialog_kind kind;
    int top, focus, page;
    struct gb_preset_browser browser;
    char *text;     /* the command shown; owned */
    char note[400]; /* why the last answer was not taken; the question of a costly run */
    bool warned;    /* the note was a warning: the same answer again is taken */
    struct gb_prompt prompt;
};

/* text: what a prompt begins with, the question of a costly run, the command; NULL is
 * fine. */
void gb_dialog_show(struct gb_dialog *dialog, enum gb_dialog_kind kind, const char *text);
/* The list of presets; current: the parameters they are compared with. */
void gb_dialog_browse(struct gb_dialog *dialog, const struct gb_params *current);
void gb_dialog_close(struct gb_dialog *dialog);

void gb_dialog_draw(struct gb_dialog *dialog, const struct gb_paint *screen);

/* Takes an event; true when the answer is given and waits in gb_dialog_answer.  Esc
 * closes the dialog, n a question. */
bool gb_dialog_type(struct gb_dialog *dialog, const struct gb_term_event *event);

/* The preset chosen, the line typed; "" for yes. */
const char *gb_dialog_answer(struct gb_dialog *dialog);

#endif
