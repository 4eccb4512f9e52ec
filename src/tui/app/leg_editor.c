/* The editor of loading.path.  The first part plans a path from its text: pressures,
 * stresses and strains at the ends of the legs, as far as they do not depend on the
 * packing, and a sketch of them.  The second part keeps the legs as texts with their
 * errors, describes a leg in words, and handles keys and drawing. */
#include "tui/app/leg_editor.h"

#include <glib.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "scene/path/path.h"
#include "tui/app/keys.h"
#include "tui/panel/plot.h"

/* Reversals of a cycle in the sketch; steps of the search for an end. */
enum { REVERSALS = 4, HALVINGS = 60, DOUBLINGS = 60 };

struct state {
    double stress[GB_PATH_COMPONENTS]; /* sign as in struct gb_path, Pa */
    int dimension;
};

static double mean(const struct state *state)
{
    const double *s = state->stress;
    return state->dimension == 3 ? (s[0] + s[1] + s[2]) / 3.0 : 0.5 * (s[0] + s[2]);
}

static double deviatoric(const struct state *state)
{
    const double *s = state->stress;
    if (state->dimension == 2) {
        return hypot(s[0] - s[2], 2.0 * s[4]);
    }
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    return sqrt(0.5 * (xy * xy + yz * yz + zx * zx) +
                3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

static bool led(const struct gb_leg *leg, int k)
{
    return leg->component[k].control == GB_LEG_STRAIN && leg->component[k].value != 0.0;
}

/* Are all axes strained equally, and nothing else moved? */
static bool isotropic(const struct gb_leg *leg, int dimension)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if (gb_path_has_component(dimension, k) &&
            (leg->component[k].control != GB_LEG_STRAIN ||
             leg->component[k].value != (k < 3 ? 1.0 : 0.0))) {
            return false;
        }
    }
    return true;
}

/* Sets the stresses of a leg from their values at its start, when the stress of the
 * leading component is t. */
static void set_stresses(const struct gb_leg *leg, const struct state *from, double t,
                         struct state *to)
{
    const bool even = isotropic(leg, from->dimension);
    for (int k = 0; k < GB_PATH_COMPONENTS && leg->leading >= 0; k++) {
        const bool still = k >= 3 && from->stress[k] == 0.0 && !led(leg, k);
        to->stress[k] = k == leg->leading || (even && led(leg, k)) ? t
                        : still                                    ? 0.0
                                                                   : (double)NAN;
    }
    /* twice, because a ratio may refer to a later component */
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
            const struct gb_leg_component *c = &leg->component[k];
            const double before = from->stress[k];
            const double other = c->of >= 0 ? from->stress[c->of] : (double)NAN;
            if (c->control == GB_LEG_STRESS) {
                to->stress[k] = isfinite(c->value) ? c->value : before;
            } else if (c->control == GB_LEG_RATIO) {
                const double ratio = isfinite(c->value)              ? c->value
                                     : before == 0.0 && other == 0.0 ? (double)NAN
                                                                     : before / other;
                to->stress[k] =
                    to->stress[c->of] == 0.0 ? 0.0 : ratio * to->stress[c->of];
            } else if (c->control == GB_LEG_FOLLOW) {
                to->stress[k] = before + c->value * (to->stress[c->of] - other);
            }
        }
    }
}

static double end_value(const struct gb_leg *leg, const struct gb_leg_end *end,
                        const struct state *state)
{
    double sum = 0.0;
    int count = 0;
    switch (end->kind) {
    case GB_LEG_END_PRESSURE:
        for (int k = 0; k < 3; k++) {
            sum += led(leg, k) ? state->stress[k] : 0.0;
            count += led(leg, k);
        }
        return count > 0 ? sum / count : (double)NAN;
    case GB_LEG_END_STRESS:
        return state->stress[end->of];
    case GB_LEG_END_MEAN:
        return mean(state);
    case GB_LEG_END_Q:
        return deviatoric(state);
    case GB_LEG_END_RATIO:
        return deviatoric(state) / mean(state);
    default:
        return (double)NAN;
    }
}

static double value_at(const struct gb_leg *leg, const struct gb_leg_end *end,
                       const struct state *from, double t)
{
    struct state there = *from;
    set_stresses(leg, from, t, &there);
    return end_value(leg, end, &there);
}

/* Is the leading stress the pressure that strain raises? */
static bool one_pressure(const struct gb_leg *leg, const struct state *from)
{
    return isotropic(leg, from->dimension) ||
           led(leg, 0) + led(leg, 1) + led(leg, 2) == 1;
}

/* The leading stress at which an end is reached, in the direction in which the leg
 * moves; NaN: it does not follow from the text. */
