#ifndef GB_TUI_SESSION_SESSION_H
#define GB_TUI_SESSION_SESSION_H

#include "io/measured.h"
#include "io/preset.h"
#include "run/runner/runner.h"
#include "tui/session/chart_csv.h"
#include "tui/session/child_command.h"
#include "tui/session/previous_curve.h"
#include "tui/session/quick_cell.h"
#include "tui/session/replica_band.h"

/* What the workbench works on, without a screen: the parameters being edited, the run
 * under way, what it has shown so far and the runs before it. */

enum { GB_SESSION_PREVIOUS = 6, GB_SESSION_LOG = 200, GB_SESSION_FORKS = 16 };

struct gb_session {
    struct gb_preset *preset; /* what is edited */
    struct gb_preset *opened; /* owned: a preset opened in the workbench */
    struct gb_runner *runner; /* NULL before the first start that worked */
    const char *folder;       /* in which runs get their directories; NULL: not kept */
    const char *attached;     /* directory whose run is shown first; NULL: none */
    struct gb_quick_cell quick_cell; /* the quick cell of the last change */
    struct gb_snapshot now; /* what the screen shows; stands still while frozen */
    size_t points;          /* of the curve, shown */
    const struct gb_view_sample *sample;
    int run_state; /* enum gb_run_state now, even while the view is frozen */
    bool frozen;
    bool pause_wanted;
    bool waiting;    /* a command was sent, its effect not yet seen */
    bool yielded;    /* the run waits while the quick cell computes */
    bool auto_start; /* the full cell starts by itself behind the quick one */
    bool start_due;  /* it is to be started now */
    struct gb_previous_curve previous[GB_SESSION_PREVIOUS];
    int previous_count, kept; /* now, and ever */
    char whatif_text[200];    /* asked for, waits for a point; "": none */
    size_t
        fork_at[GB_SESSION_FORKS]; /* points of the curve, one behind the last before */
    int forks;
    struct gb_child_command child;       /* a picture, a report, cells being made */
    struct gb_replica_band replica_band; /* mean of more cells */
    struct gb_measured *measured;        /* an experiment over the plot, or NULL */
    struct gb_chart_csv *chart;          /* a chart of numerical choices, or NULL */
    int runs;                            /* started so far */
    double particle_steps_per_s;         /* of the last dynamic run; 0: none yet */
    int64_t events_seen;
    char log[GB_SESSION_LOG][GB_EVENT_TEXT + 16];
    int64_t log_count; /* all lines ever; the last GB_SESSION_LOG are kept */
};

void gb_session_init(struct gb_session *session, struct gb_preset *preset);
void gb_session_finish(struct gb_session *session);

struct gb_params *gb_session_params(struct gb_session *session);

/* Would the edited parameters take longer than is begun unasked?  Then the question is in
 * text. */
bool gb_session_cost_question(struct gb_session *session, char *text, size_t size);

/* Starts the quick cell of the edited parameters; the run under way stands aside for it.
 * Without a quick twin, or when the run has these parameters already, nothing is
 * computed.  False: no quick cell was started. */
bool gb_session_start_quick(struct gb_session *session);

/* Whether the full run is to be started now, behind its quick cell; asked once. */
bool gb_session_take_start_due(struct gb_session *session);

/* What the views of the moment show: the quick cell while it computes, else the run. */
struct gb_session_shown {
    const struct gb_snapshot *now;
    const struct gb_params *params; /* as computed; of the preset when there is nothing */
    const struct gb_curve *curve;   /* NULL: nothing yet */
    size_t points;
    const struct gb_view_sample *sample; /* NULL: none */
    int state;  /* enum gb_run_state, even while the view is frozen */
    bool quick; /* it is the quick cell */
};

struct gb_session_shown gb_session_shown(const struct gb_session *session);

/* Starts a run with the edited parameters; the one before it joins the earlier runs.  On
 * error the old run goes on. */
bool gb_session_start(struct gb_session *session, struct gb_error *err);

/* From here on the screen shows that run; the one before ends and stays as an earlier
 * curve. */
void gb_session_replace(struct gb_session *session, struct gb_runner *runner);

/* Opens a preset for editing (it is not started). */
bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err);

/* Puts an experiment over the plot, or loads a chart.csv: what the file is, its header
 * tells.  An empty path takes the experiment away.  On error all stays as it was. */
bool gb_session_load_data(struct gb_session *session, const char *path,
                          struct gb_error *err);
/* Of what the views show against the experiment; reached is 0 without one. */
void gb_session_misfit(const struct gb_session *session, struct gb_measured_misfit *out);

/* Takes what the engine has published; true when there is something new to show. */
bool gb_session_refresh(struct gb_session *session);

void gb_session_toggle_pause(struct gb_session *session);
void gb_session_toggle_freeze(struct gb_session *session);

/* A run that would lose work when it ends. */
bool gb_session_live(const struct gb_session *session);
/* The run itself, without the quick cell. */
bool gb_session_run_is_live(const struct gb_session *session);
/* Whether news can come without a key: else there is no reason to look. */
bool gb_session_busy(const struct gb_session *session);

/* Whether the edited value is not the one the run uses. */
bool gb_session_differs(struct gb_session *session, const struct gb_field *field);
int gb_session_changes(struct gb_session *session);

/* Adds a line to the events, stamped with the run's time. */
void gb_session_note(struct gb_session *session, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Line `index` counted back from the last (0); NULL when there is none. */
const char *gb_session_event_line(const struct gb_session *session, int index);

#endif
