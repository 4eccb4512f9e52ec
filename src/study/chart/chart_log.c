#include "study/chart/chart_log.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/file.h"
#include "base/table.h"
#include "io/preset.h"
#include "many/key_difference.h"

/* Keys of the settings, and those without effect on the results. */
static const char *const free_keys[] = {
    "loading.step",
    "loading.unload_from",
    "numerics.fidelity",
    "numerics.relaxer",
    "numerics.tolerance",
    "numerics.cutoff",
    "numerics.precision",
    "numerics.time_step",
    "numerics.step_error",
    "numerics.strain_part",
    NULL,
};

static char *path_of(const struct gb_chart_log *log, const char *name)
{
    return g_build_filename(log->directory, name, NULL);
}

static bool exists(const struct gb_chart_log *log, const char *name)
{
    char *path = path_of(log, name);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static bool lock_directory(struct gb_chart_log *log, struct gb_error *err)
{
    log->lock = open(log->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (log->lock < 0) {
        return gb_error_set(err, errno == ENOTDIR ? GB_ERR_INPUT : GB_ERR_MACHINE,
                            "%.300s: %s", log->directory, g_strerror(errno));
    }
    return flock(log->lock, LOCK_EX | LOCK_NB) == 0 ||
           gb_error_set(err, GB_ERR_INPUT, "%.300s: a chart is under way there",
                        log->directory);
}

/* Apart from the preset that the workbench puts there. */
static bool is_empty(const char *directory)
{
    GDir *dir = g_dir_open(directory, 0, NULL);
    bool empty = dir != NULL;
    const char *name;
    while (empty && (name = g_dir_read_name(dir)) != NULL) {
        empty = strcmp(name, "scene.ini") == 0;
    }
    if (dir) {
        g_dir_close(dir);
    }
    return empty;
}

static bool write_scene(const struct gb_chart_log *log, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_create(&preset, err)) {
        return false;
    }
    *gb_preset_params(preset) = log->plan->params;
    char *path = path_of(log, "preset.ini");
    const bool good = gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    gb_preset_destroy(preset);
    return good;
}

static bool check_scene(const struct gb_chart_log *log, struct gb_error *err)
{
    char *path = path_of(log, "preset.ini");
    struct gb_preset *preset = NULL;
    bool good = gb_preset_load(&preset, path, err);
    if (good) {
        const struct gb_field *field = gb_key_difference_find(
            gb_preset_params(preset), &log->plan->params, free_keys);
        good = field == NULL ||
               gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: the chart of a scene with another %s.%s; accepted: "
                            "the same scene, or a new directory",
                            path, field->group, field->key);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return good;
}

/* "density_100MPa" */
static void column_name(const struct gb_chart_log *log, const char *what, int k,
                        char *name, size_t size)
{
    g_snprintf(name, (gulong)size, "%s_%.6gMPa", what, log->plan->pressure_pa[k] / 1e6);
}

struct columns {
    const double *count, *step, *tolerance, *cutoff, *bits, *time_step, *step_error,
        *failed, *evaluations, *cpu_s;
    const uint64_t *seed;
    const double *density[GB_CHART_PRESSURES], *coordination[GB_CHART_PRESSURES];
};

static bool find_columns(const struct gb_chart_log *log, const struct gb_table *table,
                         struct columns *c, struct gb_error *err)
{
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {
        {"particles", &c->count},
        {"step", &c->step},
        {"tolerance", &c->tolerance},
        {"cutoff_d", &c->cutoff},
        {"bits", &c->bits},
        {"time_step_T", &c->time_step},
        {"step_error", &c->step_error},
        {"failed", &c->failed},
        {"evaluations", &c->evaluations},
        {"cpu_s", &c->cpu_s},
    };
    c->seed = gb_table_whole(table);
    bool good = c->seed != NULL || gb_table_column(table, "seed", err) != NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(wanted) && good; i++) {
        *wanted[i].column = gb_table_column(table, wanted[i].name, err);
        good = *wanted[i].column != NULL;
    }
    for (int k = 0; k < log->plan->pressures && good; k++) {
        char name[48];
        column_name(log, "density", k, name, sizeof name);
        c->density[k] = gb_table_column(table, name, err);
        column_name(log, "coordination", k, name, sizeof name);
        c->coordination[k] = c->density[k] ? gb_table_column(table, name, err) : NULL;
        good = c->coordination[k] != NULL;
    }
    return good;
}

