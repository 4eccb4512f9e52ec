#ifndef GB_TUI_PANEL_LIST_BOX_H
#define GB_TUI_PANEL_LIST_BOX_H

#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* A list: rows in columns, a filter that is typed, paging and scrolling.  The workbench
 * uses it for presets, materials, runs, parameters, curves, help and many runs. */

/* Navigation keys, whose meaning depends on the pane, dialog or list. */
enum gb_action {
    GB_ACTION_NONE,
    GB_ACTION_UP,
    GB_ACTION_DOWN,
    GB_ACTION_LEFT,
    GB_ACTION_RIGHT,
    GB_ACTION_PAGE_UP,
    GB_ACTION_PAGE_DOWN,
    GB_ACTION_HOME,
    GB_ACTION_END,
    GB_ACTION_ENTER,
    GB_ACTION_BACK
};

enum { GB_LIST_BOX_COLUMNS = 6 };

/* A row as text.  The list frees the texts. */
struct gb_list_box_line {
    enum gb_style style;
    char *cell[GB_LIST_BOX_COLUMNS]; /* NULL: empty */
    int ink[GB_LIST_BOX_COLUMNS];    /* style of a cell; -1: style of the row */
    char *whole;                     /* over all columns; NULL: the cells */
};

struct gb_list_box_column {
    const char *title;
    int cols;   /* 0: the remaining width */
    bool right; /* aligned */
    bool tight; /* no blank after it */
};

/* How a list is drawn. */
struct gb_list_box_look {
    int columns;
    struct gb_list_box_column column[GB_LIST_BOX_COLUMNS];
    enum gb_style head; /* of the titles */
    bool titled;        /* the first row has the titles */
    const char *empty;  /* text of an empty list; NULL: nothing */
    enum gb_style empty_style;
    void (*write)(void *data, int item, struct gb_list_box_line *line);
};

struct gb_list_box {
    struct gb_prompt filter;
    int *item;      /* the items listed, in order; NULL: 0, 1, ...; owned */
    int count;      /* number of rows */
    int focus;      /* row */
    int top, page;  /* first row shown, and rows shown at the last draw */
    bool unfocused; /* rows only scroll */
};

void gb_list_box_finish(struct gb_list_box *list); /* zeroed is fine */

/* Lists items 0 to count - 1. */
void gb_list_box_set_count(struct gb_list_box *list, int count);

/* Lists those of the `total` items with a rank above 0, highest rank first, and focuses
 * the first row. words: words of the filter in lower case, NULL at the end. */
void gb_list_box_search(struct gb_list_box *list, int total,
                        int (*rank)(void *data, int item, char **words), void *data);
/* Does a text contain all words, ignoring case? */
bool gb_list_box_matches(char **words, const char *text);

/* The item in focus; -1: the list is empty. */
int gb_list_box_focused(const struct gb_list_box *list);

/* Moves the focus, or scrolls, by a number of rows. */
void gb_list_box_go(struct gb_list_box *list, int by);
/* The same for a key; false: the key moves nothing. */
bool gb_list_box_navigate(struct gb_list_box *list, enum gb_action action);

/* Handles a key: arrows and pages move, other keys edit the filter. */
enum gb_list_box_event { GB_LIST_BOX_OTHER, GB_LIST_BOX_MOVED, GB_LIST_BOX_TYPED };
enum gb_list_box_event gb_list_box_handle(struct gb_list_box *list,
                                          const struct gb_term_event *event);

/* Draws the rows into the rectangle, so that the focused one is visible. */
void gb_list_box_draw(struct gb_list_box *list, const struct gb_paint *paint,
                      const struct gb_list_box_look *look, void *data);
/* Draws the filter after its label. */
void gb_list_box_draw_filter(const struct gb_list_box *list, const struct gb_paint *paint,
                             int row, int col, const char *label);
/* Cells of a column in the focused row, for an input line. */
struct gb_rect gb_list_box_cell(const struct gb_list_box *list,
                                const struct gb_paint *paint,
                                const struct gb_list_box_look *look, int column);

#endif
