#include "tui/session/job.h"

#include <fcntl.h>
#include <glib.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/program.h"
#include "base/table.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "run/moduli_table.h"
#include "runner/runner.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"
#include "study/chart.h"
#include "tui/session/runset_view.h"

/* Jobs in the background.  A job is a command of this program as a child process.  The
 * files that it writes are read while they grow: moduli, the chart of settings,
 * stability, replicas. */

/* Seconds between two reads, or ten times the duration of a read if that is longer. */
static const double reread_s = 1.0;
static const double share = 10.0;

void gb_job_replicas_follow(struct gb_replica_band *band, const char *directory,
                            const struct gb_params *params)
{
    gb_job_replicas_finish(band);
    band->directory = g_strdup(directory);
    band->params = *params;
}

/* An error keeps the band on display, because the next read may succeed. */
bool gb_job_replicas_refresh(struct gb_replica_band *band, bool at_once)
{
    struct gb_runset_view fresh;
    struct gb_error err = {0};
    const double from = gb_clock_s();
    if (band->directory == NULL || (!at_once && from < band->due)) {
        return false;
    }
    const bool good = gb_runset_view_read(&fresh, band->directory, &err);
    band->due = gb_clock_s() + MAX(reread_s, share * (gb_clock_s() - from));
    if (good) {
        gb_runset_view_finish(&band->runset);
        band->runset = fresh;
    } else {
        gb_runset_view_finish(&fresh);
    }
    return good;
}

void gb_job_replicas_finish(struct gb_replica_band *band)
{
    gb_runset_view_finish(&band->runset);
    g_free(band->directory);
    memset(band, 0, sizeof *band);
}

const struct gb_runset_view_group *
gb_job_replicas_group(const struct gb_replica_band *band)
{
    return band->directory != NULL && band->runset.groups > 0 ? &band->runset.group[0]
                                                              : NULL;
}

static const char moduli_name[] = "moduli";

static void drop_table(struct gb_moduli_job *job)
{
    if (job->states != NULL) {
        g_array_free(job->states, TRUE);
    }
    g_free(job->directory);
    job->states = NULL;
    job->directory = NULL;
}

void gb_job_moduli_finish(struct gb_moduli_job *job)
{
    drop_table(job);
    memset(job, 0, sizeof *job);
}

static bool start_command(struct gb_moduli_job *job, const char *directory,
                          struct gb_child_command *child, struct gb_error *err)
{
    char *path = g_build_filename(directory, GB_MODULI_STATES_FILE, NULL);
    const char *const words[] = {moduli_name, directory, "--out", directory, NULL};
    char *state = g_build_filename(directory, "state.h5", NULL);
    const bool stored = g_file_test(state, G_FILE_TEST_EXISTS);
    g_free(state);
    job->waits_for = NULL;
    const bool good =
        (stored || gb_error_set(err, GB_ERR_INPUT, "the run has no stored state yet")) &&
        gb_job_start(child, moduli_name, path, GB_CHILD_COMMAND_QUIET, words, err);
    g_free(path);
    return good;
}

bool gb_job_moduli_start(struct gb_moduli_job *job, struct gb_runner *runner, bool live,
                         struct gb_child_command *child, struct gb_error *err)
{
    if (runner == NULL || gb_runner_directory(runner) == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "no stored run yet: r starts one");
    }
    if (!gb_loading_kind_check_cell(gb_runner_params(runner), moduli_name, err)) {
        return false;
    }
    if (child->pid != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the %s is not finished yet", child->name);
    }
    if (!live) {
        return start_command(job, gb_runner_directory(runner), child, err);
    }
    const int64_t stored = gb_runner_stored(runner);
    if (!gb_runner_send(runner, GB_COMMAND_STORE)) {
        return gb_error_set(err, GB_ERR_INPUT, "the engine is busy: try again");
    }
    job->waits_for = runner;
    job->stored = stored;
    return true;
}

bool gb_job_moduli_runs(const struct gb_moduli_job *job,
                        const struct gb_child_command *child)
{
    return job->waits_for != NULL ||
           (child->pid != 0 && strcmp(child->name, moduli_name) == 0);
}

bool gb_job_moduli_measures(const struct gb_moduli_job *job,
                            const struct gb_child_command *child)
{
    return gb_job_moduli_runs(job, child) &&
           (job->waits_for != NULL ||
            (job->directory != NULL && g_str_has_prefix(child->path, job->directory)));
}

