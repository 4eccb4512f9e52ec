#include "tui/app/browse.h"

#include <glib.h>
#include <ncurses.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "tui/session/earlier.h"

enum { LIST_COLS = 26, PREVIEW_FROM = LIST_COLS + 24, HEAD_LINES = 4, DIFFERENCE = 400 };

static int length_of(char **names)
{
    return names == NULL ? 0 : (int)g_strv_length(names);
}

const char *gb_browse_name(const struct gb_browse *browse)
{
    return browse->count > 0 ? browse->names[browse->shown[browse->focus]] : NULL;
}

/* The first lines of the file that are comments: source and purpose. */
static char *read_head(const char *name)
{
    char *path = gb_preset_find(name);
    char *content = NULL;
    GString *head = g_string_new(NULL);
    if (path != NULL && g_file_get_contents(path, &content, NULL, NULL)) {
        char **lines = g_strsplit(content, "\n", HEAD_LINES + 1);
        for (int i = 0; i < HEAD_LINES && lines[i] != NULL && lines[i][0] == '#'; i++) {
            g_string_append_printf(head, "%s%s", head->len > 0 ? " " : "",
                                   g_strstrip(lines[i] + 1));
        }
        g_strfreev(lines);
    }
    g_free(content);
    g_free(path);
    return g_string_free(head, FALSE);
}

static void drop_preview(struct gb_browse *browse)
{
    gb_preset_destroy(browse->preset);
    g_free(browse->head);
    browse->preset = NULL;
    browse->head = NULL;
}

static void read_preview(struct gb_browse *browse)
{
    struct gb_error err = {0};
    const char *name = gb_browse_name(browse);
    drop_preview(browse);
    if (name == NULL) {
        return;
    }
    if (gb_preset_load(&browse->preset, name, &err)) {
        browse->head = read_head(name);
    } else {
        browse->preset = NULL;
        browse->head = g_strdup(err.text);
    }
}

static void go_to(struct gb_browse *browse, int to)
{
    browse->focus = CLAMP(to, 0, MAX(browse->count - 1, 0));
    read_preview(browse);
}

/* Keeps the names in which the filter occurs, whatever its case. */
static void apply_filter(struct gb_browse *browse)
{
    const int all = length_of(browse->names);
    char *wanted = g_ascii_strdown(gb_prompt_text(&browse->filter), -1);
    browse->count = 0;
    for (int i = 0; i < all; i++) {
        char *name = g_ascii_strdown(browse->names[i], -1);
        if (strstr(name, wanted) != NULL) {
            browse->shown[browse->count++] = i;
        }
        g_free(name);
    }
    g_free(wanted);
    go_to(browse, 0);
}

void gb_browse_start(struct gb_browse *browse, const struct gb_params *current)
{
    memset(browse, 0, sizeof *browse);
    browse->names = gb_preset_list();
    browse->shown = g_new0(int, (gsize)length_of(browse->names) + 1);
    browse->base = *current;
    g_strlcpy(browse->base_name, "the screen", sizeof browse->base_name);
    gb_prompt_set(&browse->filter, "");
    apply_filter(browse);
}

void gb_browse_finish(struct gb_browse *browse)
{
    drop_preview(browse);
    g_strfreev(browse->names);
    g_free(browse->shown);
    memset(browse, 0, sizeof *browse);
}

static void keep_in_sight(struct gb_browse *browse)
{
    browse->top = MIN(browse->top, browse->focus);
    browse->top = MAX(browse->top, browse->focus - browse->page + 1);
    browse->top = MAX(MIN(browse->top, browse->count - browse->page), 0);
}

