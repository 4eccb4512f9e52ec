/* Previous curves of a session: their differences from the present parameters, their
 * points, which are kept, and their colours and markers.  Also the shell command for
 * the parameters on screen (gb_previous_command). */
#include "tui/session/previous.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "io/preset_folders.h"
#include "scene/loading_kind.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"

/* "p1-set2-38nm" if the preset is found by that name, otherwise its path. */
static char *name_of(const char *path)
{
    char *base = g_path_get_basename(path);
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    char *found = gb_preset_folders_find(base);
    char *name =
        found != NULL && strcmp(found, path) == 0 ? g_strdup(base) : g_strdup(path);
    g_free(found);
    g_free(base);
    return name;
}

/* Quotes for the shell where necessary. */
static char *quote(const char *word)
{
    for (const char *at = word; *at != '\0'; at++) {
        if (!g_ascii_isalnum(*at) && strchr("._-/=+,:%", *at) == NULL) {
            return g_shell_quote(word);
        }
    }
    return g_strdup(word);
}

static void add_word(GString *text, gsize *line, const char *word, int cols)
{
    char *quoted = quote(word);
    const gsize width = (gsize)g_utf8_strlen(quoted, -1);
    if (*line > 0 && *line + 1 + width + 2 > (gsize)cols) {
        g_string_append(text, " \\\n    ");
        *line = 4;
    } else if (*line > 0) {
        g_string_append_c(text, ' ');
        (*line)++;
    }
    g_string_append(text, quoted);
    *line += width;
    g_free(quoted);
}

static void add_values(GString *text, gsize *line, const struct gb_params *own,
                       const struct gb_params *file, int cols)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_previous_diff_same(own, file, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            char *word = g_strdup_printf("%s.%s=%s", field[i].group, field[i].key, value);
            add_word(text, line, word, cols);
            g_free(word);
        }
    }
}

char *gb_previous_command(const struct gb_preset *preset, const struct gb_params *params,
                          int cols)
{
    struct gb_preset *file = NULL;
    GString *text = g_string_new(NULL);
    gsize line = 0;
    char *name = name_of(gb_preset_path(preset));
    if (!gb_preset_load(&file, *name != '\0' ? name : "default", NULL)) {
        g_free(name);
        return g_string_free(
            g_string_assign(text, "the preset file does not exist any more"), FALSE);
    }
    add_word(text, &line, "greenbody", cols);
    add_word(text, &line, "run", cols);
    add_word(text, &line, *name != '\0' ? name : "default", cols);
    add_values(text, &line, params, gb_preset_params(file), cols);
    gb_preset_destroy(file);
    g_free(name);
    return g_string_free(text, FALSE);
}

bool gb_previous_diff_same(const struct gb_params *a, const struct gb_params *b,
                           const struct gb_field *field)
{
    char one[GB_PARAMS_VALUE_MAX];
    char other[GB_PARAMS_VALUE_MAX];
    gb_params_format(a, field, one, sizeof one);
    gb_params_format(b, field, other, sizeof other);
    return strcmp(one, other) == 0;
}

static bool is_title(const struct gb_field *field)
{
    return strcmp(field->key, "title") == 0;
}

int gb_previous_diff_count(const struct gb_params *a, const struct gb_params *b)
{
    size_t count = 0;
    int differences = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        differences += !is_title(&field[i]) && !gb_previous_diff_same(a, b, &field[i]);
    }
    return differences;
}

char *gb_previous_diff_text(const struct gb_params *own, const struct gb_params *other,
                            char *text, size_t size)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!is_title(&field[i]) && !gb_previous_diff_same(own, other, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            const bool none = value[0] == '\0';
            g_string_append_printf(all, "%s%s%s%s%s", all->len > 0 ? ", " : "",
                                   none ? "no " : "", field[i].key, none ? "" : " ",
                                   value);
        }
    }
    gb_paint_fit_copy(text, size, all->len > 0 ? all->str : "same parameters");
    g_string_free(all, TRUE);
    return text;
}

