#ifndef GB_TUI_APP_PRESET_BROWSER_H
#define GB_TUI_APP_PRESET_BROWSER_H

#include "io/preset.h"
#include "tui/app/keys.h"
#include "tui/panel/list_box.h"
#include "tui/term/paint.h"

/* What a browser lists. */
struct gb_preset_browser_kind {
    char **(*list)(void);            /* names, sorted; g_strfreev */
    char *(*find)(const char *name); /* path of one; g_free */
    /* The parameters that it stands for, where `current` are on screen. */
    bool (*load)(struct gb_preset **out, const char *name,
                 const struct gb_params *current, struct gb_error *err);
    const char *(*title)(const struct gb_params *params);
    /* The line under the title, of the preset read from path. */
    void (*describe)(struct gb_preset *preset, const char *path, char *text, size_t size);
    const char *empty; /* instead of an empty list */
};

/* The list of presets, filtered by the text typed.  Beside it: description, source and
 * differences of the selected preset to the parameters on screen, or to a preset marked
 * with Tab. */
struct gb_preset_browser {
    const struct gb_preset_browser_kind *kind;
    char **names; /* all; owned */
    struct gb_list_box list;
    struct gb_preset *preset; /* the selected one; NULL: not readable */
    char *head;               /* its comment lines, or the error of reading */
    char told[256];           /* what its kind says of it */
    struct gb_params current; /* on screen */
    struct gb_params base;    /* reference of the comparison */
    char base_name[64];
};

/* current: the parameters on screen. */
void gb_preset_browser_init(struct gb_preset_browser *browser,
                            const struct gb_preset_browser_kind *kind,
                            const struct gb_params *current);
void gb_preset_browser_finish(struct gb_preset_browser *browser); /* zeroed is fine */

void gb_preset_browser_draw(struct gb_preset_browser *browser,
                            const struct gb_paint *inside);
/* Navigation, filter, mark; false: the event is not handled (Enter, Esc). */
bool gb_preset_browser_handle(struct gb_preset_browser *browser,
                              const struct gb_term_event *event);

/* Selected name; NULL when none matches the filter. */
const char *gb_preset_browser_selected(const struct gb_preset_browser *browser);

/* Presets, and materials: the parameters on screen with another [material]. */
extern const struct gb_preset_browser_kind gb_preset_browser_kinds_presets,
    gb_preset_browser_kinds_materials;

#endif
