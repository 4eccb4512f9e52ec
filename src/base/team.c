#include "base/team.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "greenbody/status.h"

/* Blocks all signals while it creates the thread, because a thread inherits the signal
 * mask. */
bool gb_team_start_thread(pthread_t *thread, void *(*work)(void *data), void *data,
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

/* Length of a measurement window: several time slices of the scheduler.  Rounds longer
 * than a slice need only a few rounds. */
static const double window_s = 0.02;
enum { WINDOW_ROUNDS = 4 };

static const double rest_least_s = 0.1, rest_most_s = 3.2;

/* A candidate with more threads must be faster by the first factor; one with fewer may
 * be slower by the second.  A thread without a gain leaves its core to other processes.
 */
static const double worth_more = 0.95, worth_fewer = 1.01;

/* A candidate that is slower by this factor is given up after a quarter of its window. */
static const double hopeless = 1.4;

enum { NEIGHBOURS = 4 };

/* Neighbour k of `active` threads: half as many, one fewer, twice as many, one more. */
static int neighbour(const struct gb_team_pace *pace, int k)
{
    const int active = pace->active;
    const int number[NEIGHBOURS] = {active / 2, active - 1, 2 * active, active + 1};
    const int threads = number[k];
    return threads < 1 ? 1 : threads > pace->most ? pace->most : threads;
}

static void enter(struct gb_team_pace *pace, enum gb_team_pace_phase phase)
{
    pace->phase = phase;
    pace->spent_s = 0.0;
    pace->rounds = 0;
}

void gb_team_pace_init(struct gb_team_pace *pace, int most)
{
    *pace = (struct gb_team_pace){.most = most, .active = most, .rest_s = rest_least_s};
    enter(pace, most > 1 ? GB_TEAM_PACE_BASE : GB_TEAM_PACE_REST);
}

int gb_team_pace_threads(const struct gb_team_pace *pace)
{
    return pace->phase == GB_TEAM_PACE_CANDIDATE ? pace->candidate : pace->active;
}

/* Starts the window of the next neighbour that differs from `active`.  Rests after the
 * last one. */
static void try_next(struct gb_team_pace *pace)
{
    for (; pace->failed < NEIGHBOURS; pace->failed++) {
        pace->candidate = neighbour(pace, pace->next);
        if (pace->candidate != pace->active && pace->candidate != pace->last) {
            enter(pace, GB_TEAM_PACE_CANDIDATE);
            return;
        }
        pace->next = (pace->next + 1) % NEIGHBOURS;
    }
    enter(pace, GB_TEAM_PACE_REST);
    pace->last = 0;
}

static void judge(struct gb_team_pace *pace, double candidate_s)
{
    const double worth = pace->candidate > pace->active ? worth_more : worth_fewer;
    if (candidate_s < worth * pace->base_s) {
        pace->last = pace->active; /* known to be worse */
        pace->active = pace->candidate;
        pace->base_s = candidate_s;
        pace->failed = 0; /* continue in the same direction */
        pace->rest_s = rest_least_s;
    } else {
        pace->last = pace->candidate;
        pace->failed++;
        pace->next = (pace->next + 1) % NEIGHBOURS;
    }
    try_next(pace);
}

/* Is the window complete, or the candidate hopeless? */
static bool window_ends(const struct gb_team_pace *pace, double mean_s)
{
    if (pace->rounds < WINDOW_ROUNDS) {
        return false;
    }
    return pace->spent_s >= window_s ||
           (pace->phase == GB_TEAM_PACE_CANDIDATE && pace->spent_s >= window_s / 4.0 &&
            mean_s > hopeless * pace->base_s);
}

void gb_team_pace_add(struct gb_team_pace *pace, double seconds)
{
    if (pace->most < 2) {
        return;
    }
    pace->spent_s += seconds;
    pace->rounds++;
    const double mean_s = pace->spent_s / (double)pace->rounds;
    if (pace->phase == GB_TEAM_PACE_REST) {
        if (pace->spent_s >= pace->rest_s) {
            pace->rest_s = fmin(2.0 * pace->rest_s, rest_most_s);
            enter(pace, GB_TEAM_PACE_BASE);
        }
    } else if (window_ends(pace, mean_s)) {
        if (pace->phase == GB_TEAM_PACE_CANDIDATE) {
            judge(pace, mean_s);
        } else {
            pace->base_s = mean_s;
            pace->failed = 0;
            try_next(pace);
        }
    }
}

/* A waiting thread polls for some time before it sleeps, because waking it takes tens
 * of microseconds.  A strain step spends as long between two pieces of work of the
 * team.  After spin_s the thread yields its core between polls, since the thread that
 * it waits for may need the core. */
static const double spin_s = 10e-6, yield_s = 200e-6;
enum { LOOKS_PER_CLOCK = 32 }; /* reading the clock costs more than a poll */

enum { CACHE_LINE = 64 };

/* A place to sleep until another thread signals a change. */
struct bell {
    pthread_mutex_t lock;
    pthread_cond_t rung;
    atomic_bool asleep;
};

/* One thread of the team: 0 is the caller. */
struct member {
    /* Remaining items of this thread's share: the next item in the upper half of the
     * word, the end in the lower half.  The thread whose compare-exchange succeeds owns
     * the item, which belongs to the work that is current at that moment. */
    _Alignas(CACHE_LINE) _Atomic uint64_t share;
    atomic_uint first; /* first item of the share */
    _Alignas(CACHE_LINE) struct bell bell;
    pthread_t thread;
    struct gb_team *team;
    int number;
};

struct gb_team {
    struct member *member;
    int size; /* number of threads, started or not */
    bool started;
    pid_t process; /* that started the threads; its children have none */
    struct gb_team_pace pace;
    double began_s; /* of the measured work */
    /* The current work, in one cache line: written before the shares, read after an
     * item is taken. */
    _Alignas(CACHE_LINE) gb_team_item *work;
    void *data;
    atomic_int active;      /* threads of this work */
    atomic_uint generation; /* incremented for each work and at the end */
    atomic_bool over;
    _Alignas(CACHE_LINE) _Atomic int64_t left; /* number of unfinished items */
};

static inline void relax_cpu(void)
{
#if defined __x86_64__ || defined __i386__
    __builtin_ia32_pause();
#elif defined __aarch64__
    __asm__ volatile("yield");
#endif
}

static void bell_init(struct bell *bell)
{
    pthread_mutex_init(&bell->lock, NULL);
    pthread_cond_init(&bell->rung, NULL);
    atomic_init(&bell->asleep, false);
}

static void bell_finish(struct bell *bell)
{
    pthread_cond_destroy(&bell->rung);
    pthread_mutex_destroy(&bell->lock);
}

/* To be called after a change for which bell_await may wait. */
static void bell_ring(struct bell *bell)
{
    if (atomic_load(&bell->asleep)) {
        pthread_mutex_lock(&bell->lock);
        pthread_cond_signal(&bell->rung);
        pthread_mutex_unlock(&bell->lock);
    }
}

typedef bool condition(const struct member *member, uint64_t seen);

/* Polls the condition until it holds or the time limit is reached; returns whether it
 * holds. */
static bool look_until(const struct member *member, condition *holds, uint64_t seen,
                       double limit_s)
{
    const double began_s = gb_clock_s();
    for (double waited_s = 0.0; waited_s < limit_s; waited_s = gb_clock_s() - began_s) {
        for (int look = 0; look < LOOKS_PER_CLOCK; look++) {
            if (holds(member, seen)) {
                return true;
            }
            relax_cpu();
        }
        if (waited_s > spin_s) {
            sched_yield();
        }
    }
    return false;
}

/* Waits until the condition holds: polls, then sleeps. */
static void bell_await(struct member *member, condition *holds, uint64_t seen)
{
    struct bell *bell = &member->bell;
    if (look_until(member, holds, seen, yield_s)) {
        return;
    }
    pthread_mutex_lock(&bell->lock);
    atomic_store(&bell->asleep, true);
    while (!holds(member, seen)) {
        pthread_cond_wait(&bell->rung, &bell->lock);
    }
    atomic_store(&bell->asleep, false);
    pthread_mutex_unlock(&bell->lock);
}

static bool has_new_work(const struct member *member, uint64_t seen)
{
    struct gb_team *team = member->team;
    return (atomic_load(&team->generation) != seen &&
            member->number < atomic_load(&team->active)) ||
           atomic_load(&team->over);
}

static bool all_finished(const struct member *member, uint64_t seen)
{
    (void)seen;
    return atomic_load(&member->team->left) == 0;
}

static int64_t next_of(uint64_t word)
{
    return (int64_t)(word >> 32);
}

static int64_t end_of(uint64_t word)
{
    return (int64_t)(word & UINT32_MAX);
}

static uint64_t share_word(int64_t next, int64_t end)
{
    return (uint64_t)next << 32 | (uint64_t)end;
}

/* Takes an item from the member's share; false if none is left. */
static bool take(struct member *from, int64_t *item)
{
    uint64_t word = atomic_load(&from->share);
    do {
        *item = next_of(word);
        if (*item >= end_of(word)) {
            return false;
        }
    } while (
        !atomic_compare_exchange_weak(&from->share, &word, word + ((uint64_t)1 << 32)));
    return true;
}

/* Is only the last item left of a share on which its thread has started? */
static bool is_last(const struct member *from, uint64_t word)
{
    return next_of(word) + 1 == end_of(word) &&
           next_of(word) > (int64_t)atomic_load(&from->first);
}

static bool share_differs(const struct member *member, uint64_t seen)
{
    return atomic_load(&member->share) != seen;
}

/* Leaves the last item of another share to its own thread, which has the data in its
 * cache from the previous work.  Returns when that thread takes the item or
 * `patience_s` has passed. */
static void leave_last(const struct member *from, double patience_s)
{
    const uint64_t word = atomic_load(&from->share);
    if (is_last(from, word)) {
        (void)look_until(from, share_differs, word, patience_s);
    }
}

/* Counts items as finished.  No other work starts before all items are counted. */
static void count_finished(struct gb_team *team, int number, int64_t items)
{
    if (items > 0 && atomic_fetch_sub(&team->left, items) == items && number > 0) {
        bell_ring(&team->member[0].bell);
    }
}

/* Takes the items of its own share, then items of the other shares. */
static void work_off(struct gb_team *team, int number)
{
    const double began_s = gb_clock_s();
    int64_t done = 0, item;
    for (; take(&team->member[number], &item); done++) {
        team->work(team->data, item);
    }
    count_finished(team, number, done);
    const double item_s = done > 0 ? (gb_clock_s() - began_s) / (double)done : 0.0;
    for (int k = 1; k < team->size; k++) {
        struct member *from = &team->member[(number + k) % team->size];
        done = 0;
        for (leave_last(from, item_s); take(from, &item); leave_last(from, item_s)) {
            team->work(team->data, item);
            done++;
        }
        count_finished(team, number, done);
    }
}

static void *member_main(void *data)
{
    struct member *self = data;
    struct gb_team *team = self->team;
    unsigned seen = 0;
    for (;;) {
        bell_await(self, has_new_work, seen);
        if (atomic_load(&team->over)) {
            return NULL;
        }
        seen = atomic_load(&team->generation);
        work_off(team, self->number);
    }
}

bool gb_team_create(struct gb_team **out, int threads, struct gb_error *err)
{
    *out = NULL;
    if (threads < 2) {
        return true;
    }
    struct gb_team *team = gb_alloc_array(1, sizeof *team, err);
    struct member *member =
        team ? gb_alloc_array((size_t)threads, sizeof *member, err) : NULL;
    if (!member) {
        gb_alloc_free(team);
        return false;
    }
    team->member = member;
    team->size = threads;
    for (int m = 0; m < threads; m++) {
        atomic_init(&member[m].share, 0);
        atomic_init(&member[m].first, 0);
        bell_init(&member[m].bell);
        member[m].team = team;
        member[m].number = m;
    }
    gb_team_pace_init(&team->pace, threads);
    *out = team;
    return true;
}

/* Starts the threads.  If the system refuses some, the team becomes smaller. */
static void start(struct gb_team *team)
{
    team->started = true;
    team->process = getpid();
    for (int m = 1; m < team->size; m++) {
        struct member *member = &team->member[m];
        struct gb_error refused;
        if (!gb_team_start_thread(&member->thread, member_main, member, "a worker thread",
                                  &refused)) {
            for (int rest = m; rest < team->size; rest++) {
                bell_finish(&team->member[rest].bell);
            }
            team->size = m;
            gb_team_pace_init(&team->pace, m);
        }
    }
}

void gb_team_destroy(struct gb_team *team)
{
    if (!team) {
        return;
    }
    const bool inherited = team->started && team->process != getpid();
    atomic_store(&team->over, true);
    for (int m = 1; team->started && !inherited && m < team->size; m++) {
        bell_ring(&team->member[m].bell);
        pthread_join(team->member[m].thread, NULL);
    }
    for (int m = 0; !inherited && m < team->size;
         m++) { /* locks may be held in the parent */
        bell_finish(&team->member[m].bell);
    }
    gb_alloc_free(team->member);
    gb_alloc_free(team);
}

int gb_team_size(const struct gb_team *team)
{
    return team ? team->size : 1;
}

int gb_team_active(const struct gb_team *team)
{
    return team ? gb_team_pace_threads(&team->pace) : 1;
}

static void run_alone(int64_t items, gb_team_item *work, void *data)
{
    for (int64_t item = 0; item < items; item++) {
        work(data, item);
    }
}

/* First item of the share of thread m.  Shares have about the same cost, or without
 * costs the same number of items. */
static int64_t share_begin(int64_t items, const int64_t *cost, int m, int active)
{
    if (!cost || cost[items] == 0 || m == 0 || m == active) {
        return items * m / active;
    }
    const int64_t twice = 2 * cost[items] * m / active;
    int64_t item = m; /* each thread gets at least one item */
    while (item < items - (active - m) && cost[item] + cost[item + 1] <= twice) {
        item++;
    }
    return item;
}

void gb_team_run(struct gb_team *team, int64_t items, gb_team_item *work, void *data)
{
    gb_team_run_costs(team, items, NULL, work, data);
}

void gb_team_run_costs(struct gb_team *team, int64_t items, const int64_t *cost,
                       gb_team_item *work, void *data)
{
    if (items < 2 || gb_team_active(team) < 2) {
        run_alone(items, work, data);
        return;
    }
    if (!team->started) {
        start(team);
    }
    const int limit = gb_team_active(team);
    const int active = items < limit ? (int)items : limit;
    team->work = work;
    team->data = data;
    /* The release stores of the shares below publish these. */
    atomic_store_explicit(&team->left, items, memory_order_relaxed);
    atomic_store_explicit(&team->active, active, memory_order_relaxed);
    for (int m = 0; m < active; m++) {
        const int64_t begin = share_begin(items, cost, m, active);
        const int64_t end = share_begin(items, cost, m + 1, active);
        atomic_store_explicit(&team->member[m].first, (unsigned)begin,
                              memory_order_relaxed);
        atomic_store_explicit(&team->member[m].share, share_word(begin, end),
                              memory_order_release);
    }
    atomic_fetch_add(&team->generation, 1);
    for (int m = 1; m < active; m++) {
        bell_ring(&team->member[m].bell);
    }
    work_off(team, 0);
    bell_await(&team->member[0], all_finished, 0);
}

struct ranges {
    gb_team_range *work;
    void *data;
    int64_t count, parts;
};

static void run_range(void *data, int64_t part)
{
    const struct ranges *ranges = data;
    ranges->work(ranges->data, ranges->count * part / ranges->parts,
                 ranges->count * (part + 1) / ranges->parts);
}

void gb_team_run_ranges(struct gb_team *team, int64_t count, int64_t grain,
                        gb_team_range *work, void *data)
{
    enum { RANGES_PER_THREAD = 4 };
    const int64_t wanted = RANGES_PER_THREAD * (int64_t)gb_team_active(team);
    int64_t parts = count / grain < wanted ? count / grain : wanted;
    if (parts < 2 || gb_team_active(team) < 2) {
        work(data, 0, count);
        return;
    }
    struct ranges ranges = {work, data, count, parts};
    gb_team_run(team, parts, run_range, &ranges);
}

void gb_team_measured_begin(struct gb_team *team)
{
    if (team) {
        team->began_s = gb_clock_s();
    }
}

void gb_team_measured_end(struct gb_team *team)
{
    if (team) {
        gb_team_pace_add(&team->pace, gb_clock_s() - team->began_s);
    }
}