static double solve(const struct gb_leg *leg, const struct gb_leg_end *end,
                    const struct state *from)
{
    const double begun = leg->leading >= 0 ? from->stress[leg->leading] : (double)NAN;
    const double t0 = isfinite(begun) ? begun : 0.0;
    const bool direct = (end->kind == GB_LEG_END_STRESS && end->of == leg->leading) ||
                        (end->kind == GB_LEG_END_PRESSURE && one_pressure(leg, from));
    const double rise = end->value - value_at(leg, end, from, t0);
    const bool unsigned_end = end->kind >= GB_LEG_END_Q;
    if (direct) {
        return end->value;
    }
    if (leg->leading < 0 || !isfinite(rise)) {
        return (double)NAN;
    }
    const double side = unsigned_end ? leg->extension ? -1.0 : 1.0
                        : rise < 0.0 ? -1.0
                                     : 1.0;
    double near = 0.0, far = side * fmax(fabs(t0), 1e3) * 1e-3;
    for (int i = 0; i < DOUBLINGS; i++) {
        const double rest = end->value - value_at(leg, end, from, t0 + far);
        if (rest == 0.0 || rest * rise < 0.0) {
            break;
        }
        near = far;
        far *= 2.0;
    }
    for (int i = 0; i < HALVINGS; i++) {
        const double half = 0.5 * (near + far);
        const double rest = end->value - value_at(leg, end, from, t0 + half);
        *(rest * rise > 0.0 ? &near : &far) = half;
    }
    const double missed = end->value - value_at(leg, end, from, t0 + far);
    return fabs(missed) <= 1e-6 * fabs(rise) ? t0 + far : (double)NAN;
}

static void leg_sketch_add(struct gb_leg_plan *plan, int leg, const struct state *state,
                           double strain)
{
    if (plan->count < GB_LEG_PLAN_STATES) {
        plan->state[plan->count++] =
            (struct gb_leg_plan_state){leg, mean(state), fabs(deviatoric(state)), strain};
    }
}

/* The end that follows from the text, or the first if none does. */
static const struct gb_leg_end *choose_end(const struct gb_leg *leg,
                                           const struct state *from, double *t)
{
    for (int e = 0; e < leg->end_count; e++) {
        *t = solve(leg, &leg->end[e], from);
        if (isfinite(*t)) {
            return &leg->end[e];
        }
    }
    return &leg->end[0];
}

static double strain_of(const struct gb_leg_end *end)
{
    return end->kind == GB_LEG_END_STRAIN ? end->value : (double)NAN;
}

static void follow(struct gb_leg_plan *plan, const struct gb_leg *leg, int number,
                   struct state *state)
{
    const struct state from = *state;
    const int reversals = leg->cycles > REVERSALS / 2 ? REVERSALS : 2 * leg->cycles;
    double t = (double)NAN;
    for (int reversal = 0; reversal < reversals; reversal++) {
        const struct gb_leg_end *end = &leg->end[reversal % 2];
        set_stresses(leg, &from, solve(leg, end, &from), state);
        leg_sketch_add(plan, number, state, strain_of(end));
    }
    if (reversals == 0) {
        const struct gb_leg_end *end = choose_end(leg, &from, &t);
        const double strain = leg->end_count == 1 ? strain_of(end)
                              : leg->end[1].kind == GB_LEG_END_STRAIN
                                  ? strain_of(&leg->end[1])
                                  : strain_of(&leg->end[0]);
        set_stresses(leg, &from, t, state);
        leg_sketch_add(plan, number, state, strain);
    }
}

void gb_leg_editor_plan(struct gb_leg_plan *plan, const struct gb_path *path,
                        int dimension)
{
    struct state state = {.dimension = dimension};
    plan->count = 0;
    leg_sketch_add(plan, 0, &state, 0.0);
    for (int l = 0; l < path->count; l++) {
        follow(plan, &path->leg[l], l + 1, &state);
    }
}

/* Room for the label of the x axis, as a fraction of the range of the path. */
static const double label_share = 0.3;

/* Two states of a plan and their positions in the sketch. */
struct leg_sketch_line {
    double x[2], y[2];
};

int gb_leg_editor_mark(int leg)
{
    return leg <= 9 ? '0' + leg : 'a' + (leg - 10) % 26;
}

/* A line in the (p, q) plane.  Legs with unknown stresses interrupt the path. */
static bool stress_line(const struct gb_leg_plan *plan, int i,
                        struct leg_sketch_line *line)
{
    const struct gb_leg_plan_state *from = &plan->state[i - 1], *to = &plan->state[i];
    *line = (struct leg_sketch_line){{1e-6 * from->p, 1e-6 * to->p},
                                     {1e-6 * from->q, 1e-6 * to->q}};
    return isfinite(to->p) && isfinite(to->q) && isfinite(from->p) && isfinite(from->q);
}

/* A line in the strain sketch.  Reversals of a leg are side by side; a new leg begins
 * at strain 0. */
static bool strain_line(const struct gb_leg_plan *plan, int i,
                        struct leg_sketch_line *line)
{
    const struct gb_leg_plan_state *from = &plan->state[i - 1], *to = &plan->state[i];
    const double begun = from->leg == to->leg ? from->strain : 0.0;
    *line = (struct leg_sketch_line){{i - 1, i}, {100.0 * begun, 100.0 * to->strain}};
    return isfinite(to->strain) && isfinite(begun);
}