void gb_job_moduli_stop(struct gb_moduli_job *job, const struct gb_child_command *child)
{
    if (job->waits_for != NULL) {
        job->waits_for = NULL;
    } else if (gb_job_moduli_runs(job, child)) {
        gb_job_stop(child);
    }
}

/* A run that has ended has already stored its last state. */
static void follow_store(struct gb_moduli_job *job, struct gb_runner *runner,
                         struct gb_child_command *child)
{
    if (job->waits_for != runner) { /* another run is on display */
        job->waits_for = NULL;
        return;
    }
    const bool over = gb_runner_snapshot(runner, NULL)->state >= GB_RUN_DONE;
    if (over || gb_runner_stored(runner) > job->stored) {
        (void)start_command(job, gb_runner_directory(runner), child, &job->failed);
    }
}

static bool is_shown(const struct gb_moduli_job *job, const char *directory)
{
    return g_strcmp0(job->directory, directory) == 0;
}

/* Reads the table.  An error keeps the data on display, because the next read may
 * succeed. */
static void moduli_job_read_table(struct gb_moduli_job *job, const char *directory)
{
    GArray *states = g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state));
    char *path = g_build_filename(directory, GB_MODULI_STATES_FILE, NULL);
    if (g_file_test(path, G_FILE_TEST_EXISTS) &&
        gb_moduli_table_read(states, path, NULL)) {
        if (job->states != NULL) {
            g_array_free(job->states, TRUE);
        }
        job->states = states;
    } else {
        g_array_free(states, TRUE);
    }
    g_free(path);
}

bool gb_job_moduli_refresh(struct gb_moduli_job *job, struct gb_runner *runner,
                           struct gb_child_command *child, bool news)
{
    const char *directory = runner != NULL ? gb_runner_directory(runner) : NULL;
    const bool waited = job->waits_for != NULL;
    const bool other = !is_shown(job, directory);
    if (waited) {
        follow_store(job, runner, child);
    }
    if (other) {
        drop_table(job);
        job->directory = g_strdup(directory);
    }
    if (directory != NULL && (other || news)) {
        moduli_job_read_table(job, directory);
    }
    return other || (waited && job->waits_for == NULL);
}

enum { P, DENSITY, MEASURED, USED, MARGIN, STABLE, IN_USE, STABILITY_COLUMNS };

static const char *const stability_columns[STABILITY_COLUMNS] = {
    "p_MPa", "density", "measured", "used", "margin", "stable", "in_use"};

