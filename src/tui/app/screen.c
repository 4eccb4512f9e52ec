/* Draws the workbench (header, panes, message line and footer) and maps a mouse click to
 * the item under it.  Each pane is a row of a table with its functions
 * for drawing, clicks and the clipboard. */
#include "tui/app/screen.h"

#include <glib.h>
#include <ncurses.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "tui/app/key_commands.h"
#include "tui/view/views.h"

static void draw_params(struct gb_screen *screen, const struct gb_paint *paint,
                        enum gb_paint_focus focus)
{
    gb_panel_params_draw(&screen->params, paint, &screen->session, focus);
}

static void navigate_params(struct gb_screen *screen, enum gb_action action)
{
    const struct gb_field *field = gb_panel_params_field(&screen->params);
    if (action == GB_ACTION_ENTER && field == gb_params_find("loading", "path")) {
        gb_pane_commands_leg_open(screen);
        return;
    }
    gb_panel_params_navigate(&screen->params, &screen->session, action);
}

static void click_params(struct gb_screen *screen, int row, int col)
{
    gb_panel_params_click(&screen->params, &screen->session, row, col);
}

static void describe_params(struct gb_screen *screen, struct gb_message *message)
{
    gb_panel_params_describe(&screen->params, &screen->session, message);
}

static char *copied_params(struct gb_screen *screen)
{
    char text[GB_PARAMS_VALUE_MAX + 64];
    gb_panel_params_assignment(&screen->params, &screen->session, text, sizeof text);
    return g_strdup(text);
}

static void draw_plot(struct gb_screen *screen, const struct gb_paint *paint,
                      enum gb_paint_focus focus)
{
    screen->plot.edited = gb_panel_params_edit_params(&screen->params, &screen->session);
    gb_panel_plot_draw(&screen->plot, paint, &screen->session, focus);
}

static void navigate_plot(struct gb_screen *screen, enum gb_action action)
{
    if (screen->plot.view->navigate != NULL) {
        screen->plot.view->navigate(&screen->plot, action);
        return;
    }
    if (action == GB_ACTION_ENTER) {
        gb_job_commands_chart_apply(screen);
        return;
    }
    gb_panel_plot_cursor_navigate(&screen->plot, &screen->session, action);
}

/* A click on the title shows the next view; a click on the field moves the cursor. */
static void click_plot(struct gb_screen *screen, int row, int col)
{
    if (row == 0) {
        gb_panel_plot_step_view(&screen->plot, 1);
    } else {
        gb_panel_plot_cursor_click(&screen->plot, &screen->session, row, col);
    }
}

static void describe_plot(struct gb_screen *screen, struct gb_message *message)
{
    gb_panel_plot_cursor_describe(&screen->plot, &screen->session, message);
}

static char *copied_plot(struct gb_screen *screen)
{
    struct gb_message message = {.text = ""};
    if (!gb_panel_plot_cursor_shown(&screen->plot, &screen->session)) {
        return NULL;
    }
    gb_panel_plot_cursor_describe(&screen->plot, &screen->session, &message);
    return g_strdup(message.text);
}

static void draw_state(struct gb_screen *screen, const struct gb_paint *paint,
                       enum gb_paint_focus focus)
{
    gb_panel_state_draw(paint, &screen->session, focus);
}

/* Describes the error of a failed run. */
static void describe_run(struct gb_screen *screen, struct gb_message *message)
{
    if (screen->session.now.error.text[0] != '\0') {
        snprintf(message->text, sizeof message->text, "%s",
                 screen->session.now.error.text);
        message->style = GB_STYLE_WARN;
    }
}

static void draw_events(struct gb_screen *screen, const struct gb_paint *paint,
                        enum gb_paint_focus focus)
{
    gb_panel_state_events_draw(&screen->events, paint, &screen->session, focus);
}

static void navigate_events(struct gb_screen *screen, enum gb_action action)
{
    gb_panel_state_events_navigate(&screen->events, &screen->session, action);
}

/* The newest line on display. */
static char *copied_events(struct gb_screen *screen)
{
    return g_strdup(gb_session_event_line(&screen->session, screen->events.back));
}

static const struct gb_pane_type panes[GB_PANES] = {
    [GB_PANE_PARAMS] = {draw_params, navigate_params, click_params, describe_params,
                        copied_params},
    [GB_PANE_PLOT] = {draw_plot, navigate_plot, click_plot, describe_plot, copied_plot},
    [GB_PANE_STATE] = {draw_state, NULL, NULL, describe_run, NULL},
    [GB_PANE_EVENTS] = {draw_events, navigate_events, NULL, describe_run, copied_events},
};

const struct gb_pane_type *gb_screen_pane(enum gb_pane pane)
{
    return &panes[pane];
}

