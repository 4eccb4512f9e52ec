#ifndef GB_TUI_APP_PRESET_BROWSER_KINDS_H
#define GB_TUI_APP_PRESET_BROWSER_KINDS_H

#include "tui/app/preset_browser.h"

/* Presets, and materials: the parameters on screen with another [material]. */
extern const struct gb_preset_browser_kind gb_preset_browser_kinds_presets,
    gb_preset_browser_kinds_materials;

#endif
