#ifndef GB_TUI_TERM_TERM_H
#define GB_TUI_TERM_TERM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <termios.h>

#include "greenbody/status.h"
#include "tui/term/settings.h"

/* While the screen is open, messages that libraries and drivers print on standard error
 * go to the log.  The newest line is shown among the events. */
struct gb_stderr_tail {
    int64_t length; /* bytes of the log read so far; -1: not opened yet */
};

void gb_term_tail_init(struct gb_stderr_tail *stderr_tail);

/* The last complete line written to standard error since the previous call; false: none,
 * or standard error is not a file. */
bool gb_term_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size);

/* Sets the run directory.  The message after a crash names its last checkpoint, if
 * there is one.  Copied; NULL: none. */
void gb_term_crash_set_run(const char *directory);

/* Path of the log file; g_free. */
char *gb_term_log(void);

/* Can the log be written?  If not, err has the reason; everything else works without
 * it. */
bool gb_term_check_log(struct gb_error *err);

/* The terminal's own type, or for an unknown type (common over ssh) one that nearly all
 * terminals understand.  NULL: no type with cursor addressing. */
const char *gb_term_type(int fd, struct gb_error *err);

/* Number of colours in terminfo; 0: none, or an unknown type. */
int gb_term_colours(const char *type, int fd);

/* The terminal: taken over at the start and restored at every exit.  While curses uses
 * it, standard output and standard error go to a log file. */
struct gb_term;

/* Longest text, bytes.  With Base64 and its header it has 100,000 bytes, the limit of
 * some terminals. */
enum { GB_CLIPBOARD_MAX = 74994 };

/* The sequence for one of enum gb_settings_clipboard: OSC52; TMUX, also with the
 * passthrough of tmux; SCREEN, also with the passthrough of GNU screen, whose strings
 * have at most 768 bytes. g_free.  Errors: GB_ERR_INPUT if the text is empty or too
 * long, or the clipboard is off. */
char *gb_term_clipboard_sequence(int clipboard, const char *text, struct gb_error *err);

/* Sends a text to the clipboard.  No terminal reports whether it accepts the text.
 * Inside tmux the text also becomes its newest paste buffer.  Errors: as above. */
bool gb_term_clipboard_copy(struct gb_term *term, const char *text, struct gb_error *err);

/* A rectangle of character cells; rows or cols 0: hidden. */
struct gb_rect {
    int row, col;
    int rows, cols;
};

/* Longest time between Esc and the rest of a function key, s. */
#define GB_TERM_KEYS_REST_S 0.04

enum { GB_TERM_KEYS_BYTES = 256 };

struct gb_term_keys {
    char bytes[GB_TERM_KEYS_BYTES]; /* bytes that are not yet complete */
    size_t count;
    double since_s; /* clock when the last byte arrived */
};

/* Memory for bytes to be read, and its size, which is never 0 after gb_term_keys_next
 * returned false. */
char *gb_term_keys_room(struct gb_term_keys *keys, size_t *size);

/* Adds `count` bytes that were read into this memory. */
void gb_term_keys_add(struct gb_term_keys *keys, size_t count, double now_s);

enum gb_term_event_kind {
    GB_TERM_TIMEOUT,   /* timeout */
    GB_TERM_KEY,       /* curses key code or control character */
    GB_TERM_TEXT,      /* printable character */
    GB_TERM_MOUSE,     /* code: one of gb_term_mouse_code, at row, col */
    GB_TERM_RESIZED,   /* also after a suspension: redraw everything */
    GB_TERM_INTERRUPT, /* SIGINT */
    GB_TERM_TERMINATE, /* SIGTERM, SIGQUIT */
    GB_TERM_HANGUP     /* SIGHUP, or the terminal is closed: no more output to it */
};

struct gb_term_event {
    enum gb_term_event_kind kind;
    int32_t code;
    int row, col; /* position of the mouse */
};

/* The next event, if there is one.  The first bytes of a longer sequence are kept until
 * its rest arrives or GB_TERM_KEYS_REST_S has passed. */
bool gb_term_keys_next(struct gb_term_keys *keys, double now_s,
                       struct gb_term_event *event);

/* Time until kept bytes count as keys, ms; at most timeout_ms, where a negative value
 * means no limit. */
int gb_term_keys_wait_ms(const struct gb_term_keys *keys, double now_s, int timeout_ms);

enum { GB_TERM_THEME_SERIES = 6 };

struct gb_term_theme {
    short series[GB_TERM_THEME_SERIES], series_16[GB_TERM_THEME_SERIES];
    short grey, grey_16;
    short text, text_16;
    short background, background_16; /* background of all cells */
};