typedef bool line_of(const struct gb_leg_plan *plan, int i, struct leg_sketch_line *line);

static int count_lines(const struct gb_leg_plan *plan, int leg, line_of *of)
{
    struct leg_sketch_line line;
    int count = 0;
    for (int i = 1; i < plan->count; i++) {
        count += (leg == 0 || plan->state[i].leg == leg) && of(plan, i, &line);
    }
    return count;
}

static void extend(double ends[2], const double value[2])
{
    ends[0] = fmin(ends[0], fmin(value[0], value[1]));
    ends[1] = fmax(ends[1], fmax(value[0], value[1]));
}

static void draw_lines(const struct gb_leg_plan *plan, int focus, line_of *of,
                       const char *x_label, const char *y_label, struct gb_plot *plot)
{
    double x[2] = {0.0, 0.0}, y[2] = {0.0, 0.0};
    struct leg_sketch_line line;
    for (int i = 1; i < plan->count; i++) {
        if (of(plan, i, &line)) {
            extend(x, line.x);
            extend(y, line.y);
        }
    }
    x[1] += label_share * (x[1] - x[0]);
    y[1] = y[0] == y[1] ? fmax(0.5 * x[1], 1.0) : y[1];
    gb_plot_axes(plot, x, y, GB_PLOT_LINEAR, x_label, y_label);
    for (int i = 1; i < plan->count; i++) {
        const int leg = plan->state[i].leg;
        if (of(plan, i, &line)) {
            gb_plot_line(plot, &(struct gb_plot_series){
                                   .x = line.x,
                                   .y = line.y,
                                   .count = 2,
                                   .ink = GB_PLOT_INK_SERIES + (leg == focus ? 0 : 1),
                                   .marker = gb_leg_editor_mark(leg)});
        }
    }
}

void gb_leg_editor_sketch(const struct gb_path *path, int dimension, int focus,
                          struct gb_plot *plot)
{
    struct gb_leg_plan plan;
    gb_leg_editor_plan(&plan, path, dimension);
    const bool strain = count_lines(&plan, focus, strain_line) > 0;
    if (count_lines(&plan, focus, stress_line) > 0) {
        draw_lines(&plan, focus, stress_line, "p, MPa", "q, MPa", plot);
    } else if (strain) {
        draw_lines(&plan, focus, strain_line, "legs", "strain, %", plot);
    } else {
        gb_plot_text(plot, 0, 0, GB_PLOT_INK_TEXT, "p and q of this leg follow");
        gb_plot_text(plot, 1, 0, GB_PLOT_INK_TEXT, "from the packing");
    }
}

/* The editor: the legs as texts, a leg in words, keys, drawing. */

/* The legs being edited, one text each, with their errors. */

static int leg_list_count(const struct gb_leg_list *list)
{
    return (int)list->text->len;
}

static const char *leg_list_at(const struct gb_leg_list *list, int at)
{
    return g_ptr_array_index(list->text, at);
}

/* Parses all texts again, because the meaning of a leg may depend on the legs before
 * it. */
static void read_legs(struct gb_leg_list *list)
{
    list->path.count = 0;
    list->errors = 0;
    for (int i = 0; i < leg_list_count(list); i++) {
        list->error[i] = (struct gb_error){0};
        const bool good = gb_path_parse_leg(&list->path, leg_list_at(list, i),
                                            list->dimension, &list->error[i]);
        list->index[i] = good ? list->path.count - 1 : -1;
        list->errors += !good;
    }
}

static int put(struct gb_leg_list *list, int at, const char *text)
{
    char **legs = gb_path_parse_split(text);
    int count = 0;
    for (; legs[count] != NULL; count++) {
        if (legs[count][0] != '\0' && list->text->len < GB_LEG_LIST_MAX) {
            g_ptr_array_insert(list->text, at + count, g_strdup(legs[count]));
        }
    }
    g_strfreev(legs);
    return count;
}

void gb_leg_editor_list_init(struct gb_leg_list *list, const char *text, int dimension)
{
    *list = (struct gb_leg_list){.text = g_ptr_array_new_with_free_func(g_free),
                                 .former = g_ptr_array_new_with_free_func(g_free),
                                 .dimension = dimension};
    put(list, 0, text);
    read_legs(list);
}

void gb_leg_editor_list_finish(struct gb_leg_list *list)
{
    if (list->text != NULL) {
        g_ptr_array_unref(list->text);
        g_ptr_array_unref(list->former);
    }
    *list = (struct gb_leg_list){0};
}

const struct gb_leg *gb_leg_editor_list_leg(const struct gb_leg_list *list, int at)
{
    return at < leg_list_count(list) && list->index[at] >= 0
               ? &list->path.leg[list->index[at]]
               : NULL;
}

char *gb_leg_editor_list_join(const struct gb_leg_list *list)
{
    GString *all = g_string_new(NULL);
    for (int i = 0; i < leg_list_count(list); i++) {
        g_string_append_printf(all, "%s%s", i > 0 ? "; " : "", leg_list_at(list, i));
    }
    return g_string_free(all, FALSE);
}

