#include "tui/term/crash.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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

void gb_crash_install(int screen, int err, const struct termios *modes, const char *reset)
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

void gb_crash_remove(void)
{
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &installed.before[i], NULL);
    }
}

void gb_crash_set_run(const char *directory)
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
