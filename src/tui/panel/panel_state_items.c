#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/panel/panel_state_items.h"
#include "tui/panel/panel_state_text.h"
#include "tui/panel/panels.h"

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
    gb_panel_state_text_number(text, size, "%.4f", shown->now->now.density);
}

static void contacts(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_number(text, size, "%.2f", shown->now->now.coordination);
}

static void bridged(const struct gb_session_shown *shown, char *text, size_t size)
{
    const double percent = 100.0 * shown->now->now.bridged;
    gb_panel_state_text_number(text, size, percent >= 99.95 ? "%.0f %%" : "%.1f %%", percent);
}

static void rattlers(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_number(text, size, "%.1f %%", 100.0 * shown->now->now.rattlers);
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
    gb_panel_state_text_number(text, size, ns < 99.995 ? "%.2f ns" : "%.0f ns", ns);
}

static void stage(const struct gb_session_shown *shown, char *text, size_t size)
{
    snprintf(text, size, "%s", gb_panel_plot_stage(shown->now->now.branch));
}

static void kinetic(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_energy(text, size, shown->now->now.kinetic);
}

static void work(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_energy(text, size, shown->now->now.work);
}

static void elastic(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_energy(text, size, shown->now->now.elastic);
}

static void dissipated(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_energy(text, size, shown->now->now.dissipated);
}

static void energy_error(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_number(text, size, "%.2g %%", 100.0 * shown->now->now.energy_residual);
}

static void time_step(const struct gb_session_shown *shown, char *text, size_t size)
{
    if (shown->now->time_step_s > 0.0) {
        gb_units_format_short(shown->now->time_step_s, GB_DIM_TIME, 3, text, size);
    }
}

static void residual(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_number(text, size, "%.0e", shown->now->live_residual);
}

static void evaluations(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_count(text, size, (double)shown->now->evaluations);
}

static void rate(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_count(text, size, shown->now->evaluations_per_s);
}

char *gb_panel_state_items_duration(double seconds, char *text, size_t size)
{
    if (seconds >= 0.0 && seconds < 59.95) {
        snprintf(text, size, "%.1f s", seconds);
        return text;
    }
    return gb_paint_time(seconds, text, size);
}

static void elapsed_time(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_items_duration(shown->now->seconds, text, size);
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
    gb_panel_state_text_number(text, size, "%.2f", shown->now->stage.coordination);
}

static void live_kinetic(const struct gb_session_shown *shown, char *text, size_t size)
{
    gb_panel_state_text_energy(text, size, shown->now->stage.kinetic_j);
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
    gb_panel_state_text_number(text, size, "%.3f", shown->now->now.floor_over_punch);
}

static void die_time(const struct gb_session_shown *shown, char *text, size_t size)
{
    write_unit(shown->now->now.time_s, GB_DIM_TIME, text, size);
}

/* Order of the columns when all fit. */
static const struct gb_panel_state_item still_items[] = {
    {"leg", "leg", leg},
    {"density", "relative density", density},
    {"coord.", "mean coordination number", contacts},
    {"bridged", "bridged contacts", bridged},
    {"rattl.", "rattlers", rattlers},
    {"p", "pressure p", p},
    {"px", "  along x", px},
    {"py", "  along y", py},
    {"pz", "  along z", pz},
    {"q", "deviatoric stress q", q},
    {"xy", "shear stress xy", stress_xy},
    {"xz", "shear stress xz", stress_xz},
    {"yz", "shear stress yz", stress_yz},
    {"residual", "force residual", residual},
    {"evals", "force evaluations", evaluations},
    {"evals/s", "force evaluations/s", rate},
    {"elapsed", "elapsed time", elapsed_time},
};

enum { STILL_ITEMS = sizeof still_items / sizeof still_items[0] };

/* Order of importance, for panes that are too small for all. */
static const int still_weight[STILL_ITEMS] = {0, 1,  5, 9, 11, 10, 12, 13, 2,
                                              8, 15, 3, 4, 6,  7,  14, 16};