static void remember(struct gb_leg_list *list)
{
    g_ptr_array_add(list->former, gb_leg_editor_list_join(list));
}

int gb_leg_editor_list_insert(struct gb_leg_list *list, int at, const char *text)
{
    remember(list);
    const int count = put(list, at, text);
    read_legs(list);
    return count;
}

int gb_leg_editor_list_replace(struct gb_leg_list *list, int at, const char *text)
{
    remember(list);
    g_ptr_array_remove_index(list->text, (guint)at);
    const int count = put(list, at, text);
    read_legs(list);
    return count;
}

void gb_leg_editor_list_remove(struct gb_leg_list *list, int at)
{
    remember(list);
    g_ptr_array_remove_index(list->text, (guint)at);
    read_legs(list);
}

bool gb_leg_editor_list_move(struct gb_leg_list *list, int at, int by)
{
    const int to = at + by;
    if (at < 0 || at >= leg_list_count(list) || to < 0 || to >= leg_list_count(list)) {
        return false;
    }
    remember(list);
    gpointer *text = list->text->pdata;
    gpointer moved = text[at];
    text[at] = text[to];
    text[to] = moved;
    read_legs(list);
    return true;
}

void gb_leg_editor_list_set(struct gb_leg_list *list, const char *text)
{
    remember(list);
    g_ptr_array_set_size(list->text, 0);
    put(list, 0, text);
    read_legs(list);
}

bool gb_leg_editor_list_undo(struct gb_leg_list *list)
{
    if (list->former->len == 0) {
        return false;
    }
    char *text = g_ptr_array_steal_index(list->former, list->former->len - 1);
    g_ptr_array_set_size(list->text, 0);
    put(list, 0, text);
    read_legs(list);
    g_free(text);
    return true;
}

bool gb_leg_editor_list_try(const struct gb_leg_list *list, int at, const char *text,
                            struct gb_leg *leg, struct gb_error *err)
{
    struct gb_path path = {.count = 0};
    char **legs = gb_path_parse_split(text);
    for (int i = 0; i < at; i++) {
        struct gb_error ignored = {0};
        gb_path_parse_leg(&path, leg_list_at(list, i), list->dimension, &ignored);
    }
    bool good = true;
    for (int i = 0; legs[i] != NULL && good; i++) {
        good = gb_path_parse_leg(&path, legs[i], list->dimension, err);
    }
    if (good && path.count > 0) {
        *leg = path.leg[path.count - 1];
    }
    g_strfreev(legs);
    return good;
}

/* Appends to a member of struct gb_leg_words. */
static void leg_words_add(char *text, const char *separator, const char *format, ...)
{
    char more[GB_LEG_WORDS];
    va_list list;
    va_start(list, format);
    vsnprintf(more, sizeof more, format, list);
    va_end(list);
    if (text[0] != '\0') {
        g_strlcat(text, separator, GB_LEG_WORDS);
    }
    g_strlcat(text, more, GB_LEG_WORDS);
}

static bool is_fixed(const struct gb_leg_component *component)
{
    return component->control == GB_LEG_STRAIN && component->value == 0.0;
}

/* Adds "xz", or "-0.5 x" in proportion to the leading component. */
static void add_leading(const struct gb_leg *leg, int k, char *text)
{
    const double share = leg->component[k].value;
    const char *name = gb_path_component_name(k);
    if (share == 1.0) {
        leg_words_add(text, ", ", "%s", name);
    } else {
        leg_words_add(text, ", ", "%g %s", share, name);
    }
}

static void add_held(const struct gb_leg *leg, int k, char *text)
{
    const struct gb_leg_component *component = &leg->component[k];
    const char *name = gb_path_component_name(k);
    const char *of = component->of >= 0 ? gb_path_component_name(component->of) : "";
    char pressure[32];
    const bool known = isfinite(component->value);
    if (component->control == GB_LEG_STRESS && known) {
        gb_units_format_short(component->value, GB_DIM_PRESSURE, 4, pressure,
                              sizeof pressure);
        leg_words_add(text, ", ", "%s at %s", name, pressure);
    } else if (component->control == GB_LEG_STRESS) {
        leg_words_add(text, ", ", "%s as it is", name);
    } else if (component->control == GB_LEG_FOLLOW) {
        leg_words_add(text, ", ", "%s changes by %g %s", name, component->value, of);
    } else if (known) {
        leg_words_add(text, ", ", "%s = %g %s", name, component->value, of);
    } else {
        leg_words_add(text, ", ", "%s in proportion to %s", name, of);
    }
}

