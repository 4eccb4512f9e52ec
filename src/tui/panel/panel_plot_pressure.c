#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/number.h"
#include "base/units.h"
#include "tui/panel/panels.h"
#include "tui/session/overlay/pressure_rows.h"
#include "tui/view/views.h"

/* The cursor at a typed pressure. */

/* The point where loading has reached the pressure; the last one before that. */
static size_t point_at(const struct gb_session_shown *shown, double pressure_pa)
{
    for (size_t i = 0; i < shown->points; i++) {
        const struct gb_point *point = gb_curve_at(shown->curve, i);
        if (point->branch <= 0 && point->p_pa >= pressure_pa) {
            return i;
        }
    }
    return shown->points - 1;
}

void gb_panel_plot_pressure_set(struct gb_panel_plot *panel,
                                const struct gb_session *session, double pressure_pa)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (!(panel->view->options & (GB_VIEW_PRESSURE_AXIS | GB_VIEW_PRESSURE_ACROSS))) {
        panel->view = gb_views_at(0);
    }
    panel->at_pa = pressure_pa;
    panel->cursor_on = shown.points > 0;
    panel->cursor = shown.points > 0 ? point_at(&shown, pressure_pa) : 0;
}

bool gb_panel_plot_pressure_shown(const struct gb_panel_plot *panel)
{
    return panel->at_pa > 0.0 &&
           panel->view->options & (GB_VIEW_PRESSURE_AXIS | GB_VIEW_PRESSURE_ACROSS);
}

double gb_panel_plot_pressure_density(const struct gb_panel_plot *panel,
                                      const struct gb_session *session)
{
    struct gb_pressure_rows rows;
    double density = NAN;
    gb_pressure_rows_list(&rows, session, panel->hide_previous);
    for (int i = 0; i < rows.count && isnan(density); i++) {
        density = gb_pressure_rows_at(session, &rows.row[i], panel->at_pa).density;
    }
    return density;
}

static void write_value(GString *text, const struct gb_pressure_row *row,
                        struct gb_pressure_value value)
{
    char number[GB_NUMBER_ERROR_MAX];
    const char *separator = text->str[text->len - 1] == ':' ? "" : ",";
    if (isnan(value.density)) {
        g_string_append_printf(text, "%s %s -", separator, row->brief);
    } else if (isnan(value.error)) {
        g_string_append_printf(text, "%s %s %.4f", separator, row->brief, value.density);
    } else {
        g_string_append_printf(
            text, "%s %s %s", separator, row->brief,
            gb_number_error(value.density, value.error, 2, " +- ", number));
    }
}

/* "density at 100 MPa: run 0.4062 +- 0.0064, a 0.3962 +- 0.0064, measured 0.410" */
void gb_panel_plot_pressure_describe(const struct gb_panel_plot *panel,
                                     const struct gb_session *session,
                                     struct gb_message *message)
{
    struct gb_pressure_rows rows;
    char pressure[32];
    GString *text = g_string_new(NULL);
    gb_units_format_short(panel->at_pa, GB_DIM_PRESSURE, 6, pressure, sizeof pressure);
    g_string_printf(text, "density at %s:", pressure);
    gb_pressure_rows_list(&rows, session, panel->hide_previous);
    for (int i = 0; i < rows.count; i++) {
        write_value(text, &rows.row[i],
                    gb_pressure_rows_at(session, &rows.row[i], panel->at_pa));
    }
    snprintf(message->text, sizeof message->text, "%s", text->str);
    message->style = GB_STYLE_PLAIN;
    g_string_free(text, TRUE);
}