static bool stability_csv_fill(struct gb_stability_csv *out, const struct gb_table *table,
                               struct gb_error *err)
{
    const double *column[STABILITY_COLUMNS];
    for (int k = 0; k < STABILITY_COLUMNS; k++) {
        column[k] = gb_table_column(table, stability_columns[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    const size_t rows = gb_table_rows(table);
    out->row = gb_alloc_array(rows + 1, sizeof *out->row, err);
    out->p_mpa = gb_alloc_array(rows + 1, sizeof *out->p_mpa, err);
    out->margin = gb_alloc_array(rows + 1, sizeof *out->margin, err);
    if (out->row == NULL || out->p_mpa == NULL || out->margin == NULL) {
        return false;
    }
    out->count = rows;
    for (size_t i = 0; i < rows; i++) {
        out->row[i] = (struct gb_stability_csv_row){.density = column[DENSITY][i],
                                                    .measured = column[MEASURED][i],
                                                    .used = column[USED][i],
                                                    .stable = column[STABLE][i] > 0.0,
                                                    .in_use = column[IN_USE][i] > 0.0};
        g_strlcpy(out->row[i].method, gb_table_word(table, i), sizeof out->row[i].method);
        out->in_time = strcmp(out->row[i].method, "verlet") == 0;
        out->p_mpa[i] = column[P][i];
        out->margin[i] = column[MARGIN][i];
    }
    return true;
}

/* Errors: GB_ERR_INPUT, one line, for another table. */
static bool job_stability_read(struct gb_stability_csv **out, const char *path,
                               struct gb_error *err)
{
    struct gb_table *table = NULL;
    if (!gb_table_read(&table, path, "method", err)) {
        return false;
    }
    struct gb_stability_csv *fresh = gb_alloc_array(1, sizeof *fresh, err);
    const bool good = fresh != NULL && stability_csv_fill(fresh, table, err);
    gb_table_destroy(table);
    if (!good) {
        gb_job_stability_destroy(fresh);
        return false;
    }
    *out = fresh;
    return true;
}

void gb_job_stability_destroy(struct gb_stability_csv *table)
{
    if (table != NULL) {
        gb_alloc_free(table->row);
        gb_alloc_free(table->p_mpa);
        gb_alloc_free(table->margin);
        gb_alloc_free(table);
    }
}

size_t gb_job_stability_weakest(const struct gb_stability_csv *table)
{
    size_t weakest = table->count;
    for (size_t i = 0; i < table->count; i++) {
        if (table->row[i].in_use &&
            (weakest == table->count || table->margin[i] < table->margin[weakest])) {
            weakest = i;
        }
    }
    return weakest;
}

bool gb_job_stability_apply(const struct gb_stability_csv *table, size_t i,
                            struct gb_params *params, char *text, size_t size,
                            struct gb_error *err)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    if (gb_loading_kind_of(params)->follows_time) {
        snprintf(text, size, "numerics.time_step=%.3g T",
                 GB_STEP_CRITICAL_FRACTION * row->measured);
    } else if (row->stable) {
        snprintf(text, size, "numerics.relaxer=%s", row->method);
    } else {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s is not stable here: it takes %.3g, expected up to %.3g",
                            row->method, row->used, row->measured);
    }
    return gb_params_assign(params, text, err);
}

/* Finds columns; NULL, and err with the name, if one is missing. */
static bool find_columns(const struct gb_table *table, const char *const *names,
                         const double **column, size_t count, struct gb_error *err)
{
    for (size_t i = 0; i < count; i++) {
        column[i] = gb_table_column(table, names[i], err);
        if (column[i] == NULL) {
            return false;
        }
    }
    return true;
}

static void write_name(struct gb_chart_csv *chart, const struct gb_table *table,
                       size_t row)
{
    const double *step = gb_table_column(table, "step", NULL);
    const double *tolerance = gb_table_column(table, "tolerance", NULL);
    snprintf(chart->name, sizeof chart->name, "%.24s, step %.3g %%, tolerance %.3g",
             gb_table_word(table, row), step != NULL ? 100.0 * step[row] : (double)NAN,
             tolerance != NULL ? tolerance[row] : (double)NAN);
}

static double value_at(const struct gb_table *table, const char *name, size_t row)
{
    const double *column = gb_table_column(table, name, NULL);
    return column != NULL ? column[row] : (double)NAN;
}

static struct gb_chart_setting setting_of(const struct gb_table *table, size_t row)
{
    const double particles = value_at(table, "particles", row);
    struct gb_chart_setting setting = {
        .count = particles >= 1.0 && particles < 1e12 ? (int64_t)particles : 0,
        .strain_step = value_at(table, "step", row),
        .tolerance = value_at(table, "tolerance", row),
        .cutoff = value_at(table, "cutoff_d", row),
        .single = value_at(table, "bits", row) == 32.0,
        .time_step = value_at(table, "time_step_T", row),
        .step_error = value_at(table, "step_error", row),
    };
    g_strlcpy(setting.relaxer, setting.count > 0 ? gb_table_word(table, row) : "",
              sizeof setting.relaxer);
    return setting;
}

static bool allocate(struct gb_chart_csv *chart, size_t rows, struct gb_error *err)
{
    chart->setting = gb_alloc_array(rows + 1, sizeof *chart->setting, err);
    chart->seconds = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->error = gb_alloc_array(rows + 1, sizeof(double), err);
    chart->front = gb_alloc_array(rows + 1, sizeof(bool), err);
    chart->noise = gb_alloc_array(rows + 1, sizeof(bool), err);
    chart->by_cost = gb_alloc_array(rows + 1, sizeof(size_t), err);
    return chart->setting != NULL && chart->seconds != NULL && chart->error != NULL &&
           chart->front != NULL && chart->noise != NULL && chart->by_cost != NULL;
}

/* Is row i complete, with a cost and an error? */
static bool job_chart_csv_is_known(const struct gb_chart_csv *chart, size_t i)
{
    return chart->error[i] > 0.0 && chart->seconds[i] > 0.0;
}

static void sort_by_cost(struct gb_chart_csv *chart)
{
    for (size_t i = 0; i < chart->count; i++) {
        if (!job_chart_csv_is_known(chart, i)) {
            continue;
        }
        size_t at = chart->known++;
        while (at > 0 && chart->seconds[chart->by_cost[at - 1]] > chart->seconds[i]) {
            chart->by_cost[at] = chart->by_cost[at - 1];
            at--;
        }
        chart->by_cost[at] = i;
    }
}

static bool fill(struct gb_chart_csv *chart, const struct gb_table *table,
                 struct gb_error *err)
{
    enum { SECONDS, ERROR, FRONT, CHOSEN, COLUMNS };
    static const char *const names[COLUMNS] = {"cpu_s", "bound", "front", "chosen"};
    const double *column[COLUMNS];
    const size_t rows = gb_table_rows(table);
    if (!find_columns(table, names, column, COLUMNS, err) ||
        !allocate(chart, rows, err)) {
        return false;
    }
    chart->count = rows;
    chart->chosen = rows;
    chart->reference_s = NAN;
    for (size_t i = 0; i < rows; i++) {
        chart->setting[i] = setting_of(table, i);
        chart->seconds[i] = column[SECONDS][i];
        chart->error[i] = column[ERROR][i];
        chart->front[i] = column[FRONT][i] > 0.0;
        chart->noise[i] = value_at(table, "noise_limited", i) > 0.0;
        if (value_at(table, "reference", i) > 0.0) {
            chart->reference_s = chart->seconds[i];
        }
        if (column[CHOSEN][i] > 0.0) {
            chart->chosen = i;
            write_name(chart, table, i);
        }
    }
    sort_by_cost(chart);
    return true;
}

void gb_job_chart_csv_apply(const struct gb_chart_csv *chart, size_t i,
                            struct gb_params *params)
{
    struct gb_chart_setting setting = chart->setting[i];
    if (setting.count == chart->setting[0].count) {
        setting.count = params->count;
    }
    gb_chart_apply(params, &setting);
}

bool gb_job_chart_csv_read(struct gb_chart_csv **out, const char *path,
                           struct gb_error *err)
{
    struct gb_table *table = NULL;
    if (!gb_table_read(&table, path, "relaxer", err)) {
        return false;
    }
    struct gb_chart_csv *chart = gb_alloc_array(1, sizeof *chart, err);
    const bool good = chart != NULL && fill(chart, table, err);
    gb_table_destroy(table);
    if (!good) {
        gb_job_chart_csv_destroy(chart);
        return false;
    }
    *out = chart;
    return true;
}

void gb_job_chart_csv_destroy(struct gb_chart_csv *chart)
{
    if (chart != NULL) {
        gb_alloc_free(chart->setting);
        gb_alloc_free(chart->by_cost);
        gb_alloc_free(chart->seconds);
        gb_alloc_free(chart->error);
        gb_alloc_free(chart->front);
        gb_alloc_free(chart->noise);
        gb_alloc_free(chart);
    }
}

void gb_job_chart_follow(struct gb_chart_job *job, const char *directory, bool stability)
{
    gb_job_chart_finish(job);
    job->directory = g_strdup(directory);
    job->stability = stability;
}

void gb_job_chart_finish(struct gb_chart_job *job)
{
    g_free(job->directory);
    memset(job, 0, sizeof *job);
}

bool gb_job_chart_runs(const struct gb_child_command *child)
{
    return child->pid != 0 &&
           (strcmp(child->name, "chart") == 0 || strcmp(child->name, "stability") == 0);
}

/* Reads the table.  An error keeps the data on display. */
static bool read_table(const struct gb_chart_job *job, const char *path,
                       struct gb_chart_csv **chart, struct gb_stability_csv **stability)
{
    struct gb_chart_csv *next_chart = NULL;
    struct gb_stability_csv *next = NULL;
    if (!(job->stability ? job_stability_read(&next, path, NULL)
                         : gb_job_chart_csv_read(&next_chart, path, NULL))) {
        return false;
    }
    if (job->stability) {
        gb_job_stability_destroy(*stability);
        *stability = next;
    } else {
        gb_job_chart_csv_destroy(*chart);
        *chart = next_chart;
    }
    return true;
}

/* The file is always replaced as a whole. */
bool gb_job_chart_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart,
                          struct gb_stability_csv **stability)
{
    struct stat info;
    if (job->directory == NULL) {
        return false;
    }
    char *path = g_build_filename(job->directory,
                                  job->stability ? "stability.csv" : "chart.csv", NULL);
    const bool there = stat(path, &info) == 0;
    const gint64 modified_ns =
        there ? (gint64)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec : 0;
    const bool good = there && modified_ns != job->modified_ns &&
                      read_table(job, path, chart, stability);
    g_free(path);
    if (good) {
        job->modified_ns = modified_ns;
    }
    return good;
}

