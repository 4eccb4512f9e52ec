#ifndef GB_TUI_APP_DIALOGS_H
#define GB_TUI_APP_DIALOGS_H

#include "tui/app/dialog.h"

/* The dialogs of the workbench. */
extern const struct gb_dialog_type gb_dialogs_help, gb_dialogs_open, gb_dialogs_material,
    gb_dialogs_save, gb_dialogs_data, gb_dialogs_reading, gb_dialogs_what_if,
    gb_dialogs_find, gb_dialogs_densities, gb_dialogs_curves, gb_dialogs_ranges,
    gb_dialogs_pressure, gb_dialogs_replicas, gb_dialogs_calibrate, gb_dialogs_picture,
    gb_dialogs_shell, gb_dialogs_legs, gb_dialogs_quit, gb_dialogs_cost,
    gb_dialogs_results, gb_dialogs_pixels, gb_dialogs_chart, gb_dialogs_stability;

#endif
