#ifndef GB_TUI_APP_PRESET_BROWSER_H
#define GB_TUI_APP_PRESET_BROWSER_H

#include "io/preset.h"
#include "tui/app/keys.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* The list of presets: what is typed filters the names, beside it stands what the one
 * under the cursor is, where it comes from and what differs from the parameters on the
 * screen, or from another preset that Tab has marked. */
struct gb_preset_browser {
    char **names; /* all; owned */
    int *shown;   /* indices of those that fit the filter; owned */
    int count, focus, top, page;
    struct gb_prompt filter;
    struct gb_preset *preset; /* the one under the cursor, or NULL: cannot be read */
    char *head;               /* its comment lines, or why it cannot be read */
    struct gb_params base;    /* what it is compared with */
    char base_name[64];
};

/* current: the parameters on the screen. */
void gb_preset_browser_init(struct gb_preset_browser *browser,
                            const struct gb_params *current);
void gb_preset_browser_finish(struct gb_preset_browser *browser); /* zeroed is fine */

void gb_preset_browser_draw(struct gb_preset_browser *browser,
                            const struct gb_paint *inside);
/* Moves, filters, marks; false when the event is for somebody else (Enter, Esc). */
bool gb_preset_browser_handle(struct gb_preset_browser *browser,
                              const struct gb_term_event *event);

/* Name under the cursor; NULL when nothing fits the filter. */
const char *gb_preset_browser_selected(const struct gb_preset_browser *browser);

#endif