static void add_end(const struct gb_leg *leg, const struct gb_leg_end *end, char *text)
{
    char value[32];
    const char *separator = leg->cycles > 0 ? " and " : " or ";
    switch (end->kind) {
    case GB_LEG_END_STEPS:
        leg_words_add(text, separator, "after %g point%s", end->value,
                      end->value == 1.0 ? "" : "s");
        return;
    case GB_LEG_END_STRAIN:
        leg_words_add(text, separator, "at strain %g %% of %s", 100.0 * end->value,
                      leg->leading >= 0 ? gb_path_component_name(leg->leading) : "-");
        return;
    case GB_LEG_END_DENSITY:
        leg_words_add(text, separator, "at relative density %g", end->value);
        return;
    case GB_LEG_END_RATIO:
        leg_words_add(text, separator, "at q/p = %g", end->value);
        return;
    default:
        break;
    }
    gb_units_format_short(end->value, GB_DIM_PRESSURE, 4, value, sizeof value);
    leg_words_add(text, separator, "at %s = %s",
                  end->kind == GB_LEG_END_PRESSURE ? "pressure"
                  : end->kind == GB_LEG_END_MEAN   ? "p"
                  : end->kind == GB_LEG_END_Q      ? "q"
                                                   : gb_path_component_name(end->of),
                  value);
}

void gb_leg_editor_words(const struct gb_leg *leg, int dimension,
                         struct gb_leg_words *words)
{
    *words = (struct gb_leg_words){.leads = ""};
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const struct gb_leg_component *component = &leg->component[k];
        if (!gb_path_has_component(dimension, k)) {
            continue;
        }
        if (component->control != GB_LEG_STRAIN) {
            add_held(leg, k, words->held);
        } else if (is_fixed(component)) {
            leg_words_add(words->fixed, ", ", "%s", gb_path_component_name(k));
        } else {
            add_leading(leg, k, words->leads);
        }
    }
    for (int e = 0; e < leg->end_count; e++) {
        add_end(leg, &leg->end[e], words->ends);
    }
    if (leg->cycles > 0) {
        char between[GB_LEG_WORDS];
        g_strlcpy(between, words->ends, sizeof between);
        snprintf(words->ends, sizeof words->ends, "%d time%s there and back: %.120s",
                 leg->cycles, leg->cycles == 1 ? "" : "s", between);
    }
    if (leg->leading < 0) {
        g_strlcpy(words->leads, "nothing: stresses are held", sizeof words->leads);
    }
}

/* Screen of the editor.  The legs are at the top; below them is what the focused leg
 * does and the sketch, or the shorthands while a leg is typed.  The keys are in the
 * last rows. */

enum {
    TEXT_COL = 3,   /* text of a leg, after its number */
    WORD_COLS = 7,  /* width of "leads  " */
    ERROR_ROWS = 3, /* error of the focused leg */
    KEY_ROWS = 2,
    LINES = 2 * GB_LEG_LIST_MAX + 3,
    SKETCH_ROWS = 9
};

/* A line of the list: a leg, its error, or the leg being typed. */
struct line {
    int leg; /* from 0 */
    int rows;
    enum gb_style style;
    bool typed;
    const char *text;
};

struct lines {
    struct line line[LINES];
    int count;
    int focus; /* line */
    struct gb_error typed_error;
    struct gb_leg typed_leg;
    bool typed_good;
};

static void add(struct lines *lines, struct line line)
{
    if (lines->count < LINES) {
        lines->line[lines->count++] = line;
    }
}

static void add_error(struct lines *lines, const struct gb_paint *paint, int leg,
                      bool focused, const struct gb_error *err)
{
    struct gb_paint text = *paint;
    text.rect.cols -= TEXT_COL;
    const int rows = focused ? gb_paint_wrap_rows(&text, ERROR_ROWS, err->text) : 1;
    add(lines, (struct line){leg, rows, GB_STYLE_BAD, false, err->text});
}

static void add_typed(struct lines *lines, struct gb_leg_editor *editor,
                      const struct gb_paint *paint)
{
    const char *text = gb_prompt_text(&editor->prompt);
    const bool whole = editor->typing == GB_LEG_EDITOR_WHOLE;
    const int before = whole ? 0 : editor->focus;
    struct gb_path path;
    lines->typed_leg = (struct gb_leg){.leading = -1};
    if (whole) {
        gb_path_parse(&path, text, editor->list.dimension, &lines->typed_error);
    } else {
        lines->typed_good =
            text[0] != '\0' &&
            gb_leg_editor_list_try(&editor->list, before, text, &lines->typed_leg,
                                   &lines->typed_error);
    }
    lines->focus = lines->count;
    add(lines, (struct line){before, 1, GB_STYLE_EDIT, true, ""});
    if (lines->typed_error.text[0] != '\0') {
        add_error(lines, paint, before, true, &lines->typed_error);
    }
}

