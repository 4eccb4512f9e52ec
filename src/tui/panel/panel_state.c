#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/units.h"
#include "io/status/stage_text.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/panel/panels.h"
#include "tui/session/pressure_rows.h"
#include "tui/session/session.h"

/* The pane of the state: numbers as text, the quantities with a row each, and the columns. */

/* Quantities of the state pane.  A new one is a writing function and a row. */
struct panel_state_item {
    const char *brief, *name; /* for narrow and wide columns */
    void (*write)(const struct gb_session_shown *shown, char *text, size_t size);
    int rank; /* of importance, for panes that are too small for all; 0 is the first */
};

enum { GB_PANEL_STATE_ITEMS = 20 };

/* The items that apply to a run, in the order of the columns and of importance. */
struct panel_state_choice {
    const struct panel_state_item *item[GB_PANEL_STATE_ITEMS];
    const struct panel_state_item *by_rank[GB_PANEL_STATE_ITEMS];
    int count;
};

/* Numbers of the state pane; "-" for what is not finite. */

/* By a format of printf for one double. */
static void panel_state_text_number(char *text, size_t size, const char *format,
                                    double value)
{
    if (isfinite(value)) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

/* "812", "6.31 k", "12.3 M": three digits. */
/* "812", "6.31 k", "12.3 M": three digits. */
static void panel_state_text_count(char *text, size_t size, double value)
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

/* "31.2 aJ", "214 fJ": three digits, the prefix below one joule. */
/* "31.2 aJ", "214 fJ": three digits, the prefix below one joule. */
static void panel_state_text_energy(char *text, size_t size, double value)
{
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

/* All four pressures in the unit of the largest, for comparison. */
static void write_pressure(const struct gb_snapshot *now, double value, char *text,
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

static void density(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.4f", shown->now->now.density);
}

static void contacts(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.2f", shown->now->now.coordination);
}

static void bridged(const struct gb_session_shown *shown, char *text, size_t size)
{
    const double percent = 100.0 * shown->now->now.bridged;
    panel_state_text_number(text, size, percent >= 99.95 ? "%.0f %%" : "%.1f %%",
                            percent);
}

static void rattlers(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.1f %%", 100.0 * shown->now->now.rattlers);
}

static void p(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.p_pa, text, size);
}

static void px(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.px_pa, text, size);
}

static void py(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.py_pa, text, size);
}

static void pz(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.pz_pa, text, size);
}

static void simulated(const struct gb_session_shown *shown, char *text, size_t size)
{
    const double ns = 1e9 * shown->now->now.time_s;
    panel_state_text_number(text, size, ns < 99.995 ? "%.2f ns" : "%.0f ns", ns);
}

static void stage(const struct gb_session_shown *shown, char *text, size_t size)
{
    snprintf(text, size, "%s", gb_panel_plot_stage(shown->now->now.branch));
}

static void kinetic(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_energy(text, size, shown->now->now.kinetic);
}

static void work(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_energy(text, size, shown->now->now.work);
}

static void elastic(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_energy(text, size, shown->now->now.elastic);
}

static void dissipated(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_energy(text, size, shown->now->now.dissipated);
}

static void energy_error(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.2g %%",
                            100.0 * shown->now->now.energy_residual);
}

static void time_step(const struct gb_session_shown *shown, char *text, size_t size)
{
    if (shown->now->time_step_s > 0.0) {
        gb_units_format_short(shown->now->time_step_s, GB_DIM_TIME, 3, text, size);
    }
}

static void residual(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.0e", shown->now->live_residual);
}

static void evaluations(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_count(text, size, (double)shown->now->evaluations);
}

static void rate(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_count(text, size, shown->now->evaluations_per_s);
}

/* "0.7 s", "12:34", "3:04:05"; returns text. */
static char *panel_state_items_duration(double seconds, char *text, size_t size)
{
    if (seconds >= 0.0 && seconds < 59.95) {
        snprintf(text, size, "%.1f s", seconds);
        return text;
    }
    return gb_paint_time(seconds, text, size);
}

