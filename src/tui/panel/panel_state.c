#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "tui/panel/panels.h"

/* One quantity: a name for narrow columns, one for wide ones, and how it is written. */
struct item {
    const char *brief, *name;
    void (*write)(const struct gb_snapshot *now, char *text, size_t size);
};

static void write_number(char *text, size_t size, const char *format, double value)
{
    if (isfinite(value)) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

/* All four pressures in the unit of the largest, so that they can be compared. */
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

static void write_count(char *text, size_t size, double value, const char *unit)
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
    snprintf(text, size, "%.*f%s%s%s", decimals, value,
             prefix[k][0] != '\0' || unit[0] != '\0' ? " " : "", prefix[k], unit);
}

static void density(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.4f", now->now.density);
}

static void contacts(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.2f", now->now.coordination);
}

static void bridged(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.1f %%", 100.0 * now->now.bridged);
}

static void rattlers(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.1f %%", 100.0 * now->now.rattlers);
}

static void p(const struct gb_snapshot *now, char *text, size_t size)
{
    write_pressure(now, now->now.p_pa, text, size);
}

static void px(const struct gb_snapshot *now, char *text, size_t size)
{
    write_pressure(now, now->now.px_pa, text, size);
}

static void py(const struct gb_snapshot *now, char *text, size_t size)
{
    write_pressure(now, now->now.py_pa, text, size);
}

static void pz(const struct gb_snapshot *now, char *text, size_t size)
{
    write_pressure(now, now->now.pz_pa, text, size);
}

static void simulated(const struct gb_snapshot *now, char *text, size_t size)
{
    const double ns = 1e9 * now->now.time_s;
    write_number(text, size, ns < 99.995 ? "%.2f ns" : "%.0f ns", ns);
}

static void stage(const struct gb_snapshot *now, char *text, size_t size)
{
    snprintf(text, size, "%s", gb_panel_plot_stage(now->now.branch));
}

/* "31.2 aJ", "214 fJ": three digits, the prefix below one joule. */
static void write_energy(char *text, size_t size, double value)
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

static void kinetic(const struct gb_snapshot *now, char *text, size_t size)
{
    write_energy(text, size, now->now.kinetic);
}

static void work(const struct gb_snapshot *now, char *text, size_t size)
{
    write_energy(text, size, now->now.work);
}

static void elastic(const struct gb_snapshot *now, char *text, size_t size)
{
    write_energy(text, size, now->now.elastic);
}

static void dissipated(const struct gb_snapshot *now, char *text, size_t size)
{
    write_energy(text, size, now->now.dissipated);
}

static void energy_error(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.2g %%", 100.0 * now->now.energy_residual);
}

static void time_step(const struct gb_snapshot *now, char *text, size_t size)
{
    if (now->time_step_s > 0.0) {
        gb_units_format_short(now->time_step_s, GB_DIM_TIME, 3, text, size);
    }
}

static void residual(const struct gb_snapshot *now, char *text, size_t size)
{
    write_number(text, size, "%.0e", now->live_residual);
}

static void evaluations(const struct gb_snapshot *now, char *text, size_t size)
{
    write_count(text, size, (double)now->evaluations, "");
}

static void rate(const struct gb_snapshot *now, char *text, size_t size)
{
    write_count(text, size, now->evaluations_per_s, "/s");
}

static void work_time(const struct gb_snapshot *now, char *text, size_t size)
{
    gb_paint_time(now->seconds, text, size);
}

/* In the order of columns when all have a place. */
static const struct item still_items[] = {
    {"density", "density", density},
    {"contacts", "contacts a particle", contacts},
    {"bridged", "bridged contacts", bridged},
    {"rattlers", "rattlers", rattlers},
    {"p", "pressure p", p},
    {"px", "  along x", px},
    {"py", "  along y", py},
    {"pz", "  along z", pz},
    {"residual", "residual", residual},
    {"sweeps", "force sweeps", evaluations},
    {"rate", "sweeps a second", rate},
    {"time", "time of work", work_time},
};

enum { STILL_ITEMS = sizeof still_items / sizeof still_items[0] };

/* The most telling first, for panes that have no place for all. */
static const int still_weight[STILL_ITEMS] = {0, 4, 8, 1, 7, 10, 2, 3, 5, 6, 9, 11};

/* Nothing relaxes in a dynamic run: what would be its residual tells how far the forces
 * are from balance. */
static const struct item moving_items[] = {
    {"stage", "stage", stage},
    {"t", "simulated time", simulated},
    {"density", "density", density},
    {"p", "pressure p", p},
    {"px", "  along x", px},
    {"py", "  along y", py},
    {"pz", "  along z", pz},
    {"work", "work done", work},
    {"kin", "kinetic energy", kinetic},
    {"elast", "elastic energy", elastic},
    {"diss", "dissipated", dissipated},
    {"error", "energy error of work", energy_error},
    {"contacts", "contacts a particle", contacts},
    {"bridged", "bridged contacts", bridged},
    {"rattlers", "rattlers", rattlers},
    {"unbal", "unbalanced", residual},
    {"step", "time step", time_step},
    {"rate", "steps a second", rate},
};

