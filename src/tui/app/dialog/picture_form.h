#ifndef GB_TUI_APP_DIALOG_PICTURE_FORM_H
#define GB_TUI_APP_DIALOG_PICTURE_FORM_H

#include "tui/panel/action.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* What a picture of the packing shows, in rows of choices, its width in print and a file; as
 * it opens it is the picture of `greenbody snapshot` without options. */
enum {
    GB_PICTURE_FORM_SHOW,
    GB_PICTURE_FORM_COLOUR,
    GB_PICTURE_FORM_CUT,
    GB_PICTURE_FORM_VIEW,
    GB_PICTURE_FORM_CHOICES,
    GB_PICTURE_FORM_WIDTH = GB_PICTURE_FORM_CHOICES,
    GB_PICTURE_FORM_FILE,
    GB_PICTURE_FORM_ROWS
};

struct gb_picture_form {
    int row;
    int choice[GB_PICTURE_FORM_CHOICES];
    struct gb_prompt width; /* as 8cm; empty: pixels of a screen */
    struct gb_prompt file;
};

void gb_picture_form_init(struct gb_picture_form *form, const char *path);

void gb_picture_form_draw(const struct gb_picture_form *form,
                          const struct gb_paint *paint);

/* Takes a key: up and down go to a row, left and right change its choice, the rows of the width
 * and the file take text.  False: another key, as Enter and Esc. */
bool gb_picture_form_handle(struct gb_picture_form *form,
                            const struct gb_term_event *event, enum gb_action action);

/* Options of the command: at most GB_PICTURE_FORM_WORDS, NULL behind the last; valid until
 * the form changes. */
enum { GB_PICTURE_FORM_WORDS = GB_PICTURE_FORM_CHOICES + 2 };
void gb_picture_form_words(struct gb_picture_form *form,
                           const char *words[GB_PICTURE_FORM_WORDS + 1]);

#endif
