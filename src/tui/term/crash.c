#include "tui/term/crash.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

enum { FAULTS = sizeof faults / sizeof faults[0] };

/* A signal handler has no other way to its data. */
static struct {
    int screen, err;
    struct termios modes;
    char reset[256];
    size_t length;
    struct sigaction before[FAULTS];
    char state[4200], resume[4300]; /* path of the checkpoint, line that names it */
} armed;

static bool put(const char *text, size_t length)
{
    return write(armed.err, text, length) >= 0;
}

static void handle(int number)
{
    static const char text[] =
        "greenbody: the program has failed; the terminal was restored\n";
    if (write(armed.screen, armed.reset, armed.length) < 0) {
        _exit(128 + number);
    }
    tcsetattr(armed.screen, TCSANOW, &armed.modes);
    dup2(armed.err, STDERR_FILENO);
    if (!put(text, sizeof text - 1) ||
        (armed.state[0] != '\0' && access(armed.state, R_OK) == 0 &&
         !put(armed.resume, strlen(armed.resume)))) {
        _exit(128 + number);
    }
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &armed.before[i], NULL);
    }
    raise(number);
}

void gb_crash_arm(int screen, int err, const struct termios *modes, const char *reset)
{
    armed.screen = screen;
    armed.err = err;
    armed.modes = *modes;
    snprintf(armed.reset, sizeof armed.reset, "%s", reset);
    armed.length = strlen(armed.reset);
    struct sigaction action = {.sa_handler = handle};
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &action, &armed.before[i]);
    }
}

void gb_crash_disarm(void)
{
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &armed.before[i], NULL);
    }
}

void gb_crash_name(const char *directory)
{
    armed.state[0] = '\0'; /* until the line is whole */
    if (directory == NULL) {
        return;
    }
    snprintf(armed.resume, sizeof armed.resume,
             "greenbody: go on from the last checkpoint with: greenbody resume '%s'\n",
             directory);
    snprintf(armed.state, sizeof armed.state, "%s/state.h5", directory);
}
