#include <errno.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_version.h>
#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/screening.h"
#include "pack/kernel/simd.h"

struct command {
    const char *name;
    const char *summary;
    int (*function)(int argc, char **argv);
};

/* Every command that this build has; help, dispatch and messages follow from it. */
static const struct command commands[] = {
    {"run", "one run without a screen, results in a directory", gb_cmd_run},
    {"sweep", "a grid of parameters with replicas, in one table", gb_cmd_sweep},
    {"resume", "goes on with a run that was stopped or killed", gb_cmd_resume},
    {"attach", "shows a run that is under way, or takes it over", gb_cmd_attach},
    {"verify", "repeats the last stretch of a run and compares", gb_cmd_verify},
    {"calibrate", "keys fitted to measured densities, with intervals", gb_cmd_calibrate},
    {"sizes", "the log-normal law of a measured histogram of sizes", gb_cmd_sizes},
    {"pack", "the initial structure alone", gb_cmd_pack},
    {"snapshot", "picture of a packing", gb_cmd_snapshot},
    {"plot", "figures over one or more runs, and of contact laws", gb_cmd_plot},
    {"chart", "error against cost of the numerical choices of a scene", gb_cmd_chart},
    {"stability", "where each method fails, beside theory", gb_cmd_stability},
    {"report", "figures, pictures and tables of runs in a folder to hand in",
     gb_cmd_report},
    {"bench", "the speed figures", gb_cmd_bench},
    {"law", "values of a contact law as CSV", gb_cmd_law},
    {"params", "every preset key: unit, range, default, meaning, source", gb_cmd_params},
};

static void print_help(void)
{
    puts("Usage:\n"
         "  greenbody [PRESET] [group.key=value]...   the workbench\n"
         "  greenbody COMMAND ...                     see greenbody COMMAND --help\n"
         "\n"
         "Simulates the pressing of powders particle by particle.\n"
         "\n"
         "Commands:");
    for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
        printf("  %-10s %s\n", commands[i].name, commands[i].summary);
    }
    char **presets = gb_preset_list();
    puts("\nPresets:");
    for (int i = 0; presets[i]; i++) {
        printf("  %s\n", presets[i]);
    }
    g_strfreev(presets);
    puts("\nOptions:\n"
         "  -h, --help     this page\n"
         "  --diagnose     what the terminal is taken for, and what the kept runs take\n"
         "  --batch        no workbench: what run does, also in a terminal\n"
         "  --color, --graph, --images, --mouse, --ascii, --slow\n"
         "                 of the workbench: see greenbody default --help\n"
         "  --version      version, compiler, features, threads");
}

static void print_version(void)
{
#if defined(__clang__)
    const char *compiler = __VERSION__;
#else
    const char *compiler = "gcc " __VERSION__;
#endif
#ifdef _OPENMP
    const char *threads = "threads in the sweep";
#else
    const char *threads = "one thread in the sweep";
#endif
    printf("greenbody %s\n", GB_VERSION);
    printf("compiler: %s\n", compiler);
    printf("features: %s, %s, %s; GLib %u.%u, GSL %s\n",
           GB_WITH_PICTURES ? "pictures" : "no pictures", threads,
           GB_WITH_MPI ? "MPI" : "no MPI", glib_major_version, glib_minor_version,
           gsl_version);
    printf("threads: %u, vectors: %d bits\n", g_get_num_processors(), gb_simd_width(0));
}

static int unknown(const char *word)
{
    GString *names = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", commands[i].name);
    }
    struct gb_error err;
    gb_error_set(&err, GB_ERR_INPUT,
                 "%.80s: no such option, command, file or preset; commands: %s; "
                 "see greenbody --help",
                 word, names->str);
    g_string_free(names, TRUE);
    return gb_options_fail(&err);
}

/* A word that is no command must at least lead to a preset. */
static bool may_open(const char *word)
{
    if (strchr(word, '=') || strchr(word, '/') || g_file_test(word, G_FILE_TEST_EXISTS)) {
        return true;
    }
    char *path = gb_preset_find(word);
    g_free(path);
    return path != NULL;
}

/* `greenbody [PRESET]`: the workbench, or what run does where there is no terminal. */
static int open_scene(int argc, char **argv)
{
    if (argc > 1 && argv[1][0] != '-' && !may_open(argv[1])) {
        return unknown(argv[1]);
    }
    const bool asked = gb_screening_has(argc, argv, "--diagnose") ||
                       gb_screening_has(argc, argv, "--help");
    const bool batch = gb_screening_has(argc, argv, "--batch");
    if (!asked && (batch || !isatty(STDOUT_FILENO))) {
        argc = gb_screening_drop(argc, argv);
        static char name[] = "run";
        static char preset[] = "default";
        argv[0] = name;
        return argc > 1 ? gb_cmd_run(argc, argv)
                        : gb_cmd_run(2, (char *[]){name, preset, NULL});
    }
    static char program[] = "greenbody";
    argv[0] = program;
    return gb_cmd_workbench(argc, argv);
}

static int dispatch(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "";
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
        print_help();
        return 0;
    }
    if (strcmp(word, "--version") == 0) {
        print_version();
        return 0;
    }
    if (strcmp(word, "--keys") == 0) {
        gb_cmd_workbench_keys();
        return 0;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
        if (strcmp(word, commands[i].name) == 0) {
            return commands[i].function(argc - 1, argv + 1);
        }
    }
    return open_scene(argc, argv);
}

/* Threads of the sweep that wait for each other shall not spin for long: beside other
 * work on the same cores, a spinning one keeps the one it waits for from running, and a
 * sweep on all cores took ten times as long as on one.  The runtime reads this before
 * main, hence the second start. */
static void start_patient(char **argv)
{
#ifdef _OPENMP
    if (!getenv("GOMP_SPINCOUNT") && !getenv("OMP_WAIT_POLICY") &&
        setenv("GOMP_SPINCOUNT", "3000", 0) == 0) {
        execv("/proc/self/exe", argv);
    }
#else
    (void)argv;
#endif
}

int main(int argc, char **argv)
{
    start_patient(argv);
    /* Text as the user's locale says, numbers always with a point. */
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C");
    gsl_set_error_handler_off();
    signal(SIGPIPE, SIG_IGN); /* a write to a closed pipe fails instead, with EPIPE */
    struct gb_error err;
    if (!gb_simd_check(&err)) {
        return gb_options_fail(&err);
    }
    const int status = dispatch(argc, argv);
    errno = 0;
    if (fflush(stdout) != 0 && status == 0) {
        gb_options_output_failed(&err);
        return gb_options_fail(&err);
    }
    return status;
}