static void list_lines(struct lines *lines, struct gb_leg_editor *editor,
                       const struct gb_paint *paint)
{
    const struct gb_leg_list *list = &editor->list;
    const int count = leg_list_count(list);
    const enum gb_leg_editor_typing typing = editor->typing;
    if (typing == GB_LEG_EDITOR_WHOLE) {
        add_typed(lines, editor, paint);
        return;
    }
    for (int i = 0; i < count; i++) {
        const bool focused = i == editor->focus;
        if (focused && typing != GB_LEG_EDITOR_LIST) {
            add_typed(lines, editor, paint);
        }
        if (typing == GB_LEG_EDITOR_CHANGE && focused) {
            continue;
        }
        const bool bad = list->index[i] < 0;
        lines->focus =
            focused && typing == GB_LEG_EDITOR_LIST ? lines->count : lines->focus;
        add(lines,
            (struct line){i, 1,
                          focused && typing == GB_LEG_EDITOR_LIST ? GB_STYLE_SELECTED
                          : bad                                   ? GB_STYLE_WARN
                                                                  : GB_STYLE_PLAIN,
                          false, leg_list_at(list, i)});
        if (bad) {
            add_error(lines, paint, i, focused, &list->error[i]);
        }
    }
    if (editor->focus == count && typing != GB_LEG_EDITOR_LIST) {
        add_typed(lines, editor, paint);
    } else if (typing == GB_LEG_EDITOR_LIST) {
        lines->focus = editor->focus == count ? lines->count : lines->focus;
        add(lines,
            (struct line){
                count, 1, editor->focus == count ? GB_STYLE_SELECTED : GB_STYLE_DIM,
                false, count > 0 ? "Enter adds a leg" : "no legs: Enter adds one"});
    }
}

/* Rows from line `from` to the end of the focused leg. */
static int rows_to_focus(const struct lines *lines, int from)
{
    const int leg = lines->line[lines->focus].leg;
    int rows = 0;
    for (int i = from; i < lines->count; i++) {
        if (i <= lines->focus || lines->line[i].leg == leg) {
            rows += lines->line[i].rows;
        }
    }
    return rows;
}

/* Number of a line.  Legs after an inserted one are counted from it. */
static int number_of(const struct gb_leg_editor *editor, const struct line *line)
{
    const bool behind = editor->typing == GB_LEG_EDITOR_INSERT && !line->typed &&
                        line->leg >= editor->focus;
    return line->leg + 1 + behind;
}

static void draw_line(struct gb_leg_editor *editor, const struct gb_paint *paint, int row,
                      const struct line *line, bool first)
{
    const int cols = paint->rect.cols - TEXT_COL;
    char number[16];
    snprintf(number, sizeof number, "%2d", number_of(editor, line));
    if (first) {
        gb_paint_text(paint, row, 0, GB_STYLE_DIM, number);
    }
    if (line->typed) {
        gb_prompt_draw(&editor->prompt, paint, row, TEXT_COL, cols);
    } else if (line->rows > 1) {
        struct gb_paint text = *paint;
        text.rect.col += TEXT_COL;
        text.rect.cols -= TEXT_COL;
        gb_paint_wrap(&text, row, line->rows, line->style, line->text);
    } else {
        gb_paint_cell(paint, row, TEXT_COL, cols, line->style, line->text);
    }
}

/* Returns the rows used, at most `most`. */
static int draw_list(struct gb_leg_editor *editor, const struct gb_paint *paint, int most,
                     const struct lines *lines)
{
    int from = 0;
    int row = 0;
    while (from < lines->focus && rows_to_focus(lines, from) > most) {
        from++;
    }
    for (int i = from; i < lines->count && row + lines->line[i].rows <= most; i++) {
        const bool first = i == 0 || lines->line[i].leg != lines->line[i - 1].leg ||
                           lines->line[i].style != GB_STYLE_BAD;
        draw_line(editor, paint, row, &lines->line[i], first);
        row += lines->line[i].rows;
    }
    return row;
}

static int draw_word(const struct gb_paint *paint, int row, const char *name,
                     const char *text)
{
    struct gb_paint right = *paint;
    if (text[0] == '\0' || row >= paint->rect.rows) {
        return row;
    }
    gb_paint_text(paint, row, 0, GB_STYLE_DIM, name);
    right.rect.col += WORD_COLS;
    right.rect.cols -= WORD_COLS;
    return row + gb_paint_wrap(&right, row, paint->rect.rows - row, GB_STYLE_PLAIN, text);
}

static void draw_words(const struct gb_paint *paint, const struct gb_leg *leg,
                       int dimension)
{
    struct gb_leg_words words;
    gb_leg_editor_words(leg, dimension, &words);
    int row = draw_word(paint, 0, "leads", words.leads);
    row = draw_word(paint, row, "held", words.held);
    row = draw_word(paint, row, "fixed", words.fixed);
    draw_word(paint, row, "ends", words.ends);
}

static void draw_sketch(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const struct gb_leg_list *list = &editor->list;
    const struct gb_leg *leg = gb_leg_editor_list_leg(list, editor->focus);
    const int focus = leg != NULL ? list->index[editor->focus] + 1 : 0;
    if (gb_plot_resize(&editor->plot, paint->rect.rows, paint->rect.cols, editor->glyphs,
                       NULL)) {
        gb_leg_editor_sketch(&list->path, list->dimension, focus, &editor->plot);
        gb_paint_plot(paint, 0, 0, &editor->plot);
    }
}

