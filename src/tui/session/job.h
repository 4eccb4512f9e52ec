#ifndef GB_TUI_SESSION_JOB_H
#define GB_TUI_SESSION_JOB_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "run/moduli_table.h"
#include "runner/runner.h"
#include "study/chart.h"
#include "tui/session/runset_view.h"

enum { GB_CHILD_COMMAND_LINE = 256 };

enum gb_child_command_kind {
    GB_CHILD_COMMAND_SHORT, /* its last line of output is shown if it fails */
    GB_CHILD_COMMAND_LONG,  /* all its output is shown; lower scheduling priority */
    GB_CHILD_COMMAND_QUIET  /* its progress is shown, else as SHORT; lower priority */
};

/* A command of this program as a child process: picture, report, replicas, calibration.
 * One at a time. */
struct gb_child_command {
    int pid;       /* 0: no child */
    int output_fd; /* pipe of its standard output and error; -1: closed */
    enum gb_child_command_kind kind;
    char name[16];                        /* "picture" */
    char path[512];                       /* path of its result */
    char progress[GB_CHILD_COMMAND_LINE]; /* "12 of 40 runs, ...", "1 of 3 states: ..." */
    char line[GB_CHILD_COMMAND_LINE];     /* incomplete line, or the last one */
    size_t length;
    bool succeeded; /* success of the last command that ended */
};

/* words: command and arguments without the program's name, NULL at the end, 14 at most.
 * Errors: GB_ERR_INPUT while another one is running, GB_ERR_MACHINE. */
bool gb_job_start(struct gb_child_command *child, const char *name, const char *path,
                  enum gb_child_command_kind kind, const char *const *words,
                  struct gb_error *err);

/* Asks the command to end; it has ended at GB_CHILD_COMMAND_ENDED. */
void gb_job_stop(const struct gb_child_command *child);

enum gb_child_command_event {
    GB_CHILD_COMMAND_NONE,
    GB_CHILD_COMMAND_PROGRESS, /* in child->progress */
    GB_CHILD_COMMAND_OUTPUT,
    GB_CHILD_COMMAND_ENDED
};

/* The next event; text receives the line of output, or the outcome. */
enum gb_child_command_event gb_job_poll(struct gb_child_command *child, char *text,
                                        size_t size);

/* Accuracy against cost, or stability, of the scene on display: a child command
 * `greenbody chart` or `greenbody stability`, whose table is read while it grows. */
struct gb_chart_job {
    char *directory;    /* NULL: none was started */
    bool stability;     /* the table is stability.csv, else chart.csv */
    gint64 modified_ns; /* time of the table that was read */
};

/* Follows the table in a directory from now on. */
void gb_job_chart_follow(struct gb_chart_job *job, const char *directory, bool stability);

void gb_job_chart_finish(struct gb_chart_job *job); /* zeroed is fine */

/* Is the child command one of these two? */
bool gb_job_chart_runs(const struct gb_child_command *child);

/* The chart.csv of `greenbody chart`: cost and error of numerical settings. */
struct gb_chart_csv {
    size_t count;
    struct gb_chart_setting *setting; /* relaxer "": the row has no setting */
    double *seconds, *error; /* CPU time of one cell; bound of the density error */
    double reference_s;      /* CPU time of a cell of the reference; NaN: unknown */
    bool *front;             /* on the Pareto front */
    bool *noise;             /* no error exceeds two standard errors */
    size_t chosen;           /* count: none */
    char name[64];   /* of the recommended one: "fire, step 0.1 %, tolerance 0.02" */
    size_t *by_cost; /* rows with an error, the cheapest first */
    size_t known;    /* number of these */
};

/* The stability.csv of `greenbody stability PRESET`: longest stable steps of the
 * methods of a scene in states of its run. */
struct gb_stability_csv_row {
    char method[24];
    double density;
    double measured, used; /* sqrt(m/(E d)), which is T; of steepest 1/(E d) */
    bool stable;           /* stable with the step of the run */
    bool in_use;
};

