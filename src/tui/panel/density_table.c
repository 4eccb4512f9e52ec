#include "tui/panel/density_table.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "measure/average.h"
#include "tui/session/pressure_rows.h"

static const double level_pa[] = {10e6, 50e6, 100e6, 500e6};

enum {
    LEVELS = sizeof level_pa / sizeof level_pa[0],
    VALUE_COLS = 9,
    MISFIT_COLS = 7,
    NAME_COLS_MIN = 11,
    NAME_COLS_MAX = 40,
    FOOT_ROWS = 3, /* explanation of the signs */
    LINES_MAX = 3 * GB_PRESSURE_ROWS
};

/* One line of the table. */
struct line {
    char name[64];
    char value[LEVELS][VALUE_COLS + 1];
    char misfit[MISFIT_COLS + 1]; /* misfit to the measured data */
    enum gb_style name_style, style[LEVELS];
};

struct table {
    struct line line[LINES_MAX];
    int count;
};

static struct line *add(struct table *table, const char *name, enum gb_style style)
{
    struct line *line = &table->line[table->count++];
    *line = (struct line){.name_style = style};
    g_strlcpy(line->name, name, sizeof line->name);
    for (int k = 0; k < LEVELS; k++) {
        line->style[k] = style;
    }
    return line;
}

static void write_densities(struct table *table, const struct gb_pressure_row *row,
                            const struct gb_pressure_value value[LEVELS], double misfit)
{
    struct line *line = add(table, row->name, GB_STYLE_PLAIN);
    if (isfinite(misfit)) {
        snprintf(line->misfit, sizeof line->misfit, "%.2f %%", 100.0 * misfit);
    }
    for (int k = 0; k < LEVELS; k++) {
        gb_pressure_rows_write(value[k], line->value[k], sizeof line->value[k]);
    }
}

static void write_errors(struct table *table, const struct gb_pressure_row *row,
                         const struct gb_pressure_value value[LEVELS])
{
    const bool one_cell =
        row->kind != GB_PRESSURE_ROW_MEASURED && row->kind != GB_PRESSURE_ROW_REPLICAS;
    struct line *line = add(table, one_cell ? "  +- cell" : "  +- error", GB_STYLE_DIM);
    bool some = false;
    for (int k = 0; k < LEVELS; k++) {
        if (isfinite(value[k].density) && isfinite(value[k].error)) {
            snprintf(line->value[k], sizeof line->value[k], "%.4f", value[k].error);
            some = true;
        }
    }
    table->count -= !some;
}

static void write_differences(struct table *table, const struct gb_pressure_row *row,
                              const struct gb_pressure_value value[LEVELS],
                              const struct gb_pressure_row *base,
                              const struct gb_pressure_value base_value[LEVELS])
{
    struct line *line = add(table, "  - run", GB_STYLE_DIM);
    bool some = false;
    for (int k = 0; k < LEVELS; k++) {
        const enum gb_pressure_verdict verdict = gb_pressure_rows_write_difference(
            row, value[k], base, base_value[k], line->value[k], sizeof line->value[k]);
        some = some || line->value[k][0] != '\0';
        if (verdict == GB_PRESSURE_VERDICT_BEYOND) {
            line->style[k] = GB_STYLE_BOLD;
        }
    }
    table->count -= !some;
}

static void fill(struct table *table, const struct gb_session *session,
                 bool hide_previous)
{
    struct gb_pressure_rows rows;
    struct gb_pressure_value value[GB_PRESSURE_ROWS][LEVELS];
    gb_pressure_rows_list(&rows, session, hide_previous);
    table->count = 0;
    for (int i = 0; i < rows.count; i++) {
        const struct gb_pressure_row *row = &rows.row[i];
        for (int k = 0; k < LEVELS; k++) {
            value[i][k] = gb_pressure_rows_at(session, row, level_pa[k]);
        }
        write_densities(table, row, value[i], gb_pressure_rows_misfit(session, row));
        write_errors(table, row, value[i]);
        if (i > 0 && rows.row[0].kind == GB_PRESSURE_ROW_RUN) {
            write_differences(table, row, value[i], &rows.row[0], value[0]);
        }
    }
}

