/* The program on a pseudo-terminal: output, frame rate, time of answers, and random keys
 * and sizes.
 * Usage: test_pty GREENBODY PRESET_FOLDER */
#include <errno.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/patience.h"
#include "tui/term/pixels.h"

/* Limits of time are asserted with 'long' on an idle machine; otherwise only what does
 * not depend on the load. */
static const char *program, *presets;
static char *home, *reports; /* folder of the reports of sanitizers */

struct child {
    pid_t pid;
    int fd;
    struct termios before;
    int64_t bytes, bursts; /* received; a burst ends with 15 ms of silence */
    gint64 last_us;
    bool saw_leave;      /* the sequence that leaves the alternate screen */
    const char *awaited; /* text to wait for, NULL: none; whether it was received */
    bool saw_awaited;
    char tail[64];
};

/* Reports of sanitizers go to files: the terminal may be closed already. */
static void keep_reports(const char *name)
{
    const char *options = g_getenv(name);
    char *more =
        g_strdup_printf("%s:log_path=%s", options != NULL ? options : "", reports);
    g_setenv(name, more, TRUE);
    g_free(more);
}

static void tell_reports(void)
{
    char *folder = g_path_get_dirname(reports);
    char *begins = g_path_get_basename(reports);
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(folder, name, NULL);
        char *text = NULL;
        if (g_str_has_prefix(name, begins) &&
            g_file_get_contents(path, &text, NULL, NULL)) {
            fprintf(stderr, "%s\n", text);
        }
        g_free(text);
        g_free(path);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_free(begins);
    g_free(folder);
}

static void become_program(char **words)
{
    keep_reports("ASAN_OPTIONS");
    keep_reports("TSAN_OPTIONS");
    keep_reports("UBSAN_OPTIONS");
    setenv("TERM", "xterm-256color", 1);
    setenv("LC_ALL", "C.UTF-8", 1);
    setenv("GB_PRESET_DIR", presets, 1);
    setenv("XDG_CONFIG_HOME", home, 1);
    setenv("XDG_STATE_HOME", home, 1);
    unsetenv("NO_COLOR");
    if (chdir(home) != 0) {
        _exit(126);
    }
    execv(program, words);
    _exit(127);
}

/* fidelity = reference, so that no run ends during a test of the screen.  Settings are
 * words. */
static void open_program(struct child *child, int rows, int cols, const char *settings)
{
    struct winsize size = {.ws_row = (unsigned short)rows,
                           .ws_col = (unsigned short)cols};
    char *line =
        g_strdup_printf("greenbody default numerics.fidelity=reference %s", settings);
    char **words = g_strsplit(line, " ", -1);
    memset(child, 0, sizeof *child);
    child->pid = forkpty(&child->fd, NULL, NULL, &size);
    g_assert_cmpint(child->pid, >=, 0);
    if (child->pid == 0) {
        become_program(words);
    }
    tcgetattr(child->fd, &child->before);
    g_strfreev(words);
    g_free(line);
}

static void look_for_texts(struct child *child, const char *text, size_t length)
{
    GString *all = g_string_new(child->tail);
    g_string_append_len(all, text, (gssize)length);
    for (gsize i = 0; i < all->len; i++) {
        if (all->str[i] == '\0') {
            all->str[i] = ' ';
        }
    }
    child->saw_leave = child->saw_leave || strstr(all->str, "\033[?1049l") != NULL;
    child->saw_awaited = child->saw_awaited || (child->awaited != NULL &&
                                                strstr(all->str, child->awaited) != NULL);
    g_strlcpy(child->tail, all->len > 16 ? all->str + all->len - 16 : all->str,
              sizeof child->tail);
    g_string_free(all, TRUE);
}

/* Reads for a time; stops at once when bytes come if first_only.  False: the other end is
 * closed. */
static bool receive(struct child *child, double seconds, bool first_only)
{
    const gint64 end = g_get_monotonic_time() + (gint64)(1e6 * seconds);
    for (;;) {
        const gint64 left = end - g_get_monotonic_time();
        struct pollfd fd = {child->fd, POLLIN, 0};
        char buffer[65536];
        if (left <= 0 || poll(&fd, 1, (int)(left / 1000) + 1) <= 0) {
            return true;
        }
        const ssize_t n = read(child->fd, buffer, sizeof buffer);
        if (n <= 0) {
            return false;
        }
        const gint64 now = g_get_monotonic_time();
        child->bursts += now - child->last_us > 15000;
        child->last_us = now;
        child->bytes += n;
        look_for_texts(child, buffer, (size_t)n);
        if (first_only) {
            return true;
        }
    }
}

