/* Teams: every item once, whatever the number of threads, and as many threads as pay. */

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/team.h"

static struct gb_team *team_of(int threads)
{
    struct gb_team *team;
    struct gb_error err;
    g_assert_true(gb_team_create(&team, threads, &err));
    g_assert_cmpint(gb_team_size(team), ==, threads);
    return team;
}

static void test_alone(void)
{
    struct gb_team *team = team_of(1);
    g_assert_null(team);
    g_assert_cmpint(gb_team_active(team), ==, 1);
    gb_team_measured_begin(team);
    gb_team_measured_end(team);
    gb_team_destroy(team);
}

/* A team that never worked has no thread to end. */
static void test_idle(void)
{
    gb_team_destroy(team_of(5));
}

enum { MOST = 300 };

struct counts {
    atomic_int times[MOST];
    int plain[MOST]; /* visible to the caller afterwards */
};

static void count_item(void *data, int64_t item)
{
    struct counts *counts = data;
    atomic_fetch_add(&counts->times[item], 1);
    counts->plain[item]++;
}

static void test_once(void)
{
    for (int threads = 1; threads <= 5; threads++) {
        struct gb_team *team = team_of(threads);
        struct counts *counts = g_new0(struct counts, 1);
        int64_t total = 0, expected = 0;
        for (int64_t round = 0; round < 2000; round++) {
            const int64_t items = round * 7 % MOST;
            gb_team_run(team, items, count_item, counts);
            expected += items;
        }
        for (int i = 0; i < MOST; i++) {
            g_assert_cmpint(counts->plain[i], ==, atomic_load(&counts->times[i]));
            total += counts->plain[i];
        }
        g_assert_cmpint(total, ==, expected);
        g_free(counts);
        gb_team_destroy(team);
    }
}

struct costs {
    int64_t first;    /* item that one thread holds */
    atomic_int other; /* first item of another thread; -1 */
};

/* The first item waits for one of another thread. */
static void take_costly(void *data, int64_t item)
{
    struct costs *costs = data;
    int none = -1;
    if (item != costs->first) {
        (void)atomic_compare_exchange_strong(&costs->other, &none, (int)item);
    }
    while (item == costs->first && atomic_load(&costs->other) < 0) {
        g_usleep(100);
    }
}

/* The second of two threads begins where half of the cost lies before its items. */
static void test_costs(void)
{
    static const struct {
        int64_t cost[7], begin;
    } cases[] = {
        {{0, 1, 2, 3, 4, 5, 6}, 3},        {{0, 0, 0, 0, 0, 0, 0}, 3},
        {{0, 90, 92, 94, 96, 98, 100}, 1}, {{0, 1, 2, 3, 4, 5, 100}, 5},
        {{0, 30, 49, 70, 90, 95, 100}, 2}, {{0, 0, 0, 0, 50, 100, 100}, 4},
    };
    for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
        struct gb_team *team = team_of(2);
        struct costs costs = {0};
        atomic_init(&costs.other, -1);
        gb_team_run_costs(team, 6, cases[c].cost, take_costly, &costs);
        g_assert_cmpint(atomic_load(&costs.other), ==, cases[c].begin);
        struct counts *counts = g_new0(struct counts, 1);
        gb_team_run_costs(team, 6, cases[c].cost, count_item, counts);
        for (int i = 0; i < 6; i++) {
            g_assert_cmpint(counts->plain[i], ==, 1);
        }
        g_free(counts);
        gb_team_destroy(team);
    }
}

struct meeting {
    atomic_int present;
};

/* Ends only if two threads hold an item each. */
static void meet(void *data, int64_t item)
{
    struct meeting *meeting = data;
    (void)item;
    atomic_fetch_add(&meeting->present, 1);
    while (atomic_load(&meeting->present) < 2) {
        g_thread_yield();
    }
}

static void test_threads_work(void)
{
    struct gb_team *team = team_of(2);
    struct meeting meeting;
    for (int round = 0; round < 20; round++) {
        atomic_store(&meeting.present, 0);
        gb_team_run(team, 2, meet, &meeting);
        if (round % 5 == 4) {
            g_usleep(2000); /* long enough that the threads sleep */
        }
    }
    gb_team_destroy(team);
}

/* The only item of the second share ends when the caller has taken every other one. */
struct stalled {
    atomic_int others;
    int most;
};

static void stall_last(void *data, int64_t item)
{
    struct stalled *stalled = data;
    if (item == stalled->most) {
        while (atomic_load(&stalled->others) < stalled->most) {
            g_thread_yield();
        }
    } else {
        atomic_fetch_add(&stalled->others, 1);
    }
}

