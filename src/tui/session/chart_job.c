#include "tui/session/chart_job.h"

#include <string.h>
#include <sys/stat.h>

void gb_chart_job_follow(struct gb_chart_job *job, const char *directory, bool stability)
{
    gb_chart_job_finish(job);
    job->directory = g_strdup(directory);
    job->stability = stability;
}

void gb_chart_job_finish(struct gb_chart_job *job)
{
    g_free(job->directory);
    memset(job, 0, sizeof *job);
}

bool gb_chart_job_runs(const struct gb_child_command *child)
{
    return child->pid != 0 &&
           (strcmp(child->name, "chart") == 0 || strcmp(child->name, "stability") == 0);
}

/* An error of reading keeps what is shown. */
static bool read_table(const struct gb_chart_job *job, const char *path,
                       struct gb_chart_csv **chart, struct gb_stability_csv **stability)
{
    struct gb_chart_csv *next_chart = NULL;
    struct gb_stability_csv *next = NULL;
    if (!(job->stability ? gb_stability_csv_read(&next, path, NULL)
                         : gb_chart_csv_read(&next_chart, path, NULL))) {
        return false;
    }
    if (job->stability) {
        gb_stability_csv_destroy(*stability);
        *stability = next;
    } else {
        gb_chart_csv_destroy(*chart);
        *chart = next_chart;
    }
    return true;
}

/* The file is replaced as a whole. */
bool gb_chart_job_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart,
                          struct gb_stability_csv **stability)
{
    struct stat info;
    if (job->directory == NULL) {
        return false;
    }
    char *path = g_build_filename(
        job->directory, job->stability ? "stability.csv" : "chart.csv", NULL);
    const bool there = stat(path, &info) == 0;
    const gint64 modified_ns =
        there ? (gint64)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec : 0;
    const bool good =
        there && modified_ns != job->modified_ns &&
                      read_table(job, path, chart, stability);
    g_free(path);
    if (good) {
        job->modified_ns = modified_ns;
    }
    return good;
}
