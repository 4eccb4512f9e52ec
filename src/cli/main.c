#ifdef __GLIBC__
#endif

#include <errno.h>
#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_version.h>
#include <locale.h>
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/built_with.h"
#include "base/program.h"
#include "base/visible.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/options.h"
#include "hdf/hdf.h"
#include "io/preset_folders.h"
#include "pack/kernel/simd.h"

static const struct {
    const char *status, *meaning;
} rows[] = {
    {"0", "done"},
    {"1",
     "a physical or numerical guard stopped the run, or it ended without reaching a goal "
     "(loading.until, a pressure of loading.unload_from) or beyond one (also the end of a leg "
     "of loading.path), or with points that are not in "
     "equilibrium; the results are kept"},
    {"2", "bad usage or input; one line with the rejected value and what is expected"},
    {"3", "the machine: disk full, no permission, out of memory"},
    {"129", "stopped by SIGHUP; points and state are kept"},
    {"130", "stopped by SIGINT; points and state are kept"},
    {"143", "stopped by SIGTERM; points and state are kept"},
};

/* Exit statuses of all commands, one line "STATUS MEANING" each.  The manual pages are
 * made from it, and tests/pages.py compares docs/manual.md with it. */
static void exit_status_print(FILE *to)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        gb_visible_print(to, "%s %s\n", rows[i].status, rows[i].meaning);
    }
}

static void print_names(char **names)
{
    for (int i = 0; names[i]; i++) {
        gb_visible_print(stdout, "  %s\n", names[i]);
    }
    g_strfreev(names);
}

static void print_help(void)
{
    gb_visible_put(
        stdout,
        "Usage:\n"
        "  greenbody [PRESET] [group.key=value]...   the workbench\n"
        "  greenbody COMMAND ...                     see greenbody COMMAND --help\n"
        "\n"
        "Simulates the pressing of powders particle by particle.\n"
        "\n"
        "Commands:\n");
    gb_commands_print(stdout);
    gb_visible_put(stdout, "\nPresets:\n");
    print_names(gb_preset_folders_list());
    gb_visible_put(stdout, "\nMaterials, as material=NAME among the keys:\n");
    print_names(gb_preset_folders_list_materials());
    gb_visible_put(
        stdout,
        "\nOptions:\n"
        "  -h, --help     this page\n"
        "  --diagnose     detected features of the terminal, disk space of kept runs\n"
        "  --batch        greenbody run instead of the workbench, also in a terminal\n"
        "  --color, --graph, --images, --mouse, --ascii, --slow\n"
        "                 of the workbench: see greenbody default --help\n"
        "  --version      version, compiler, features, threads\n");
}

static void print_version(void)
{
#if defined(__clang__)
    const char *compiler = __VERSION__;
#else
    const char *compiler = "gcc " __VERSION__;
#endif
    gb_visible_print(stdout, "greenbody %s\n", GB_VERSION);
    gb_visible_print(stdout, "compiler: %s\n", compiler);
    gb_visible_print(stdout, "features: %s; GLib %u.%u, GSL %s\n",
                     GB_WITH_PICTURES ? "pictures" : "no pictures", glib_major_version,
                     glib_minor_version, gsl_version);
    gb_visible_print(stdout, "threads: %u, vectors: %d bits (%s)\n",
                     g_get_num_processors(), gb_simd_width(0),
                     gb_simd_name(gb_simd_width(0)));
}

static int refuse_word(const char *word)
{
    char *names = gb_commands_names(), **presets = gb_preset_folders_list(), meant[64];
    struct gb_error err;
    if (*gb_words_nearest_in(word, names, meant, sizeof meant) == '\0') {
        gb_words_nearest(word, presets, meant, sizeof meant);
    }
    gb_error_set(&err, GB_ERR_INPUT,
                 "%.80s: no such option, command, file or preset; %scommands: %s; "
                 "see greenbody --help",
                 word, meant, names);
    g_free(names);
    g_strfreev(presets);
    return gb_options_fail(&err);
}

/* Can the first word be a preset, a file or an assignment? */
static bool may_open(const char *word)
{
    if (strchr(word, '=') || strchr(word, '/') || g_file_test(word, G_FILE_TEST_EXISTS)) {
        return true;
    }
    char *path = gb_preset_folders_find(word);
    g_free(path);
    return path != NULL;
}

/* `greenbody [PRESET]`: the workbench, or `greenbody run` without a terminal. */
static int open_scene(int argc, char **argv)
{
    if (argc > 1 && argv[1][0] != '-' && !may_open(argv[1])) {
        return refuse_word(argv[1]);
    }
    const bool prints =
        gb_options_has(argc, argv, "--diagnose") || gb_options_has(argc, argv, "--help");
    const bool batch = gb_options_has(argc, argv, "--batch");
    if (!prints && (batch || !isatty(STDOUT_FILENO))) {
        argc = gb_options_screen_drop(argc, argv);
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

/* `greenbody --complete WORD... PREFIX`, for the completion scripts of the shells. */
static int complete(int argc, char **argv)
{
    static char program[] = "greenbody", requested[] = GB_COMPLETION_WORD;
    const struct gb_commands_row *command = argc > 3 ? gb_commands_find(argv[2]) : NULL;
    const char *first = argc > 2 ? argv[2] : "";
    if (command != NULL) {
        argv[1] = argv[2];
        argv[2] = requested;
        return command->function(argc - 1, argv + 1);
    }
    if (argc <= 3) {
        gb_completion_first(first);
    }
    argv[0] = program;
    return argc > 3 || first[0] == '-' ? gb_cmd_workbench(argc, argv) : 0;
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
    if (strcmp(word, "--keys") == 0) { /* keys of the workbench, for the manual page */
        gb_cmd_workbench_keys();
        return 0;
    }
    if (strcmp(word, "--views") == 0) { /* views of the workbench, for tests */
        gb_cmd_workbench_views();
        return 0;
    }
    if (strcmp(word, "--commands") == 0) { /* for the manual page */
        gb_commands_print_plain(stdout);
        return 0;
    }
    if (strcmp(word, "--exit-statuses") == 0) { /* for the manual pages */
        exit_status_print(stdout);
        return 0;
    }
    if (strcmp(word, GB_COMPLETION_WORD) == 0) {
        return complete(argc, argv);
    }
    const struct gb_commands_row *command = gb_commands_find(word);
    return command != NULL ? command->function(argc - 1, argv + 1)
                           : open_scene(argc, argv);
}

/* Returns the memory of large arrays to the system when they are freed.  By default the
 * C library would keep up to 32 MB per thread. */
static void set_heap(void)
{
#ifdef __GLIBC__
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 20);
    (void)mallopt(M_TRIM_THRESHOLD, 4 << 20);
    /* One heap for all threads.  A thread that finds no 64 MB of addresses for a heap
     * of its own maps a page for every small allocation; HDF5 makes thousands, and
     * aborts. */
    (void)mallopt(M_ARENA_MAX, 1);
#endif
}

int main(int argc, char **argv)
{
    gb_program_name_process();
    set_heap();
    gb_hdf_skip_exit();
    /* Text in the user's locale, but numbers always with a decimal point. */
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C");
    gsl_set_error_handler_off();
    signal(SIGXFSZ, SIG_IGN); /* a file beyond its size limit is an error of write() */
    signal(SIGPIPE, SIG_IGN); /* writing to a closed pipe is the error EPIPE instead */
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
