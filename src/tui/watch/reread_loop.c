#include "tui/watch/reread_loop.h"

#include <math.h>
#include <signal.h>

#include "base/clock.h"

/* Time between two readings over the duration of one, at least. */
static const double share = 10.0;

enum { STATUS_SIGNAL = 128 };

/* Exit status; -1: continue. */
static int handle(const struct gb_reread_loop *loop, struct gb_term *term,
                  const struct gb_term_event *event)
{
    switch (event->kind) {
    case GB_TERM_KEY:
    case GB_TERM_TEXT:
        return loop->key(loop->data, term, event) ? -1 : 0;
    case GB_TERM_MOUSE:
        loop->wheel(loop->data, event->code == GB_TERM_WHEEL_UP     ? -1
                                : event->code == GB_TERM_WHEEL_DOWN ? 1
                                                                    : 0);
        return -1;
    case GB_TERM_INTERRUPT:
        return STATUS_SIGNAL + SIGINT;
    case GB_TERM_TERMINATE:
        return STATUS_SIGNAL + event->code;
    case GB_TERM_HANGUP:
        return STATUS_SIGNAL + SIGHUP;
    case GB_TERM_TIMEOUT:
    case GB_TERM_RESIZED:
        break;
    }
    return -1;
}

/* Reads and returns when to do so again. */
static double reread(const struct gb_reread_loop *loop)
{
    const double from = gb_clock_s();
    loop->reread(loop->data);
    const double now = gb_clock_s();
    return now + fmax(loop->reread_s, share * (now - from));
}

int gb_reread_loop_run(const struct gb_reread_loop *loop, struct gb_term *term)
{
    double due = gb_clock_s() + loop->reread_s;
    bool hangup = false;
    int status = -1;
    while (status < 0) {
        loop->draw(loop->data, term);
        const double left = due - gb_clock_s();
        const struct gb_term_event event =
            gb_term_wait(term, left > 0.0 ? (int)(1e3 * left) + 1 : 0);
        status = handle(loop, term, &event);
        hangup = event.kind == GB_TERM_HANGUP;
        if (status < 0 && gb_clock_s() >= due) {
            due = reread(loop);
        }
    }
    if (hangup) {
        gb_term_abandon(term);
    } else {
        gb_term_stop(term);
    }
    gb_term_destroy(term);
    return status;
}