static void draw_head(const struct gb_paint *paint, int name_cols, bool misfit)
{
    gb_paint_cell(paint, 0, 0, name_cols, GB_STYLE_BOLD, "density at");
    for (int k = 0; k < LEVELS; k++) {
        char pressure[24];
        gb_units_format_short(level_pa[k], GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
        const int end = name_cols + (k + 1) * VALUE_COLS - 1; /* room for the sign */
        gb_paint_text(paint, 0, end - gb_paint_width(pressure), GB_STYLE_BOLD, pressure);
    }
    if (misfit) {
        const int from = name_cols + LEVELS * VALUE_COLS;
        gb_paint_text(paint, 0, from, GB_STYLE_BOLD, " misfit");
    }
}

static void draw_line(const struct gb_paint *paint, int row, int name_cols,
                      const struct line *line)
{
    gb_paint_cell(paint, row, 0, name_cols - 1, line->name_style, line->name);
    for (int k = 0; k < LEVELS; k++) {
        const char *value = line->value[k];
        const int signs =
            value[0] != '\0' && !g_ascii_isdigit(value[0]) && value[1] != '\0';
        const int end = name_cols + (k + 1) * VALUE_COLS - 1 + signs;
        gb_paint_text(paint, row, end - gb_paint_width(value), line->style[k], value);
    }
    const int end = name_cols + LEVELS * VALUE_COLS + MISFIT_COLS;
    gb_paint_text(paint, row, end - gb_paint_width(line->misfit), line->name_style,
                  line->misfit);
}

static void draw_foot(const struct gb_paint *paint, int row)
{
    gb_paint_wrap(
        paint, row, FOOT_ROWS, GB_STYLE_DIM,
        "~ within, ! beyond two standard deviations of the difference; +- cell: "
        "measured scatter of one cell; no sign: error unknown, or quick against full "
        "cell; misfit: RMS of density.");
}

char *gb_density_table_text(const struct gb_session *session, bool hide_previous)
{
    struct table table;
    GString *text = g_string_new("density at");
    fill(&table, session, hide_previous);
    for (int k = 0; k < LEVELS; k++) {
        char pressure[24];
        gb_units_format_short(level_pa[k], GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
        g_string_append_printf(text, "\t%s", pressure);
    }
    g_string_append_c(text, '\n');
    for (int i = 0; i < table.count; i++) {
        char *name = g_strstrip(g_strdup(table.line[i].name));
        g_string_append(text, name);
        g_free(name);
        for (int k = 0; k < LEVELS; k++) {
            g_string_append_printf(text, "\t%s", table.line[i].value[k]);
        }
        g_string_append_c(text, '\n');
    }
    return g_string_free(text, FALSE);
}

int gb_density_table_draw(const struct gb_paint *paint, const struct gb_session *session,
                          bool hide_previous, int *top)
{
    struct table table;
    const int page = MAX(1, paint->rect.rows - FOOT_ROWS - 1);
    const bool misfit = gb_session_measured(session) != NULL;
    const int name_cols =
        CLAMP(paint->rect.cols - LEVELS * VALUE_COLS - (misfit ? MISFIT_COLS : 0),
              NAME_COLS_MIN, NAME_COLS_MAX);
    fill(&table, session, hide_previous);
    *top = CLAMP(*top, 0, MAX(0, table.count - page));
    draw_head(paint, name_cols, misfit);
    for (int i = 0; i < page && *top + i < table.count; i++) {
        draw_line(paint, 1 + i, name_cols, &table.line[*top + i]);
    }
    if (table.count == 0) {
        gb_paint_text(paint, 1, 0, GB_STYLE_DIM, "no curve yet: r starts a run");
    }
    draw_foot(paint, paint->rect.rows - FOOT_ROWS);
    return page;
}
