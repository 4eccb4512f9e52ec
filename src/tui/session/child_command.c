#include "tui/session/child_command.h"

#include <fcntl.h>
#include <glib.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/program.h"

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

bool gb_child_command_start(struct gb_child_command *child, const char *name,
                            const char *path, enum gb_child_command_kind kind,
                            const char *const *words, struct gb_error *err)
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

/* True: a complete line; the last one may lack its newline. */
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

void gb_child_command_stop(const struct gb_child_command *child)
{
    if (child->pid != 0) {
        (void)kill(child->pid, SIGTERM);
    }
}

/* "12 of 40 runs, 0 failed, 3 min left", "1 of 3 states: ...", " 5 of 82  0.1 CPU s  fire,
 * ...": replaced by the next one. */
static bool is_progress(const char *line)
{
    line += strspn(line, " ");
    return g_ascii_isdigit(line[0]) && strstr(line, " of ") != NULL &&
           (strstr(line, " runs, ") != NULL || strstr(line, " states: ") != NULL ||
            strstr(line, " CPU s ") != NULL);
}

static const char error_prefix[] = "greenbody: ";

/* The reason of a failure, the last line of a command. */
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

enum gb_child_command_event gb_child_command_poll(struct gb_child_command *child,
                                                  char *text, size_t size)
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
        /* an error is part of the outcome */
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
