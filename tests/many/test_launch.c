#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "many/pool.h"

/* Rank and count by the variables of launchers, and the share of the processors. */

static const char *const all[] = {"OMPI_COMM_WORLD_RANK",
                                  "OMPI_COMM_WORLD_SIZE",
                                  "OMPI_COMM_WORLD_LOCAL_SIZE",
                                  "PMI_RANK",
                                  "PMI_SIZE",
                                  "MPI_LOCALRANKID",
                                  "MPI_LOCALNRANKS",
                                  "PMI_LOCAL_SIZE",
                                  "SLURM_PROCID",
                                  "SLURM_STEP_NUM_TASKS",
                                  "SLURM_NTASKS",
                                  "SLURM_STEP_TASKS_PER_NODE",
                                  "SLURM_CPUS_ON_NODE",
                                  "SLURM_ARRAY_TASK_ID",
                                  "SLURM_ARRAY_TASK_COUNT",
                                  "SLURM_ARRAY_TASK_MIN",
                                  "SLURM_ARRAY_TASK_STEP"};

/* Variables as "A=1 B=2". */
static struct gb_launch read_of(const char *variables)
{
    for (size_t i = 0; i < G_N_ELEMENTS(all); i++) {
        g_unsetenv(all[i]);
    }
    char **pairs = g_strsplit(variables, " ", -1);
    for (int i = 0; pairs[i] != NULL; i++) {
        char **pair = g_strsplit(pairs[i], "=", 2);
        g_assert_true(g_setenv(pair[0], pair[1], TRUE));
        g_strfreev(pair);
    }
    g_strfreev(pairs);
    return gb_pool_launch();
}

static void test_launchers(void)
{
    static const struct {
        const char *name, *variables;
        long rank, count, local_count;
        bool launched;
    } cases[] = {
        {"nothing", "PMI_LOCAL_SIZE=3", 0, 1, 1, false},
        {"Open MPI",
         "OMPI_COMM_WORLD_RANK=5 OMPI_COMM_WORLD_SIZE=8 OMPI_COMM_WORLD_LOCAL_SIZE=4", 5,
         8, 4, true},
        {"Open MPI in a job",
         "OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_LOCAL_SIZE=2 "
         "SLURM_PROCID=0 SLURM_STEP_NUM_TASKS=1",
         1, 2, 2, true},
        {"Hydra", "PMI_RANK=2 PMI_SIZE=6 MPI_LOCALRANKID=0 MPI_LOCALNRANKS=2", 2, 6, 2,
         true},
        {"srun", "SLURM_PROCID=7 SLURM_STEP_NUM_TASKS=8 SLURM_STEP_TASKS_PER_NODE=4(x2)",
         7, 8, 4, true},
        {"srun --mpi=pmi2",
         "PMI_RANK=1 PMI_SIZE=2 SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=2 "
         "SLURM_STEP_TASKS_PER_NODE=2",
         1, 2, 2, true},
        {"PALS", "PMI_RANK=3 PMI_SIZE=4 PMI_LOCAL_SIZE=2", 3, 4, 2, true},
        {"a batch script", "SLURM_PROCID=0 SLURM_NTASKS=4", 0, 1, 1, false},
        {"an array",
         "SLURM_PROCID=0 SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_COUNT=4 "
         "SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_STEP=2",
         2, 4, 1, true},
        {"srun in an array",
         "SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=2 SLURM_STEP_TASKS_PER_NODE=2 "
         "SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=0",
         3, 6, 2, true},
        {"no numbers", "PMI_RANK=a PMI_SIZE=b MPI_LOCALNRANKS=", 0, 1, 1, false},
        {"a rank outside", "OMPI_COMM_WORLD_RANK=8 OMPI_COMM_WORLD_SIZE=8", 0, 1, 1,
         false},
        {"huge", "OMPI_COMM_WORLD_RANK=99999999999999999999 OMPI_COMM_WORLD_SIZE=9", 0, 1,
         1, false},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        const struct gb_launch launch = read_of(cases[i].variables);
        g_test_message("%s", cases[i].name);
        g_assert_cmpint(launch.rank, ==, cases[i].rank);
        g_assert_cmpint(launch.count, ==, cases[i].count);
        g_assert_cmpint(launch.local_count, ==, cases[i].local_count);
        g_assert_cmpint(launch.launched, ==, cases[i].launched);
    }
}

static void test_cores(void)
{
    const long own = (long)g_get_num_processors();
    struct gb_launch launch = read_of("SLURM_CPUS_ON_NODE=1000000");
    const long alone = gb_pool_cores(&launch);
    g_assert_cmpint(alone, >=, 1);
    g_assert_cmpint(alone, <=, own);
    launch.local_count = 1000000;
    g_assert_cmpint(gb_pool_cores(&launch), ==, 1);
    launch = read_of("SLURM_CPUS_ON_NODE=1");
    g_assert_cmpint(gb_pool_cores(&launch), ==, 1);
}

static void put(const char *folder, const char *text)
{
    char *path = g_build_filename(folder, "cpu.max", NULL);
    g_assert_cmpint(g_mkdir_with_parents(folder, 0777), ==, 0);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    g_free(path);
}

/* The smallest of the groups above counts. */
static void test_quota(void)
{
    char *root = g_dir_make_tmp("greenbody-launch-XXXXXX", NULL);
    char *job = g_build_filename(root, "job", NULL);
    char *step = g_build_filename(job, "step", NULL);
    g_assert_cmpint(gb_pool_quota(root, "/job/step"), ==, 0);
    put(step, "max 100000\n");
    g_assert_cmpint(gb_pool_quota(root, "/job/step"), ==, 0);
    put(job, "350000 100000\n");
    g_assert_cmpint(gb_pool_quota(root, "/job/step"), ==, 4);
    put(step, "1000 100000\n");
    g_assert_cmpint(gb_pool_quota(root, "/job/step"), ==, 1);
    g_assert_cmpint(gb_pool_quota(root, "/job"), ==, 4);
    put(root, "200000 100000\n");
    g_assert_cmpint(gb_pool_quota(root, "/job"), ==, 2);
    g_assert_cmpint(gb_pool_quota(root, "/"), ==, 2);
    const char *const folders[] = {step, job, root};
    for (size_t i = 0; i < G_N_ELEMENTS(folders); i++) {
        char *path = g_build_filename(folders[i], "cpu.max", NULL);
        g_assert_cmpint(g_remove(path), ==, 0);
        g_assert_cmpint(g_rmdir(folders[i]), ==, 0);
        g_free(path);
    }
    g_free(step);
    g_free(job);
    g_free(root);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/launch/launchers", test_launchers);
    g_test_add_func("/launch/cores", test_cores);
    g_test_add_func("/launch/quota", test_quota);
    return g_test_run();
}
