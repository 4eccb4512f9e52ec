#ifndef GB_TUI_WATCH_REREAD_LOOP_H
#define GB_TUI_WATCH_REREAD_LOOP_H

#include "tui/term/term.h"

/* A screen of files that other processes write: events, and the files read again. */
struct gb_reread_loop {
    /* Seconds between two readings, or ten times the duration of one, whichever is longer. */
    double reread_s;
    /* False: the screen is left. */
    bool (*key)(void *data, struct gb_term *term, const struct gb_term_event *event);
    void (*wheel)(void *data, int rows); /* -1, 0 or 1 */
    void (*reread)(void *data);
    void (*draw)(void *data, struct gb_term *term);
    void *data;
};

/* Until the screen is left or a signal ends it; stops and destroys the terminal.  Returns
 * the exit status. */
int gb_reread_loop_run(const struct gb_reread_loop *loop, struct gb_term *term);

#endif