static bool read_runs(struct gb_chart_log *log, struct gb_error *err)
{
    char *path = path_of(log, "runs.csv");
    struct gb_table *table = NULL;
    struct columns c = {0};
    const bool good =
        gb_table_read_whole(&table, path, "relaxer", "seed", err) &&
        find_columns(log, table, &c, err);
    for (size_t i = 0; good && i < gb_table_rows(table); i++) {
        struct gb_chart_run run = {
            .setting = {.count = (int64_t)c.count[i],
                        .strain_step = c.step[i],
                        .tolerance = c.tolerance[i],
                        .cutoff = c.cutoff[i],
                        .single = c.bits[i] < 64.0,
                        .time_step = c.time_step[i],
                        .step_error = c.step_error[i]},
            .seed = c.seed[i],
            .failed = c.failed[i] != 0.0,
            .evaluations = c.evaluations[i],
            .cpu_s = c.cpu_s[i],
        };
        g_strlcpy(run.setting.relaxer, gb_table_word(table, i),
                  sizeof run.setting.relaxer);
        for (int k = 0; k < log->plan->pressures; k++) {
            run.density[k] = c.density[k][i];
            run.coordination[k] = c.coordination[k][i];
        }
        g_array_append_val(log->runs, run);
    }
    gb_table_destroy(table);
    g_free(path);
    return good;
}

static void add_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.17g", value);
    }
}

static void add_numbers(GString *text, const double *number, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        add_number(text, number[i]);
    }
}

static void add_row(const struct gb_chart_log *log, GString *text,
                    const struct gb_chart_run *run)
{
    const struct gb_chart_setting *c = &run->setting;
    g_string_append(text, c->relaxer);
    const double setting[] = {(double)c->count, c->strain_step, c->tolerance, c->cutoff,
                              gb_chart_bits(c), c->time_step,   c->step_error};
    const double result[] = {(double)run->failed, run->evaluations, run->cpu_s};
    add_numbers(text, setting, G_N_ELEMENTS(setting));
    g_string_append_printf(text, ",%" PRIu64, run->seed);
    add_numbers(text, result, G_N_ELEMENTS(result));
    for (int k = 0; k < log->plan->pressures; k++) {
        add_number(text, run->density[k]);
        add_number(text, run->coordination[k]);
    }
    g_string_append_c(text, '\n');
}

static bool write_runs(const struct gb_chart_log *log, struct gb_error *err)
{
    GString *text = g_string_new(
        "# greenbody " GB_VERSION "\n"
        "# cells simulated for chart.csv; cpu_s: of the loading, one thread\n"
        "relaxer,particles,step,tolerance,cutoff_d,bits,time_step_T,step_error,"
        "seed,failed,evaluations,cpu_s");
    for (int k = 0; k < log->plan->pressures; k++) {
        char name[48];
        column_name(log, "density", k, name, sizeof name);
        g_string_append_printf(text, ",%s", name);
        column_name(log, "coordination", k, name, sizeof name);
        g_string_append_printf(text, ",%s", name);
    }
    g_string_append_c(text, '\n');
    for (guint i = 0; i < log->runs->len; i++) {
        add_row(log, text, &g_array_index(log->runs, struct gb_chart_run, i));
    }
    const bool good = gb_chart_log_keep(log, "runs.csv", text, err);
    g_string_free(text, TRUE);
    return good;
}

bool gb_chart_log_open(struct gb_chart_log *log, const char *directory,
                       const struct gb_chart_plan *plan, struct gb_error *err)
{
    *log = (struct gb_chart_log){.directory = g_strdup(directory), .plan = plan};
    log->lock = -1;
    log->runs = g_array_new(FALSE, FALSE, sizeof(struct gb_chart_run));
    if (g_mkdir_with_parents(directory, 0777) != 0) {
        const int why = errno;
        const bool input = why == ENOTDIR || why == EEXIST || why == ENAMETOOLONG;
        return gb_error_set(err, input ? GB_ERR_INPUT : GB_ERR_MACHINE, "%.300s: %s",
                            directory, g_strerror(why));
    }
    if (!lock_directory(log, err)) {
        return false;
    }
    if (exists(log, "runs.csv")) {
        return check_scene(log, err) && read_runs(log, err);
    }
    if (!is_empty(directory)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: holds other files and no chart; accepted: a new or "
                            "empty directory, or that of a chart",
                            directory);
    }
    return write_scene(log, err) && write_runs(log, err);
}

void gb_chart_log_close(struct gb_chart_log *log)
{
    if (log->directory && log->lock >= 0) {
        close(log->lock);
    }
    if (log->runs) {
        g_array_free(log->runs, TRUE);
    }
    g_free(log->directory);
    *log = (struct gb_chart_log){.lock = -1};
}

const struct gb_chart_run *gb_chart_log_find(const struct gb_chart_log *log,
                                             const struct gb_chart_setting *setting,
                                             uint64_t seed)
{
    for (guint i = 0; i < log->runs->len; i++) {
        const struct gb_chart_run *run =
            &g_array_index(log->runs, struct gb_chart_run, i);
        if (run->seed == seed && gb_chart_same(&run->setting, setting)) {
            return run;
        }
    }
    return NULL;
}

bool gb_chart_log_add(struct gb_chart_log *log, const struct gb_chart_run *run,
                      struct gb_error *err)
{
    g_array_append_val(log->runs, *run);
    return write_runs(log, err);
}

bool gb_chart_log_keep(const struct gb_chart_log *log, const char *name,
                       const GString *text, struct gb_error *err)
{
    char *path = path_of(log, name);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    return good;
}