static void test_shares_move(void)
{
    struct gb_team *team = team_of(2);
    struct stalled stalled = {.most = 63};
    atomic_store(&stalled.others, 0);
    gb_team_run(team, 64, stall_last, &stalled);
    g_assert_cmpint(atomic_load(&stalled.others), ==, 63);
    gb_team_destroy(team);
}

static void mark_range(void *data, int64_t begin, int64_t end)
{
    struct counts *counts = data;
    for (int64_t i = begin; i < end; i++) {
        count_item(counts, i);
    }
}

static void test_ranges(void)
{
    static const int64_t grains[] = {1, 7, 100, 1000};
    for (int threads = 1; threads <= 3; threads++) {
        struct gb_team *team = team_of(threads);
        for (size_t g = 0; g < G_N_ELEMENTS(grains); g++) {
            struct counts *counts = g_new0(struct counts, 1);
            gb_team_run_ranges(team, 299, grains[g], mark_range, counts);
            for (int i = 0; i < MOST; i++) {
                g_assert_cmpint(counts->plain[i], ==, i < 299);
            }
            g_free(counts);
        }
        gb_team_destroy(team);
    }
}

static void test_memory(void)
{
    for (long k = 1; k <= 2; k++) {
        struct gb_team *team;
        struct gb_error err;
        gb_alloc_fail_after(k);
        g_assert_false(gb_team_create(&team, 3, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
        g_assert_null(team);
    }
    gb_alloc_fail_after(0);
}

/* Elapsed time of a round, s, by t threads at a time. */
typedef double round_time(int threads, double now_s);

static double free_cores(int threads, double now_s)
{
    (void)now_s;
    return 1e-3 / threads;
}

/* Threads that do not pay: a second one makes it slower. */
static double crowded(int threads, double now_s)
{
    (void)now_s;
    return 1e-3 * (1.0 + 0.8 * (threads - 1));
}

/* Seven cores of eight are free: eight threads wait for the one without. */
static double seven_free(int threads, double now_s)
{
    (void)now_s;
    return threads > 7 ? 1e-3 : 2e-3 / threads;
}

static double crowded_later(int threads, double now_s)
{
    return now_s < 3.0 ? free_cores(threads, now_s) : crowded(threads, now_s);
}

static double free_later(int threads, double now_s)
{
    return now_s < 3.0 ? crowded(threads, now_s) : free_cores(threads, now_s);
}

/* Works for 10 s; the rounds beyond `from_s` cost at most `excess` times the best. */
static void try_machine(round_time *machine, int most, int best, double from_s,
                        double excess)
{
    struct gb_team_pace pace;
    double now_s = 0.0, cost = 0.0, least = 0.0;
    gb_team_pace_init(&pace, most);
    while (now_s < 10.0) {
        const int threads = gb_team_pace_threads(&pace);
        g_assert_cmpint(threads, >=, 1);
        g_assert_cmpint(threads, <=, most);
        const double round_s = machine(threads, now_s);
        gb_team_pace_add(&pace, round_s);
        now_s += round_s;
        if (now_s > from_s) {
            cost += round_s;
            least += machine(best, now_s);
        }
    }
    g_assert_cmpint(pace.active, ==, best);
    g_assert_cmpfloat(cost, <, excess * least);
}

static void test_pace(void)
{
    try_machine(free_cores, 2, 2, 0.0, 1.05);
    try_machine(crowded, 2, 1, 0.0, 1.05);
    try_machine(free_cores, 8, 8, 0.0, 1.05);
    try_machine(seven_free, 8, 7, 1.0, 1.1);
    try_machine(crowded, 64, 1, 1.0, 1.1);
    try_machine(crowded_later, 2, 1, 7.0, 1.05);
    try_machine(free_later, 2, 2, 7.0, 1.05);
    try_machine(free_later, 16, 16, 8.0, 1.1);
}

/* A thread that gains less than some percent is left to others. */
static double useless(int threads, double now_s)
{
    (void)now_s;
    return threads > 1 ? 0.995e-3 : 1e-3;
}

static void test_stand_back(void)
{
    try_machine(useless, 2, 1, 1.0, 1.02);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/team/alone", test_alone);
    g_test_add_func("/team/idle", test_idle);
    g_test_add_func("/team/once", test_once);
    g_test_add_func("/team/costs", test_costs);
    g_test_add_func("/team/threads_work", test_threads_work);
    g_test_add_func("/team/shares_move", test_shares_move);
    g_test_add_func("/team/ranges", test_ranges);
    g_test_add_func("/team/memory", test_memory);
    g_test_add_func("/team/pace", test_pace);
    g_test_add_func("/team/stand_back", test_stand_back);
    return g_test_run();
}
