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
    /* Loads a preset, or the parameters `current` with a material. */
    bool (*load)(struct gb_preset **out, const char *name,
                 const struct gb_params *current, struct gb_error *err);
    const char *(*title)(const struct gb_params *params);
    /* Writes the line under the title for the preset read from path. */
    void (*describe)(struct gb_preset *preset, const char *path, char *text, size_t size);
    const char *empty; /* text for an empty list */
};

/* The list of presets, filtered by the typed text.  Next to it are description, source
 * and differences of the selected preset from the parameters on screen, or from a
 * preset marked with Tab. */
struct gb_preset_browser {
    const struct gb_preset_browser_kind *kind;
    char **names; /* all; owned */
    struct gb_list_box list;
    struct gb_preset *preset; /* the selected one; NULL: not readable */
    char *head;               /* its comment lines, or the error of reading */
    char told[256];           /* text of gb_preset_browser_kind.describe */
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
/* Handles navigation, filter and mark; false: another event (Enter, Esc). */
bool gb_preset_browser_handle(struct gb_preset_browser *browser,
                              const struct gb_term_event *event);

/* Selected name; NULL when none matches the filter. */
const char *gb_preset_browser_selected(const struct gb_preset_browser *browser);

/* Presets; materials (the parameters on screen with another [material]). */
extern const struct gb_preset_browser_kind gb_preset_browser_kinds_presets,
    gb_preset_browser_kinds_materials;

#endif