static void elapsed_time(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_items_duration(shown->now->seconds, text, size);
}

static void leg(const struct gb_session_shown *shown, char *text, size_t size)
{
    struct gb_path path;
    const double number = shown->now->now.leg;
    if (isfinite(number) &&
        gb_path_parse(&path, shown->params->path, shown->params->dimension, NULL)) {
        snprintf(text, size, "%.0f of %d", number, path.count);
    }
}

static void q(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.q_pa, text, size);
}

/* Shear stresses have the sign of the shear, as in loading.path. */
static void stress_xy(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, -shown->now->now.shear_pa[0], text, size);
}

static void stress_xz(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, -shown->now->now.shear_pa[1], text, size);
}

static void stress_yz(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, -shown->now->now.shear_pa[2], text, size);
}

/* Lengths, "24.1 um"; times, "40.6 us". */
static void write_unit(double value, enum gb_dimension dimension, char *text, size_t size)
{
    if (isfinite(value)) {
        gb_units_format_short(value, dimension, 3, text, size);
    }
}

static void poured(const struct gb_session_shown *shown, char *text, size_t size)
{
    snprintf(text, size, "%lld", (long long)shown->now->stage.poured);
}

static void filled_height(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_unit(shown->now->stage.height_m, GB_DIM_LENGTH, text, size);
}

static void live_contacts(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.2f", shown->now->stage.coordination);
}

static void live_kinetic(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_energy(text, size, shown->now->stage.kinetic_j);
}

static void live_time(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_unit(shown->now->stage.time_s, GB_DIM_TIME, text, size);
}

static void height(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_unit(shown->now->now.height_m, GB_DIM_LENGTH, text, size);
}

static void wall(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_pressure(shown->now, shown->now->now.wall_pa, text, size);
}

static void floor_ratio(const struct gb_session_shown *shown, char *text, size_t size)
{
    panel_state_text_number(text, size, "%.3f", shown->now->now.floor_over_punch);
}

static void die_time(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_unit(shown->now->now.time_s, GB_DIM_TIME, text, size);
}

/* Order of the columns when all fit. */
static const struct panel_state_item still_items[] = {
    {"leg", "leg", leg, 0},
    {"density", "relative density", density, 1},
    {"coord.", "mean coordination number", contacts, 8},
    {"bridged", "bridged contacts", bridged, 11},
    {"rattl.", "rattlers", rattlers, 12},
    {"p", "pressure p", p, 2},
    {"px", "  along x", px, 13},
    {"py", "  along y", py, 14},
    {"pz", "  along z", pz, 9},
    {"q", "deviatoric stress q", q, 3},
    {"xy", "shear stress xy", stress_xy, 5},
    {"xz", "shear stress xz", stress_xz, 4},
    {"yz", "shear stress yz", stress_yz, 6},
    {"residual", "force residual", residual, 7},
    {"evals", "force evaluations", evaluations, 15},
    {"evals/s", "force evaluations/s", rate, 10},
    {"elapsed", "elapsed time", elapsed_time, 16},
};

enum { STILL_ITEMS = sizeof still_items / sizeof still_items[0] };

/* The residual of a dynamic run is the unbalanced force. */
static const struct panel_state_item moving_items[] = {
    {"stage", "stage", stage, 3},
    {"t", "simulated time", simulated, 2},
    {"density", "relative density", density, 0},
    {"p", "pressure p", p, 1},
    {"px", "  along x", px, 14},
    {"py", "  along y", py, 17},
    {"pz", "  along z", pz, 15},
    {"work", "work done", work, 4},
    {"kin", "kinetic energy", kinetic, 5},
    {"elast", "elastic energy", elastic, 6},
    {"diss", "dissipated", dissipated, 7},
    {"E err", "energy balance error", energy_error, 8},
    {"coord.", "mean coordination number", contacts, 10},
    {"bridged", "bridged contacts", bridged, 13},
    {"rattl.", "rattlers", rattlers, 16},
    {"unbal.", "unbalanced force", residual, 9},
    {"step", "time step", time_step, 11},
    {"steps/s", "time steps/s", rate, 12},
};

