#ifndef GB_BASE_THREAD_H
#define GB_BASE_THREAD_H

#include <pthread.h>
#include <stdbool.h>

#include "greenbody/status.h"

/* Starts a thread with all signals blocked: they are handled by the program's first
 * thread.  pthread_join is due.
 *
 * what   name of the thread in the message, as in "the engine thread"
 * Errors: GB_ERR_MACHINE. */
bool gb_thread_start(pthread_t *thread, void *(*work)(void *data), void *data,
                     const char *what, struct gb_error *err);

#endif