static void send_text(struct child *child, const char *text, size_t length)
{
    while (length > 0) {
        const ssize_t n = write(child->fd, text, length);
        if (n < 0 && errno != EINTR) {
            return; /* the program has quit */
        }
        text += n > 0 ? n : 0;
        length -= n > 0 ? (size_t)n : 0;
    }
}

/* Until so many frames have come, however long that takes. */
static void receive_bursts(struct child *child, int64_t bursts)
{
    const gint64 from = g_get_monotonic_time();
    while (child->bursts < bursts) {
        patience_check(from, "frames");
        g_assert_true(receive(child, 0.2, false));
    }
}

static int wait_for_end(struct child *child)
{
    const gint64 from = g_get_monotonic_time();
    int status = 0;
    while (waitpid(child->pid, &status, WNOHANG) != child->pid) {
        if (g_get_monotonic_time() - from > patience_us()) {
            kill(child->pid, SIGKILL);
            waitpid(child->pid, &status, 0);
            g_error("the program does not end");
        }
        if (!receive(child, 0.02, false)) {
            g_usleep(20000);
        }
    }
    receive(child, 0.05, false);
    return status;
}

/* The program has ended with one of two statuses. */
static void check_status(int status, int good, int as_good)
{
    if (!WIFEXITED(status) ||
        (WEXITSTATUS(status) != good && WEXITSTATUS(status) != as_good)) {
        tell_reports();
    }
    g_assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) != as_good) {
        g_assert_cmpint(WEXITSTATUS(status), ==, good);
    }
}

static void check_restored(struct child *child)
{
    struct termios now;
    g_assert_true(child->saw_leave);
    if (tcgetattr(child->fd, &now) == 0) {
        g_assert_cmpuint(now.c_lflag, ==, child->before.c_lflag);
        g_assert_cmpuint(now.c_iflag, ==, child->before.c_iflag);
        g_assert_cmpuint(now.c_oflag, ==, child->before.c_oflag);
    }
    close(child->fd);
}

static void quit(struct child *child)
{
    kill(child->pid, SIGTERM);
    check_status(wait_for_end(child), 143, 143);
    check_restored(child);
}

