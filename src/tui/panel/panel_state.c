/* The panes of the state and of the events.  Quantities of the state are rows of a
 * table with their names, format and importance; how many are shown depends on the size
 * of the pane.  Above them are the progress of the run and the density at a pressure. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/units.h"
#include "io/status_json.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/panel/panels.h"
#include "tui/session/pressure_rows.h"
#include "tui/session/session.h"

static int limit(int value, int max)
{
    return value < 0 ? 0 : value > max ? max : value;
}

static int scroll_max(const struct gb_panel_events *panel,
                      const struct gb_session *session)
{
    const int64_t kept =
        session->log_count < GB_SESSION_LOG ? session->log_count : GB_SESSION_LOG;
    return kept > panel->page ? (int)kept - panel->page : 0;
}

/* Number of rows of the lines from the newest to this one. */
static int total_rows(const struct gb_panel_events *panel, const struct gb_paint *paint,
                      const struct gb_session *session, int max)
{
    int total = 0;
    for (int i = panel->back; total < panel->page; i++) {
        const char *line = gb_session_event_line(session, i);
        if (line == NULL) {
            break;
        }
        total += gb_paint_wrap_rows(paint, max, line);
    }
    return total;
}

/* Draws the newest line at the bottom.  A long line is wrapped, up to half of the pane.
 */
void gb_panel_state_events_draw(struct gb_panel_events *panel,
                                const struct gb_paint *paint,
                                const struct gb_session *session,
                                enum gb_paint_focus focus)
{
    char title[GB_CHILD_COMMAND_LINE + 32] = "Events";
    if (session->child.progress[0] != '\0') {
        snprintf(title, sizeof title, "Events: %s, %s", session->child.name,
                 session->child.progress);
    }
    gb_paint_title(paint, title, focus);
    panel->page = paint->rect.rows - 1;
    panel->back = limit(panel->back, scroll_max(panel, session));
    const int max = panel->page > 3 ? 3 : 1;
    const int total = total_rows(panel, paint, session, max);
    int end = 1 + (total < panel->page ? total : panel->page);
    const char *line = NULL;
    for (int i = panel->back; end > 1; i++) {
        line = gb_session_event_line(session, i);
        if (line == NULL) {
            return;
        }
        const int rows = gb_paint_wrap_rows(paint, max, line);
        if (end - rows < 1) {
            return;
        }
        end -= rows;
        gb_paint_wrap(paint, end, rows, GB_STYLE_PLAIN, line);
    }
}

void gb_panel_state_events_navigate(struct gb_panel_events *panel,
                                    const struct gb_session *session,
                                    enum gb_action action)
{
    const int max = scroll_max(panel, session);
    switch (action) {
    case GB_ACTION_UP:
        panel->back = limit(panel->back + 1, max);
        break;
    case GB_ACTION_DOWN:
        panel->back = limit(panel->back - 1, max);
        break;
    case GB_ACTION_PAGE_UP:
        panel->back = limit(panel->back + panel->page, max);
        break;
    case GB_ACTION_PAGE_DOWN:
        panel->back = limit(panel->back - panel->page, max);
        break;
    case GB_ACTION_HOME:
        panel->back = max;
        break;
    case GB_ACTION_END:
        panel->back = 0;
        break;
    default:
        break;
    }
}

/* The pane of the state: numbers as text, one row per quantity, and the columns. */

/* Condition for listing a quantity. */
enum need { NOTHING, SOLID /* three dimensions */, LEGS /* loading.path */, SHEAR };

/* When a quantity has a value: from the first point, after an evaluation, at once. */
enum from { POINT, EVALUATION, START };

/* A quantity of the state pane: a row of the lists below.  It has names for narrow and
 * wide columns. rank is its importance if the pane is too small for all; 0 is the most
 * important. */
