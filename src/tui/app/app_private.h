#ifndef GB_TUI_APP_APP_PRIVATE_H
#define GB_TUI_APP_APP_PRIVATE_H

#include "tui/app/screen.h"
#include "tui/term/stderr_tail.h"

/* State of the workbench.  app.c: the event loop; dispatch.c and mouse.c: events;
 * *_commands.c: functions of the keys. */
enum { GB_APP_FRAMES = 10, GB_APP_FRAMES_SLOW = 2 };

struct gb_app {
    struct gb_screen screen;
    struct gb_stderr_tail stderr_tail;
    bool leave;
    bool detach;        /* the run goes on in a process of its own */
    int status;         /* exit status */
    bool terminal_lost; /* hang-up: no more output to the terminal */
    bool redraw;        /* the screen has changed */
    bool input_pending; /* key or resize since the last frame: drawn without delay */
    double frame_s[GB_APP_FRAMES]; /* clock of the last frames, s; ring buffer */
    int frames;                    /* drawn so far */
    int frames_max;                /* within any second */
};

#endif
