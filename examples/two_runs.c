/* Two runs in two threads with different friction; the first to end cancels the other.
 * Usage: two_runs PRESET [KEY=VALUE]... */
#include <greenbody/greenbody.h>
#include <pthread.h>
#include <stdio.h>

static struct gb_simulation *run[2];

static void *advance(void *data)
{
    const int mine = *(const int *)data;
    struct gb_error err = {0};
    const enum gb_run_outcome outcome = gb_simulation_advance(run[mine], INT64_MAX, &err);
    gb_simulation_cancel(run[1 - mine], "the other run was faster");
    printf("run %d: %s, %zu points\n", mine,
           outcome == GB_RUN_OUTCOME_DONE ? "done" : err.text,
           gb_simulation_points(run[mine]));
    return NULL;
}

int main(int argc, char **argv)
{
    static const char *const friction[] = {"contact.mu=0.1", "contact.mu=0.5"};
    static const int index[] = {0, 1};
    pthread_t thread[2];
    struct gb_error err = {0};
    struct gb_parameters *parameters = NULL;
    bool good = gb_parameters_create(&parameters, argc > 1 ? argv[1] : NULL, &err);
    for (int i = 2; good && i < argc; i++) {
        good = gb_parameters_set(parameters, argv[i], &err);
    }
    for (int k = 0; good && k < 2; k++) {
        good = gb_parameters_set(parameters, friction[k], &err) &&
               gb_simulation_create(&run[k], parameters, &err);
    }
    for (int k = 0; good && k < 2; k++) {
        pthread_create(&thread[k], NULL, advance, (void *)&index[k]);
    }
    for (int k = 0; good && k < 2; k++) {
        pthread_join(thread[k], NULL);
    }
    for (int k = 0; k < 2; k++) {
        gb_simulation_destroy(run[k]);
    }
    gb_parameters_destroy(parameters);
    fprintf(stderr, "%s%s", err.text, err.code ? "\n" : "");
    return gb_status_exit_code(err.code);
}