/* Draws what the focused leg does on the left, and the whole path on the right. */
static void draw_preview(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const struct gb_leg *leg = gb_leg_editor_list_leg(&editor->list, editor->focus);
    struct gb_paint left = *paint, right = *paint;
    left.rect.cols = paint->rect.cols / 2 - 1;
    right.rect.col += paint->rect.cols / 2;
    right.rect.cols -= paint->rect.cols / 2;
    if (leg != NULL) {
        draw_words(&left, leg, editor->list.dimension);
    }
    if (editor->list.path.count > 0) {
        draw_sketch(editor, &right);
    }
}

/* Does a shorthand match the typed text: "shear" matches "sh" and "shear xz to"? */
static bool fits(const char *usage, const char *typed)
{
    const size_t word = strcspn(usage, " ");
    const size_t length = strcspn(typed, " ");
    return strncmp(usage, typed, length) == 0 &&
           (length == word || (length < word && typed[length] == '\0'));
}

/* The index-th shorthand that matches the typed text; false: no more. */
static bool leg_editor_offer(struct gb_leg_editor *editor, int index, const char **usage,
                             const char **doc)
{
    const char *typed = gb_prompt_text(&editor->prompt);
    int found = -1;
    for (int i = 0; gb_path_parse_shorthand(i, usage, doc); i++) {
        found += fits(*usage, typed);
        if (found == index) {
            return true;
        }
    }
    return false;
}

/* Draws the matching shorthands and what the focused one does. */
static void draw_offers(struct gb_leg_editor *editor, const struct gb_paint *paint)
{
    const char *usage, *doc, *focused = "";
    const int rows = paint->rect.rows - 2;
    const int from = MAX(0, editor->offer - rows + 1);
    int row = 0;
    for (int i = from; row < rows && leg_editor_offer(editor, i, &usage, &doc); i++) {
        const bool here = i == editor->offer;
        focused = here ? doc : focused;
        gb_paint_cell(paint, row++, TEXT_COL, paint->rect.cols - TEXT_COL,
                      here ? GB_STYLE_BOLD : GB_STYLE_DIM, usage);
        if (here) {
            gb_paint_text(paint, row - 1, 1, GB_STYLE_BOLD, ">");
        }
    }
    gb_paint_wrap(paint, row, 2, GB_STYLE_DIM, focused);
}

static void draw_typing(struct gb_leg_editor *editor, const struct gb_paint *paint,
                        const struct lines *lines)
{
    struct gb_paint lower = *paint;
    if (lines->typed_good && editor->typing != GB_LEG_EDITOR_WHOLE) {
        draw_words(&lower, &lines->typed_leg, editor->list.dimension);
    } else if (editor->typing != GB_LEG_EDITOR_WHOLE) {
        draw_offers(editor, &lower);
    }
}

/* Writes "Enter edit  O add  ...  Esc restore" from the key table. */
static void write_keys(const struct gb_leg_editor *editor, GString *text)
{
    if (editor->typing != GB_LEG_EDITOR_LIST) {
        g_string_assign(text, "Enter takes the leg  Tab completes  Up Down choose  "
                              "Esc leaves it");
        return;
    }
    g_string_assign(text, "Enter edit  ");
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        if ((key.scope & GB_KEY_LEGS) && key.brief != NULL) {
            g_string_append_printf(text, "%.*s %s  ", (int)strcspn(key.name, " "),
                                   key.name, key.brief);
        }
    }
    g_string_append(text, "Esc restore");
}

void gb_leg_editor_draw(struct gb_leg_editor *editor, const struct gb_paint *inside)
{
    struct lines lines = {.count = 0};
    struct gb_paint lower = *inside;
    GString *keys = g_string_new(NULL);
    write_keys(editor, keys);
    const int key_rows = gb_paint_wrap_rows(inside, KEY_ROWS, keys->str);
    const int rows = inside->rect.rows - key_rows;
    const bool typing = editor->typing != GB_LEG_EDITOR_LIST;
    list_lines(&lines, editor, inside);
    const int used = draw_list(
        editor, inside, MAX(4, typing ? rows / 3 + 1 : rows - SKETCH_ROWS), &lines);
    lower.rect.row += used + (rows > 15);
    lower.rect.rows = rows - used - (rows > 15);
    if (typing) {
        draw_typing(editor, &lower, &lines);
    } else {
        draw_preview(editor, &lower);
    }
    gb_paint_wrap(inside, rows, key_rows, GB_STYLE_DIM, keys->str);
    g_string_free(keys, TRUE);
}

void gb_leg_editor_init(struct gb_leg_editor *editor, const char *text, int dimension,
                        enum gb_plot_glyphs glyphs)
{
    *editor = (struct gb_leg_editor){.glyphs = glyphs};
    gb_leg_editor_list_init(&editor->list, text, dimension);
    gb_plot_init(&editor->plot);
}

void gb_leg_editor_finish(struct gb_leg_editor *editor)
{
    gb_leg_editor_list_finish(&editor->list);
    gb_plot_finish(&editor->plot);
}

