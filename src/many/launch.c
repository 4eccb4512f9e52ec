#include "many/launch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "base/read_file.h"

enum { COUNT_MOST = 10000000, TEXT_BYTES = 16384 };

/* Variables of one launcher. */
struct variables {
    const char *rank, *count, *local_count;
    bool all; /* must be there, the last one too */
};

/* The first that fits: mpirun inside a job of Slurm sees the variables of the job as well,
 * and srun sets some of PMI.  SLURM_STEP_TASKS_PER_NODE is as "4(x2),3": the first number,
 * right for steps that are spread evenly. */
static const struct variables launchers[] = {
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE", false},
    {"PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS", true},
    {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE", false},
    {"PMI_RANK", "PMI_SIZE", "PMI_LOCAL_SIZE", false},
};

/* A number of the environment; `otherwise` where it is not there or no such number. */
static long read_number(const char *name, long otherwise)
{
    const char *text = getenv(name);
    char *end = NULL;
    const long value = text != NULL ? strtol(text, &end, 10) : 0;
    return text != NULL && end != text && value >= 0 && value <= COUNT_MOST ? value
                                                                            : otherwise;
}

/* Tasks of an array are jobs of their own, each with its processors. */
static void add_array(struct gb_launch *launch)
{
    const long tasks = read_number("SLURM_ARRAY_TASK_COUNT", 0);
    const long task = read_number("SLURM_ARRAY_TASK_ID", -1);
    const long first = read_number("SLURM_ARRAY_TASK_MIN", 0);
    const long step = read_number("SLURM_ARRAY_TASK_STEP", 1);
    if (tasks > 0 && task >= first) {
        launch->rank += (task - first) / MAX(step, 1) * launch->count;
        launch->count *= tasks;
        launch->launched = true;
    }
}

struct gb_launch gb_launch_read(void)
{
    struct gb_launch launch = {.count = 1, .local_count = 1};
    for (size_t i = 0; i < G_N_ELEMENTS(launchers) && !launch.launched; i++) {
        const struct variables *by = &launchers[i];
        const long rank = read_number(by->rank, -1), count = read_number(by->count, 0);
        const long local = read_number(by->local_count, 0);
        if (rank < 0 || rank >= count || (by->all && local < 1)) {
            continue;
        }
        launch = (struct gb_launch){.rank = rank, .count = count, .launched = true};
        launch.local_count = CLAMP(local, 1, count);
    }
    add_array(&launch);
    return launch;
}

/* The beginning of a file of the kernel, which has no size before it is read. */
static bool read_text(const char *path, char text[TEXT_BYTES])
{
    const int file = gb_read_file_open(path, NULL);
    const ssize_t length = file >= 0 ? read(file, text, TEXT_BYTES - 1) : -1;
    if (file >= 0) {
        close(file);
    }
    text[length > 0 ? length : 0] = '\0';
    return length > 0;
}

/* cpu.max of one cgroup, "400000 100000" or "max 100000": processors, rounded up. */
static long read_quota(const char *folder)
{
    char *path = g_build_filename(folder, "cpu.max", NULL);
    char text[TEXT_BYTES];
    double used = 0.0, period = 0.0;
    long cores = 0;
    if (read_text(path, text) && sscanf(text, "%lf %lf", &used, &period) == 2 &&
        used > 0.0 && period > 0.0) {
        cores = (long)fmin(fmax(ceil(used / period), 1.0), COUNT_MOST);
    }
    g_free(path);
    return cores;
}

long gb_launch_quota(const char *root, const char *group)
{
    char *at = g_strdup(group);
    long least = 0;
    while (true) {
        char *folder = g_build_filename(root, at, NULL);
        const long cores = read_quota(folder);
        least = cores > 0 && (least == 0 || cores < least) ? cores : least;
        g_free(folder);
        char *end = strrchr(at, '/');
        if (end == NULL) {
            break;
        }
        *end = '\0';
    }
    g_free(at);
    return least;
}

static long own_quota(void)
{
    char text[TEXT_BYTES];
    long cores = 0;
    if (read_text("/proc/self/cgroup", text)) {
        char **lines = g_strsplit(text, "\n", -1);
        for (int i = 0; lines[i] != NULL; i++) {
            if (g_str_has_prefix(lines[i], "0::/")) {
                cores = gb_launch_quota("/sys/fs/cgroup", lines[i] + strlen("0::"));
            }
        }
        g_strfreev(lines);
    }
    return cores;
}

long gb_launch_cores(const struct gb_launch *launch)
{
    const long own = (long)g_get_num_processors(); /* of the affinity */
    long together = MAX(sysconf(_SC_NPROCESSORS_ONLN), own);
    const long allocated = read_number("SLURM_CPUS_ON_NODE", 0), quota = own_quota();
    together = allocated > 0 ? MIN(together, allocated) : together;
    together = quota > 0 ? MIN(together, quota) : together;
    return CLAMP(together / launch->local_count, 1, own);
}