void gb_previous_curve_finish(struct gb_previous_curve *previous)
{
    gb_alloc_free(previous->density);
    gb_alloc_free(previous->pressure_pa);
    gb_alloc_free(previous->elapsed);
    gb_alloc_free(previous->loading);
    memset(previous, 0, sizeof *previous);
}

double gb_previous_curve_elapsed(int kind, const struct gb_point *point)
{
    return gb_loading_kind_at(kind)->given_rate ? 1e9 * point->time_s
                                                : (double)point->step;
}

/* Copies the branches of a curve in sequence, with NaN between them. */
static void copy_branches(struct gb_previous_curve *previous,
                          const struct gb_curve *curve, size_t count)
{
    int branch = 0;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (i > 0 && point->branch != branch && (point->branch > 0 || branch > 0)) {
            previous->density[n] = NAN;
            previous->elapsed[n] = NAN;
            previous->loading[n] = false;
            previous->pressure_pa[n++] = NAN;
        }
        branch = point->branch;
        previous->density[n] = point->density;
        previous->loading[n] = branch <= 0;
        previous->elapsed[n] = gb_previous_curve_elapsed(previous->params.kind, point);
        previous->pressure_pa[n++] = point->p_pa;
    }
    previous->count = n;
}

bool gb_previous_curve_copy(struct gb_previous_curve *previous,
                            const struct gb_params *params, const struct gb_curve *curve,
                            size_t count)
{
    memset(previous, 0, sizeof *previous);
    previous->params = *params;
    previous->density = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->pressure_pa = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->elapsed = gb_alloc_array(2 * count, sizeof(double), NULL);
    previous->loading = gb_alloc_array(2 * count, sizeof(bool), NULL);
    if (previous->density == NULL || previous->pressure_pa == NULL ||
        previous->elapsed == NULL || previous->loading == NULL) {
        gb_previous_curve_finish(previous);
        return false;
    }
    copy_branches(previous, curve, count);
    return true;
}

void gb_previous_list_delete(struct gb_session *session, int index)
{
    struct gb_previous_curve *previous = &session->previous[index];
    gb_previous_curve_finish(previous);
    session->previous_count--;
    memmove(previous, previous + 1,
            (size_t)(session->previous_count - index) * sizeof *previous);
}

void gb_previous_list_forget(struct gb_session *session, const struct gb_params *params,
                             bool quick)
{
    for (int i = session->previous_count - 1; i >= 0; i--) {
        const struct gb_previous_curve *previous = &session->previous[i];
        if (previous->quick == quick && !(quick && previous->label.pinned) &&
            gb_previous_diff_count(&previous->params, params) == 0) {
            gb_previous_list_delete(session, i);
        }
    }
}

static bool has_colour(const struct gb_session *session, int colour)
{
    for (int i = 0; i < session->previous_count; i++) {
        const struct gb_curve_label *label = &session->previous[i].label;
        if (!label->hidden && label->colour == colour) {
            return true;
        }
    }
    return false;
}

int gb_previous_list_free_colour(const struct gb_session *session)
{
    for (int colour = 1; colour <= GB_CURVE_COLOURS; colour++) {
        if (!has_colour(session, colour)) {
            return colour;
        }
    }
    return 0;
}

/* A colour for another curve: the colour it had before, a free one, or the colour of
 * the oldest curve that is not pinned, which becomes dim. */
static int take_colour(struct gb_session *session, int before)
{
    if (before > 0 && !has_colour(session, before)) {
        return before;
    }
    int colour = gb_previous_list_free_colour(session);
    for (int i = 0; colour == 0 && i < session->previous_count; i++) {
        struct gb_curve_label *label = &session->previous[i].label;
        if (!label->hidden && !label->pinned && label->colour > 0) {
            colour = label->colour;
            label->colour = 0;
        }
    }
    return colour;
}

