#include "tui/app/preset_browser.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/units.h"
#include "io/material.h"
#include "io/preset_folders.h"
#include "tui/session/previous.h"

/* --- presets ---------------------------------------------------------------------- */

static bool load_preset(struct gb_preset **out, const char *name,
                        const struct gb_params *current, struct gb_error *err)
{
    (void)current;
    return gb_preset_load(out, name, err);
}

static const char *title_of_scene(const struct gb_params *params)
{
    return params->title;
}

static void write_scene(struct gb_preset *preset, const char *path, char *text,
                        size_t size)
{
    const struct gb_params *params = gb_preset_params(preset);
    (void)path;
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

const struct gb_preset_browser_kind gb_preset_browser_kinds_presets = {
    .list = gb_preset_folders_list,
    .find = gb_preset_folders_find,
    .load = load_preset,
    .title = title_of_scene,
    .describe = write_scene,
    .empty = "no presets found",
};

/* --- materials -------------------------------------------------------------------- */

static bool load_material(struct gb_preset **out, const char *name,
                          const struct gb_params *current, struct gb_error *err)
{
    if (!gb_preset_create(out, err)) {
        return false;
    }
    *gb_preset_params(*out) = *current;
    if (!gb_material_apply(gb_preset_params(*out), name, err)) {
        gb_preset_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

static const char *name_of_material(const struct gb_params *params)
{
    return params->material;
}

static void write_guessed(struct gb_preset *preset, const char *path, char *text,
                          size_t size)
{
    char *keys = gb_material_guessed(path);
    (void)preset;
    g_snprintf(text, size, "%s%s", *keys != '\0' ? "Guessed: " : "", keys);
    g_free(keys);
}

const struct gb_preset_browser_kind gb_preset_browser_kinds_materials = {
    .list = gb_preset_folders_list_materials,
    .find = gb_preset_folders_find_material,
    .load = load_material,
    .title = name_of_material,
    .describe = write_guessed,
    .empty = "no materials found",
};

enum {
    HEAD_ROWS = 2,
    LIST_COLS = 28,
    PREVIEW_FROM = LIST_COLS + 24,
    HEAD_LINES = 4,
    DIFFERENCE = 400
};
enum { BYTES_MAX = 1 << 20 }; /* size limit of a preset */

static int length_of(char **names)
{
    return names == NULL ? 0 : (int)g_strv_length(names);
}

const char *gb_preset_browser_selected(const struct gb_preset_browser *browser)
{
    const int item = gb_list_box_focused(&browser->list);
    return item >= 0 ? browser->names[item] : NULL;
}

/* Comment lines at the beginning of the file: source and purpose. */
static char *read_head(const char *path)
{
    char *content = NULL;
    size_t length = 0;
    GString *head = g_string_new(NULL);
    if (path != NULL && gb_file_read(path, BYTES_MAX, &content, &length, NULL)) {
        char **lines = g_strsplit(content, "\n", HEAD_LINES + 1);
        for (int i = 0; i < HEAD_LINES && lines[i] != NULL && lines[i][0] == '#'; i++) {
            g_string_append_printf(head, "%s%s", head->len > 0 ? " " : "",
                                   g_strstrip(lines[i] + 1));
        }
        g_strfreev(lines);
    }
    gb_alloc_free(content);
    return g_string_free(head, FALSE);
}

static void drop_preview(struct gb_preset_browser *browser)
{
    gb_preset_destroy(browser->preset);
    g_free(browser->head);
    browser->preset = NULL;
    browser->head = NULL;
}

static void read_preview(struct gb_preset_browser *browser)
{
    struct gb_error err = {0};
    const char *name = gb_preset_browser_selected(browser);
    drop_preview(browser);
    if (name == NULL) {
        return;
    }
    if (browser->kind->load(&browser->preset, name, &browser->current, &err)) {
        char *path = browser->kind->find(name);
        browser->head = read_head(path);
        browser->kind->describe(browser->preset, path, browser->told,
                                sizeof browser->told);
        g_free(path);
    } else {
        browser->preset = NULL;
        browser->head = g_strdup(err.text);
    }
}

/* Rank of a name: whether it contains the words of the filter. */
static int rank_name(void *data, int item, char **words)
{
    const struct gb_preset_browser *browser = data;
    return gb_list_box_matches(words, browser->names[item]);
}

static void apply_filter(struct gb_preset_browser *browser)
{
    gb_list_box_search(&browser->list, length_of(browser->names), rank_name, browser);
    read_preview(browser);
}

void gb_preset_browser_init(struct gb_preset_browser *browser,
                            const struct gb_preset_browser_kind *kind,
                            const struct gb_params *current)
{
    memset(browser, 0, sizeof *browser);
    browser->kind = kind;
    browser->names = kind->list();
    browser->current = *current;
    browser->base = *current;
    g_strlcpy(browser->base_name, "the current parameters", sizeof browser->base_name);
    apply_filter(browser);
}

void gb_preset_browser_finish(struct gb_preset_browser *browser)
{
    drop_preview(browser);
    g_strfreev(browser->names);
    gb_list_box_finish(&browser->list);
    memset(browser, 0, sizeof *browser);
}

static void write_name(void *data, int item, struct gb_list_box_line *line)
{
    const struct gb_preset_browser *browser = data;
    line->cell[0] = g_strdup(browser->names[item]);
}

static void draw_list(struct gb_preset_browser *browser, const struct gb_paint *paint)
{
    const bool any = length_of(browser->names) > 0;
    const struct gb_list_box_look look = {.columns = 1,
                                          .empty =
                                              any ? "no match" : browser->kind->empty,
                                          .empty_style = GB_STYLE_DIM,
                                          .write = write_name};
    struct gb_rect rows = paint->rect;
    rows.row += HEAD_ROWS;
    rows.rows -= HEAD_ROWS;
    rows.cols--;
    gb_list_box_draw_filter(&browser->list, paint, 0, 0, "Filter:");
    const struct gb_paint below = gb_paint_at(paint->term, rows);
    gb_list_box_draw(&browser->list, &below, &look, browser);
}

static void draw_preview(const struct gb_preset_browser *browser,
                         const struct gb_paint *paint)
{
    char text[256];
    char difference[DIFFERENCE];
    int row = 0;
    if (browser->preset == NULL) {
        gb_paint_wrap(paint, 0, paint->rect.rows, GB_STYLE_WARN,
                      browser->head != NULL ? browser->head : "");
        return;
    }
    const struct gb_params *params = gb_preset_params(browser->preset);
    row += gb_paint_wrap(paint, row, 2, GB_STYLE_BOLD, browser->kind->title(params));
    row += gb_paint_wrap(paint, row, 2, GB_STYLE_PLAIN, browser->told);
    row += 1 + gb_paint_wrap(paint, row, MAX(paint->rect.rows / 3, 1), GB_STYLE_DIM,
                             browser->head);
    gb_previous_diff_text(params, &browser->base, difference, sizeof difference);
    snprintf(text, sizeof text, "Differs from %s:", browser->base_name);
    row += gb_paint_wrap(paint, row, 1, GB_STYLE_PLAIN, text);
    gb_paint_wrap(paint, row, paint->rect.rows - row, GB_STYLE_CHANGED, difference);
}

void gb_preset_browser_draw(struct gb_preset_browser *browser,
                            const struct gb_paint *inside)
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
    draw_list(browser, &list);
    draw_preview(browser, &preview);
}

/* Marks the selected preset as the reference for comparisons. */
static void mark(struct gb_preset_browser *browser)
{
    if (browser->preset != NULL) {
        browser->base = *gb_preset_params(browser->preset);
        g_strlcpy(browser->base_name, gb_preset_browser_selected(browser),
                  sizeof browser->base_name);
    }
}

bool gb_preset_browser_handle(struct gb_preset_browser *browser,
                              const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_KEY && event->code == '\t') {
        mark(browser);
        return true;
    }
    switch (gb_list_box_handle(&browser->list, event)) {
    case GB_LIST_BOX_MOVED:
        read_preview(browser);
        return true;
    case GB_LIST_BOX_TYPED:
        apply_filter(browser);
        return true;
    case GB_LIST_BOX_OTHER:
        break;
    }
    return false;
}