/* The residual of a dynamic run is the unbalanced force. */
static const struct gb_panel_state_item moving_items[] = {
    {"stage", "stage", stage},
    {"t", "simulated time", simulated},
    {"density", "relative density", density},
    {"p", "pressure p", p},
    {"px", "  along x", px},
    {"py", "  along y", py},
    {"pz", "  along z", pz},
    {"work", "work done", work},
    {"kin", "kinetic energy", kinetic},
    {"elast", "elastic energy", elastic},
    {"diss", "dissipated", dissipated},
    {"E err", "energy balance error", energy_error},
    {"coord.", "mean coordination number", contacts},
    {"bridged", "bridged contacts", bridged},
    {"rattl.", "rattlers", rattlers},
    {"unbal.", "unbalanced force", residual},
    {"step", "time step", time_step},
    {"steps/s", "time steps/s", rate},
};

enum { MOVING_ITEMS = sizeof moving_items / sizeof moving_items[0] };

static const int moving_weight[MOVING_ITEMS] = {2,  3,  1,  0,  7,  8, 9, 10, 11,
                                                15, 12, 16, 17, 13, 4, 6, 14, 5};

/* Of a die, before its first point: of the bed as it is now. */
static const struct gb_panel_state_item filling_items[] = {
    {"in die", "particles in the die", poured},
    {"height", "height of the powder", filled_height},
    {"coord.", "mean coordination number", live_contacts},
    {"kin", "kinetic energy", live_kinetic},
    {"unbal.", "unbalanced force", residual},
    {"t", "simulated time", live_time},
    {"step", "time step", time_step},
    {"steps", "time steps", evaluations},
    {"steps/s", "time steps/s", rate},
    {"elapsed", "elapsed time", elapsed_time},
};

enum { FILLING_ITEMS = sizeof filling_items / sizeof filling_items[0] };

static const int filling_weight[FILLING_ITEMS] = {0, 1, 3, 2, 4, 8, 5, 9, 7, 6};

/* And at its points. */
static const struct gb_panel_state_item die_items[] = {
    {"density", "relative density", density},
    {"height", "height of the powder", height},
    {"coord.", "mean coordination number", contacts},
    {"rattl.", "rattlers", rattlers},
    {"p", "pressure p", p},
    {"wall", "radial pressure on the wall", wall},
    {"floor/p", "floor-to-punch force ratio", floor_ratio},
    {"unbal.", "unbalanced force", residual},
    {"t", "simulated time", die_time},
    {"steps", "time steps", evaluations},
    {"steps/s", "time steps/s", rate},
    {"elapsed", "elapsed time", elapsed_time},
};

enum { DIE_ITEMS = sizeof die_items / sizeof die_items[0] };

static const int die_weight[DIE_ITEMS] = {0, 4, 2, 1, 6, 5, 10, 3, 7, 8, 11, 9};

/* The quantities of a run, and their order of importance. */
struct list {
    const struct gb_panel_state_item *item;
    const int *weight;
    int count;
};

static const struct list still = {still_items, still_weight, STILL_ITEMS},
                         moving = {moving_items, moving_weight, MOVING_ITEMS},
                         filling = {filling_items, filling_weight, FILLING_ITEMS},
                         die = {die_items, die_weight, DIE_ITEMS};

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

static bool applies(const struct gb_panel_state_item *item,
                    const struct gb_params *params, const struct gb_path *path)
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

struct gb_panel_state_choice gb_panel_state_items_choose(const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    const struct gb_params *params = shown.params;
    const struct list *list = list_of(&shown);
    struct gb_panel_state_choice choice = {.count = 0};
    struct gb_path path = {.count = 0};
    int weighed = 0;
    if (!gb_loading_kind_follows_path(params) ||
        !gb_path_parse(&path, params->path, params->dimension, NULL)) {
        path.count = 0;
    }
    for (int i = 0; i < list->count; i++) {
        if (applies(&list->item[i], params, &path)) {
            choice.item[choice.count++] = &list->item[i];
        }
        if (applies(&list->item[list->weight[i]], params, &path)) {
            choice.by_weight[weighed++] =
                &list->item[list->weight[i]];
        }
    }
    return choice;
}

static bool is_of(const struct list *list, const struct gb_panel_state_item *item)
{
    return item >= list->item && item < list->item + list->count;
}

/* Items of a run without state: elapsed time, the residual, those of a die that is filled. */
void gb_panel_state_items_write(const struct gb_panel_state_item *item,
                                const struct gb_session_shown *shown, char *text,
                                size_t size)
{
    const struct gb_snapshot *now = shown->now;
    snprintf(text, size, "-");
    const bool evaluated = now->evaluations > 0 &&
                           (item->write == residual || is_of(&filling, item));
    if (now->now_valid || item->write == elapsed_time || evaluated) {
        item->write(shown, text, size);
    }
}
