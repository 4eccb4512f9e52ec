#ifndef GB_TUI_SESSION_SESSION_H
#define GB_TUI_SESSION_SESSION_H

#include <glib.h>

#include "io/lab/lab_reader.h"
#include "io/measured.h"
#include "io/preset.h"
#include "runner/runner.h"
#include "tui/session/job.h"
#include "tui/session/past.h"
#include "tui/session/previous.h"
#include "tui/session/results.h"

/* The quick cell of the edited parameters: a second engine that computes a whole
 * loading curve in about two seconds (run/cost.h), before the full run or at the same
 * time. */
struct gb_quick_cell {
    struct gb_params full_params; /* the full scene */
    struct gb_runner *runner;     /* NULL: no quick cell */
    struct gb_snapshot now;
    size_t points;
    const struct gb_view_sample *sample;
    enum gb_run_state state;
    bool missed; /* updates withheld while the view is frozen */
};

bool gb_session_quick_cell_live(const struct gb_quick_cell *quick_cell);

/* State of the workbench without its screen: the edited parameters, the current run,
 * its data on display and the previous curves. */

enum {
    GB_SESSION_WHATIF = 800,
    GB_SESSION_LOG = 200,
    GB_SESSION_WHATIFS = GB_KEPT_RUN_WHATIFS
};

struct gb_session {
    struct gb_preset *preset; /* the preset being edited */
    GPtrArray *opened;        /* presets opened in the workbench; owned, NULL: none */
    struct gb_runner *runner; /* NULL before the first start */
    const char *folder;   /* parent of the run directories; NULL: runs are not stored */
    const char *attached; /* directory of the run shown first; NULL: none */
    struct gb_quick_cell quick_cell; /* quick cell of the last change */
    struct gb_snapshot now;          /* snapshot on display; unchanged while frozen */
    size_t points;                   /* points of the curve on display */
    const struct gb_view_sample *sample;
    enum gb_run_state run_state; /* current even while frozen */
    bool frozen;
    bool pause_wanted;
    bool waiting;    /* a command was sent, its effect is not yet visible */
    bool yielded;    /* the run waits while the quick cell computes */
    bool auto_start; /* the full cell starts after the quick one */
    bool start_due;  /* the full cell is due */
    struct gb_previous_curve previous[GB_SESSION_PREVIOUS];
    int previous_count, previous_total; /* number of previous curves, and of all so far */
    struct gb_curve_label run_label;    /* label of the run on display */
    struct gb_kept_runs kept;           /* runs and quick cells that can be shown again */
    struct gb_param_steps steps;        /* changes of the parameters */
    char whatif_text
        [GB_SESSION_WHATIF]; /* what-if that waits for the next point; "": none */
    size_t whatif_at[GB_SESSION_WHATIFS]; /* points of the curve where a what-if began */
    int whatifs;
    struct gb_child_command child; /* picture, report, replicas, calibration, moduli */
    struct gb_replica_band replica_band; /* mean of the replicas */
    struct gb_moduli_job moduli;         /* elastic moduli of the run */
    struct gb_results results;           /* results of the jobs */
    struct gb_measured *measured;        /* measured data; NULL: none */
    int measured_dimension;     /* dimension of the scene when they were loaded */
    char *reading;              /* how the file was read, as for --columns; owned */
    struct gb_chart_csv *chart; /* chart of numerical settings; NULL: none */
    struct gb_stability_csv *stability; /* stability of the methods; NULL: none */
    struct gb_chart_job chart_job;
    int runs;                    /* number of started runs */
    double particle_steps_per_s; /* speed of the last dynamic run; 0: none yet */
    int64_t events_seen;
    char log[GB_SESSION_LOG][GB_EVENT_TEXT + 16];
    int64_t log_count; /* number of all lines; the last GB_SESSION_LOG are kept */
};

void gb_session_init(struct gb_session *session, struct gb_preset *preset);
void gb_session_finish(struct gb_session *session);

struct gb_params *gb_session_params(struct gb_session *session);

