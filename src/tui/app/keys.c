/* The key table of the workbench, with the footer and the help.  Each key is a row:
 * codes, name, help text, scope and command function.  Rows for the views are inserted
 * between the two parts of the table.  The help lists the keys in groups and the
 * glossary, filtered by the words that the user types. */
#include "tui/app/keys.h"

#include <glib.h>
#include <ncurses.h>
#include <string.h>

#include "tui/app/key_commands.h"
#include "tui/panel/list_box.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

enum { CTRL_L = 'L' & 31, CTRL_R = 'R' & 31 };

/* clang-format off: one key per row */

/* Every command has a plain character: terminals and multiplexers intercept function
 * keys. */
static const struct gb_key before_views[] = {
    {{KEY_UP, 'k'},
     "Up k",
     "scroll",
     "up; the packing: seen from above",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_UP},
    {{KEY_DOWN, 'j'},
     "Down j",
     NULL,
     "down; the packing: seen from below",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_DOWN},
    {{KEY_LEFT, 'h'},
     "Left h",
     "cursor",
     "cursor to the previous point; turn the packing",
     GB_KEY_PLOT,
     gb_pane_commands_navigate,
     GB_ACTION_LEFT},
    {{KEY_RIGHT, 'l'},
     "Right l",
     NULL,
     "cursor to the next point; turn the packing",
     GB_KEY_PLOT,
     gb_pane_commands_navigate,
     GB_ACTION_RIGHT},
    {{KEY_PPAGE, '['},
     "PgUp [",
     NULL,
     "one page or ten points back",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_PAGE_UP},
    {{KEY_NPAGE, ']'},
     "PgDn ]",
     NULL,
     "one page or ten points forward",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_PAGE_DOWN},
    {{KEY_HOME, 'g'},
     "Home g",
     NULL,
     "to the beginning",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_HOME},
    {{KEY_END, 'G'},
     "End G",
     NULL,
     "to the end",
     GB_KEY_LISTS,
     gb_pane_commands_navigate,
     GB_ACTION_END},
    {{'\t', 'n'},
     "Tab n",
     "pane",
     "next pane",
     GB_KEY_ANY_PANE,
     gb_pane_commands_next,
     GB_ACTION_NONE},
    {{KEY_BTAB, 'N'},
     "S-Tab N",
     NULL,
     "previous pane",
     GB_KEY_ANY_PANE,
     gb_pane_commands_previous,
     GB_ACTION_NONE},
    {{'z'},
     "z",
     "zoom",
     "zoom: the pane alone, or all panes",
     GB_KEY_ANY_PANE,
     gb_pane_commands_zoom,
     GB_ACTION_NONE},
    {{GB_KEY_ESCAPE},
     "Esc",
     NULL,
     "close or cancel; cursor off",
     GB_KEY_PLOT,
     gb_pane_commands_navigate,
     GB_ACTION_BACK},
    {{'\n', '\r', KEY_ENTER, 'i'},
     "Enter i",
     "edit",
     "edit the parameter, or the leg; accept, apply",
     GB_KEY_PARAMS | GB_KEY_PLOT,
     gb_pane_commands_navigate,
     GB_ACTION_ENTER},
    {{'/'},
     "/",
     "find",
     "find a parameter by name, symbol or meaning",
     GB_KEY_ANY_PANE,
     gb_pane_commands_find,
     GB_ACTION_NONE},
    {{'+', '='},
     "+ =",
     "increase",
     "increase the parameter, or its next choice",
     GB_KEY_ANY_PANE,
     gb_pane_commands_increase,
     GB_ACTION_NONE},
    {{'-', '_'},
     "- _",
     NULL,
     "decrease the parameter, or its previous choice",
     GB_KEY_ANY_PANE,
     gb_pane_commands_decrease,
     GB_ACTION_NONE},
    {{'u', '<'},
     "u <",
     "undo",
     "undo the last change, with its curve",
     GB_KEY_ANY_PANE | GB_KEY_LEGS,
     gb_pane_commands_undo,
     GB_ACTION_NONE},
    {{CTRL_R, '>'},
     "^R >",
     NULL,
     "redo the change undone",
     GB_KEY_ANY_PANE,
     gb_pane_commands_redo,
     GB_ACTION_NONE},
    {{'B'},
     "B",
     NULL,
     "back to the value that the run uses",
     GB_KEY_PARAMS,
     gb_pane_commands_revert,
     GB_ACTION_NONE},
    {{'A'},
     "A",
     NULL,
     "list all parameters, or those in use",
     GB_KEY_ANY_PANE,
     gb_pane_commands_list_all,
     GB_ACTION_NONE},
    {{'d'},
     "d",
     "material",
     "material: a list of names with what changes",
     GB_KEY_ANY_PANE,
     gb_file_commands_material,
     GB_ACTION_NONE},
    {{'r'},
     "r",
     "run",
     "run the parameters shown; a long run asks",
     GB_KEY_ANY_PANE,
     gb_file_commands_start,
     GB_ACTION_NONE},
    {{'p'},
     "p",
     "pause",
     "pause or resume the engine",
     GB_KEY_ANY_PANE,
     gb_file_commands_pause,
     GB_ACTION_NONE},
    {{' '},
     "Space",
     "freeze",
     "freeze the view; the engine continues",
     GB_KEY_ANY_PANE,
     gb_file_commands_freeze,
     GB_ACTION_NONE},
    {{'f'},
     "f",
     "what-if",
     "what-if: continue the run with other values",
     GB_KEY_ANY_PANE,
     gb_file_commands_what_if,
     GB_ACTION_NONE},
    {{'D'},
     "D",
     NULL,
     "drop the changes that a what-if has left",
     GB_KEY_ANY_PANE,
     gb_file_commands_drop_changes,
     GB_ACTION_NONE},
    {{'a'},
     "a",
     NULL,
     "full cell after the quick one: automatic, or r",
     GB_KEY_ANY_PANE,
     gb_file_commands_auto_start,
     GB_ACTION_NONE},
    {{'t'},
     "t",
     NULL,
     "take over the attached run",
     GB_KEY_ANY_PANE,
     gb_file_commands_take_over,
     GB_ACTION_NONE},
};