static void draw_list(struct gb_browse *browse, const struct gb_paint *paint, int cols)
{
    gb_paint_text(paint, 0, 0, GB_STYLE_DIM, "Filter:");
    gb_prompt_draw(&browse->filter, paint, 0, 8, cols - 9);
    browse->page = paint->rect.rows - 2;
    keep_in_sight(browse);
    if (browse->count == 0) {
        gb_paint_text(paint, 2, 0, GB_STYLE_DIM,
                      length_of(browse->names) > 0 ? "no name fits"
                                                   : "no preset was found");
    }
    for (int i = 0; i < browse->page && browse->top + i < browse->count; i++) {
        const int at = browse->top + i;
        gb_paint_cell(paint, 2 + i, 0, cols - 1,
                      at == browse->focus ? GB_STYLE_SELECTED : GB_STYLE_PLAIN,
                      browse->names[browse->shown[at]]);
    }
}

static void write_scene(const struct gb_params *params, char *text, size_t size)
{
    char diameter[32];
    char until[48];
    char geometry[32];
    gb_units_format_short(params->diameter_m, GB_DIM_LENGTH, 4, diameter,
                          sizeof diameter);
    gb_params_format(params, gb_params_find("loading", "until"), until, sizeof until);
    gb_params_format(params, gb_params_find("loading", "geometry"), geometry,
                     sizeof geometry);
    snprintf(text, size, "%dD, %lld particles of %s, %s, until %s", params->dimension,
             (long long)params->count, diameter, geometry, until);
}

static void draw_preview(const struct gb_browse *browse, const struct gb_paint *paint)
{
    char text[256];
    char difference[DIFFERENCE];
    int row = 0;
    if (browse->preset == NULL) {
        gb_paint_wrap(paint, 0, paint->rect.rows, GB_STYLE_WARN,
                      browse->head != NULL ? browse->head : "");
        return;
    }
    const struct gb_params *params = gb_preset_params(browse->preset);
    row += gb_paint_wrap(paint, row, 2, GB_STYLE_BOLD, params->title);
    write_scene(params, text, sizeof text);
    row += gb_paint_wrap(paint, row, 2, GB_STYLE_PLAIN, text);
    row += 1 + gb_paint_wrap(paint, row, MAX(paint->rect.rows / 3, 1), GB_STYLE_DIM,
                             browse->head);
    gb_earlier_describe(params, &browse->base, difference, sizeof difference);
    snprintf(text, sizeof text, "Differs from %s:", browse->base_name);
    row += gb_paint_wrap(paint, row, 1, GB_STYLE_PLAIN, text);
    gb_paint_wrap(paint, row, paint->rect.rows - row, GB_STYLE_CHANGED, difference);
}

void gb_browse_draw(struct gb_browse *browse, const struct gb_paint *inside)
{
    const int cols = inside->rect.cols;
    const bool beside = cols >= PREVIEW_FROM;
    struct gb_rect left = inside->rect;
    struct gb_rect right = inside->rect;
    if (beside) {
        left.cols = LIST_COLS;
        right.col += LIST_COLS;
        right.cols -= LIST_COLS;
    } else { /* one above the other */
        left.rows = inside->rect.rows / 2 + 1;
        right.row += left.rows;
        right.rows -= left.rows;
    }
    const struct gb_paint list = gb_paint_at(inside->term, left);
    const struct gb_paint preview = gb_paint_at(inside->term, right);
    draw_list(browse, &list, left.cols);
    draw_preview(browse, &preview);
}

/* The preset under the cursor becomes what others are compared with. */
static void mark(struct gb_browse *browse)
{
    if (browse->preset != NULL) {
        browse->base = *gb_preset_params(browse->preset);
        g_strlcpy(browse->base_name, gb_browse_name(browse), sizeof browse->base_name);
    }
}

bool gb_browse_type(struct gb_browse *browse, const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_KEY) {
        switch (event->code) {
        case KEY_UP:
            go_to(browse, browse->focus - 1);
            return true;
        case KEY_DOWN:
            go_to(browse, browse->focus + 1);
            return true;
        case KEY_PPAGE:
            go_to(browse, browse->focus - browse->page);
            return true;
        case KEY_NPAGE:
            go_to(browse, browse->focus + browse->page);
            return true;
        case '\t':
            mark(browse);
            return true;
        default:
            break;
        }
    }
    if (gb_prompt_take(&browse->filter, event)) {
        apply_filter(browse);
        return true;
    }
    return false;
}
