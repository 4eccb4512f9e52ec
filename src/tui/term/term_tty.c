#include "tui/term/term_tty.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <ncurses.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <term.h>
#include <termios.h>
#include <unistd.h>

/* The terminal apart from curses: its log file, and what a crash leaves behind. */

enum { TAIL_BYTES = 1024 };

void gb_term_tty_tail_init(struct gb_stderr_tail *stderr_tail)
{
    stderr_tail->length = -1;
}

/* The last line of a text, without control characters. */
static bool last_line(char *text, char *line, size_t size)
{
    g_strchomp(text);
    const char *end = strrchr(text, '\n');
    g_strlcpy(line, end != NULL ? end + 1 : text, size);
    for (char *at = line; *at != '\0'; at++) {
        *at = *at == '\033' || g_ascii_iscntrl(*at) ? ' ' : *at;
    }
    return *line != '\0';
}

/* The log, if it is a file; a pipe without a reader or writer would block for ever. */
static int open_file(const char *path, int flags)
{
    struct stat info;
    const int fd = open(path, flags | O_CLOEXEC | O_NONBLOCK, 0600);
    if (fd >= 0 && (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode))) {
        close(fd);
        errno = ENXIO; /* as where a pipe has no reader */
        return -1;
    }
    return fd;
}

/* Descriptor of the log for reading; -1: error. */
static int term_tty_read_log(void)
{
    char *path = gb_term_tty_log();
    const int fd = open_file(path, O_RDONLY);
    g_free(path);
    return fd;
}

bool gb_term_tty_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size)
{
    struct stat now;
    char text[TAIL_BYTES + 1];
    if (fstat(STDERR_FILENO, &now) != 0 || !S_ISREG(now.st_mode)) {
        return false;
    }
    const int64_t before = stderr_tail->length;
    stderr_tail->length = now.st_size;
    if (before < 0 || now.st_size <= before) {
        return false;
    }
    const int64_t from = MAX(before, now.st_size - TAIL_BYTES);
    const int log = term_tty_read_log();
    const ssize_t n = log < 0 ? -1 : pread(log, text, TAIL_BYTES, from);
    if (log >= 0) {
        close(log);
    }
    text[n > 0 ? n : 0] = '\0';
    return n > 0 && last_line(text, line, size);
}

static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

enum { FAULTS = sizeof faults / sizeof faults[0] };

/* File scope: a signal handler has no argument for its data. */
static struct {
    int screen, err;
    struct termios modes;
    char reset[256];
    size_t length;
    struct sigaction before[FAULTS];
    char state[4200],
        resume[4300]; /* path of the checkpoint, and the line that names it */
} installed;

static bool put(const char *text, size_t length)
{
    return write(installed.err, text, length) >= 0;
}

static void handle(int number)
{
    static const char text[] =
        "greenbody: the program has failed; the terminal was restored\n";
    if (write(installed.screen, installed.reset, installed.length) < 0) {
        _exit(128 + number);
    }
    tcsetattr(installed.screen, TCSANOW, &installed.modes);
    dup2(installed.err, STDERR_FILENO);
    if (!put(text, sizeof text - 1) ||
        (installed.state[0] != '\0' && access(installed.state, R_OK) == 0 &&
         !put(installed.resume, strlen(installed.resume)))) {
        _exit(128 + number);
    }
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &installed.before[i], NULL);
    }
    raise(number);
}

void gb_term_tty_crash_install(int screen, int err, const struct termios *modes,
                               const char *reset)
{
    installed.screen = screen;
    installed.err = err;
    installed.modes = *modes;
    snprintf(installed.reset, sizeof installed.reset, "%s", reset);
    installed.length = strlen(installed.reset);
    struct sigaction action = {.sa_handler = handle};
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &action, &installed.before[i]);
    }
}

void gb_term_tty_crash_remove(void)
{
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &installed.before[i], NULL);
    }
}

void gb_term_tty_crash_set_run(const char *directory)
{
    installed.state[0] = '\0'; /* set after the line is complete */
    if (directory == NULL) {
        return;
    }
    snprintf(installed.resume, sizeof installed.resume,
             "greenbody: continue from the last checkpoint with: greenbody resume '%s'\n",
             directory);
    snprintf(installed.state, sizeof installed.state, "%s/state.h5", directory);
}

char *gb_term_tty_log(void)
{
    return g_build_filename(g_get_user_state_dir(), "greenbody", "workbench.log", NULL);
}

/* -1 with errno; ENXIO: it is no file. */
static int open_log(void)
{
    char *path = gb_term_tty_log();
    char *folder = g_path_get_dirname(path);
    g_mkdir_with_parents(folder, 0700);
    const int fd = open_file(path, O_WRONLY | O_CREAT | O_APPEND);
    g_free(path);
    g_free(folder);
    return fd;
}

bool gb_term_tty_check_log(struct gb_error *err)
{
    const int log = open_log();
    const int why = errno;
    if (log >= 0) {
        close(log);
        return true;
    }
    char *path = gb_term_tty_log();
    gb_error_set(
        err, GB_ERR_MACHINE, "nothing is logged: workbench.log: %s (%.300s)",
        why == ENXIO || why == EISDIR ? "is not a regular file" : g_strerror(why), path);
    g_free(path);
    return false;
}

/* Libraries print to standard error and standard output, which would corrupt the
 * screen. */
void gb_term_tty_redirect(void)
{
    fflush(stdout);
    int log = open_log();
    log = log >= 0 ? log : open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (log >= 0) {
        dup2(log, STDOUT_FILENO);
        dup2(log, STDERR_FILENO);
        close(log);
    }
}

void gb_term_tty_restore(int out, int err)
{
    fflush(stdout);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
}

static bool can_position_cursor(const char *type, int fd)
{
    int found = 0;
    if (setupterm(type, fd, &found) != OK) {
        return false;
    }
    const bool positions = cursor_address != NULL;
    del_curterm(cur_term);
    return positions;
}

int gb_term_tty_colours(const char *type, int fd)
{
    int found = 0;
    if (setupterm(type, fd, &found) != OK) {
        return 0;
    }
    const int colours = tigetnum("colors");
    del_curterm(cur_term);
    return colours > 0 ? colours : 0;
}

const char *gb_term_tty_type(int fd, struct gb_error *err)
{
    const char *own = getenv("TERM");
    int found = 0;
    const bool known = own != NULL && *own != '\0' && setupterm(own, fd, &found) == OK;
    if (known) {
        del_curterm(cur_term);
    }
    static const char *const fallback[] = {"xterm-256color", "xterm", "vt100"};
    if (known && can_position_cursor(own, fd)) {
        return own;
    }
    for (size_t i = 0; !known && i < G_N_ELEMENTS(fallback); i++) {
        if (can_position_cursor(fallback[i], fd)) {
            return fallback[i];
        }
    }
    gb_error_set(err, GB_ERR_MACHINE,
                 "the terminal type TERM=%s %s; `greenbody run PRESET` needs no screen",
                 own == NULL ? "" : own,
                 known ? "cannot position the cursor" : "is unknown");
    return NULL;
}
