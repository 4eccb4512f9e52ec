#include "base/clock.h"

#include <time.h>

static double seconds_of(clockid_t id)
{
    struct timespec now;
    clock_gettime(id, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double gb_clock_s(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double gb_clock_thread_s(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double gb_clock_process_s(void)
{
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}
