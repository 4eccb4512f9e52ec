#ifndef GB_TUI_PANEL_PROMPT_H
#define GB_TUI_PANEL_PROMPT_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "tui/term/paint.h"

/* An input line: a value, a name. */
enum { GB_PROMPT_MAX = GB_PARAMS_VALUE_MAX };

struct gb_prompt {
    uint32_t text[GB_PROMPT_MAX]; /* Unicode */
    int length, cursor;
    bool fresh; /* the first character typed replaces the text */
    char utf8[4 * GB_PROMPT_MAX + 1];
};

/* Sets the text; the cursor is at its end. */
void gb_prompt_set(struct gb_prompt *prompt, const char *text);

/* The same for an old value: the first typed character replaces it, other keys edit it.
 */
void gb_prompt_offer(struct gb_prompt *prompt, const char *text);

/* Handles a key or a character; false: not handled (Enter, Esc, Tab, ...). */
bool gb_prompt_handle(struct gb_prompt *prompt, const struct gb_term_event *event);

/* The text as UTF-8, valid until the next change. */
const char *gb_prompt_text(struct gb_prompt *prompt);

/* Draws the part around the cursor in `cols` cells. */
void gb_prompt_draw(const struct gb_prompt *prompt, const struct gb_paint *paint, int row,
                    int col, int cols);

/* Completes a path like a shell, to the longest common prefix of all matching names.  A
 * folder ends with a slash; "~/" is the home directory. *count (may be NULL) receives
 * the number of matches. g_free. */
char *gb_prompt_complete_path(const char *path, int *count);

/* Replaces "~/" at the beginning by the home directory; other paths are unchanged.
 * g_free. */
char *gb_prompt_complete_home(const char *path);

#endif
