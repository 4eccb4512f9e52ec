#ifndef GB_TUI_TERM_INPUT_TERM_KEYS_H
#define GB_TUI_TERM_INPUT_TERM_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "tui/term/term.h"

/* Keys, text and mouse events from the bytes of a terminal.  The sequences are those that
 * curses has from terminfo.  Not by curses' own reading, which measures its wait for the
 * rest of a sequence by the time of day and waits for days where that is set back. */

/* Longest time between Esc and the rest of a function key, s. */
#define GB_TERM_KEYS_REST_S 0.04

enum { GB_TERM_KEYS_BYTES = 256 };

struct gb_term_keys {
    char bytes[GB_TERM_KEYS_BYTES]; /* not yet understood */
    size_t count;
    double since_s; /* clock when the last of them came */
};

/* Room for bytes to be read, and its size; never 0 after gb_term_keys_next was false. */
char *gb_term_keys_room(struct gb_term_keys *keys, size_t *size);
/* So many bytes were read into the room. */
void gb_term_keys_add(struct gb_term_keys *keys, size_t count, double now_s);

/* The next event, if there is one.  The first bytes of a longer sequence are kept until its
 * rest comes or too much time has passed. */
bool gb_term_keys_next(struct gb_term_keys *keys, double now_s,
                       struct gb_term_event *event);

/* Time until bytes that are kept are keys of their own, ms; at most timeout_ms, which is
 * negative for no limit. */
int gb_term_keys_wait_ms(const struct gb_term_keys *keys, double now_s, int timeout_ms);

#endif