/* The keys of the views are inserted between the two tables; see row_of_view. */
static const struct gb_key after_views[] = {
    {{'v'},
     "v",
     "view",
     "next view",
     GB_KEY_ANY_PANE,
     gb_view_commands_next,
     GB_ACTION_NONE},
    {{'V'},
     "V",
     NULL,
     "previous view",
     GB_KEY_ANY_PANE,
     gb_view_commands_previous,
     GB_ACTION_NONE},
    {{'L'},
     "L",
     "log",
     "logarithmic or linear pressure axis",
     GB_KEY_ANY_PANE,
     gb_view_commands_log,
     GB_ACTION_NONE},
    {{'F'},
     "F",
     NULL,
     "colour of the packing: depth, contacts, ...",
     GB_KEY_ANY_PANE,
     gb_view_commands_colour,
     GB_ACTION_NONE},
    {{'m'},
     "m",
     NULL,
     "show or hide previous curves that are not pinned",
     GB_KEY_ANY_PANE,
     gb_view_commands_previous_curves,
     GB_ACTION_NONE},
    {{'O'},
     "O",
     "curves",
     "list of curves: pin, name, hide, delete",
     GB_KEY_ANY_PANE,
     gb_view_commands_curve_open,
     GB_ACTION_NONE},
    {{'Z'},
     "Z",
     NULL,
     "ranges of the axes, or automatic ones",
     GB_KEY_ANY_PANE,
     gb_view_commands_ranges,
     GB_ACTION_NONE},
    {{'@'},
     "@",
     "pressure",
     "cursor at a pressure that is typed",
     GB_KEY_ANY_PANE,
     gb_view_commands_pressure,
     GB_ACTION_NONE},
    {{'#'},
     "#",
     "table",
     "densities of the curves, differences, verdicts",
     GB_KEY_ANY_PANE,
     gb_view_commands_densities,
     GB_ACTION_NONE},
    {{'b'},
     "b",
     NULL,
     "plot with braille, blocks or ASCII",
     GB_KEY_ANY_PANE,
     gb_view_commands_glyphs,
     GB_ACTION_NONE},
    {{'c'},
     "c",
     "command",
     "shell command that repeats the run",
     GB_KEY_ANY_PANE,
     gb_file_commands_shell,
     GB_ACTION_NONE},
    {{'y'},
     "y",
     "copy",
     "copy parameter, values at the cursor, folder",
     GB_KEY_ANY_PANE | GB_KEY_COPIED,
     gb_pane_commands_copy,
     GB_ACTION_NONE},
    {{'e'},
     "e",
     "data",
     "measured data over the plot, or a chart.csv",
     GB_KEY_ANY_PANE,
     gb_file_commands_data,
     GB_ACTION_NONE},
    {{'s'},
     "s",
     "picture",
     "picture of the packing: what, colour, cut, file",
     GB_KEY_ANY_PANE,
     gb_file_commands_picture,
     GB_ACTION_NONE},
    {{'x'},
     "x",
     "report",
     "report on the run, as a folder",
     GB_KEY_ANY_PANE,
     gb_file_commands_report,
     GB_ACTION_NONE},
    {{'R'},
     "R",
     "replicas",
     "replicas of this scene: mean and band",
     GB_KEY_ANY_PANE,
     gb_job_commands_replicas,
     GB_ACTION_NONE},
    {{'C'},
     "C",
     "calibrate",
     "calibrate parameters to the measured data",
     GB_KEY_ANY_PANE,
     gb_job_commands_calibrate,
     GB_ACTION_NONE},
    {{'Y'},
     "Y",
     NULL,
     "elastic moduli of the run's states; again: stop",
     GB_KEY_ANY_PANE,
     gb_job_commands_moduli,
     GB_ACTION_NONE},
    {{'X'},
     "X",
     "chart",
     "chart, in view T stability; again: stop",
     GB_KEY_ANY_PANE,
     gb_job_commands_chart_open,
     GB_ACTION_NONE},
    {{'W'},
     "W",
     "result",
     "result of the last job, or of view E or S",
     GB_KEY_ANY_PANE,
     gb_job_commands_result_show,
     GB_ACTION_NONE},
    {{'w'},
     "w",
     "save",
     "save the parameters as a preset",
     GB_KEY_ANY_PANE,
     gb_file_commands_save,
     GB_ACTION_NONE},
    {{'o'},
     "o",
     "open",
     "open a preset and run it",
     GB_KEY_ANY_PANE,
     gb_file_commands_open,
     GB_ACTION_NONE},
    {{'O'},
     "O",
     "add",
     "legs of a path: add one after it",
     GB_KEY_LEGS,
     gb_pane_commands_leg_add,
     GB_ACTION_NONE},
    {{'I'},
     "I",
     "insert",
     "legs of a path: insert one before",
     GB_KEY_LEGS,
     gb_pane_commands_leg_insert,
     GB_ACTION_NONE},
    {{'D'},
     "D",
     "delete",
     "legs of a path: delete",
     GB_KEY_LEGS,
     gb_pane_commands_leg_delete,
     GB_ACTION_NONE},
    {{'J'},
     "J",
     "down",
     "legs of a path: move down",
     GB_KEY_LEGS,
     gb_pane_commands_leg_down,
     GB_ACTION_NONE},
    {{'K'},
     "K",
     "up",
     "legs of a path: move up",
     GB_KEY_LEGS,
     gb_pane_commands_leg_up,
     GB_ACTION_NONE},
    {{'T'},
     "T",
     "text",
     "legs of a path: edit as one text",
     GB_KEY_LEGS,
     gb_pane_commands_leg_text,
     GB_ACTION_NONE},
    {{'y'},
     "y",
     "take",
     "legs of a path: take them",
     GB_KEY_LEGS,
     gb_pane_commands_leg_take,
     GB_ACTION_NONE},
    {{'*'},
     "*",
     NULL,
     "list of curves: pin or unpin",
     GB_KEY_CURVES,
     gb_view_commands_curve_pin,
     GB_ACTION_NONE},
    {{'m'},
     "m",
     NULL,
     "list of curves: hide or show",
     GB_KEY_CURVES,
     gb_view_commands_curve_hide,
     GB_ACTION_NONE},
    {{'D'},
     "D",
     NULL,
     "list of curves: delete",
     GB_KEY_CURVES,
     gb_view_commands_curve_delete,
     GB_ACTION_NONE},
    {{'H'},
     "H",
     NULL,
     "colours: next theme, which is remembered",
     GB_KEY_ANY_PANE,
     gb_pane_commands_theme,
     GB_ACTION_NONE},
    {{'M'},
     "M",
     NULL,
     "mouse on or off (Shift-drag selects text)",
     GB_KEY_ANY_PANE,
     gb_pane_commands_mouse,
     GB_ACTION_NONE},
    {{CTRL_L},
     "^L",
     NULL,
     "repaint the screen",
     GB_KEY_ANY_PANE,
     gb_pane_commands_repaint,
     GB_ACTION_NONE},
    {{'?', KEY_F(1)},
     "? F1",
     "help",
     "keys and glossary, filtered by typing",
     GB_KEY_ANY_PANE,
     gb_pane_commands_help,
     GB_ACTION_NONE},
    {{'q', KEY_F(10)},
     "q F10",
     "quit",
     "quit; asks while a run is live",
     GB_KEY_ALWAYS,
     gb_pane_commands_quit,
     GB_ACTION_NONE},
};