enum { MOVING_ITEMS = sizeof moving_items / sizeof moving_items[0] };

static const int moving_weight[MOVING_ITEMS] = {2,  3,  1,  0,  7,  8, 9, 10, 11,
                                                15, 12, 16, 17, 13, 4, 6, 14, 5};

/* The items that apply to a run, in order of columns and of weight. */
struct choice {
    const struct item *item[MOVING_ITEMS], *by_weight[MOVING_ITEMS];
    int count;
};

static bool applies(const struct item *item, const struct gb_params *params)
{
    return item->write != py || params->dimension == 3;
}

static struct choice choose(const struct gb_session *session)
{
    const struct gb_params *params = gb_session_shown(session).params;
    const bool moving = gb_loading_kind_of(params)->columns == GB_COLUMNS_ENERGY;
    const struct item *all = moving ? moving_items : still_items;
    const int *weight = moving ? moving_weight : still_weight;
    struct choice choice = {.count = 0};
    int weighed = 0;
    for (int i = 0; i < (moving ? (int)MOVING_ITEMS : (int)STILL_ITEMS); i++) {
        if (applies(&all[i], params)) {
            choice.item[choice.count++] = &all[i];
        }
        if (applies(&all[weight[i]], params)) {
            choice.by_weight[weighed++] = &all[weight[i]];
        }
    }
    return choice;
}

const char *gb_panel_state_word(int state, enum gb_style *style)
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
    *style = words[state].style;
    return words[state].word;
}

/* "0:12 left" while it runs, "in 3:04" when it is over. */
static void write_left(const struct gb_snapshot *now, char *left, size_t size)
{
    char time[24];
    left[0] = '\0';
    if (now->seconds_left >= 0.0 && now->state <= GB_RUN_PAUSED) {
        snprintf(left, size, "%s left",
                 gb_paint_time(now->seconds_left, time, sizeof time));
    } else if (now->state > GB_RUN_PAUSED) {
        snprintf(left, size, "in %s", gb_paint_time(now->seconds, time, sizeof time));
    }
}

/* State, bar, share and time in one row, or the bar in a row of its own. */
static void draw_progress(const struct gb_paint *paint, const struct gb_session *session,
                          bool own_row)
{
    char left[48];
    enum gb_style style = GB_STYLE_DIM;
    const char *word = "not started";
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    if (shown.curve != NULL) {
        word = gb_panel_state_word(now->state, &style);
    }
    write_left(now, left, sizeof left);
    /* the last step of a dynamic run ends a little before or behind its time */
    const bool done = shown.curve != NULL && now->state == GB_RUN_DONE;
    const double share = done ? 1.0 : now->progress;
    const double percent = floor(100.0 * share);
    const int inner = paint->rect.cols - 2;
    const int end = gb_paint_text(paint, 1, 1, style, word) + 1;
    const int tail = 6 + (left[0] != '\0' ? 1 + (int)strlen(left) : 0);
    if (own_row) {
        gb_paint_bar(paint, 2, 1, inner, share);
        gb_paint_format(paint, 1, 1 + inner - tail, GB_STYLE_PLAIN, "%4.0f %% %s",
                        percent, left);
        return;
    }
    const int bar = inner + 1 - end - tail;
    gb_paint_bar(paint, 1, end, bar > 4 ? bar : 0, share);
    gb_paint_format(paint, 1, end + (bar > 4 ? bar : 0), GB_STYLE_PLAIN, "%4.0f %% %s",
                    percent, left);
}

static void draw_item(const struct gb_paint *paint, int row, int col, int cols,
                      const struct item *item, const struct gb_snapshot *now)
{
    char text[48] = "-";
    if (now->now_valid || item->write == work_time ||
        (item->write == residual && now->evaluations > 0)) {
        item->write(now, text, sizeof text);
    }
    const char *name = cols >= 26 ? item->name : item->brief;
    gb_paint_text(paint, row, col, GB_STYLE_DIM, name);
    gb_paint_text(paint, row, col + cols - (int)strlen(text), GB_STYLE_PLAIN, text);
}

static void draw_items(const struct gb_paint *paint, int first, int rows,
                       const struct gb_snapshot *now, const struct choice *choice)
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
                  all ? choice->item[i] : choice->by_weight[i], now);
    }
}

void gb_panel_state_draw(const struct gb_paint *paint, const struct gb_session *session,
                         bool focus)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_snapshot *now = shown.now;
    gb_paint_title(paint, shown.quick ? "State of the quick cell" : "State", focus);
    const struct choice choice = choose(session);
    const bool roomy = paint->rect.rows >= choice.count + 5;
    draw_progress(paint, session, roomy);
    int row = roomy ? 4 : 2;
    draw_items(paint, row, paint->rect.rows - row, now, &choice);
    if (roomy && now->error.text[0] != '\0') {
        row += choice.count + 1;
        gb_paint_wrap(paint, row, paint->rect.rows - row, GB_STYLE_WARN, now->error.text);
    }
}
