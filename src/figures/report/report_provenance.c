#include "base/alloc.h"
#include "base/file.h"
#include "base/read_file.h"
#include "base/table.h"
#include "figures/report/report.h"
#include "figures/report/report_table.h"

/* Copies a file of a run; *sum becomes its SHA-256, "" when the run has no such file. */
static bool copy_file(const struct gb_report *report, size_t run, const char *name,
                      char **sum, struct gb_error *err)
{
    char *text = NULL;
    size_t size = 0;
    char *from = g_build_filename(report->set->run[run].directory, name, NULL);
    char *to = g_strdup_printf("%s/runs/%zu-%s", report->folder, run + 1, name);
    bool good = true;
    *sum = g_strdup("");
    if (gb_read_file(from, GB_TABLE_BYTES_MAX, &text, &size, NULL)) {
        g_free(*sum);
        *sum = g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, size);
        good = gb_file_replace(to, text, size, err);
    }
    gb_alloc_free(text);
    g_free(to);
    g_free(from);
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
        gb_report_table_put(&table, "%.16s", curve != NULL ? curve : "");
        g_free(preset);
        g_free(curve);
    }
    return gb_report_table_end(report, &table, "runs",
                               "Runs; the folder runs has their presets and curves as "
                               "NUMBER-preset.ini and "
                               "NUMBER-curve.csv. greenbody run NUMBER-preset.ini "
                               "repeats a run bit by bit.",
                               err) &&
           good;
}
