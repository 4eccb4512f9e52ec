#ifndef GB_TUI_APP_PRESET_BROWSER_H
#define GB_TUI_APP_PRESET_BROWSER_H

#include "io/preset.h"
#include "tui/app/keys.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* The list of presets, filtered by the text typed.  Beside it: description, source and
 * differences of the selected preset to the parameters on screen, or to a preset marked
 * with Tab. */
struct gb_preset_browser {
    char **names; /* all; owned */
    int *shown;   /* indices of the names that match the filter; owned */
    int count, focus, top, page;
    struct gb_prompt filter;
    struct gb_preset *preset; /* the selected one; NULL: not readable */
    char *head;               /* its comment lines, or the error of reading */
    struct gb_params base;    /* reference of the comparison */
    char base_name[64];
};

/* current: the parameters on screen. */
void gb_preset_browser_init(struct gb_preset_browser *browser,
                            const struct gb_params *current);
void gb_preset_browser_finish(struct gb_preset_browser *browser); /* zeroed is fine */

void gb_preset_browser_draw(struct gb_preset_browser *browser,
                            const struct gb_paint *inside);
/* Navigation, filter, mark; false: the event is not handled (Enter, Esc). */
bool gb_preset_browser_handle(struct gb_preset_browser *browser,
                              const struct gb_term_event *event);

/* Selected name; NULL when none matches the filter. */
const char *gb_preset_browser_selected(const struct gb_preset_browser *browser);

#endif