/* clang-format on */

enum {
    BEFORE = sizeof before_views / sizeof before_views[0],
    AFTER = sizeof after_views / sizeof after_views[0]
};

static struct gb_key row_of_view(const struct gb_plot_view *view)
{
    return (struct gb_key){.code = {view->key[0]},
                           .name = view->key,
                           .help = view->help,
                           .scope = GB_KEY_ANY_PANE,
                           .command = gb_view_commands_show};
}

size_t gb_keys_count(void)
{
    return BEFORE + gb_views_count() + AFTER;
}

struct gb_key gb_keys_at(size_t index)
{
    const size_t views = gb_views_count();
    return index < BEFORE           ? before_views[index]
           : index < BEFORE + views ? row_of_view(gb_views_at(index - BEFORE))
                                    : after_views[index - BEFORE - views];
}

bool gb_keys_find(int code, int scope, struct gb_key *key)
{
    const size_t count = gb_keys_count();
    for (size_t i = 0; i < count && code != 0; i++) {
        *key = gb_keys_at(i);
        for (int k = 0; (key->scope & scope) && k < GB_KEYS_PER_ROW && key->code[k] != 0;
             k++) {
            if (key->code[k] == code) {
                return true;
            }
        }
    }
    return false;
}

/* The first row of each group of the help. */
static const struct {
    const char *first;
    int scope;
    const char *heading;
} groups[] = {
    {"Up k", GB_KEY_ANY_PANE, "Moving"},
    {"Enter i", GB_KEY_ANY_PANE, "Parameters"},
    {"r", GB_KEY_ANY_PANE, "Runs"},
    {"1", GB_KEY_ANY_PANE, "Views and cursor"},
    {"c", GB_KEY_ANY_PANE, "Copies, data, pictures, reports"},
    {"R", GB_KEY_ANY_PANE, "Jobs during the run"},
    {"w", GB_KEY_ANY_PANE, "Presets"},
    {"O", GB_KEY_LEGS, "Legs of a loading path"},
    {"*", GB_KEY_CURVES, "List of curves"},
    {"H", GB_KEY_ANY_PANE, "Screen"},
};

