#include "tui/session/child_command.h"

#include <fcntl.h>
#include <glib.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WORDS = 16, NICER = 5 };

/* The screen blocks signals; its helper is to be stopped by them as any program, and must
 * not write to the screen. */
static void settle(gpointer data)
{
    const struct gb_child_command *errand = data;
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    (void)dup2(STDERR_FILENO, STDOUT_FILENO);
    if (errand->talks) {
        (void)setpriority(PRIO_PROCESS, 0, NICER);
    }
}

bool gb_child_command_start(struct gb_child_command *errand, const char *what,
                            const char *path, bool talks, const char *const *words,
                            struct gb_error *err)
{
    static char self[] = "/proc/self/exe";
    char *argv[WORDS] = {self};
    GError *trouble = NULL;
    GPid pid = 0;
    if (errand->pid != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the %s before is not finished",
                            errand->what);
    }
    struct gb_child_command next = {.said = -1, .talks = talks};
    for (int i = 0; words[i] != NULL && i < WORDS - 2; i++) {
        argv[i + 1] = (char *)words[i];
    }
    if (!g_spawn_async_with_pipes(NULL, argv, NULL, G_SPAWN_DO_NOT_REAP_CHILD, settle,
                                  &next, &pid, NULL, NULL, &next.said, &trouble)) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: %s", what, trouble->message);
        g_error_free(trouble);
        return false;
    }
    (void)fcntl(next.said, F_SETFL, fcntl(next.said, F_GETFL) | O_NONBLOCK);
    next.pid = (int)pid;
    g_strlcpy(next.what, what, sizeof next.what);
    g_strlcpy(next.path, path, sizeof next.path);
    *errand = next;
    return true;
}

/* True when a line is whole; a last one may have no end. */
static bool read_line(struct gb_child_command *errand)
{
    char c = '\0';
    while (errand->said >= 0) {
        const ssize_t n = read(errand->said, &c, 1);
        if (n < 0) {
            return false; /* nothing yet */
        }
        if (n == 0) {
            close(errand->said);
            errand->said = -1;
        }
        if (n == 0 || c == '\n') {
            const bool some = errand->length > 0;
            errand->length = 0;
            if (some) {
                return true;
            }
        } else if (errand->length + 1 < sizeof errand->line) {
            errand->line[errand->length++] = c;
            errand->line[errand->length] = '\0';
        }
    }
    return false;
}

/* "12 of 40 runs, 0 failed, 3 min left": the next one takes its place. */
static bool is_progress(const char *line)
{
    return strstr(line, " of ") != NULL && strstr(line, " runs, ") != NULL &&
           g_ascii_isdigit(line[0]);
}

static void tell_end(const struct gb_child_command *errand, int status, char *text,
                     size_t size)
{
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        snprintf(text, size, "%s: %s", errand->what, errand->path);
    } else {
        snprintf(text, size, "%s: %s", errand->what,
                 errand->line[0] != '\0' ? errand->line : "it was stopped");
    }
}

enum gb_child_command_news gb_child_command_poll(struct gb_child_command *errand,
                                                 char *text, size_t size)
{
    int status = 0;
    if (errand->pid == 0) {
        return GB_CHILD_COMMAND_NOTHING;
    }
    while (read_line(errand)) {
        if (errand->talks && is_progress(errand->line)) {
            g_strlcpy(errand->progress, errand->line, sizeof errand->progress);
            return GB_CHILD_COMMAND_PROGRESS;
        }
        if (errand->talks) {
            snprintf(text, size, "%s: %s", errand->what, errand->line);
            return GB_CHILD_COMMAND_LINE_SAID;
        }
    }
    if (errand->said >= 0 || waitpid(errand->pid, &status, WNOHANG) != errand->pid) {
        return GB_CHILD_COMMAND_NOTHING;
    }
    errand->pid = 0;
    errand->progress[0] = '\0';
    tell_end(errand, status, text, size);
    return GB_CHILD_COMMAND_ENDED;
}