static struct gb_paint whole(const struct gb_screen *screen)
{
    return gb_paint_at(screen->term, (struct gb_rect){0, 0, LINES, COLS});
}

static void draw_header(struct gb_screen *screen)
{
    const struct gb_paint paint = gb_paint_at(screen->term, screen->layout.header);
    const struct gb_session *session = &screen->session;
    enum gb_style style = GB_STYLE_DIM;
    const char *word = "not started";
    const struct gb_session_shown shown = gb_session_shown(session);
    if (shown.quick) {
        style = GB_STYLE_SERIES;
        word = gb_session_quick_cell_live(&session->quick_cell) ? "\u25b6 quick cell"
                                                                : "\u2713 quick cell";
    } else if (shown.curve != NULL) {
        word = gb_panel_state_word(session->run_state, session->now.error.text, &style);
    }
    const int cols = paint.rect.cols;
    char right[192], stage[128], staged[144];
    if (!shown.quick && shown.curve != NULL &&
        gb_panel_state_stage(shown.now, session->run_state, cols / 2 - 4, stage,
                             sizeof stage)) {
        snprintf(staged, sizeof staged, "\u25b6 %s", stage);
        word = staged;
    }
    snprintf(right, sizeof right, "%s%s", session->frozen ? "view frozen  " : "", word);
    const int from = cols - gb_paint_width(right) - 1;
    const int name = gb_paint_text(&paint, 0, 1, GB_STYLE_BOLD, "greenbody") + 2;
    const struct gb_params *params =
        shown.params; /* parameters of the scene named on the right */
    char title[192];
    snprintf(title, sizeof title, "%s \u00b7 N %lld", params->title,
             (long long)params->count);
    gb_paint_cell(&paint, 0, name, from - name - 2, GB_STYLE_PLAIN, title);
    const int word_at = cols - gb_paint_width(word) - 1;
    if (session->frozen) {
        gb_paint_text(&paint, 0, from, GB_STYLE_WARN, "view frozen");
    }
    gb_paint_text(&paint, 0, word_at, style, word);
}

/* First name of a key: "?" for "? F1". */
static void brief_name(const struct gb_key *key, char *name, size_t size)
{
    const size_t length = strcspn(key->name, " ");
    snprintf(name, size, "%.*s", (int)length, key->name);
}

static int footer_width(const struct gb_key *key, int gap)
{
    char name[16];
    brief_name(key, name, sizeof name);
    return gb_paint_width(name) + 1 + gb_paint_width(key->brief) + gap;
}

/* A key in the footer with its column. */
struct footer_key {
    struct gb_key key;
    int col;
};

enum { FOOTER_KEYS = GB_KEYS_FOOTER + 2 };

/* Places the keys of the front pane that fit, and always help and quit.  Returns their
 * number. */
static int layout_footer(enum gb_pane pane, int cols, struct footer_key in[FOOTER_KEYS])
{
    const size_t rows = gb_keys_count();
    const struct gb_key last[] = {gb_keys_at(rows - 2), gb_keys_at(rows - 1)};
    const char *const *name = gb_keys_footer(pane);
    int count = 0;
    int all = footer_width(&last[0], 2) + footer_width(&last[1], 2);
    while (count < GB_KEYS_FOOTER && name[count] != NULL &&
           gb_keys_named(name[count], &in[count].key)) {
        all += footer_width(&in[count++].key, 2);
    }
    const int gap = all <= cols ? 2 : 1;
    const int reserved = footer_width(&last[0], gap) + footer_width(&last[1], 0);
    int col = gap - 1;
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const int width = footer_width(&in[i].key, gap);
        if (col + width + reserved <= cols) {
            in[kept++] = (struct footer_key){in[i].key, col};
            col += width;
        }
    }
    in[kept++] = (struct footer_key){last[0], col};
    in[kept++] = (struct footer_key){last[1], col + footer_width(&last[0], gap)};
    return kept;
}

static void draw_footer(struct gb_screen *screen)
{
    const struct gb_paint paint = gb_paint_at(screen->term, screen->layout.footer);
    struct footer_key in[FOOTER_KEYS];
    const int count = layout_footer(screen->focus, paint.rect.cols, in);
    for (int i = 0; i < count; i++) {
        char name[16];
        brief_name(&in[i].key, name, sizeof name);
        const int col = gb_paint_text(&paint, 0, in[i].col, GB_STYLE_BOLD, name) + 1;
        gb_paint_text(&paint, 0, col, GB_STYLE_DIM, in[i].key.brief);
    }
}

bool gb_screen_key_at(const struct gb_screen *screen, int row, int col,
                      struct gb_key *key)
{
    const struct gb_rect *footer = &screen->layout.footer;
    struct footer_key in[FOOTER_KEYS];
    if (footer->rows == 0 || row != footer->row) {
        return false;
    }
    const int count = layout_footer(screen->focus, footer->cols, in);
    for (int i = 0; i < count; i++) {
        *key = in[i].key;
        if (col >= in[i].col && col < in[i].col + footer_width(key, 0)) {
            return true;
        }
    }
    return false;
}

