#include "base/thread.h"

#include <signal.h>
#include <string.h>

/* A thread inherits the signal mask under which it is created. */
bool gb_thread_start(pthread_t *thread, void *(*work)(void *data), void *data,
                     const char *what, struct gb_error *err)
{
    sigset_t all;
    sigset_t old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    const int failure = pthread_create(thread, NULL, work, data);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    return failure == 0 || gb_error_set(err, GB_ERR_MACHINE, "cannot start %s: %s", what,
                                        strerror(failure));
}
