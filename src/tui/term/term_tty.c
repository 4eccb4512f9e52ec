#include "tui/term/term_tty.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <ncurses.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <term.h>
#include <unistd.h>

char *gb_term_tty_log(void)
{
    return g_build_filename(g_get_user_state_dir(), "greenbody", "workbench.log", NULL);
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

int gb_term_tty_read_log(void)
{
    char *path = gb_term_tty_log();
    const int fd = open_file(path, O_RDONLY);
    g_free(path);
    return fd;
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