/* Frames drawn and seconds with the screen, from the log written at the end. */
static void read_frames(long long *frames, double *seconds)
{
    char *path = g_build_filename(home, "greenbody", "workbench.log", NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    const char *last = g_strrstr(text, "greenbody: frames drawn: ");
    g_assert_nonnull(last);
    g_assert_cmpint(
        sscanf(last, "greenbody: frames drawn: %lld in %lf s", frames, seconds), ==, 2);
    g_free(text);
    g_free(path);
}

/* A running screen of 120 x 40: below 2 kB per frame on average including the first whole
 * one, at most ten frames within any second.  The frames are counted by the program:
 * several may be received at once on a loaded machine. */
static void test_running(void)
{
    struct child child;
    long long frames = 0;
    double seconds = 0.0;
    for (int bursts = 40; frames < 20; bursts *= 2) { /* a loaded machine splits frames */
        open_program(&child, 40, 120, "particles.count=4000");
        receive_bursts(&child, bursts);
        quit(&child);
        read_frames(&frames, &seconds);
    }
    const double mean = (double)child.bytes / (double)MAX(frames, 1);
    g_test_message("%lld bytes in %lld frames: %.0f bytes a frame, %.1f frames/s",
                   (long long)child.bytes, frames, mean, (double)frames / seconds);
    g_assert_cmpfloat((double)frames, <=, 10.0 * (seconds + 1.0));
    g_assert_cmpfloat(mean, <, 2048.0);
}

/* Paused, after the last frame: no output for three seconds, in which a computing engine
 * has twenty updates. */
static void test_paused(void)
{
    struct child child;
    open_program(&child, 40, 120, "particles.count=6000");
    receive_bursts(&child, 5);
    send_text(&child, "p", 1);
    const gint64 from = g_get_monotonic_time();
    do {
        patience_check(from, "silence");
        child.bytes = 0;
        g_assert_true(receive(&child, 3.0, false));
    } while (child.bytes > 0);
    quit(&child);
}

/* From a key until a text is on the screen. */
struct answer {
    double seconds;
    int64_t frames; /* begun meanwhile */
};

static struct answer await(struct child *child, const char *key, const char *text)
{
    const gint64 from = g_get_monotonic_time();
    const int64_t before = child->bursts;
    child->awaited = text;
    child->saw_awaited = false;
    child->tail[0] = '\0';
    send_text(child, key, strlen(key));
    while (!child->saw_awaited) {
        g_assert_true(receive(child, 0.5, true));
        patience_check(from, text);
    }
    return (struct answer){.seconds = 1e-6 * (double)(g_get_monotonic_time() - from),
                           .frames = child->bursts - before};
}

enum { LATENCY_KEYS = 25 };

static int compare_seconds(const void *a, const void *b)
{
    const double x = ((const struct answer *)a)->seconds;
    const double y = ((const struct answer *)b)->seconds;
    return (x > y) - (x < y);
}

/* The list of keys while the engine computes N = 8000 on all cores; sorted by time.
 * Returns the fewest frames that an answer took. */
static int64_t measure_latency(struct answer waited[LATENCY_KEYS])
{
    struct child child;
    int64_t fewest = INT64_MAX;
    open_program(&child, 40, 120, "particles.count=8000");
    receive_bursts(&child, 20);
    for (int i = 0; i < LATENCY_KEYS; i++) {
        waited[i] = await(&child, "?", "filter,");
        fewest = MIN(fewest, waited[i].frames);
        await(&child, "?", "against relative density");
        receive(&child, 0.31, false);
    }
    quit(&child);
    qsort(waited, LATENCY_KEYS, sizeof waited[0], compare_seconds);
    g_test_message(
        "answer after %.0f ms (least), %.0f ms (median), %.0f ms (worst of %d)",
        1e3 * waited[0].seconds, 1e3 * waited[LATENCY_KEYS / 2].seconds,
        1e3 * waited[LATENCY_KEYS - 1].seconds, LATENCY_KEYS);
    return fewest;
}

/* The next frame answers a key.  A frame that is being drawn while the key arrives does
 * not count, and a loaded machine splits frames sometimes; an answer delayed by the
 * program itself would always follow updates of the engine. */
static void test_latency(void)
{
    struct answer waited[LATENCY_KEYS];
    g_assert_cmpint(measure_latency(waited), <=, 1);
}

/* The limit of time, for an idle machine. */
static void test_latency_median(void)
{
    struct answer waited[LATENCY_KEYS];
    measure_latency(waited);
    g_assert_cmpfloat(waited[LATENCY_KEYS / 2].seconds, <, 0.05);
}

/* The packing as pixel image with --images: an image with its view, and none after a
 * change of the view. */
static void check_images(const char *option, const char *begins)
{
    struct child child;
    open_program(&child, 40, 120, option);
    receive_bursts(&child, 5);
    await(&child, "9", begins);
    await(&child, "?", "filter,");
    await(&child, "?", begins);
    quit(&child);
}

static void test_images(void)
{
    if (!gb_pixels_available()) {
        g_test_skip("built without libchafa");
        return;
    }
    check_images("--images=sixel", "\033P");
    check_images("--images=kitty", "\033_G");
}

/* Number of lines of a file of the first run of the default preset in a folder of its
 * own; 0: no such file. */
static int count_lines(const char *folder, const char *name)
{
    char *path = g_build_filename(folder, "greenbody", "runs", "default-1", name, NULL);
    char *text = NULL;
    int lines = 0;
    if (g_file_get_contents(path, &text, NULL, NULL)) {
        for (const char *c = text; *c != '\0'; c++) {
            lines += *c == '\n';
        }
    }
    g_free(text);
    g_free(path);
    return lines;
}

/* Lines of a curve from which on the run has results. */
enum { POINTS = 9 };

/* A second request to end, while the engine is being stopped, does not lose the run.  Its
 * strain steps are so small that points are recorded soon and the run does not end; r
 * starts it beside its quick cell, which may take minutes. */
static void test_interrupted_twice(void)
{
    char *const before = home;
    struct child child;
    home = g_build_filename(before, "twice", NULL);
    g_assert_cmpint(g_mkdir(home, 0700), ==, 0);
    open_program(&child, 24, 80, "particles.count=3000 loading.step=0.001%");
    receive_bursts(&child, 1);
    send_text(&child, "r", 1);
    gint64 from = g_get_monotonic_time();
    while (count_lines(home, "curve.csv") < POINTS) {
        patience_check(from, "points of the curve");
        g_assert_true(receive(&child, 0.1, false));
    }
    await(&child, "q", "Quit?");
    send_text(&child, "y", 1);
    from = g_get_monotonic_time();
    while (!child.saw_leave) {
        patience_check(from, "the terminal given back");
        g_assert_true(receive(&child, 10.0, true));
    }
    kill(child.pid, SIGTERM);
    (void)wait_for_end(&child);
    check_restored(&child);
    g_assert_cmpint(count_lines(home, "state.h5"), >, 0);
    g_free(home);
    home = before;
}

/* Keys of the table, text, escape sequences; none that sends a signal, and no slash, so
 * that saved presets stay in their folder. */
enum { KEY_MOST = 32 };

static const char *random_key(GRand *rand, char buffer[KEY_MOST])
{
    static const char *const special[] = {
        "\033[A", "\033[B", "\033[C", "\033[D", "\033OP", "\033[5~", "\033[6~", "\033[H",
        "\033[F", "\033[Z", "\t",     "\r",     "\033",   "\x15",    "\x0c",    "\x7f"};
    static const char plain[] = "hjklgGnNiurpmbLvVwoecafsxtAMq?+-= 0123456789xyz.;%~";
    if (g_rand_int_range(rand, 0, 8) == 0) { /* the mouse */
        static const int button[] = {0, 0, 64, 65, 2, 35};
        g_snprintf(buffer, KEY_MOST, "\033[<%d;%d;%dM",
                   button[g_rand_int_range(rand, 0, G_N_ELEMENTS(button))],
                   g_rand_int_range(rand, 1, 230), g_rand_int_range(rand, 1, 80));
        return buffer;
    }
    if (g_rand_int_range(rand, 0, 3) == 0) {
        return special[g_rand_int_range(rand, 0, (gint32)G_N_ELEMENTS(special))];
    }
    buffer[0] = plain[g_rand_int_range(rand, 0, (gint32)strlen(plain))];
    buffer[1] = '\0';
    return buffer;
}

static void resize(struct child *child, GRand *rand)
{
    const struct winsize size = {.ws_row = (unsigned short)g_rand_int_range(rand, 1, 70),
                                 .ws_col =
                                     (unsigned short)g_rand_int_range(rand, 1, 220)};
    ioctl(child->fd, TIOCSWINSZ, &size);
}

static bool has_ended(struct child *child)
{
    int status = 0;
    if (waitpid(child->pid, &status, WNOHANG) != child->pid) {
        return false;
    }
    receive(child, 0.05, false);
    check_status(status, 0, 0); /* q, and y to a question */
    check_restored(child);
    return true;
}

/* After the first frame: before it, no signal handler is installed. */
static void open_for_storm(struct child *child)
{
    open_program(child, 24, 80, "particles.count=120");
    receive_bursts(child, 1);
}

static void storm(int keys, int resizes)
{
    struct child child;
    GRand *rand = g_rand_new_with_seed(20240917);
    open_for_storm(&child);
    int starts = 1;
    for (int i = 0; i < keys; i++) {
        char buffer[KEY_MOST];
        const char *key = random_key(rand, buffer);
        send_text(&child, key, strlen(key));
        if (i % MAX(keys / resizes, 1) == 0) {
            resize(&child, rand);
        }
        receive(&child, i % 10 == 0 ? 0.03 : 0.001, false);
        if (i % 50 == 0 && has_ended(&child)) {
            open_for_storm(&child);
            starts++;
        }
    }
    g_test_message("%d keys, %d resizes, started %d times", keys, resizes, starts);
    g_rand_free(rand);
    /* it may be ending already: both statuses are correct */
    if (!child.saw_leave) {
        kill(child.pid, SIGTERM);
    }
    const int status = wait_for_end(&child);
    g_test_message("status %d", status);
    check_status(status, 143, 0);
    check_restored(&child);
}

static void test_storm(void)
{
    storm(1000, 60);
}

static void test_long_storm(void)
{
    storm(10000, 500);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_assert_cmpint(argc, >=, 3);
    program = argv[1];
    presets = argv[2];
    home = g_dir_make_tmp("gb-pty-XXXXXX", NULL);
    reports = g_build_filename(home, "sanitizer", NULL);
    if (argc > 3) {
        g_test_add_func("/tui/pty/latency-median", test_latency_median);
        g_test_add_func("/tui/pty/long-storm", test_long_storm);
    } else {
        g_test_add_func("/tui/pty/running", test_running);
        g_test_add_func("/tui/pty/paused", test_paused);
        g_test_add_func("/tui/pty/latency", test_latency);
        g_test_add_func("/tui/pty/images", test_images);
        g_test_add_func("/tui/pty/asked-twice", test_interrupted_twice);
        g_test_add_func("/tui/pty/storm", test_storm);
    }
    const int status = g_test_run();
    char *command = g_strdup_printf("rm -rf '%s'", home);
    g_spawn_command_line_sync(command, NULL, NULL, NULL, NULL);
    g_free(command);
    g_free(reports);
    g_free(home);
    return status;
}
