#include "io/runs/run_line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

enum { STATE_COLS = 14 };

/* "done", "live 45 %", "detached 45 %", "paused 45 %". */
static void write_state(const struct gb_run_list_item *item, char *text, size_t size)
{
    const bool paused = strcmp(item->state, "paused") == 0;
    if (item->engine == GB_RUN_LIST_NONE) {
        snprintf(text, size, "%s", item->state);
    } else {
        snprintf(text, size, "%s %.0f %%",
                 paused ? item->state : gb_run_list_engine_word(item->engine),
                 floor(100.0 * item->progress));
    }
}

char *gb_run_line_size(int64_t bytes)
{
    char *size = g_format_size((guint64)bytes);
    char **parts = g_strsplit(size, "\u00a0", 2); /* no-break space */
    char *text = g_strjoinv(" ", parts);
    g_strfreev(parts);
    g_free(size);
    return text;
}

/* "11-25 23:58", or "2025-11-25" of another year; g_free. */
static char *date_text(int64_t seconds)
{
    GDateTime *time = g_date_time_new_from_unix_local(seconds);
    GDateTime *now = g_date_time_new_now_local();
    const bool known = time != NULL && now != NULL;
    char *text = !known ? g_strdup("-")
                        : g_date_time_format(time, g_date_time_get_year(time) ==
                                                           g_date_time_get_year(now)
                                                       ? "%m-%d %H:%M"
                                                       : "%Y-%m-%d");
    g_clear_pointer(&time, g_date_time_unref);
    g_clear_pointer(&now, g_date_time_unref);
    return text;
}

static char *join(enum gb_run_line_extent extent, const char *state, const char *density,
                  const char *pressure, const char *size, const char *date)
{
    return extent == GB_RUN_LINE_ALL
               ? g_strdup_printf("%-*s  %7s  %8s  %8s  %s", STATE_COLS, state, density,
                                 pressure, size, date)
               : g_strdup_printf("%-*s  %8s  %s", STATE_COLS, state, size, date);
}

char *gb_run_line_values(const struct gb_run_list_item *item,
                         enum gb_run_line_extent extent)
{
    char state[48];
    char density[16] = "-";
    char pressure[32] = "-";
    char *date = date_text(item->modified_s);
    char *size = gb_run_line_size(item->bytes);
    write_state(item, state, sizeof state);
    if (isfinite(item->density)) {
        snprintf(density, sizeof density, "%.4f", item->density);
    }
    if (isfinite(item->pressure_pa)) {
        gb_units_format_short(item->pressure_pa, GB_DIM_PRESSURE, 3, pressure,
                              sizeof pressure);
    }
    char *line = join(extent, state, density, pressure, size, date);
    g_free(size);
    g_free(date);
    return line;
}

char *gb_run_line_head(enum gb_run_line_extent extent)
{
    return join(extent, "state", "density", "pressure", "size", "date");
}
