/* One thread at a time has HDF5, which many builds need. */
#include <glib.h>

#include "hdf/hdf.h"

enum { THREADS = 4, FILES = 50 };

struct holders {
    gint inside, together;
};

/* A file in memory, and a pause in which another thread would come in. */
static gpointer work(gpointer data)
{
    struct holders *holders = data;
    for (int k = 0; k < FILES; k++) {
        struct gb_hdf *outer = NULL, *inner = NULL;
        struct gb_error err = {0};
        g_assert_true(gb_hdf_create(&outer, "/tmp/greenbody-threads", &err));
        g_atomic_int_inc(&holders->inside);
        g_thread_yield();
        g_assert_true(gb_hdf_create(&inner, "/tmp/greenbody-threads", &err)); /* its own */
        gb_hdf_destroy(inner);
        g_thread_yield();
        if (g_atomic_int_get(&holders->inside) != 1) {
            g_atomic_int_inc(&holders->together);
        }
        g_atomic_int_add(&holders->inside, -1);
        gb_hdf_destroy(outer);
    }
    return NULL;
}

static void test_one_thread(void)
{
    struct holders holders = {0};
    GThread *thread[THREADS];
    for (int k = 0; k < THREADS; k++) {
        thread[k] = g_thread_new("files", work, &holders);
    }
    for (int k = 0; k < THREADS; k++) {
        g_thread_join(thread[k]);
    }
    g_assert_cmpint(holders.together, ==, 0);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/hdf/one_thread", test_one_thread);
    return g_test_run();
}