enum { MOVING_ITEMS = sizeof moving_items / sizeof moving_items[0] };

/* Of a die, before its first point: of the bed as it is now. */
static const struct panel_state_item filling_items[] = {
    {"in die", "particles in the die", poured, 0},
    {"height", "height of the powder", filled_height, 1},
    {"coord.", "mean coordination number", live_contacts, 3},
    {"kin", "kinetic energy", live_kinetic, 2},
    {"unbal.", "unbalanced force", residual, 4},
    {"t", "simulated time", live_time, 6},
    {"step", "time step", time_step, 9},
    {"steps", "time steps", evaluations, 8},
    {"steps/s", "time steps/s", rate, 5},
    {"elapsed", "elapsed time", elapsed_time, 7},
};

enum { FILLING_ITEMS = sizeof filling_items / sizeof filling_items[0] };

/* And at its points. */
static const struct panel_state_item die_items[] = {
    {"density", "relative density", density, 0},
    {"height", "height of the powder", height, 3},
    {"coord.", "mean coordination number", contacts, 2},
    {"rattl.", "rattlers", rattlers, 7},
    {"p", "pressure p", p, 1},
    {"wall", "radial pressure on the wall", wall, 5},
    {"floor/p", "floor-to-punch force ratio", floor_ratio, 4},
    {"unbal.", "unbalanced force", residual, 8},
    {"t", "simulated time", die_time, 9},
    {"steps", "time steps", evaluations, 11},
    {"steps/s", "time steps/s", rate, 6},
    {"elapsed", "elapsed time", elapsed_time, 10},
};

enum { DIE_ITEMS = sizeof die_items / sizeof die_items[0] };

/* The quantities of a run. */
struct list {
    const struct panel_state_item *item;
    int count;
};

static const struct list still = {still_items, STILL_ITEMS},
                         moving = {moving_items, MOVING_ITEMS},
                         filling = {filling_items, FILLING_ITEMS},
                         die = {die_items, DIE_ITEMS};

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

/* Some leg of the path strains or holds this component. */
static bool sheared(const struct gb_path *path, int component)
{
    bool moved = false;
    for (int l = 0; l < path->count; l++) {
        const struct gb_leg_component *control = &path->leg[l].component[component];
        moved = moved || control->control != GB_LEG_STRAIN || control->value != 0.0;
    }
    return moved;
}

static bool applies(const struct panel_state_item *item, const struct gb_params *params,
                    const struct gb_path *path)
{
    if (item->write == leg || item->write == q) {
        return path->count > 0;
    }
    return item->write == py          ? params->dimension == 3
           : item->write == stress_xy ? sheared(path, 3)
           : item->write == stress_xz ? sheared(path, 4)
           : item->write == stress_yz ? sheared(path, 5)
                                      : true;
}

