#ifndef GB_TESTS_PATIENCE_H
#define GB_TESTS_PATIENCE_H

#include <stdbool.h>
#include <stdlib.h>

#include <glib.h>

/* Waits for events.  The limit is one that only a hang meets: a slow or busy machine, an
 * old processor and a sanitizer together take far less.  Where they would not,
 * GB_TEST_PATIENCE multiplies it, as in patience.sh. */
static inline gint64 patience_us(void)
{
    const char *more = g_getenv("GB_TEST_PATIENCE");
    const gint64 times = more != NULL ? g_ascii_strtoll(more, NULL, 10) : 1;
    return 900 * G_USEC_PER_SEC * MAX(times, 1);
}

/* To be called over and over while an event is awaited that began to be at from. */
static inline void patience_check(gint64 from, const char *event)
{
    if (g_get_monotonic_time() - from > patience_us()) {
        g_error("no event within the limit: %s", event);
    }
}

/* Until come(data). */
static inline void patience_wait(bool (*come)(void *data), void *data, const char *event)
{
    const gint64 from = g_get_monotonic_time();
    while (!come(data)) {
        patience_check(from, event);
        g_usleep(1000);
    }
}

#endif