const char *gb_keys_heading(size_t index)
{
    const struct gb_key key = gb_keys_at(index);
    for (size_t i = 0; i < G_N_ELEMENTS(groups); i++) {
        if ((key.scope & groups[i].scope) && strcmp(groups[i].first, key.name) == 0) {
            return groups[i].heading;
        }
    }
    return NULL;
}

/* Names of keys for the footer of each pane, the most useful first.  Help and quit are
 * added. */
static const char *const footers[GB_PANES][GB_KEYS_FOOTER] = {
    [GB_PANE_PARAMS] = {"Tab n", "Enter i", "/", "+ =", "u <", "r", "p", "v", "d", "o",
                        "w", "y", "z"},
    [GB_PANE_PLOT] = {"Tab n", "v", "Left h", "@", "#", "O", "r", "p", "L", "e", "y", "z",
                      "s", "Space", "R"},
    [GB_PANE_STATE] = {"Tab n", "r", "p", "f", "R", "x", "c", "y", "z", "W", "X",
                       "Space"},
    [GB_PANE_EVENTS] = {"Tab n", "Up k", "r", "p", "y", "z", "s", "x", "v"},
};

const char *const *gb_keys_footer(enum gb_pane pane)
{
    return footers[pane];
}

bool gb_keys_named(const char *name, struct gb_key *key)
{
    for (size_t i = 0; i < gb_keys_count(); i++) {
        *key = gb_keys_at(i);
        if (strcmp(key->name, name) == 0) {
            return true;
        }
    }
    return false;
}