static struct panel_state_choice
panel_state_items_choose(const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_params *params = shown.params;
    const struct list *list = list_of(&shown);
    struct panel_state_choice choice = {.count = 0};
    struct gb_path path = {.count = 0};
    if (!gb_loading_kind_follows_path(params) ||
        !gb_path_parse(&path, params->path, params->dimension, NULL)) {
        path.count = 0;
    }
    for (int i = 0; i < list->count; i++) {
        const struct panel_state_item *item = &list->item[i];
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

static bool is_of(const struct list *list, const struct panel_state_item *item)
{
    return item >= list->item && item < list->item + list->count;
}

/* Value of an item; "-" where there is none yet.  Without a state there are elapsed time,
 * residual and the items of a die that is filled. */
static void panel_state_items_write(const struct panel_state_item *item,
                                    const struct gb_session_shown *shown, char *text,
                                    size_t size)
{
    const struct gb_snapshot *now = shown->now;
    snprintf(text, size, "-");
    const bool evaluated =
        now->evaluations > 0 && (item->write == residual || is_of(&filling, item));
    if (now->now_valid || item->write == elapsed_time || evaluated) {
        item->write(shown, text, size);
    }
}

/* Width of a column from which on names are not abbreviated; least width of the bar. */
enum { FULL_NAME_COLS = 30, BAR_MIN = 4 };

/* Height of a pane that has a line for the density at a pressure, for that of replicas. */
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
    gb_stage_text_value(stage, value, sizeof value);
    snprintf(text, size, "%s%s%s", gb_stage_text_name(stage->stage),
             value[0] != '\0' ? " " : "", value);
    if ((int)strlen(text) > cols) {
        snprintf(text, size, "%s", gb_stage_text_name(stage->stage));
    }
    return (int)strlen(text) <= cols;
}

/* "done in 0.7 s", "stopped after 3:04"; of a live run only the state. */
static void write_state(const struct gb_snapshot *now, const char *word, char *text,
                        size_t size)
{
    char time[24];
    if (now->state > GB_RUN_PAUSED) {
        panel_state_items_duration(now->seconds, time, sizeof time);
        snprintf(text, size, "%s %s %s", word, now->state == GB_RUN_DONE ? "in" : "after",
                 time);
    } else {
        snprintf(text, size, "%s", word);
    }
}

/* " 45 %", " 45 % 0:12 left"; " 45 % estimating" where powder comes to rest when it does. */
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

/* The stage in place of the word "running". */
static void write_stage(const struct gb_snapshot *now, int cols, char *text, size_t size)
{
    char stage[128];
    if (gb_panel_state_stage(now, now->state, cols - 2, stage, sizeof stage)) {
        snprintf(text, size, "\u25b6 %s", stage);
    }
}

/* State, bar, percentage and time in one row, or the bar in a row of its own. */
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
    /* the last time step of a dynamic run ends slightly before or after its end time */
    const bool done = shown.curve != NULL && now->state == GB_RUN_DONE;
    const double share = done ? 1.0 : now->progress;
    const int inner = paint->rect.cols - 2;
    write_share(now, share, tail, sizeof tail);
    if (!own_row && shown.curve != NULL) {
        write_stage(now, inner - (int)strlen(tail), state, sizeof state);
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
                      const struct panel_state_item *item,
                      const struct gb_session_shown *shown)
{
    char text[48];
    panel_state_items_write(item, shown, text, sizeof text);
    const char *name = cols >= FULL_NAME_COLS ? item->name : item->brief;
    gb_paint_cell(paint, row, col, cols - 1 - (int)strlen(text), GB_STYLE_DIM, name);
    gb_paint_text(paint, row, col + cols - (int)strlen(text), GB_STYLE_PLAIN, text);
}

static void draw_items(const struct gb_paint *paint, int first, int rows,
                       const struct gb_session_shown *shown,
                       const struct panel_state_choice *choice)
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

/* What the density is of: the quick cell or the run, or the mean of replicas of the run. */
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
                          gb_params_diff_count(&band->params, shown->params) == 0;
        if (of_shown || mean) {
            *row = rows.row[i];
            found = true;
        }
    }
    return found;
}

/* "(5 cells)", "(cell scatter)": what the error is, the longest of three that fits. */
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

/* "rho(100 MPa) = 0.4062 +- 0.0064" and "(cell scatter)", the latter for a row of `cols`
 * columns behind the former, or of its own where it has no room there.  False: not
 * reached. */
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

/* In a row, or in two where there is room for them; returns how many. */
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
    const struct panel_state_choice choice = panel_state_items_choose(session);
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
