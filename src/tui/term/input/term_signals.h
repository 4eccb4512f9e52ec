#ifndef GB_TUI_TERM_INPUT_TERM_SIGNALS_H
#define GB_TUI_TERM_INPUT_TERM_SIGNALS_H

#include <signal.h>

/* Signals as events to be read, instead of handlers. */
enum { GB_TERM_SIGNALS = 7 };

struct gb_term_signals {
    int fd; /* of a signalfd, to be polled; -1: none */
    sigset_t mask_before;
    struct sigaction before[GB_TERM_SIGNALS], pipe_before;
};

/* Blocks SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT and SIGWINCH in this thread and
 * those that it starts; ignores SIGPIPE. */
void gb_term_signals_catch(struct gb_term_signals *signals);

/* Restores what was there before.  Pending signals are discarded: they requested the end
 * that has come.  No effect after giving up. */
void gb_term_signals_release(struct gb_term_signals *signals);

/* Leaves the signals blocked for good. */
void gb_term_signals_give_up(struct gb_term_signals *signals);

/* The next signal; 0: none. */
int gb_term_signals_read(const struct gb_term_signals *signals);

/* Stops the process; returns after SIGCONT. */
void gb_term_signals_stop(void);

#endif
