#ifndef GB_TUI_APP_APP_H
#define GB_TUI_APP_APP_H

#include "greenbody/status.h"
#include "io/preset.h"
#include "tui/app/screen.h"
#include "tui/term/settings.h"
#include "tui/term/term.h"

/* The workbench: takes over the terminal, starts a run of the preset and handles events
 * until the user quits.  The preset's parameters are edited in place; the caller owns it.
 *
 * folder    parent of the directories of the runs; NULL: runs are not stored
 * attached  directory of a run to show instead of starting one; NULL: none
 * settings  settings of the terminal
 *
 * After a hang-up of the terminal the run continues or stops as output.on_hangup says,
 * and the function returns when it has ended.
 *
 * Returns the exit status: 0; 130, 143, 129 after SIGINT, SIGTERM, SIGHUP.  When the
 * terminal cannot be used, err is filled and its status returned. */
int gb_app_run(struct gb_preset *preset, const char *folder, const char *attached,
               const struct gb_settings *settings, struct gb_error *err);

/* State of the workbench. app.c has the event loop, *_commands.c the functions of the
 * keys. */
enum { GB_APP_FRAMES = 10, GB_APP_FRAMES_SLOW = 2 };

struct gb_app {
    struct gb_screen screen;
    struct gb_stderr_tail stderr_tail;
    bool leave;
    bool detach;        /* continue the run in a process of its own */
    int status;         /* exit status */
    bool terminal_lost; /* hang-up: no more output to the terminal */
    bool redraw;        /* the screen has changed */
    bool input_pending; /* key or resize since the last frame: draw without delay */
    double frame_s[GB_APP_FRAMES]; /* clock of the last frames, s; ring buffer */
    int frames;                    /* drawn so far */
    int frames_max;                /* limit in any second */
};

/* Passes a key or a character to the open dialog, the edited value, or the key table. */
void gb_app_event(struct gb_app *app, const struct gb_term_event *event);

#endif
