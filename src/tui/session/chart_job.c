#include "tui/session/chart_job.h"

#include <string.h>
#include <sys/stat.h>

void gb_chart_job_follow(struct gb_chart_job *job, const char *directory)
{
    gb_chart_job_finish(job);
    job->directory = g_strdup(directory);
}

void gb_chart_job_finish(struct gb_chart_job *job)
{
    g_free(job->directory);
    memset(job, 0, sizeof *job);
}

bool gb_chart_job_runs(const struct gb_child_command *child)
{
    return child->pid != 0 && strcmp(child->name, "chart") == 0;
}

/* The file is replaced as a whole; an error of reading keeps what is shown. */
bool gb_chart_job_refresh(struct gb_chart_job *job, struct gb_chart_csv **chart)
{
    struct stat info;
    struct gb_chart_csv *fresh = NULL;
    if (job->directory == NULL) {
        return false;
    }
    char *path = g_build_filename(job->directory, "chart.csv", NULL);
    const bool there = stat(path, &info) == 0;
    const gint64 modified_ns =
        there ? (gint64)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec : 0;
    const bool good =
        there && modified_ns != job->modified_ns && gb_chart_csv_read(&fresh, path, NULL);
    g_free(path);
    if (good) {
        job->modified_ns = modified_ns;
        gb_chart_csv_destroy(*chart);
        *chart = fresh;
    }
    return good;
}