/* Moves the focus to a leg, or to the line after the last one. */
static void go_to(struct gb_leg_editor *editor, int to)
{
    editor->focus = CLAMP(to, 0, leg_list_count(&editor->list));
}

static bool on_leg(const struct gb_leg_editor *editor)
{
    return editor->focus < leg_list_count(&editor->list);
}

void gb_leg_editor_go(struct gb_leg_editor *editor, int by)
{
    go_to(editor, CLAMP(by, -GB_LEG_LIST_MAX, GB_LEG_LIST_MAX) + editor->focus);
}

static void begin(struct gb_leg_editor *editor, enum gb_leg_editor_typing typing,
                  const char *text)
{
    editor->typing = typing;
    editor->offer = 0;
    gb_prompt_set(&editor->prompt, text);
}

void gb_leg_editor_change(struct gb_leg_editor *editor)
{
    begin(editor, on_leg(editor) ? GB_LEG_EDITOR_CHANGE : GB_LEG_EDITOR_INSERT,
          on_leg(editor) ? leg_list_at(&editor->list, editor->focus) : "");
}

void gb_leg_editor_insert(struct gb_leg_editor *editor, int behind)
{
    go_to(editor, editor->focus + behind);
    begin(editor, GB_LEG_EDITOR_INSERT, "");
}

void gb_leg_editor_whole(struct gb_leg_editor *editor)
{
    char *text = gb_leg_editor_list_join(&editor->list);
    begin(editor, GB_LEG_EDITOR_WHOLE, text);
    g_free(text);
}

void gb_leg_editor_delete(struct gb_leg_editor *editor)
{
    if (on_leg(editor)) {
        gb_leg_editor_list_remove(&editor->list, editor->focus);
        go_to(editor, editor->focus);
    }
}

void gb_leg_editor_move(struct gb_leg_editor *editor, int by)
{
    if (gb_leg_editor_list_move(&editor->list, editor->focus, by)) {
        go_to(editor, editor->focus + by);
    }
}

void gb_leg_editor_undo(struct gb_leg_editor *editor)
{
    gb_leg_editor_list_undo(&editor->list);
    go_to(editor, editor->focus);
}

static void move_offer(struct gb_leg_editor *editor, int by)
{
    const char *usage, *doc;
    const int to = editor->offer + by;
    if (to >= 0 && leg_editor_offer(editor, to, &usage, &doc)) {
        editor->offer = to;
    }
}

/* Inserts the word of the focused shorthand; false: none matches, or it is complete. */
static bool complete(struct gb_leg_editor *editor)
{
    const char *usage, *doc;
    const char *typed = gb_prompt_text(&editor->prompt);
    if (strchr(typed, ' ') != NULL ||
        !leg_editor_offer(editor, editor->offer, &usage, &doc) ||
        strcspn(usage, " ") == strlen(typed)) {
        return false;
    }
    char *word = g_strndup(usage, strcspn(usage, " "));
    char *begun = g_strconcat(word, " ", NULL);
    gb_prompt_set(&editor->prompt, begun);
    editor->offer = 0;
    g_free(begun);
    g_free(word);
    return true;
}

static void accept(struct gb_leg_editor *editor)
{
    const char *text = gb_prompt_text(&editor->prompt);
    int count = 0;
    switch (editor->typing) {
    case GB_LEG_EDITOR_CHANGE:
        gb_leg_editor_list_replace(&editor->list, editor->focus, text);
        break;
    case GB_LEG_EDITOR_INSERT:
        count = gb_leg_editor_list_insert(&editor->list, editor->focus, text);
        break;
    default:
        gb_leg_editor_list_set(&editor->list, text);
        break;
    }
    go_to(editor, editor->focus + MAX(count - 1, 0));
    editor->typing = GB_LEG_EDITOR_LIST;
}

/* Handles Enter.  A text without a shorthand has no meaning, so Enter inserts the
 * focused one. */
static void enter(struct gb_leg_editor *editor)
{
    const char *text = gb_prompt_text(&editor->prompt);
    const bool chosen = editor->typing == GB_LEG_EDITOR_INSERT && text[0] == '\0';
    if (!chosen || !complete(editor)) {
        accept(editor);
    }
}

bool gb_leg_editor_type(struct gb_leg_editor *editor, const struct gb_term_event *event)
{
    if (editor->typing == GB_LEG_EDITOR_LIST) {
        return false;
    }
    if (gb_prompt_handle(&editor->prompt, event)) {
        editor->offer = 0;
        return true;
    }
    switch (gb_keys_action(event->code)) {
    case GB_ACTION_UP:
        move_offer(editor, -1);
        break;
    case GB_ACTION_DOWN:
        move_offer(editor, 1);
        break;
    case GB_ACTION_ENTER:
        enter(editor);
        break;
    case GB_ACTION_BACK:
        editor->typing = GB_LEG_EDITOR_LIST;
        break;
    default:
        if (event->code == '\t') {
            complete(editor);
        }
        break;
    }
    return true;
}
