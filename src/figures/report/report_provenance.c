#include "base/alloc.h"
#include "base/file.h"
#include "base/read_file.h"
#include "base/table.h"
#include "figures/report/report.h"
#include "figures/report/report_table.h"

/* Writes the bytes of a file into the folder and its line into SHA256SUMS; *sum: g_free. */
static bool keep(struct gb_report *report, const char *name, const char *text,
                 size_t size, char **sum, struct gb_error *err)
{
    char *to = g_build_filename(report->folder, name, NULL);
    *sum = g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, size);
    g_string_append_printf(report->sums, "%s  %s\n", *sum, name);
    const bool good = gb_file_replace(to, text, size, err);
    g_free(to);
    return good;
}

/* Copies a file of a run; *sum becomes its SHA-256, "" when the run has no such file. */
static bool copy_file(struct gb_report *report, size_t run, const char *name, char **sum,
                      struct gb_error *err)
{
    char *text = NULL;
    size_t size = 0;
    char *from = g_build_filename(report->set->run[run].directory, name, NULL);
    char *to = g_strdup_printf("runs/%zu-%s", run + 1, name);
    bool good = true;
    if (gb_read_file(from, GB_TABLE_BYTES_MAX, &text, &size, NULL)) {
        good = keep(report, to, text, size, sum, err);
    } else {
        *sum = g_strdup("");
    }
    gb_alloc_free(text);
    g_free(to);
    g_free(from);
    return good;
}

/* Name of the copy of a file: letters, digits and "._-" of its own, so that every system and
 * SHA256SUMS take it; g_free. */
static char *plain_name(const char *path)
{
    char *name = g_path_get_basename(path);
    g_strcanon(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-",
               '_');
    if (*name == '-' || *name == '.') {
        *name = '_';
    }
    return name;
}

/* The file of the measured points and its checksum. */
static bool add_laboratory(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"laboratory file", "copy", "points", "SHA-256",
                                        NULL};
    const char *path = gb_table_path(report->data);
    char *text = NULL;
    char *sum = NULL;
    size_t size = 0;
    struct gb_report_table table;
    char *name = plain_name(path);
    char *copy = g_strconcat("data/", name, NULL);
    bool good = gb_read_file(path, GB_TABLE_BYTES_MAX, &text, &size, err) &&
                keep(report, copy, text, size, &sum, err);
    if (good) {
        gb_report_table_begin(&table, heads);
        gb_report_table_put(&table, "%s", path);
        gb_report_table_put(&table, "%s", copy);
        gb_report_table_put(&table, "%zu", gb_table_rows(report->data));
        gb_report_table_put(&table, "%s", sum);
        good = gb_report_table_end(report, &table, "laboratory",
                                   "Measured points, as they were read.", err);
    }
    gb_alloc_free(text);
    g_free(sum);
    g_free(copy);
    g_free(name);
    return good;
}

bool gb_report_provenance(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"run",
                                        "directory",
                                        "title",
                                        "particles",
                                        "seed",
                                        "points",
                                        "SHA-256 of curve.csv",
                                        NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    bool good = true;
    gb_report_table_begin(&table, heads);
    for (size_t i = 0; i < set->count && good; i++) {
        const struct gb_runset_run *run = &set->run[i];
        char *preset = NULL;
        char *curve = NULL;
        good = copy_file(report, i, "preset.ini", &preset, err) &&
               copy_file(report, i, "curve.csv", &curve, err);
        gb_report_table_put(&table, "%zu", i + 1);
        gb_report_table_put(&table, "%s", run->directory);
        gb_report_table_put(&table, "%s", run->params.title);
        gb_report_table_put(&table, "%" G_GINT64_FORMAT, run->params.count);
        gb_report_table_put(&table, "%" G_GUINT64_FORMAT, run->params.seed);
        gb_report_table_put(&table, "%zu",
                            run->table != NULL ? gb_table_rows(run->table) : 0);
        gb_report_table_put(&table, "%s", curve != NULL ? curve : "");
        g_free(preset);
        g_free(curve);
    }
    return gb_report_table_end(report, &table, "runs",
                               "Runs; the folder runs has their presets and curves as "
                               "NUMBER-preset.ini and "
                               "NUMBER-curve.csv. greenbody run NUMBER-preset.ini "
                               "repeats a run bit by bit, sha256sum -c SHA256SUMS "
                               "checks the copies.",
                               err) &&
           good && (report->data == NULL || add_laboratory(report, err));
}