/* Draws the last message, or the description of the focused pane. */
static void draw_message(struct gb_screen *screen)
{
    const struct gb_paint paint = gb_paint_at(screen->term, screen->layout.message);
    if (screen->making != NULL && screen->session.child.pid == 0) {
        if (strcmp(screen->message.text, screen->making) == 0) {
            screen->message.text[0] = '\0';
        }
        screen->making = NULL;
    }
    struct gb_message message = screen->message;
    if (message.text[0] == '\0') {
        message.style = GB_STYLE_DIM;
        gb_screen_pane(screen->focus)->describe(screen, &message);
    }
    gb_paint_wrap(&paint, 0, paint.rect.rows, message.style, message.text);
}

static void draw_pane(struct gb_screen *screen, enum gb_pane pane)
{
    const struct gb_paint paint = gb_paint_at(screen->term, screen->layout.pane[pane]);
    const bool keys = screen->focus == pane && screen->dialog.type == NULL;
    gb_screen_pane(pane)->draw(screen, &paint,
                               keys ? GB_PAINT_FOCUSED : GB_PAINT_UNFOCUSED);
}

static void join(const struct gb_paint *paint, int row, int col, const char *sign)
{
    gb_paint_text(paint, row, col, GB_STYLE_DIM, sign);
}

/* Separators between panes side by side. */
static void draw_lines(const struct gb_screen *screen)
{
    const struct gb_layout *layout = &screen->layout;
    const struct gb_paint paint = whole(screen);
    const struct gb_rect *params = &layout->pane[GB_PANE_PARAMS];
    const struct gb_rect *state = &layout->pane[GB_PANE_STATE];
    const struct gb_rect *events = &layout->pane[GB_PANE_EVENTS];
    const int bottom = params->row + params->rows - 1;
    if (layout->kind < GB_LAYOUT_FULL) {
        return;
    }
    const int left = params->col + params->cols - 1;
    gb_paint_column(&paint, left, params->row + 1, bottom);
    join(&paint, params->row, left, "\u252c");
    if (layout->kind == GB_LAYOUT_FULL) {
        join(&paint, state->row, left, "\u251c");
        join(&paint, events->row, left, "\u251c");
        return;
    }
    gb_paint_column(&paint, state->col - 1, params->row + 1, bottom);
    join(&paint, state->row, state->col - 1, "\u252c");
    join(&paint, events->row, events->col - 1, "\u251c");
}

static void draw_too_small(const struct gb_screen *screen)
{
    const struct gb_paint paint = gb_paint_at(screen->term, screen->layout.message);
    char text[96];
    snprintf(text, sizeof text, "greenbody needs %d x %d, has %d x %d; q quits",
             GB_LAYOUT_MIN_COLS, GB_LAYOUT_MIN_ROWS, COLS, LINES);
    gb_paint_wrap(&paint, 0, paint.rect.rows, GB_STYLE_PLAIN, text);
}

void gb_screen_draw(struct gb_screen *screen)
{
    gb_layout_make(&screen->layout, LINES, COLS, screen->focus);
    if (screen->zoom) {
        gb_layout_zoom(&screen->layout, screen->focus);
    }
    erase();
    if (screen->layout.kind == GB_LAYOUT_TOO_SMALL) {
        draw_too_small(screen);
        return;
    }
    draw_header(screen);
    for (enum gb_pane pane = GB_PANE_PARAMS; pane < GB_PANES; pane++) {
        if (gb_layout_shows(&screen->layout, pane)) {
            draw_pane(screen, pane);
        }
    }
    draw_lines(screen);
    draw_message(screen);
    draw_footer(screen);
    const struct gb_paint paint = whole(screen);
    gb_dialog_draw(&screen->dialog, &paint);
}

struct gb_term_picture gb_screen_picture(const struct gb_screen *screen)
{
    const struct gb_session_shown shown = gb_session_shown(&screen->session);
    const struct gb_dialog *dialog = &screen->dialog;
    if (dialog->type != NULL) {
        return (struct gb_term_picture){
            .picture = dialog->pixels.rgb != NULL ? &dialog->pixels : NULL,
            .look = &screen->plot.look,
            .cells = &dialog->field};
    }
    const bool wanted = screen->plot.pixels &&
                        screen->plot.view->draw == gb_view_packing_draw &&
                        gb_layout_shows(&screen->layout, GB_PANE_PLOT);
    return (struct gb_term_picture){
        .sample =
            wanted && shown.sample != NULL && shown.sample->valid ? shown.sample : NULL,
        .look = &screen->plot.look,
        .cells = &screen->plot.field};
}