enum gb_action gb_keys_action(int code)
{
    struct gb_key key;
    return gb_keys_find(code, GB_KEY_EVERYWHERE, &key) ? key.action : GB_ACTION_NONE;
}

/* The help: the keys in groups and the glossary (docs/glossary.md), filtered by the
 * typed words. */

enum { KEY_COLS = 10, INDENT = 2, HEAD_ROWS = 2 };

static const struct gb_help_word glossary[] = {
#include "tui/glossary_rows.inc"
};

const struct gb_help_word *gb_keys_glossary(size_t *count)
{
    *count = G_N_ELEMENTS(glossary);
    return glossary;
}

/* A line of the list, with a name before or above the text. */
struct line {
    char *name, *text; /* owned; NULL: none */
    enum gb_style style;
    int col; /* first column of the text */
};

struct lines {
    GPtrArray *line;
    const struct gb_paint *paint;
    char **wanted;       /* words of the filter, lower case */
    const char *heading; /* heading before the next line; NULL: none */
};

static void free_line(void *data)
{
    struct line *line = data;
    g_free(line->name);
    g_free(line->text);
    g_free(line);
}

static void add(struct lines *lines, const char *name, const char *text,
                enum gb_style style, int col)
{
    struct line *line = g_new0(struct line, 1);
    *line = (struct line){g_strdup(name), g_strdup(text), style, col};
    g_ptr_array_add(lines->line, line);
}

/* Adds a heading only if lines follow it. */
static void add_heading(struct lines *lines)
{
    if (lines->heading != NULL) {
        if (lines->line->len > 0) {
            add(lines, NULL, "", GB_STYLE_PLAIN, 0);
        }
        add(lines, NULL, lines->heading, GB_STYLE_TITLE, 0);
        lines->heading = NULL;
    }
}

