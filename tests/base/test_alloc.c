#include "base/alloc.h"

#include <stdint.h>

#include <glib.h>

static void test_zeroed_aligned_counted(void)
{
    const size_t before = gb_alloc_bytes();
    for (size_t count = 0; count < 300; count += 37) {
        struct gb_error err = {0};
        unsigned char *memory = gb_alloc_array(count, 3, &err);
        g_assert_nonnull(memory);
        g_assert_cmpuint((uintptr_t)memory % 64, ==, 0);
        g_assert_cmpuint(gb_alloc_bytes() - before, >=, count * 3);
        for (size_t i = 0; i < count * 3; i++) {
            g_assert_cmpuint(memory[i], ==, 0);
            memory[i] = 0xff; /* the sanitizer watches the end */
        }
        gb_alloc_free(memory);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    gb_alloc_free(NULL);
}

static void test_overflow(void)
{
    static const size_t bad[][2] = {{SIZE_MAX, 2},
                                    {2, SIZE_MAX},
                                    {SIZE_MAX / 8, 9},
                                    {SIZE_MAX, 1},
                                    {SIZE_MAX / 2, 1}};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        struct gb_error err = {0};
        g_assert_null(gb_alloc_array(bad[i][0], bad[i][1], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
        g_assert_cmpint(gb_status_exit_code(err.code), ==, 3);
    }
    g_assert_null(gb_alloc_array(SIZE_MAX, 2, NULL));
}

/* Exactly the k-th one fails, and the hook is off afterwards. */
static void test_hook(void)
{
    for (long k = 1; k <= 5; k++) {
        gb_alloc_fail_after(k);
        for (long i = 1; i <= 8; i++) {
            struct gb_error err = {0};
            void *memory = gb_alloc_array(4, 8, &err);
            g_assert_true((memory == NULL) == (i == k));
            g_assert_true((err.code == GB_ERR_MEMORY) == (i == k));
            gb_alloc_free(memory);
        }
    }
    gb_alloc_fail_after(1);
    gb_alloc_fail_after(0);
    void *memory = gb_alloc_array(1, 1, NULL);
    g_assert_nonnull(memory);
    gb_alloc_free(memory);
}

static void *allocate_many(void *data)
{
    gintptr failed = 0;
    (void)data;
    for (int i = 0; i < 2000; i++) {
        void *memory = gb_alloc_array(8, 8, NULL);
        failed += memory == NULL;
        gb_alloc_free(memory);
    }
    return (void *)failed;
}

static void test_threads(void)
{
    const size_t before = gb_alloc_bytes();
    gb_alloc_fail_after(1000);
    GThread *threads[4];
    for (int i = 0; i < 4; i++) {
        threads[i] = g_thread_new(NULL, allocate_many, NULL);
    }
    gintptr failed = 0;
    for (int i = 0; i < 4; i++) {
        failed += (gintptr)g_thread_join(threads[i]);
    }
    g_assert_cmpint(failed, ==, 1);
    g_assert_cmpuint(gb_alloc_bytes(), ==, before);
}

/* What is kept stays, the rest is zero; without memory all stays. */
static void test_grow(void)
{
    struct gb_error err = {0};
    int *numbers = gb_alloc_grow(NULL, 0, 3, sizeof *numbers, &err);
    g_assert_nonnull(numbers);
    for (int k = 0; k < 3; k++) {
        g_assert_cmpint(numbers[k], ==, 0);
        numbers[k] = k + 1;
    }
    gb_alloc_fail_after(1);
    g_assert_null(gb_alloc_grow(numbers, 2, 100, sizeof *numbers, &err));
    gb_alloc_fail_after(0);
    g_assert_cmpint(err.code, ==, GB_ERR_MEMORY);
    g_assert_cmpint(numbers[2], ==, 3);
    numbers = gb_alloc_grow(numbers, 2, 100, sizeof *numbers, &err);
    g_assert_nonnull(numbers);
    for (int k = 0; k < 100; k++) {
        g_assert_cmpint(numbers[k], ==, k < 2 ? k + 1 : 0);
    }
    gb_alloc_free(numbers);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/alloc/zeroed-aligned-counted", test_zeroed_aligned_counted);
    g_test_add_func("/alloc/overflow", test_overflow);
    g_test_add_func("/alloc/hook", test_hook);
    g_test_add_func("/alloc/threads", test_threads);
    g_test_add_func("/alloc/grow", test_grow);
    return g_test_run();
}
