#ifndef GB_TUI_APP_APP_PRIVATE_H
#define GB_TUI_APP_APP_PRIVATE_H

#include "tui/app/screen.h"
#include "tui/term/stderr_tail.h"

/* The workbench from inside: app.c is the loop, act.c what each key does, asks.c what is
 * asked and answered, pointer.c the mouse. */
enum { GB_APP_FRAMES = 10, GB_APP_FRAMES_SLOW = 2 };

struct gb_app {
    struct gb_screen screen;
    struct gb_stderr_tail stderr_tail;
    bool leave, dirty;
    bool gone;   /* the terminal */
    bool urgent; /* a key waits for its frame */
    int status;
    double frame[GB_APP_FRAMES]; /* clock of the last frames, the next one takes the
                                    oldest */
    int frames;
    int max; /* of them within a second */
};

#endif