/* Do the edited parameters need a confirmation because of their cost? text receives the
 * question. */
bool gb_session_cost_question(struct gb_session *session, char *text, size_t size);

/* Data for the views: the quick cell while it computes, otherwise the run. */
struct gb_session_shown {
    const struct gb_snapshot *now;
    const struct gb_params *params; /* of the run; of the preset without a run */
    const struct gb_curve *curve;   /* NULL: no curve yet */
    size_t points;
    const struct gb_view_sample *sample; /* NULL: none */
    enum gb_run_state state;             /* current even while frozen */
    bool quick;                          /* of the quick cell */
};

struct gb_session_shown gb_session_shown(const struct gb_session *session);

/* Starts a run with the edited parameters; the curve of the current one becomes a
 * previous curve.  After an error the current run continues. */
bool gb_session_start(struct gb_session *session, struct gb_error *err);

/* Replaces the current run, whose curve becomes a previous curve, by a new one. */
void gb_session_replace(struct gb_session *session, struct gb_runner *runner);

/* Opens a preset for editing; does not start it. */
bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err);

/* Loads measured data or a chart.csv, distinguished by the header of the file.  An
 * empty path removes the measured data. reading: a list for gb_lab_options_parse; "":
 * no options.  Nothing changes after a question or an error. */
enum gb_lab_outcome gb_session_load_data(struct gb_session *session, const char *path,
                                         const char *reading,
                                         struct gb_lab_report *report,
                                         struct gb_error *err);
/* The measured data, and the mean of the replicas, if they have the dimension of the
 * scene on display: densities of spheres do not compare with discs.  NULL: none. */
const struct gb_measured *gb_session_measured(const struct gb_session *session);
const struct gb_runset_view_group *gb_session_replicas(const struct gb_session *session);
/* Misfit of the curve on display to the measured data; reached is 0 without data. */
void gb_session_misfit(const struct gb_session *session, struct gb_measured_misfit *out);

/* Takes the published snapshots; true if the screen changes. */
bool gb_session_refresh(struct gb_session *session);

void gb_session_toggle_pause(struct gb_session *session);
void gb_session_toggle_freeze(struct gb_session *session);

/* Is an engine computing or paused, for the run or the quick cell? */
bool gb_session_live(const struct gb_session *session);
/* The same for the run only. */
bool gb_session_run_is_live(const struct gb_session *session);
/* Can the display change without a key, so that polling is needed? */
bool gb_session_busy(const struct gb_session *session);

/* Does the edited value differ from that of the run? */
bool gb_session_differs(struct gb_session *session, const struct gb_field *field);
int gb_session_changes(struct gb_session *session);

/* Adds a line to the events, with the elapsed time of the run. */
void gb_session_note(struct gb_session *session, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Line `index` from the end (0: the last); NULL: none. */
const char *gb_session_event_line(const struct gb_session *session, int index);

/* A what-if: the current run continues from its next point with other values, in the
 * syntax of gb_changes_add (scene/field/changes.h).  Its curve so far becomes a
 * previous curve.  Errors: GB_ERR_INPUT. */
bool gb_session_whatif_request(struct gb_session *session, const char *text,
                               struct gb_error *err);

/* After a change of the parameters: shows the run or quick cell with these parameters
 * if it is kept in memory, else starts a quick cell.  A run that was stopped because it
 * was replaced continues if it is stored in a directory. */
void gb_session_show_edited(struct gb_session *session);

/* Goes to the parameters before (-1) or after (1) a change and shows their results.
 * text receives what has changed, or that there is nothing.  False: nothing has
 * changed. */
bool gb_session_recall_step(struct gb_session *session, int direction, char *text,
                            size_t size);

/* Starts the quick cell of the edited parameters; the engine of the current run waits
 * for it.  Nothing starts for scenes without a quick cell or with the parameters of the
 * current run.  False: no quick cell was started. */
bool gb_session_quick_start(struct gb_session *session);

/* Is the full run due after its quick cell?  Clears the flag. */
bool gb_session_quick_take_due(struct gb_session *session);

#endif
