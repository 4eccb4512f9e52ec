#include "tui/errand.h"

#include <glib.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* The screen blocks signals; its helper is to be stopped by them as any program. */
static void unblock(gpointer data)
{
    sigset_t none;
    (void)data;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

bool gb_errand_start(struct gb_errand *errand, const char *what, const char *path,
                     const char *const *words, struct gb_error *err)
{
    static char self[] = "/proc/self/exe";
    char *argv[8] = {self};
    GError *trouble = NULL;
    GPid pid = 0;
    if (errand->pid != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the %s before is not finished",
                            errand->what);
    }
    for (int i = 0; words[i] != NULL && i < 6; i++) {
        argv[i + 1] = (char *)words[i];
    }
    if (!g_spawn_async_with_pipes(NULL, argv, NULL, G_SPAWN_DO_NOT_REAP_CHILD, unblock,
                                  NULL, &pid, NULL, NULL, &errand->complaint, &trouble)) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: %s", what, trouble->message);
        g_error_free(trouble);
        return false;
    }
    errand->pid = (int)pid;
    g_strlcpy(errand->what, what, sizeof errand->what);
    g_strlcpy(errand->path, path, sizeof errand->path);
    return true;
}

/* The last line; a complaint is shorter than a pipe's room. */
static void read_complaint(int fd, char *line, size_t size)
{
    char all[4096];
    const ssize_t n = read(fd, all, sizeof all - 1);
    all[n > 0 ? n : 0] = '\0';
    const char *text = g_strchomp(all);
    const char *last = strrchr(text, '\n');
    g_strlcpy(line, last != NULL ? last + 1 : text, size);
}

bool gb_errand_poll(struct gb_errand *errand, char *text, size_t size)
{
    int status = 0;
    char line[256];
    if (errand->pid == 0 || waitpid(errand->pid, &status, WNOHANG) != errand->pid) {
        return false;
    }
    errand->pid = 0;
    read_complaint(errand->complaint, line, sizeof line);
    close(errand->complaint);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        snprintf(text, size, "%s: %s", errand->what, errand->path);
    } else {
        snprintf(text, size, "%s: %s", errand->what,
                 line[0] != '\0' ? line : "it was stopped");
    }
    return true;
}