/* The row of a theme, one of enum gb_settings_theme.  Any two of the six series differ
 * by at least 15 in CIELAB, also for protanopia, deuteranopia and tritanopia (matrices
 * of Machado et al. 2009).
 *
 * Least contrast of the series as in WCAG: `light` 3 on white; `dark` 5 on black;
 * `contrast` 7 on its black background; `auto` 2.4 on white and 3.2 on black. */
const struct gb_term_theme *gb_term_theme_row(int theme);

/* Resolves a theme: auto becomes light or dark if the terminal reports its background
 * in $COLORFGBG ("15;0"; NULL: it does not). */
int gb_term_theme_resolve(int theme, const char *colorfgbg);

/* Styles by meaning.  Their attributes depend on the terminal and on NO_COLOR.  Every
 * meaning also has a word or a symbol. */
enum gb_style {
    GB_STYLE_PLAIN,
    GB_STYLE_DIM,
    GB_STYLE_BOLD,
    GB_STYLE_TITLE,
    GB_STYLE_FOCUS,    /* title of the pane with the focus */
    GB_STYLE_SELECTED, /* line with the focus */
    GB_STYLE_EDIT,     /* text being typed */
    GB_STYLE_CHANGED,  /* parameter with a value that the run does not use yet */
    GB_STYLE_GOOD,
    GB_STYLE_WARN,
    GB_STYLE_BAD,
    GB_STYLE_SERIES, /* + colour, 0 to 5 */
    GB_STYLE_COUNT = GB_STYLE_SERIES + 6
};

enum gb_term_mouse_code { GB_TERM_CLICK, GB_TERM_WHEEL_UP, GB_TERM_WHEEL_DOWN };

/* Takes over the terminal.  Errors: GB_ERR_MACHINE without a terminal, or for a type
 * without cursor addressing and without a fallback; nothing has changed then. */
bool gb_term_start(struct gb_term **out, const struct gb_settings *settings,
                   struct gb_error *err);
/* Restores the terminal.  Signals stay blocked until gb_term_destroy, so that a repeated
 * request to end does not interrupt the saving of data. */
void gb_term_stop(struct gb_term *term);

/* Call this instead of gb_term_stop after a hang-up: the terminal is no longer
 * accessed.  Standard output and error stay in the log file, and signals stay blocked. */
void gb_term_abandon(struct gb_term *term);

/* Call this after gb_term_stop or gb_term_abandon; NULL is fine. */
void gb_term_destroy(struct gb_term *term);

/* Waits for an event, at most timeout_ms (negative: no limit). */
struct gb_term_event gb_term_wait(struct gb_term *term, int timeout_ms);

/* Redraws the whole screen at the next flush. */
void gb_term_repaint(struct gb_term *term);
/* Sends the changes to the terminal. */
void gb_term_flush(struct gb_term *term);

void gb_term_size(const struct gb_term *term, int *rows, int *cols);
bool gb_term_utf8(const struct gb_term *term);
/* Are braille characters available?  The fonts of the Linux console lack them. */
bool gb_term_braille(const struct gb_term *term);
/* Are shades of one hue available?  Their attributes: shade 0 (dark) to GB_TERM_SHADES
 * - 1 on a background of another shade; -1: background of the terminal. */
enum { GB_TERM_SHADES = 8 };
bool gb_term_shaded(const struct gb_term *term);
uint64_t gb_term_shade(const struct gb_term *term, int shade, int back);
/* Switches mouse reporting.  While it is on, only Shift-drag selects text in the
 * terminal.  It stays off if terminfo has no mouse sequence. */
void gb_term_mouse(struct gb_term *term, bool on);
bool gb_term_has_mouse(const struct gb_term *term);

/* Pixel images: GB_IMAGES_NONE, _SIXEL or _KITTY; pixels of a cell; number of full
 * repaints, which delete images; sending of a sequence after a flush. */
int gb_term_images(const struct gb_term *term);
void gb_term_cell(const struct gb_term *term, int *width, int *height);
int64_t gb_term_repaints(const struct gb_term *term);
void gb_term_send(struct gb_term *term, int row, int col, const char *text);

/* Sets the colours, one of enum gb_settings_theme, from the next frame on.  No effect
 * without colours. */
void gb_term_set_theme(struct gb_term *term, int theme);
int gb_term_present_theme(const struct gb_term *term);

/* curses attributes of a style. */
uint64_t gb_term_attributes(const struct gb_term *term, enum gb_style style);

#endif
