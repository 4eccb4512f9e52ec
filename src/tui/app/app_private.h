#ifndef GB_TUI_APP_APP_PRIVATE_H
#define GB_TUI_APP_APP_PRIVATE_H

#include "tui/app/screen.h"
#include "tui/term/stderr_tail.h"

/* State of the workbench: app.c is the loop, dispatch.c and mouse.c take the events,
 * *_commands.c are the functions of the keys. */
enum { GB_APP_FRAMES = 10, GB_APP_FRAMES_SLOW = 2 };

struct gb_app {
    struct gb_screen screen;
    struct gb_stderr_tail stderr_tail;
    bool leave;
    int status;                    /* exit status */
    bool terminal_lost;            /* hang-up: the terminal must not be touched */
    bool redraw;                   /* the screen has changed */
    bool input_pending;            /* by a key: drawn without delay */
    double frame_s[GB_APP_FRAMES]; /* clock of the last frames, a ring */
    int frames;                    /* drawn so far */
    int frames_max;                /* within any second */
};

#endif
