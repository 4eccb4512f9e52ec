#include "tui/term/input/term_signals.h"

#include <stdbool.h>
#include <sys/signalfd.h>
#include <unistd.h>

static const int handled[GB_TERM_SIGNALS] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,
                                             SIGTSTP, SIGCONT, SIGWINCH};

void gb_term_signals_catch(struct gb_term_signals *signals)
{
    sigset_t mask;
    sigemptyset(&mask);
    for (int i = 0; i < GB_TERM_SIGNALS; i++) {
        sigaction(handled[i], NULL, &signals->before[i]);
        sigaddset(&mask, handled[i]);
    }
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGPIPE, &ignore, &signals->pipe_before);
    pthread_sigmask(SIG_BLOCK, &mask, &signals->mask_before);
    signals->fd = signalfd(-1, &mask, SFD_CLOEXEC | SFD_NONBLOCK);
}

void gb_term_signals_release(struct gb_term_signals *signals)
{
    if (signals->fd < 0) {
        return;
    }
    while (gb_term_signals_read(signals) != 0) {
    }
    for (int i = 0; i < GB_TERM_SIGNALS; i++) {
        sigaction(handled[i], &signals->before[i], NULL);
    }
    sigaction(SIGPIPE, &signals->pipe_before, NULL);
    gb_term_signals_give_up(signals);
    pthread_sigmask(SIG_SETMASK, &signals->mask_before, NULL);
}

void gb_term_signals_give_up(struct gb_term_signals *signals)
{
    close(signals->fd);
    signals->fd = -1;
}

int gb_term_signals_read(const struct gb_term_signals *signals)
{
    struct signalfd_siginfo info;
    const bool whole = read(signals->fd, &info, sizeof info) == (ssize_t)sizeof info;
    return whole ? (int)info.ssi_signo : 0;
}

void gb_term_signals_stop(void)
{
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTSTP);
    const struct sigaction plain = {.sa_handler = SIG_DFL};
    sigaction(SIGTSTP, &plain, NULL);
    pthread_sigmask(SIG_UNBLOCK, &stop, NULL);
    raise(SIGTSTP);
    pthread_sigmask(SIG_BLOCK, &stop, NULL);
}