struct gb_stability_csv {
    size_t count;
    bool in_time; /* velocity Verlet with its step; else relaxers, which start
                   * with their largest step and shorten it */
    struct gb_stability_csv_row *row; /* in the order of the run */
    double *p_mpa, *margin;           /* margin: measured over used */
};

/* Reads the table if it has changed; true if *chart or *stability was replaced. */
bool gb_job_chart_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart,
                          struct gb_stability_csv **stability);

/* Errors: GB_ERR_INPUT, one line, for another table. */
bool gb_job_chart_csv_read(struct gb_chart_csv **out, const char *path,
                           struct gb_error *err);

/* Sets the parameters of row i.  The number of particles does not change if the row has
 * that of the chart's own scene. */
void gb_job_chart_csv_apply(const struct gb_chart_csv *chart, size_t i,
                            struct gb_params *params);

void gb_job_chart_csv_destroy(struct gb_chart_csv *chart); /* NULL is fine */

void gb_job_stability_destroy(struct gb_stability_csv *table); /* NULL is fine */

/* The row of the method in use with the least margin; count: none. */
size_t gb_job_stability_weakest(const struct gb_stability_csv *table);

/* Sets the method of row i; in a dynamic scene the time step with a margin of 2. text
 * receives the assignment as in a preset.  Errors: GB_ERR_INPUT for a relaxer that is
 * not stable there. */
bool gb_job_stability_apply(const struct gb_stability_csv *table, size_t i,
                            struct gb_params *params, char *text, size_t size,
                            struct gb_error *err);

/* Elastic moduli of the run on display: a child command `greenbody moduli DIR --out
 * DIR`, started after the run has stored its present state, and the table that it
 * writes. */
struct gb_moduli_job {
    char *directory; /* run whose table is on display; NULL: none */
    GArray *states;  /* struct gb_moduli_state in the order of the run; NULL: none */
    const struct gb_runner *waits_for; /* run that stores its state first; NULL: none */
    int64_t stored;                    /* gb_runner_stored before the request */
    struct gb_error failed;            /* for the events: the command could not start */
};

void gb_job_moduli_finish(struct gb_moduli_job *job); /* zeroed is fine */

/* Measures the states of the run that have no moduli yet: the states kept in its
 * directory and the present one.  Errors: GB_ERR_INPUT (no stored run, no periodic
 * cell, another child command), GB_ERR_MACHINE. */
bool gb_job_moduli_start(struct gb_moduli_job *job, struct gb_runner *runner, bool live,
                         struct gb_child_command *child, struct gb_error *err);

/* Is a measurement active; is it for the run on display; its end. */
bool gb_job_moduli_runs(const struct gb_moduli_job *job,
                        const struct gb_child_command *child);

bool gb_job_moduli_measures(const struct gb_moduli_job *job,
                            const struct gb_child_command *child);

void gb_job_moduli_stop(struct gb_moduli_job *job, const struct gb_child_command *child);

/* Starts the command when the state is stored, and reads the table of the run when the
 * child command reports news.  True if the display changes. */
bool gb_job_moduli_refresh(struct gb_moduli_job *job, struct gb_runner *runner,
                           struct gb_child_command *child, bool news);

/* Replicas of a scene for the plot: mean and standard error, read from their directory
 * while they are computed. */
struct gb_replica_band {
    char *directory; /* NULL: none */
    struct gb_params params;
    struct gb_runset_view runset;
    double target, target_pa; /* standard error of density asked for; 0: none */
    double due;               /* clock time of the next read, s */
};

/* Starts showing the replicas in a directory. */
void gb_job_replicas_follow(struct gb_replica_band *band, const char *directory,
                            const struct gb_params *params);

/* Reads again when due, or at once; true if it read. */
bool gb_job_replicas_refresh(struct gb_replica_band *band, bool at_once);

void gb_job_replicas_finish(struct gb_replica_band *band); /* zeroed is fine */

/* The band to draw; NULL: none yet. */
const struct gb_runset_view_group *
gb_job_replicas_group(const struct gb_replica_band *band);

#endif