static void make_room(struct gb_session *session)
{
    if (session->previous_count < GB_SESSION_PREVIOUS) {
        return;
    }
    int oldest = 0;
    while (oldest < GB_SESSION_PREVIOUS - 1 && session->previous[oldest].label.pinned) {
        oldest++;
    }
    gb_previous_list_delete(session, oldest);
}

/* Label of a new previous curve.  A run keeps its label.  A quick cell takes the label
 * of a pinned curve of the same cell, which it replaces. */
static struct gb_curve_label take_label(struct gb_session *session,
                                        const struct gb_params *params, bool quick)
{
    struct gb_curve_label label = {.marker = '\0'};
    if (!quick) {
        label = session->run_label;
    }
    for (int i = 0; quick && i < session->previous_count; i++) {
        const struct gb_previous_curve *previous = &session->previous[i];
        if (previous->quick && gb_previous_diff_count(&previous->params, params) == 0) {
            label = previous->label;
            gb_previous_list_delete(session, i);
            break;
        }
    }
    if (label.marker == '\0') {
        label.marker = (char)('a' + session->previous_total++ % 26);
    }
    return label;
}

void gb_previous_list_keep(struct gb_session *session, const struct gb_params *params,
                           const struct gb_runner *runner, enum gb_session_cell cell)
{
    const struct gb_curve *curve = gb_runner_curve(runner);
    const size_t count = gb_curve_count(curve);
    struct gb_previous_curve previous;
    if (count < 2 || !gb_previous_curve_copy(&previous, params, curve, count)) {
        return;
    }
    previous.quick = cell == GB_SESSION_QUICK_CELL;
    previous.label = take_label(session, params, previous.quick);
    make_room(session);
    previous.label.colour = take_colour(session, previous.label.colour);
    if (!previous.quick) {
        session->run_label = previous.label;
    }
    session->previous[session->previous_count++] = previous;
}

void gb_previous_list_describe(struct gb_session *session, const struct gb_params *params)
{
    for (int i = 0; i < session->previous_count; i++) {
        struct gb_previous_curve *previous = &session->previous[i];
        const char *head = previous->quick ? "quick: " : "";
        char text[GB_PARAMS_DIFF_TEXT];
        gb_previous_diff_text(&previous->params, params, text, sizeof text);
        char *whole = g_strconcat(head, text, NULL);
        gb_paint_fit_copy(previous->difference, sizeof previous->difference, whole);
        g_free(whole);
    }
}

struct gb_curve_label *gb_previous_list_label(struct gb_session *session, int index)
{
    return index < 0 ? &session->run_label : &session->previous[index].label;
}

const char *gb_previous_list_name(const struct gb_previous_curve *previous)
{
    return previous->label.name[0] != '\0' ? previous->label.name : previous->difference;
}

bool gb_previous_list_shown(const struct gb_previous_curve *previous, bool hide)
{
    return !previous->label.hidden && (previous->label.pinned || !hide);
}

static int count_pinned(const struct gb_session *session)
{
    int pinned = session->run_label.pinned;
    for (int i = 0; i < session->previous_count; i++) {
        pinned += session->previous[i].label.pinned;
    }
    return pinned;
}

bool gb_previous_list_pin(struct gb_session *session, int index, bool pinned)
{
    struct gb_curve_label *label = gb_previous_list_label(session, index);
    if (pinned && !label->pinned && count_pinned(session) >= GB_PREVIOUS_PINNED) {
        return false;
    }
    label->pinned = pinned;
    return true;
}

void gb_previous_list_hide(struct gb_session *session, int index, bool hidden)
{
    struct gb_curve_label *label = &session->previous[index].label;
    if (label->hidden && !hidden) {
        label->colour = take_colour(session, label->colour);
    }
    label->hidden = hidden;
}
