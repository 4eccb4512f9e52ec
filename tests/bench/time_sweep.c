/* What a sweep of tiny cells costs beside what the cells themselves cost.
 * Usage: time_sweep GREENBODY [RUNS [PARTICLES]]
 * The same cells are pressed here, without files, and by `greenbody sweep` with one
 * worker and with one per processor, block after block, so that a busy machine meets all of
 * them alike.  Prints processor and elapsed time; overhead is of the
 * former.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glib.h>

#include "base/clock.h"
#include "io/preset.h"
#include "io/preset_folders.h"
#include "many/single_run.h"
#include "run/experiment.h"

/* A block is long enough for the start of a program to be a small part of it. */
enum { BLOCK = 500, RUNS = 1000, PARTICLES = 250, WORDS = 32 };

/* Pressed to 100 MPa from here on. */
static const char *const scene[] = {"structure.base=auto", "loading.until=100 MPa",
                                    "loading.unload_from=", "numerics.fidelity=fast"};

struct method {
    const char *name;
    const char *words[WORDS]; /* before `sweep`; NULL first: in this process */
    const char *jobs;
    double cpu_s, elapsed_s;
};

static void fail(const char *what)
{
    fprintf(stderr, "time_sweep: %s\n", what);
    exit(1);
}

static struct gb_params cell(const char *particles)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    char *count = g_strconcat("particles.count=", particles, NULL);
    char *path = gb_preset_folders_find("default");
    if (path == NULL || !gb_preset_load(&preset, path, &err)) {
        fail(path ? err.text : "no preset of the name default");
    }
    struct gb_params params = *gb_preset_params(preset);
    bool good = gb_params_assign(&params, count, &err);
    for (size_t i = 0; i < G_N_ELEMENTS(scene); i++) {
        good = good && gb_params_assign(&params, scene[i], &err);
    }
    if (!good) {
        fail(err.text);
    }
    params.threads = 1;
    gb_preset_destroy(preset);
    g_free(path);
    g_free(count);
    return params;
}

/* The engine alone. */
static void press(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        fail(err.text);
    }
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_experiment_advance(experiment, 100, &err);
    }
    if (how != GB_STEP_DONE) {
        fail(err.text);
    }
    gb_experiment_destroy(experiment);
}

static void press_all(struct gb_params params, const char *folder, int first, int runs)
{
    struct gb_error err = {0};
    for (int k = 0; k < runs; k++) {
        params.seed = (uint64_t)(first + k);
        char *out = folder ? g_strdup_printf("%s/%d", folder, first + k) : NULL;
        if (out == NULL) {
            press(&params);
        } else if (!gb_single_run(&params, out, NULL, &err)) {
            fail(err.text);
        }
        g_free(out);
    }
}

static void append(char **argv, int *argc, const char *word)
{
    if (*argc + 1 < WORDS) {
        argv[(*argc)++] = (char *)word;
    }
}

/* Runs a program to its end; the processor time of all that it waited for. */
static double spawn(char **argv)
{
    struct rusage used;
    int status = 0;
    const pid_t pid = fork();
    if (pid == 0) {
        execvp(argv[0], argv);
        _exit(127);
    }
    if (pid < 0 || wait4(pid, &status, 0, &used) != pid || status != 0) {
        fail(argv[0]);
    }
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

static double sweep(const struct method *method, const char *greenbody,
                    const char *particles, const char *folder, int first, int runs)
{
    char *argv[WORDS] = {NULL};
    int argc = 0;
    char *out =
        g_strdup_printf("%s/%s%s-%d", folder, method->words[0], method->jobs, first);
    char *seed = g_strdup_printf("structure.seed=%d", first);
    char *count = g_strconcat("particles.count=", particles, NULL);
    char *replicas = g_strdup_printf("--replicas=%d", runs);
    for (int k = 0; method->words[k] != NULL; k++) {
        append(argv, &argc, method->words[k]);
    }
    const char *const words[] = {greenbody, "sweep",  "default", count,   seed,
                                 replicas,  "-q",     "-o",      out,     method->jobs,
                                 scene[0],  scene[1], scene[2],  scene[3]};
    for (size_t k = 0; k < G_N_ELEMENTS(words); k++) {
        append(argv, &argc, words[k]);
    }
    const double cpu_s = spawn(argv);
    g_free(out);
    g_free(seed);
    g_free(count);
    g_free(replicas);
    return cpu_s;
}

int main(int argc, char **argv)
{
    static struct method methods[] = {
        {.name = "cells, nothing kept"},
        {.name = "cells with directories", .jobs = "kept"},
        {.name = "one process, --jobs 1", .words = {"env", NULL}, .jobs = "--jobs=1"},
        {.name = "one process, all processors",
         .words = {"env", NULL},
         .jobs = "--jobs=0"}};
    const int runs = argc > 2 ? atoi(argv[2]) : RUNS;
    const int block = MIN(runs, BLOCK);
    char *folder = g_dir_make_tmp("time_sweep-XXXXXX", NULL);
    if (argc < 2 || folder == NULL) {
        fail("usage: time_sweep GREENBODY [RUNS [PARTICLES]]");
    }
    char *particles = argc > 3 ? g_strdup(argv[3]) : g_strdup_printf("%d", PARTICLES);
    const struct gb_params params = cell(particles);
    const size_t count = G_N_ELEMENTS(methods);
    for (int first = 1; first + block - 1 <= runs; first += block) {
        for (size_t w = 0; w < count; w++) {
            struct method *method = &methods[w];
            const double begun = gb_clock_s();
            const double used = gb_clock_process_s();
            if (method->words[0] == NULL) {
                press_all(params, method->jobs ? folder : NULL, first, block);
                method->cpu_s += gb_clock_process_s() - used;
            } else {
                method->cpu_s += sweep(method, argv[1], particles, folder, first, block);
            }
            method->elapsed_s += gb_clock_s() - begun;
        }
    }
    printf("%d cells of %s particles to 100 MPa, in blocks of %d\n"
           "%-28s %14s %14s %10s\n",
           runs / block * block, particles, block, "", "processor ms", "elapsed ms",
           "overhead");
    for (size_t w = 0; w < count; w++) {
        const double scale = 1e3 / (double)(runs / block * block);
        printf("%-28s %14.2f %14.2f %9.1f%%\n", methods[w].name, scale * methods[w].cpu_s,
               scale * methods[w].elapsed_s,
               1e2 * (methods[w].cpu_s / methods[1].cpu_s - 1.0));
    }
    char *const remove[] = {(char *)"rm", (char *)"-rf", folder, NULL};
    (void)spawn((char **)remove);
    g_free(folder);
    g_free(particles);
    return 0;
}
