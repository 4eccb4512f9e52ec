#include "cli/signals.h"

#include <signal.h>
#include <stddef.h>

/* Set by the handlers, tested between slices. */
static volatile sig_atomic_t caught, hung;

static void on_signal(int number)
{
    caught = number;
}

static void on_hangup(int number)
{
    (void)number;
    hung = 1;
}

void gb_signals_install(enum gb_signals_hangup hangup)
{
    struct sigaction before;
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    const struct sigaction note = {.sa_handler = on_hangup, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, NULL, &before);
    if (before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, hangup == GB_SIGNALS_HANGUP_ENDS ? &action : &note, NULL);
    }
    signal(SIGPIPE, SIG_IGN);
}

int gb_signals_caught(void)
{
    return (int)caught;
}

bool gb_signals_cancelled(void *data)
{
    (void)data;
    return caught != 0;
}

bool gb_signals_take_hangup(void)
{
    const bool was = hung != 0;
    hung = 0;
    return was;
}

void gb_signals_stop_by_hangup(void)
{
    caught = SIGHUP;
}

int gb_signals_exit_status(const struct gb_error *err)
{
    return err->code == GB_ERR_CANCELLED && caught != 0 ? 128 + (int)caught
                                                        : gb_status_exit_code(err->code);
}
