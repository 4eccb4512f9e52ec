#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "io/lock.h"

/* A lock ends with its holder and with nothing else. */

static char *folder;
static const char name[] = "one.lock";

/* A process that holds the lock, once it does. */
static pid_t hold(void)
{
    int ready[2];
    char sign = 0;
    g_assert_cmpint(pipe(ready), ==, 0);
    const pid_t holder = fork();
    if (holder == 0) {
        struct gb_lock lock;
        sign = gb_lock_take(&lock, folder, name) ? 'y' : 'n';
        (void)!write(ready[1], &sign, 1);
        while (true) {
            pause();
        }
    }
    g_assert_cmpint(read(ready[0], &sign, 1), ==, 1);
    g_assert_cmpint(sign, ==, 'y');
    close(ready[0]);
    close(ready[1]);
    return holder;
}

static void end(pid_t holder)
{
    g_assert_cmpint(kill(holder, SIGKILL), ==, 0);
    g_assert_cmpint(waitpid(holder, NULL, 0), ==, holder);
}

static bool file_is_there(void)
{
    char *path = g_build_filename(folder, name, NULL);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static void test_holder(void)
{
    struct gb_lock lock;
    g_assert_false(gb_lock_is_held(folder, name));
    const pid_t holder = hold();
    int status = 0;
    g_assert_true(gb_lock_is_held(folder, name));
    g_assert_false(gb_lock_take(&lock, folder, name));
    g_assert_cmpint(errno, ==, EWOULDBLOCK);
    char *who = gb_lock_holder(folder, name);
    char *want = g_strdup_printf("process %ld on %s", (long)holder, g_get_host_name());
    g_assert_cmpstr(who, ==, want);
    g_free(who);
    g_free(want);
    g_assert_cmpint(kill(holder, SIGSTOP), ==, 0);
    g_assert_cmpint(waitpid(holder, &status, WUNTRACED), ==, holder);
    g_assert_true(WIFSTOPPED(status));
    g_assert_false(gb_lock_take(&lock, folder, name)); /* it stands still, but lives */
    end(holder);
    g_assert_true(file_is_there()); /* which means nothing */
    g_assert_false(gb_lock_is_held(folder, name));
    g_assert_true(gb_lock_take(&lock, folder, name));
    g_assert_true(gb_lock_is_held(folder, name));
    gb_lock_release(&lock);
    gb_lock_release(&lock);
    g_assert_false(file_is_there());
    g_assert_false(gb_lock_is_held(folder, name));
    who = gb_lock_holder(folder, name);
    g_assert_cmpstr(who, ==, "another process");
    g_free(who);
}

/* A child has the lock of its parent, and does not end it. */
static void test_child(void)
{
    struct gb_lock lock;
    g_assert_true(gb_lock_take(&lock, folder, name));
    const pid_t child = fork();
    if (child == 0) {
        gb_lock_release(&lock);
        _exit(0);
    }
    g_assert_cmpint(waitpid(child, NULL, 0), ==, child);
    g_assert_true(gb_lock_is_held(folder, name));
    gb_lock_release(&lock);
    g_assert_false(file_is_there());
}

static void test_folders(void)
{
    struct gb_lock lock;
    g_assert_false(gb_lock_take(&lock, "/no/such/folder", name));
    g_assert_cmpint(errno, ==, ENOENT);
    gb_lock_release(&lock);
    g_assert_false(gb_lock_is_held("/no/such/folder", name));
    char *link = g_build_filename(folder, "link.lock", NULL);
    g_assert_cmpint(symlink("/etc/passwd", link), ==, 0);
    g_assert_false(gb_lock_take(&lock, folder, "link.lock")); /* written nowhere else */
    g_assert_cmpint(errno, ==, ELOOP);
    g_assert_cmpint(g_remove(link), ==, 0);
    g_free(link);
}

/* Eight processes count in a file, one after the other: no two have the lock. */
static void test_exclusion(void)
{
    enum { PROCESSES = 8, TIMES = 200 };
    char *count = g_build_filename(folder, "count", NULL);
    pid_t pid[PROCESSES];
    g_assert_true(g_file_set_contents(count, "0", -1, NULL));
    for (int p = 0; p < PROCESSES; p++) {
        pid[p] = fork();
        for (int k = 0; k < TIMES && pid[p] == 0; k++) {
            struct gb_lock lock;
            char *text = NULL;
            while (!gb_lock_take(&lock, folder, name)) {
                g_usleep(50);
            }
            g_assert_true(g_file_get_contents(count, &text, NULL, NULL));
            char *next = g_strdup_printf("%d", atoi(text) + 1);
            g_assert_true(g_file_set_contents(count, next, -1, NULL));
            g_free(next);
            g_free(text);
            gb_lock_release(&lock);
        }
        if (pid[p] == 0) {
            _exit(0);
        }
    }
    for (int p = 0; p < PROCESSES; p++) {
        g_assert_cmpint(waitpid(pid[p], NULL, 0), ==, pid[p]);
    }
    char *text = NULL;
    g_assert_true(g_file_get_contents(count, &text, NULL, NULL));
    g_assert_cmpint(atoi(text), ==, PROCESSES * TIMES);
    g_assert_cmpint(g_remove(count), ==, 0);
    g_free(text);
    g_free(count);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("greenbody-lock-XXXXXX", NULL);
    g_assert_nonnull(folder);
    g_test_add_func("/lock/holder", test_holder);
    g_test_add_func("/lock/child", test_child);
    g_test_add_func("/lock/folders", test_folders);
    g_test_add_func("/lock/exclusion", test_exclusion);
    const int status = g_test_run();
    g_assert_cmpint(g_rmdir(folder), ==, 0);
    g_free(folder);
    return status;
}