enum { WORDS = 16, LOWER_PRIORITY = 5 };

/* In the child: unblocks the signals that the screen blocks, and redirects standard
 * output to standard error, off the screen. */
static void prepare_child(gpointer data)
{
    const struct gb_child_command *child = data;
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    (void)dup2(STDERR_FILENO, STDOUT_FILENO);
    if (child->kind != GB_CHILD_COMMAND_SHORT) {
        (void)setpriority(PRIO_PROCESS, 0, LOWER_PRIORITY);
    }
}

bool gb_job_start(struct gb_child_command *child, const char *name, const char *path,
                  enum gb_child_command_kind kind, const char *const *words,
                  struct gb_error *err)
{
    static char program[] = "greenbody";
    if (child->pid != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the %s is not finished yet", child->name);
    }
    char *file = gb_program_executable();
    char *argv[WORDS + 1] = {file, program};
    GError *error = NULL;
    GPid pid = 0;
    struct gb_child_command next = {.output_fd = -1, .kind = kind};
    for (int i = 0; words[i] != NULL && i < WORDS - 2; i++) {
        argv[i + 2] = (char *)words[i];
    }
    const bool started = g_spawn_async_with_pipes(
        NULL, argv, NULL, G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_FILE_AND_ARGV_ZERO,
        prepare_child, &next, &pid, NULL, NULL, &next.output_fd, &error);
    g_free(file);
    if (!started) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: %s", name, error->message);
        g_error_free(error);
        return false;
    }
    (void)fcntl(next.output_fd, F_SETFL, fcntl(next.output_fd, F_GETFL) | O_NONBLOCK);
    next.pid = (int)pid;
    g_strlcpy(next.name, name, sizeof next.name);
    g_strlcpy(next.path, path, sizeof next.path);
    *child = next;
    return true;
}

