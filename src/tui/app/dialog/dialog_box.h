#ifndef GB_TUI_APP_DIALOG_DIALOG_BOX_H
#define GB_TUI_APP_DIALOG_DIALOG_BOX_H

#include "tui/term/paint.h"

/* The frames of dialogs. */

/* A centred box with a border, at most as large as the screen. */
struct gb_paint gb_dialog_box(const struct gb_paint *screen, int rows, int cols,
                              const char *title);
/* What is inside of its border. */
struct gb_paint gb_dialog_box_inside(const struct gb_paint *paint);

#endif