struct item {
    const char *brief, *name;
    int rank;
    void (*write)(const struct item *item, const struct gb_session_shown *shown,
                  char *text, size_t size);
    size_t at;          /* offset of its double in struct gb_snapshot */
    const char *format; /* for write_number and write_percent */
    enum need need;
    int component; /* of a shear strain */
    enum from from;
};

enum { ITEMS_MOST = 20 };

/* The items that apply to a run, in the order of columns and of importance. */
struct choice {
    const struct item *item[ITEMS_MOST];
    const struct item *by_rank[ITEMS_MOST];
    int count;
};

/* Formatting of numbers; "-" if a value is not finite. */

static double value_of(const struct item *item, const struct gb_session_shown *shown)
{
    double value;
    memcpy(&value, (const char *)shown->now + item->at, sizeof value);
    return value;
}

/* Formats with a printf format for one double. */
static void put_number(char *text, size_t size, const char *format, double value)
{
    if (isfinite(value)) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

/* Writes "812", "6.31 k" or "12.3 M": three digits. */
static void put_count(char *text, size_t size, double value)
{
    static const char *const prefix[] = {"", "k", "M", "G", "T"};
    size_t k = 0;
    while (fabs(value) >= 999.5 && k < 4) {
        value *= 1e-3;
        k++;
    }
    const int decimals = k == 0 || fabs(value) >= 99.95 ? 0
                         : fabs(value) >= 9.995         ? 1
                                                        : 2;
    snprintf(text, size, "%.*f%s%s", decimals, value, k > 0 ? " " : "", prefix[k]);
}

/* Writes "31.2 aJ" or "214 fJ": three digits, with a prefix for values below one joule.
 */
static void write_energy(const struct item *item, const struct gb_session_shown *shown,
                         char *text, size_t size)
{
    double value = value_of(item, shown);
    static const char *const prefix[] = {"", "m", "u", "n", "p", "f", "a"};
    size_t k = 0;
    while (fabs(value) < 0.9995 && k < 6) {
        value *= 1e3;
        k++;
    }
    const int decimals = fabs(value) >= 99.95 ? 0 : fabs(value) >= 9.995 ? 1 : 2;
    if (!isfinite(value)) {
        snprintf(text, size, "-");
    } else if (fabs(value) < 0.005) {
        snprintf(text, size, "0 J");
    } else {
        snprintf(text, size, "%.*f %sJ", decimals, value, prefix[k]);
    }
}

/* Writes a pressure in the unit of the largest of the four, so that they compare. */
static void put_pressure(const struct gb_snapshot *now, double value, char *text,
                         size_t size)
{
    const double max =
        fmax(fmax(fabs(now->now.p_pa), fabs(now->now.pz_pa)), fabs(now->now.px_pa));
    if (!isfinite(value)) {
        snprintf(text, size, "-");
    } else if (max >= 9.995e8) {
        snprintf(text, size, "%.3f GPa", value * 1e-9);
    } else {
        snprintf(text, size, max >= 9.995e7 ? "%.1f MPa" : "%.2f MPa", value * 1e-6);
    }
}

static void write_pressure(const struct item *item, const struct gb_session_shown *shown,
                           char *text, size_t size)
{
    put_pressure(shown->now, value_of(item, shown), text, size);
}

/* Writes a shear stress with the sign of the shear, as in loading.path. */
static void write_stress(const struct item *item, const struct gb_session_shown *shown,
                         char *text, size_t size)
{
    put_pressure(shown->now, -value_of(item, shown), text, size);
}

static void write_number(const struct item *item, const struct gb_session_shown *shown,
                         char *text, size_t size)
{
    put_number(text, size, item->format, value_of(item, shown));
}

static void write_percent(const struct item *item, const struct gb_session_shown *shown,
                          char *text, size_t size)
{
    put_number(text, size, item->format, 100.0 * value_of(item, shown));
}

static void write_bridged(const struct item *item, const struct gb_session_shown *shown,
                          char *text, size_t size)
{
    const double percent = 100.0 * value_of(item, shown);
    put_number(text, size, percent >= 99.95 ? "%.0f %%" : "%.1f %%", percent);
}

static void write_nanoseconds(const struct item *item,
                              const struct gb_session_shown *shown, char *text,
                              size_t size)
{
    const double ns = 1e9 * value_of(item, shown);
    put_number(text, size, ns < 99.995 ? "%.2f ns" : "%.0f ns", ns);
}

/* Writes lengths such as "24.1 um" and times such as "40.6 us". */
static void put_unit(double value, enum gb_dimension dimension, char *text, size_t size)
{
    if (isfinite(value)) {
        gb_units_format_short(value, dimension, 3, text, size);
    }
}

static void write_length(const struct item *item, const struct gb_session_shown *shown,
                         char *text, size_t size)
{
    put_unit(value_of(item, shown), GB_DIM_LENGTH, text, size);
}

static void write_time(const struct item *item, const struct gb_session_shown *shown,
                       char *text, size_t size)
{
    put_unit(value_of(item, shown), GB_DIM_TIME, text, size);
}

static void write_time_step(const struct item *item, const struct gb_session_shown *shown,
                            char *text, size_t size)
{
    if (value_of(item, shown) > 0.0) {
        write_time(item, shown, text, size);
    }
}

static void write_rate(const struct item *item, const struct gb_session_shown *shown,
                       char *text, size_t size)
{
    put_count(text, size, value_of(item, shown));
}

static void write_evaluations(const struct item *item,
                              const struct gb_session_shown *shown, char *text,
                              size_t size)
{
    (void)item;
    put_count(text, size, (double)shown->now->evaluations);
}

static void write_poured(const struct item *item, const struct gb_session_shown *shown,
                         char *text, size_t size)
{
    (void)item;
    snprintf(text, size, "%lld", (long long)shown->now->stage.poured);
}

static void write_stage(const struct item *item, const struct gb_session_shown *shown,
                        char *text, size_t size)
{
    (void)item;
    snprintf(text, size, "%s", gb_panel_plot_stage(shown->now->now.branch));
}

/* "0.7 s", "12:34", "3:04:05"; returns text. */
static char *put_duration(double seconds, char *text, size_t size)
{
    if (seconds >= 0.0 && seconds < 59.95) {
        snprintf(text, size, "%.1f s", seconds);
        return text;
    }
    return gb_paint_time(seconds, text, size);
}

static void write_duration(const struct item *item, const struct gb_session_shown *shown,
                           char *text, size_t size)
{
    put_duration(value_of(item, shown), text, size);
}

static void write_leg(const struct item *item, const struct gb_session_shown *shown,
                      char *text, size_t size)
{
    struct gb_path path;
    const double number = value_of(item, shown);
    if (isfinite(number) &&
        gb_path_parse(&path, shown->params->path, shown->params->dimension, NULL)) {
        snprintf(text, size, "%.0f of %d", number, path.count);
    }
}

#define AT(member) .at = offsetof(struct gb_snapshot, member)

/* Order of the columns when all fit. */
static const struct item still_items[] = {
    {"leg", "leg", 0, write_leg, AT(now.leg), .need = LEGS},
    {"density", "relative density", 1, write_number, AT(now.density), "%.4f"},
    {"coord.", "mean coordination number", 8, write_number, AT(now.coordination), "%.2f"},
    {"bridged", "bridged contacts", 11, write_bridged, AT(now.bridged)},
    {"rattl.", "rattlers", 12, write_percent, AT(now.rattlers), "%.1f %%"},
    {"p", "pressure p", 2, write_pressure, AT(now.p_pa)},
    {"px", "  along x", 13, write_pressure, AT(now.px_pa)},
    {"py", "  along y", 14, write_pressure, AT(now.py_pa), .need = SOLID},
    {"pz", "  along z", 9, write_pressure, AT(now.pz_pa)},
    {"q", "deviatoric stress q", 3, write_pressure, AT(now.q_pa), .need = LEGS},
    {"xy", "shear stress xy", 5, write_stress, AT(now.shear_pa[0]), .need = SHEAR,
     .component = 3},
    {"xz", "shear stress xz", 4, write_stress, AT(now.shear_pa[1]), .need = SHEAR,
     .component = 4},
    {"yz", "shear stress yz", 6, write_stress, AT(now.shear_pa[2]), .need = SHEAR,
     .component = 5},
    {"residual", "force residual", 7, write_number, AT(live_residual), "%.0e",
     .from = EVALUATION},
    {"evals", "force evaluations", 15, write_evaluations, .from = POINT},
    {"evals/s", "force evaluations/s", 10, write_rate, AT(evaluations_per_s)},
    {"elapsed", "elapsed time", 16, write_duration, AT(seconds), .from = START},
};

/* Dynamic runs: the residual is the unbalanced force. */
static const struct item moving_items[] = {
    {"stage", "stage", 3, write_stage, .from = POINT},
    {"t", "simulated time", 2, write_nanoseconds, AT(now.time_s)},
    {"density", "relative density", 0, write_number, AT(now.density), "%.4f"},
    {"p", "pressure p", 1, write_pressure, AT(now.p_pa)},
    {"px", "  along x", 14, write_pressure, AT(now.px_pa)},
    {"py", "  along y", 17, write_pressure, AT(now.py_pa), .need = SOLID},
    {"pz", "  along z", 15, write_pressure, AT(now.pz_pa)},
    {"work", "work done", 4, write_energy, AT(now.work)},
    {"kin", "kinetic energy", 5, write_energy, AT(now.kinetic)},
    {"elast", "elastic energy", 6, write_energy, AT(now.elastic)},
    {"diss", "dissipated", 7, write_energy, AT(now.dissipated)},
    {"E err", "energy balance error", 8, write_percent, AT(now.energy_residual),
     "%.2g %%"},
    {"coord.", "mean coordination number", 10, write_number, AT(now.coordination),
     "%.2f"},
    {"bridged", "bridged contacts", 13, write_bridged, AT(now.bridged)},
    {"rattl.", "rattlers", 16, write_percent, AT(now.rattlers), "%.1f %%"},
    {"unbal.", "unbalanced force", 9, write_number, AT(live_residual), "%.0e",
     .from = EVALUATION},
    {"step", "time step", 11, write_time_step, AT(time_step_s)},
    {"steps/s", "time steps/s", 12, write_rate, AT(evaluations_per_s)},
};

/* Dies before the first point: the present bed. */
static const struct item filling_items[] = {
    {"in die", "particles in the die", 0, write_poured, .from = EVALUATION},
    {"height", "height of the powder", 1, write_length, AT(stage.height_m),
     .from = EVALUATION},
    {"coord.", "mean coordination number", 3, write_number, AT(stage.coordination),
     "%.2f", .from = EVALUATION},
    {"kin", "kinetic energy", 2, write_energy, AT(stage.kinetic_j), .from = EVALUATION},
    {"unbal.", "unbalanced force", 4, write_number, AT(live_residual), "%.0e",
     .from = EVALUATION},
    {"t", "simulated time", 6, write_time, AT(stage.time_s), .from = EVALUATION},
    {"step", "time step", 9, write_time_step, AT(time_step_s), .from = EVALUATION},
    {"steps", "time steps", 8, write_evaluations, .from = EVALUATION},
    {"steps/s", "time steps/s", 5, write_rate, AT(evaluations_per_s), .from = EVALUATION},
    {"elapsed", "elapsed time", 7, write_duration, AT(seconds), .from = START},
};

/* Dies from the first point on. */
static const struct item die_items[] = {
    {"density", "relative density", 0, write_number, AT(now.density), "%.4f"},
    {"height", "height of the powder", 3, write_length, AT(now.height_m)},
    {"coord.", "mean coordination number", 2, write_number, AT(now.coordination), "%.2f"},
    {"rattl.", "rattlers", 7, write_percent, AT(now.rattlers), "%.1f %%"},
    {"p", "pressure p", 1, write_pressure, AT(now.p_pa)},
    {"wall", "radial pressure on the wall", 5, write_pressure, AT(now.wall_pa)},
    {"floor/p", "floor-to-punch force ratio", 4, write_number, AT(now.floor_over_punch),
     "%.3f"},
    {"unbal.", "unbalanced force", 8, write_number, AT(live_residual), "%.0e",
     .from = EVALUATION},
    {"t", "simulated time", 9, write_time, AT(now.time_s)},
    {"steps", "time steps", 11, write_evaluations, .from = POINT},
    {"steps/s", "time steps/s", 6, write_rate, AT(evaluations_per_s)},
    {"elapsed", "elapsed time", 10, write_duration, AT(seconds), .from = START},
};

#undef AT

/* The quantities of a run. */
struct list {
    const struct item *item;
    int count;
};

#define COUNT(items) (sizeof items / sizeof items[0])
static const struct list still = {still_items, COUNT(still_items)},
                         moving = {moving_items, COUNT(moving_items)},
                         filling = {filling_items, COUNT(filling_items)},
                         die = {die_items, COUNT(die_items)};

static const struct list *list_of(const struct gb_session_shown *shown)
{
    switch (gb_loading_kind_of(shown->params)->columns) {
    case GB_COLUMNS_ENERGY:
        return &moving;
    case GB_COLUMNS_DIE:
        return shown->now->now_valid ? &die : &filling;
    case GB_COLUMNS_COMMON:
        break;
    }
    return &still;
}

/* Does a leg of the path strain or hold this component? */
static bool sheared(const struct gb_path *path, int component)
{
    bool moved = false;
    for (int l = 0; l < path->count; l++) {
        const struct gb_leg_component *control = &path->leg[l].component[component];
        moved = moved || control->control != GB_LEG_STRAIN || control->value != 0.0;
    }
    return moved;
}

static bool applies(const struct item *item, const struct gb_params *params,
                    const struct gb_path *path)
{
    switch (item->need) {
    case SOLID:
        return params->dimension == 3;
    case LEGS:
        return path->count > 0;
    case SHEAR:
        return sheared(path, item->component);
    case NOTHING:
        break;
    }
    return true;
}

static struct choice choose(const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_params *params = shown.params;
    const struct list *list = list_of(&shown);
    struct choice choice = {.count = 0};
    struct gb_path path = {.count = 0};
    if (!gb_loading_kind_follows_path(params) ||
        !gb_path_parse(&path, params->path, params->dimension, NULL)) {
        path.count = 0;
    }
    for (int i = 0; i < list->count; i++) {
        const struct item *item = &list->item[i];
        int at = choice.count;
        if (!applies(item, params, &path)) {
            continue;
        }
        choice.item[choice.count++] = item;
        for (; at > 0 && choice.by_rank[at - 1]->rank > item->rank; at--) {
            choice.by_rank[at] = choice.by_rank[at - 1];
        }
        choice.by_rank[at] = item;
    }
    return choice;
}

/* Writes the value of an item; "-" if there is none yet. */
static void write_item(const struct item *item, const struct gb_session_shown *shown,
                       char *text, size_t size)
{
    const struct gb_snapshot *now = shown->now;
    snprintf(text, size, "-");
    if (now->now_valid || item->from == START ||
        (item->from == EVALUATION && now->evaluations > 0)) {
        item->write(item, shown, text, size);
    }
}

/* Width of a column from which names are not abbreviated; least width of the bar. */
enum { FULL_NAME_COLS = 30, BAR_MIN = 4 };

/* Heights of the pane from which the densities at a pressure and of replicas have a
 * line. */
enum { DENSITY_FROM_ROWS = 5, MEAN_FROM_ROWS = 4 };

const char *gb_panel_state_word(enum gb_run_state state, const char *error,
                                enum gb_style *style)
{
    static const struct {
        const char *word;
        enum gb_style style;
    } words[] = {
        [GB_RUN_PACKING] = {"\u25cc packing", GB_STYLE_SERIES},
        [GB_RUN_RUNNING] = {"\u25b6 running", GB_STYLE_GOOD},
        [GB_RUN_PAUSED] = {"\u2016 paused", GB_STYLE_WARN},
        [GB_RUN_DONE] = {"\u2713 done", GB_STYLE_GOOD},
        [GB_RUN_STOPPED] = {"\u25a0 stopped", GB_STYLE_WARN},
        [GB_RUN_FAILED] = {"\u2717 failed", GB_STYLE_BAD},
    };
    if (state == GB_RUN_DONE && error[0] != '\0') {
        *style = GB_STYLE_WARN;
        return "! done";
    }
    *style = words[state].style;
    return words[state].word;
}

bool gb_panel_state_stage(const struct gb_snapshot *now, enum gb_run_state state,
                          int cols, char *text, size_t size)
{
    char value[112];
    const struct gb_stage_report *stage = &now->stage;
    if (state != GB_RUN_RUNNING || stage->stage == GB_STAGE_NONE) {
        return false;
    }
    gb_status_json_stage_value(stage, value, sizeof value);
    snprintf(text, size, "%s%s%s", gb_status_json_stage_name(stage->stage),
             value[0] != '\0' ? " " : "", value);
    if ((int)strlen(text) > cols) {
        snprintf(text, size, "%s", gb_status_json_stage_name(stage->stage));
    }
    return (int)strlen(text) <= cols;
}

/* Writes "done in 0.7 s" or "stopped after 3:04"; only the state for a live run. */
static void write_state(const struct gb_snapshot *now, const char *word, char *text,
                        size_t size)
{
    char time[24];
    if (now->state > GB_RUN_PAUSED) {
        put_duration(now->seconds, time, sizeof time);
        snprintf(text, size, "%s %s %s", word, now->state == GB_RUN_DONE ? "in" : "after",
                 time);
    } else {
        snprintf(text, size, "%s", word);
    }
}

/* Writes " 45 %" or " 45 % 0:12 left"; " 45 % estimating" while the end cannot be
 * predicted. */
static void write_share(const struct gb_snapshot *now, double share, char *text,
                        size_t size)
{
    char time[24];
    const bool live = now->seconds_left >= 0.0 && now->state <= GB_RUN_PAUSED;
    const bool stages = now->stage.stage != GB_STAGE_NONE && now->state <= GB_RUN_PAUSED;
    snprintf(text, size, "%4.0f %%%s%s%s", floor(100.0 * share), live ? " " : "",
             live ? gb_paint_time(now->seconds_left, time, sizeof time) : "",
             live     ? " left"
             : stages ? " estimating"
                      : "");
}

/* Writes the stage instead of the word "running". */
static void write_running_stage(const struct gb_snapshot *now, int cols, char *text,
                                size_t size)
{
    char stage[128];
    if (gb_panel_state_stage(now, now->state, cols - 2, stage, sizeof stage)) {
        snprintf(text, size, "\u25b6 %s", stage);
    }
}

/* Draws state, bar, percentage and time in one row, or the bar in a row of its own. */
static void draw_progress(const struct gb_paint *paint, const struct gb_session *session,
                          bool own_row)
{
    char state[160] = "not started";
    char tail[48];
    enum gb_style style = GB_STYLE_DIM;
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    if (shown.curve != NULL) {
        write_state(now, gb_panel_state_word(now->state, now->error.text, &style), state,
                    sizeof state);
    }
    /* rounding may end the last time step of a dynamic run slightly before its end time
     */
    const bool done = shown.curve != NULL && now->state == GB_RUN_DONE;
    const double share = done ? 1.0 : now->progress;
    const int inner = paint->rect.cols - 2;
    write_share(now, share, tail, sizeof tail);
    if (!own_row && shown.curve != NULL) {
        write_running_stage(now, inner - (int)strlen(tail), state, sizeof state);
    }
    const int end = gb_paint_text(paint, 1, 1, style, state) + 1;
    const int room = inner + 1 - end - (int)strlen(tail);
    const int bar = own_row || room <= BAR_MIN ? 0 : room;
    if (own_row) {
        gb_paint_bar(paint, 2, 1, inner, share);
        if (gb_panel_state_stage(now, now->state, inner, state, sizeof state)) {
            gb_paint_text(paint, 3, 1, GB_STYLE_PLAIN, state);
        }
        gb_paint_text(paint, 1, 1 + inner - (int)strlen(tail), GB_STYLE_PLAIN, tail);
        return;
    }
    gb_paint_bar(paint, 1, end, bar, share);
    gb_paint_text(paint, 1, end + bar, GB_STYLE_PLAIN, tail);
}

static void draw_item(const struct gb_paint *paint, int row, int col, int cols,
                      const struct item *item, const struct gb_session_shown *shown)
{
    char text[48];
    write_item(item, shown, text, sizeof text);
    const char *name = cols >= FULL_NAME_COLS ? item->name : item->brief;
    gb_paint_cell(paint, row, col, cols - 1 - (int)strlen(text), GB_STYLE_DIM, name);
    gb_paint_text(paint, row, col + cols - (int)strlen(text), GB_STYLE_PLAIN, text);
}

static void draw_items(const struct gb_paint *paint, int first, int rows,
                       const struct gb_session_shown *shown, const struct choice *choice)
{
    const int count = choice->count;
    const int inner = paint->rect.cols - 2;
    int columns = inner >= 47 ? 3 : inner >= 34 ? 2 : 1;
    if (rows >= count) {
        columns = 1;
    } else if (2 * rows >= count && columns > 2) {
        columns = 2;
    }
    const int gap = columns > 1 ? 2 : 0;
    int width = (inner - gap * (columns - 1)) / columns;
    width = width > 34 ? 34 : width;
    const bool all = rows * columns >= count;
    const int each = all ? (count + columns - 1) / columns : rows;
    for (int i = 0; i < count && i < each * columns; i++) {
        const int column = all ? i / each : i % columns;
        const int row = all ? i % each : i / columns;
        draw_item(paint, first + row, 1 + column * (width + gap), width,
                  all ? choice->item[i] : choice->by_rank[i], shown);
    }
}

/* Finds what the density belongs to: the quick cell, the run, or the mean of its
 * replicas. */
static bool find_row(const struct gb_session *session,
                     const struct gb_session_shown *shown, struct gb_pressure_row *row)
{
    const struct gb_replica_band *band = &session->replica_band;
    struct gb_pressure_rows rows;
    bool found = false;
    gb_pressure_rows_list(&rows, session, false);
    for (int i = 0; i < rows.count; i++) {
        const enum gb_pressure_row_kind kind = rows.row[i].kind;
        const bool of_shown =
            kind == (shown->quick ? GB_PRESSURE_ROW_QUICK : GB_PRESSURE_ROW_RUN);
        const bool mean = kind == GB_PRESSURE_ROW_REPLICAS && !shown->quick &&
                          gb_previous_diff_count(&band->params, shown->params) == 0;
        if (of_shown || mean) {
            *row = rows.row[i];
            found = true;
        }
    }
    return found;
}

/* Writes the origin of the error, "(5 cells)" or "(cell scatter)": the longest form
 * that fits. */
static void write_origin(const struct gb_session *session,
                         const struct gb_pressure_row *row, double error, int cols,
                         char *text, size_t size)
{
    static const char *const scatter[] = {"(scatter expected of one cell)",
                                          "(cell scatter)", "(1 cell)"};
    static const char *const unknown[] = {"(1 cell, scatter unknown)", "(1 cell)", ""};
    const char *const *choice = isnan(error) ? unknown : scatter;
    int fits = 0;
    if (row->kind == GB_PRESSURE_ROW_REPLICAS) {
        snprintf(text, size, "(%zu cells)",
                 gb_job_replicas_group(&session->replica_band)->members);
        return;
    }
    while (fits < 2 && (int)strlen(choice[fits]) > cols) {
        fits++;
    }
    snprintf(text, size, "%s", choice[fits]);
}

enum { DENSITY_TEXT = 128 };

/* Writes "rho(100 MPa) = 0.4062 +- 0.0064" and "(cell scatter)".  The second text is
 * for the same row if it fits into `cols` columns, else for a row of its own.  False:
 * the pressure was not reached. */
static bool write_density(const struct gb_session *session,
                          const struct gb_session_shown *shown, int cols,
                          char head[DENSITY_TEXT], char origin[DENSITY_TEXT])
{
    char number[GB_NUMBER_ERROR_MAX], pressure[24];
    struct gb_pressure_row row;
    const double at_pa = gb_pressure_rows_usual(session, 0.0);
    if (!find_row(session, shown, &row)) {
        return false;
    }
    const struct gb_pressure_value value = gb_pressure_rows_at(session, &row, at_pa);
    if (!isfinite(value.density)) {
        return false;
    }
    gb_units_format_short(at_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    if (isnan(value.error)) {
        snprintf(number, sizeof number, "%.4f", value.density);
    } else {
        gb_number_error(value.density, value.error, 2, " +- ", number);
    }
    snprintf(head, DENSITY_TEXT, "rho(%s) = %s", pressure, number);
    const int left = cols - (int)strlen(head) - 1;
    write_origin(session, &row, value.error, left, origin, DENSITY_TEXT);
    if ((int)strlen(origin) > left) {
        write_origin(session, &row, value.error, cols, origin, DENSITY_TEXT);
    }
    return true;
}

static bool shows_density(const struct gb_paint *paint, const struct gb_session *session,
                          const struct gb_session_shown *shown)
{
    struct gb_pressure_row row;
    return paint->rect.rows >= DENSITY_FROM_ROWS ||
           (paint->rect.rows >= MEAN_FROM_ROWS && find_row(session, shown, &row) &&
            row.kind == GB_PRESSURE_ROW_REPLICAS);
}

/* Draws the density in one row, or in two if there is room; returns the number of rows.
 */
static int draw_density(const struct gb_paint *paint, const struct gb_session *session,
                        const struct gb_session_shown *shown, int row, bool roomy)
{
    char head[DENSITY_TEXT], origin[DENSITY_TEXT];
    const int cols = paint->rect.cols - 2;
    if (!write_density(session, shown, cols, head, origin)) {
        return 0;
    }
    gb_paint_text(paint, row, 1, GB_STYLE_BOLD, head);
    if ((int)(strlen(head) + strlen(origin)) < cols) {
        gb_paint_text(paint, row, 2 + (int)strlen(head), GB_STYLE_BOLD, origin);
    } else if (roomy) {
        gb_paint_text(paint, row + 1, 1, GB_STYLE_PLAIN, origin);
        return 2;
    }
    return 1;
}

void gb_panel_state_draw(const struct gb_paint *paint, const struct gb_session *session,
                         enum gb_paint_focus focus)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    gb_paint_title(paint, shown.quick ? "State of the quick cell" : "State", focus);
    const struct choice choice = choose(session);
    const bool roomy = paint->rect.rows >= choice.count + 6;
    draw_progress(paint, session, roomy);
    int row = roomy ? 4 : 2;
    if (shows_density(paint, session, &shown)) {
        row += draw_density(paint, session, &shown, row, roomy);
    }
    draw_items(paint, row, paint->rect.rows - row, &shown, &choice);
    if (roomy && now->error.text[0] != '\0') {
        row += choice.count + 1;
        gb_paint_wrap(paint, row, paint->rect.rows - row, GB_STYLE_WARN, now->error.text);
    }
}
