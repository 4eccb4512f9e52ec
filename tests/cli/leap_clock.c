/* For LD_PRELOAD: every few calls the wall clock jumps by a day forward or back; with
 * LEAP_CLOCK=back each call finds it set back by a day more.  The monotonic clock is
 * unchanged. */
#include <dlfcn.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>

enum { DAY = 86400, CALLS = 7 };

int clock_gettime(clockid_t id, struct timespec *now);
int gettimeofday(struct timeval *restrict now, void *restrict zone);
time_t time(time_t *now);

static time_t jump(void)
{
    static atomic_uint calls;
    static const time_t days[] = {0, 1, -1, 2, -2};
    const unsigned call = atomic_fetch_add(&calls, 1), k = call / CALLS;
    if (getenv("LEAP_CLOCK") != NULL) {
        return -DAY * (time_t)call;
    }
    return DAY * days[k % (sizeof days / sizeof days[0])];
}

int clock_gettime(clockid_t id, struct timespec *now)
{
    int (*real)(clockid_t, struct timespec *) = NULL;
    *(void **)(void *)&real = dlsym(RTLD_NEXT, "clock_gettime");
    const int result = real(id, now);
    if (id == CLOCK_REALTIME || id == CLOCK_REALTIME_COARSE) {
        now->tv_sec += jump();
    }
    return result;
}

int gettimeofday(struct timeval *restrict now, void *restrict zone)
{
    struct timespec precise;
    (void)zone;
    const int result = clock_gettime(CLOCK_REALTIME, &precise);
    now->tv_sec = precise.tv_sec;
    now->tv_usec = precise.tv_nsec / 1000;
    return result;
}

time_t time(time_t *now)
{
    struct timespec precise;
    (void)clock_gettime(CLOCK_REALTIME, &precise);
    if (now != NULL) {
        *now = precise.tv_sec;
    }
    return precise.tv_sec;
}
