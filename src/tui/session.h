#ifndef GB_TUI_SESSION_H
#define GB_TUI_SESSION_H

#include "run/preset.h"
#include "run/runner.h"

/* What the workbench works on, without a screen: the parameters being edited, the run
 * under way, what it has shown so far and the runs before it. */

enum { GB_SESSION_EARLIER = 6, GB_SESSION_LOG = 200, GB_SESSION_DIFFERENCE = 96 };

/* A run that was replaced: what the plot needs of it. */
struct gb_earlier {
    struct gb_params params;
    char letter;                            /* 'a', 'b', ...: its mark in the plot */
    char difference[GB_SESSION_DIFFERENCE]; /* its own values where the new run differs */
    size_t count;
    double *density, *pressure_pa; /* NaN between branches */
    double *elapsed;               /* gb_session_elapsed of the points */
};

struct gb_session {
    struct gb_preset *preset; /* what is edited */
    struct gb_preset *opened; /* owned: a preset opened in the workbench */
    struct gb_runner *runner; /* NULL before the first start that worked */
    struct gb_snapshot now;   /* what the screen shows; stands still while frozen */
    size_t points;            /* of the curve, shown */
    int engine;               /* enum gb_run_state now, even while the view is frozen */
    bool frozen;
    bool pause_wanted;
    bool waiting; /* a command was sent, its effect not yet seen */
    struct gb_earlier earlier[GB_SESSION_EARLIER];
    int earlier_count;
    int runs;                    /* started so far */
    double particle_steps_per_s; /* of the last dynamic run; 0: none yet */
    int64_t events_seen;
    char log[GB_SESSION_LOG][GB_SNAPSHOT_EVENT + 16];
    int64_t log_count; /* all lines ever; the last GB_SESSION_LOG are kept */
};

void gb_session_init(struct gb_session *session, struct gb_preset *preset);
void gb_session_finish(struct gb_session *session);

struct gb_params *gb_session_params(struct gb_session *session);

/* Would the edited parameters take longer than is begun unasked?  Then the question is in
 * text. */
bool gb_session_costly(struct gb_session *session, char *text, size_t size);

/* Starts a run with the edited parameters; the one before it joins the earlier runs.  On
 * error the old run goes on. */
bool gb_session_start(struct gb_session *session, struct gb_error *err);

/* Opens a preset for editing (it is not started). */
bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err);

/* Takes what the engine has published; true when there is something new to show. */
bool gb_session_refresh(struct gb_session *session);

void gb_session_toggle_pause(struct gb_session *session);
void gb_session_toggle_freeze(struct gb_session *session);

/* A run that would lose work when it ends. */
bool gb_session_live(const struct gb_session *session);
/* Whether news can come without a key: else there is no reason to look. */
bool gb_session_busy(const struct gb_session *session);

/* Whether the edited value is not the one the run uses. */
bool gb_session_differs(struct gb_session *session, const struct gb_field *field);
int gb_session_changes(struct gb_session *session);

/* Where a point of a run of that kind lies in time: ns simulated of a dynamic run, the
 * number of the recorded step of a quasi-static one. */
double gb_session_elapsed(int kind, const struct gb_point *point);

/* Adds a line to the events, stamped with the run's time. */
void gb_session_note(struct gb_session *session, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Line `index` counted back from the last (0); NULL when there is none. */
const char *gb_session_line(const struct gb_session *session, int index);

#endif
