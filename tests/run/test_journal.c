/* The digest of a preset in a checkpoint. */
#include <glib.h>

#include "run/record/run_journal.h"
#include "greenbody/params.h"

static int64_t digest_with(const char *assignment)
{
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    if (assignment != NULL && !gb_params_assign(&params, assignment, &err)) {
        g_error("%s", err.text);
    }
    return gb_run_journal_digest(&params);
}

static void test_changes(void)
{
    static const char *const other[] = {"contact.mu=0.3", "particles.count=1000",
                                        "structure.seed=2",
                                        "loading.on_collapse=strain"};
    static const char *const free_keys[] = {"scene.title=x", "numerics.threads=2",
                                            "output.checkpoint_every=5 s"};
    const int64_t defaults = digest_with(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(other); i++) {
        g_assert_cmpint(digest_with(other[i]), !=, defaults);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(free_keys); i++) {
        g_assert_cmpint(digest_with(free_keys[i]), ==, defaults);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/journal/changes", test_changes);
    return g_test_run();
}