/* Adds the text, wrapped at blanks from column `col`; the name is on the first line. */
static void add_wrapped(struct lines *lines, const char *name, const char *text, int col)
{
    const int room = MAX(lines->paint->rect.cols - col, 8);
    char **word = g_strsplit(text, " ", -1);
    GString *line = g_string_new(NULL);
    add_heading(lines);
    for (size_t i = 0; word[i] != NULL; i++) {
        if (line->len > 0 &&
            gb_paint_width(line->str) + 1 + gb_paint_width(word[i]) > room) {
            add(lines, name, line->str, GB_STYLE_PLAIN, col);
            name = NULL;
            g_string_truncate(line, 0);
        }
        g_string_append_printf(line, "%s%s", line->len > 0 ? " " : "", word[i]);
    }
    add(lines, name, line->str, GB_STYLE_PLAIN, col);
    g_string_free(line, TRUE);
    g_strfreev(word);
}

/* Do the texts contain all words of the filter? */
static bool wanted(const struct lines *lines, const char *name, const char *text,
                   const char *heading)
{
    char *joined = g_strdup_printf("%s %s %s", name, text, heading);
    const bool found = gb_list_box_matches(lines->wanted, joined);
    g_free(joined);
    return found;
}

static void add_keys(struct lines *lines)
{
    const char *group = "";
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        const char *heading = gb_keys_heading(i);
        if (heading != NULL) {
            group = lines->heading = heading;
        }
        if (wanted(lines, key.name, key.help, group)) {
            add_wrapped(lines, key.name, key.help, KEY_COLS);
        }
    }
}

static void add_glossary(struct lines *lines)
{
    for (size_t i = 0; i < G_N_ELEMENTS(glossary); i++) {
        const struct gb_help_word *entry = &glossary[i];
        if (entry->word == NULL) {
            lines->heading = entry->meaning;
        } else if (wanted(lines, entry->word, entry->meaning, "glossary")) {
            add_heading(lines);
            add(lines, NULL, entry->word, GB_STYLE_BOLD, 0);
            add_wrapped(lines, NULL, entry->meaning, INDENT);
        }
    }
}

void gb_keys_help_init(struct gb_help_list *list)
{
    *list = (struct gb_help_list){.box = {.unfocused = true}};
}

bool gb_keys_help_handle(struct gb_help_list *list, const struct gb_term_event *event)
{
    if ((event->kind == GB_TERM_TEXT && event->code == '?') ||
        !gb_prompt_handle(&list->box.filter, event)) {
        return false;
    }
    list->box.top = 0;
    return true;
}

static void write_line(void *data, int item, struct gb_list_box_line *out)
{
    const struct lines *lines = data;
    const struct line *line = g_ptr_array_index(lines->line, (guint)item);
    out->style = line->style;
    if (line->col < KEY_COLS) { /* without a name in the first column */
        out->whole = g_strdup_printf("%*s%s", line->col, "", line->text);
    } else {
        out->cell[0] = g_strdup(line->name);
        out->ink[0] = GB_STYLE_BOLD;
        out->cell[1] = g_strdup(line->text);
    }
}

void gb_keys_help_draw(struct gb_help_list *list, const struct gb_paint *paint)
{
    static const struct gb_list_box_look look = {
        .columns = 2,
        .column = {{.cols = KEY_COLS}, {.cols = 0}},
        .empty = "no key and no word of the glossary has this",
        .empty_style = GB_STYLE_WARN,
        .write = write_line};
    char *typed = g_utf8_casefold(gb_prompt_text(&list->box.filter), -1);
    struct lines lines = {.line = g_ptr_array_new_with_free_func(free_line),
                          .paint = paint,
                          .wanted = g_strsplit(typed, " ", -1)};
    struct gb_rect rect = paint->rect;
    rect.row += HEAD_ROWS;
    rect.rows -= HEAD_ROWS;
    const struct gb_paint rows = gb_paint_at(paint->term, rect);
    add_keys(&lines);
    add_glossary(&lines);
    gb_list_box_set_count(&list->box, (int)lines.line->len);
    gb_list_box_draw_filter(&list->box, paint, 0, 0, "Filter:");
    gb_list_box_draw(&list->box, &rows, &look, &lines);
    g_strfreev(lines.wanted);
    g_free(typed);
    g_ptr_array_free(lines.line, TRUE);
}
