#include "tui/app/dialogs.h"

#include "tui/app/dialog.h"
#include "tui/app/key_commands.h"

/* One row per dialog.  Accept functions are in the file of the command that opens it. */

const struct gb_dialog_type gb_dialogs_help = {
    .form = &gb_dialog_forms_help,
    .title = "Keys and glossary (type to filter, Esc closes)",
    .opened_by = gb_pane_commands_help,
};

const struct gb_dialog_type gb_dialogs_open = {
    .form = &gb_dialog_forms_presets,
    .title = "Open a preset (Enter opens, Tab compares, Esc)",
    .opened_by = gb_file_commands_open,
    .accept = gb_file_commands_accept_open,
};

const struct gb_dialog_type gb_dialogs_material = {
    .form = &gb_dialog_forms_presets,
    .title = "Choose a material (Enter sets it, Tab compares, Esc)",
    .opened_by = gb_file_commands_material,
    .accept = gb_file_commands_accept_material,
};

const struct gb_dialog_type gb_dialogs_save = {
    .form = &gb_dialog_forms_prompt,
    .title = "Save the parameters as a preset (Esc cancels)",
    .label = "Name, or a path with a slash:",
    .opened_by = gb_file_commands_save,
    .accept = gb_file_commands_accept_save,
};

const struct gb_dialog_type gb_dialogs_data = {
    .form = &gb_dialog_forms_prompt,
    .title = "Measured data over the plot (Esc cancels)",
    .label = "CSV file (Tab completes; empty removes it):",
    .completes_path = true,
    .opened_by = gb_file_commands_data,
    .accept = gb_file_commands_accept_data,
};

const struct gb_dialog_type gb_dialogs_reading = {
    .form = &gb_dialog_forms_prompt,
    .title = "How is this file read? (Esc cancels)",
    .label = "quantity=column:unit,... and what is asked below:",
    .opened_by = gb_file_commands_data,
    .accept = gb_file_commands_accept_reading,
};

const struct gb_dialog_type gb_dialogs_what_if = {
    .form = &gb_dialog_forms_prompt,
    .title = "What-if: continue with other values (Esc cancels)",
    .label = "key=value; ... (legs of a path: leg then leg):",
    .opened_by = gb_file_commands_what_if,
    .accept = gb_file_commands_accept_what_if,
};

const struct gb_dialog_type gb_dialogs_find = {
    .form = &gb_dialog_forms_finder,
    .title = "Find a parameter (Enter goes there, Esc)",
    .opened_by = gb_pane_commands_find,
    .accept = gb_pane_commands_accept_find,
};

const struct gb_dialog_type gb_dialogs_pressure = {
    .form = &gb_dialog_forms_prompt,
    .title = "Densities at a pressure (Esc cancels)",
    .label = "Pressure, as 100 MPa:",
    .opened_by = gb_view_commands_pressure,
    .accept = gb_view_commands_accept_pressure,
};

const struct gb_dialog_type gb_dialogs_ranges = {
    .form = &gb_dialog_forms_prompt,
    .title = "Ranges of the axes (Esc cancels)",
    .label = "p=10 MPa:500 MPa rho=0.3:0.6 (empty: automatic):",
    .opened_by = gb_view_commands_ranges,
    .accept = gb_view_commands_accept_ranges,
};

const struct gb_dialog_type gb_dialogs_densities = {
    .form = &gb_dialog_forms_densities,
    .title = "Densities of the curves (y copies, Esc closes)",
    .scope = GB_KEY_COPIED,
    .opened_by = gb_view_commands_densities,
    .copied = gb_view_commands_densities_text,
};

const struct gb_dialog_type gb_dialogs_curves = {
    .form = &gb_dialog_forms_curves,
    .title = "Curves (Enter names, * pins, m hides, D deletes, Esc)",
    .scope = GB_KEY_CURVES,
    .opened_by = gb_view_commands_curve_open,
    .accept = gb_view_commands_curve_accept_name,
};

const struct gb_dialog_type gb_dialogs_replicas = {
    .form = &gb_dialog_forms_prompt,
    .title = "Replicas of this scene (Esc cancels)",
    .label = "Number of cells; stop at standard error of density:",
    .opened_by = gb_job_commands_replicas,
    .accept = gb_job_commands_accept_replicas,
};

const struct gb_dialog_type gb_dialogs_calibrate = {
    .form = &gb_dialog_forms_prompt,
    .title = "Calibration to the measured data (Esc cancels)",
    .label = "Up to 4 parameters, comma-separated, each key[=LOW:HIGH]:",
    .opened_by = gb_job_commands_calibrate,
    .accept = gb_job_commands_accept_calibrate,
};

const struct gb_dialog_type gb_dialogs_picture = {
    .form = &gb_dialog_forms_picture,
    .title = "Picture of the last stored packing (Enter, Esc)",
    .opened_by = gb_file_commands_picture,
    .accept = gb_file_commands_accept_picture,
};

const struct gb_dialog_type gb_dialogs_legs = {
    .form = &gb_dialog_forms_legs,
    .title = "Legs of loading.path (y takes them, Esc restores)",
    .scope = GB_KEY_LEGS,
};

const struct gb_dialog_type gb_dialogs_shell = {
    .form = &gb_dialog_forms_command,
    .title = "Shell command that repeats this run (Esc closes)",
    .label = "y copies, c closes",
    .scope = GB_KEY_COPIED,
    .opened_by = gb_file_commands_shell,
    .copied = gb_file_commands_shell_text,
};

const struct gb_dialog_type gb_dialogs_quit = {
    .form = &gb_dialog_forms_question,
    .title = "Quit?",
    .yes = "quit",
    .no = "stay",
    .opened_by = gb_pane_commands_quit,
    .press = gb_pane_commands_press_quit,
    .accept = gb_pane_commands_accept_quit,
};

const struct gb_dialog_type gb_dialogs_cost = {
    .form = &gb_dialog_forms_question,
    .title = "A long run: start it?",
    .yes = "start",
    .no = "cancel",
    .accept = gb_file_commands_accept_cost,
    .decline = gb_file_commands_decline_cost,
};

const struct gb_dialog_type gb_dialogs_results = {
    .form = &gb_dialog_forms_cards,
    .title = "Result",
    .scope = GB_KEY_COPIED,
    .opened_by = gb_job_commands_result_show,
    .copied = gb_job_commands_result_text,
    .press = gb_job_commands_result_press,
    .accept = gb_job_commands_result_accept,
};

const struct gb_dialog_type gb_dialogs_pixels = {
    .form = &gb_dialog_forms_pixels,
    .title = "Picture (Esc closes)",
};

const struct gb_dialog_type gb_dialogs_chart = {
    .form = &gb_dialog_forms_prompt,
    .title = "Accuracy against cost of this scene (Esc cancels)",
    .label = "Cells of each setting; CPU time; pressures:",
    .opened_by = gb_job_commands_chart_open,
    .accept = gb_job_commands_chart_accept,
};

const struct gb_dialog_type gb_dialogs_stability = {
    .form = &gb_dialog_forms_prompt,
    .title = "Stability of this scene's methods (Esc cancels)",
    .label = "States, as 10 MPa; density=0.5 (empty: 1, 10, 100 MPa):",
    .opened_by = gb_job_commands_chart_open,
    .accept = gb_job_commands_stability_accept,
};