/* Reads output; true: a complete line.  The last line may lack its newline. */
static bool read_line(struct gb_child_command *child)
{
    char c = '\0';
    while (child->output_fd >= 0) {
        const ssize_t n = read(child->output_fd, &c, 1);
        if (n < 0) {
            return false; /* nothing yet */
        }
        if (n == 0) {
            close(child->output_fd);
            child->output_fd = -1;
        }
        if (n == 0 || c == '\n') {
            const bool some = child->length > 0;
            child->length = 0;
            if (some) {
                return true;
            }
        } else if (child->length + 1 < sizeof child->line) {
            child->line[child->length++] = c;
            child->line[child->length] = '\0';
        }
    }
    return false;
}

void gb_job_stop(const struct gb_child_command *child)
{
    if (child->pid != 0) {
        (void)kill(child->pid, SIGTERM);
    }
}

/* Is this a progress line, which the next one replaces: "12 of 40 runs, 0 failed, 3 min
 * left", "1 of 3 states: ...", " 5 of 82  0.1 CPU s  fire, ..."? */
static bool is_progress(const char *line)
{
    line += strspn(line, " ");
    return g_ascii_isdigit(line[0]) && strstr(line, " of ") != NULL &&
           (strstr(line, " runs, ") != NULL || strstr(line, " states: ") != NULL ||
            strstr(line, " CPU s ") != NULL);
}

static const char error_prefix[] = "greenbody: ";

/* Is this the reason of a failure, the last line of a command? */
static bool is_error(const char *line)
{
    return g_str_has_prefix(line, error_prefix);
}

static void write_outcome(const struct gb_child_command *child, char *text, size_t size)
{
    if (child->succeeded) {
        snprintf(text, size, "%s saved: %s", child->name, child->path);
    } else {
        const char *line =
            is_error(child->line) ? child->line + strlen(error_prefix) : child->line;
        snprintf(text, size, "%s: %s", child->name, *line != '\0' ? line : "stopped");
    }
}

enum gb_child_command_event gb_job_poll(struct gb_child_command *child, char *text,
                                        size_t size)
{
    int status = 0;
    if (child->pid == 0) {
        return GB_CHILD_COMMAND_NONE;
    }
    while (read_line(child)) {
        if (child->kind != GB_CHILD_COMMAND_SHORT && is_progress(child->line)) {
            g_strlcpy(child->progress, child->line + strspn(child->line, " "),
                      sizeof child->progress);
            return GB_CHILD_COMMAND_PROGRESS;
        }
        /* an error line is part of the outcome */
        if (child->kind == GB_CHILD_COMMAND_LONG && !is_error(child->line)) {
            snprintf(text, size, "%s: %s", child->name, child->line);
            return GB_CHILD_COMMAND_OUTPUT;
        }
    }
    if (child->output_fd >= 0 || waitpid(child->pid, &status, WNOHANG) != child->pid) {
        return GB_CHILD_COMMAND_NONE;
    }
    child->pid = 0;
    child->progress[0] = '\0';
    child->succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    write_outcome(child, text, size);
    return GB_CHILD_COMMAND_ENDED;
}
