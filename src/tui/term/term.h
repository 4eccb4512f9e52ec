#ifndef GB_TUI_TERM_TERM_H
#define GB_TUI_TERM_TERM_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* The terminal: taken at the start, given back on every way out.  While curses owns it,
 * standard output and error of everybody else go to a log file. */
struct gb_term;

/* Meanings, not colours: what they look like depends on the terminal and on NO_COLOR, and
 * each of them is told by a word or a mark as well. */
enum gb_style {
    GB_STYLE_PLAIN,
    GB_STYLE_DIM,
    GB_STYLE_BOLD,
    GB_STYLE_TITLE,
    GB_STYLE_FOCUS,    /* title of the pane with the focus */
    GB_STYLE_SELECTED, /* line with the focus */
    GB_STYLE_EDIT,     /* text being typed */
    GB_STYLE_CHANGED,  /* parameter the run does not use yet */
    GB_STYLE_GOOD,
    GB_STYLE_WARN,
    GB_STYLE_BAD,
    GB_STYLE_SERIES, /* + colour, GB_TERM_SERIES of them */
    GB_STYLE_COUNT = GB_STYLE_SERIES + 6
};

enum gb_term_event_kind {
    GB_TERM_TIMEOUT,   /* the time is over */
    GB_TERM_KEY,       /* curses key code or control character */
    GB_TERM_TEXT,      /* printable character */
    GB_TERM_MOUSE,     /* code: one of gb_term_mouse_code, at row, col */
    GB_TERM_RESIZED,   /* also after a suspension: paint everything */
    GB_TERM_INTERRUPT, /* SIGINT */
    GB_TERM_TERMINATE, /* SIGTERM, SIGQUIT */
    GB_TERM_HANGUP     /* SIGHUP, or the terminal is closed: it must not be touched */
};

enum gb_term_mouse_code { GB_TERM_CLICK, GB_TERM_WHEEL_UP, GB_TERM_WHEEL_DOWN };

struct gb_term_event {
    enum gb_term_event_kind kind;
    int32_t code;
    int row, col; /* of the mouse */
};

/* Takes the terminal.  Errors (GB_ERR_MACHINE): not a terminal, unknown and no fallback
 * works, cannot place the cursor; nothing has been changed then. */
bool gb_term_start(struct gb_term **out, const struct gb_settings *settings,
                   struct gb_error *err);
/* Gives it back.  Signals are held up until gb_term_destroy, so that nobody who asks
 * twice for the end cuts off what is still to be kept. */
void gb_term_stop(struct gb_term *term);

/* Instead of gb_term_stop when the terminal is gone: it is not touched again.  Standard
 * output and error stay in the log file, signals stay blocked for ever. */
void gb_term_abandon(struct gb_term *term);

/* After one of the two; NULL is fine. */
void gb_term_destroy(struct gb_term *term);

/* Sleeps until something happens, at most timeout_ms (negative: for ever). */
struct gb_term_event gb_term_wait(struct gb_term *term, int timeout_ms);

/* Stops the process as Ctrl-Z does, and takes the screen back when it goes on. */
void gb_term_suspend(struct gb_term *term);

/* Paints the whole screen with the next flush, whatever it shows now. */
void gb_term_repaint(struct gb_term *term);
/* Sends what has changed. */
void gb_term_flush(struct gb_term *term);

void gb_term_size(const struct gb_term *term, int *rows, int *cols);
bool gb_term_utf8(const struct gb_term *term);
/* Braille is in no font of the Linux console. */
bool gb_term_braille(const struct gb_term *term);
/* Whether the screen has the shades of a relief; their attributes: shade 0 (dark) to
 * GB_TERM_SHADES - 1 before a background of another shade, -1: the screen's own. */
enum { GB_TERM_SHADES = 8 };
bool gb_term_shaded(const struct gb_term *term);
uint64_t gb_term_shade(const struct gb_term *term, int shade, int back);
/* Whether clicks and the wheel are reported; then only Shift lets the terminal itself
 * select text.  Stays off where terminfo knows no mouse. */
void gb_term_mouse(struct gb_term *term, bool on);
bool gb_term_has_mouse(const struct gb_term *term);

/* Pictures between the characters: GB_IMAGES_NONE, _SIXEL or _KITTY; pixels of a cell;
 * how often the screen was wiped, which takes pictures away; sends one behind a flush. */
int gb_term_images(const struct gb_term *term);
void gb_term_cell(const struct gb_term *term, int *width, int *height);
int64_t gb_term_repaints(const struct gb_term *term);
void gb_term_send(struct gb_term *term, int row, int col, const char *text);

/* curses attributes of a style. */
uint64_t gb_term_attributes(const struct gb_term *term, enum gb_style style);

#endif
