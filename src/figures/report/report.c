#include "figures/report/report.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"
#include "figures/report/report_conditions.h"

static const struct gb_report_part parts[] = {
    {"results", "Results", "first page: conditions, key results with errors",
     gb_report_results},
    {"figures", "Figures", "every figure that the runs have data for", gb_report_figures},
    {"tables", "Tables", "densities at round pressures, ends of branches",
     gb_report_tables},
    {"fits", "Equations of compaction", "parameters of all equations with intervals",
     gb_report_fits},
    {"pictures", "Pictures", "last state of each scene: coordination, stress, forces",
     gb_report_pictures},
    {"keys", "Parameters", "keys in use with symbols, units and sources", gb_report_keys},
    {"references", "References", "papers whose laws and equations are used",
     gb_report_references},
    {"provenance", "Provenance", "runs with seeds, presets, curves and checksums",
     gb_report_provenance},
    {"preset", "Preset", "preset.ini of the first run", gb_report_preset},
    {0},
};

/* Folders of the files of the parts. */
static const char *const folders[] = {"figures", "pictures", "tables", "runs", "data"};

const struct gb_report_part *gb_report_parts(void)
{
    return parts;
}

char *gb_report_caption(const struct gb_report *report, const char *text)
{
    return g_strdup_printf("%s %s", text, report->conditions);
}

char *gb_report_figure_caption(struct gb_report *report, const char *text)
{
    report->figures++;
    return g_strdup_printf("Figure %d. %s %s", report->figures, text, report->conditions);
}

static const char *plural(size_t count)
{
    return count == 1 ? "" : "s";
}

static void begin_page(struct gb_report *report)
{
    const struct gb_runset *set = report->set;
    GDateTime *now = g_date_time_new_now_utc();
    char *date = g_date_time_format(now, "%Y-%m-%d %H:%M UTC");
    char *subtitle = g_strdup_printf(
        "%zu run%s of %zu scene%s \xc2\xb7 greenbody %s \xc2\xb7 %s", set->count,
        plural(set->count), set->groups, plural(set->groups), GB_VERSION, date);
    gb_page_begin(&report->page, set->run[0].params.title, subtitle);
    g_free(subtitle);
    g_free(date);
    g_date_time_unref(now);
}

static bool write_page(struct gb_report *report, struct gb_error *err)
{
    char *html = g_build_filename(report->folder, "index.html", NULL);
    char *markdown = g_build_filename(report->folder, "report.md", NULL);
    char *sums = g_build_filename(report->folder, "SHA256SUMS", NULL);
    gb_page_end(&report->page);
    const bool good =
        gb_file_replace(html, report->page.html->str, report->page.html->len, err) &&
        gb_file_replace(markdown, report->page.markdown->str, report->page.markdown->len,
                        err) &&
        gb_file_replace(sums, report->sums->str, report->sums->len, err);
    g_free(sums);
    g_free(markdown);
    g_free(html);
    return good;
}

static bool make_folders(const struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    const size_t count =
        G_N_ELEMENTS(folders) - (report->data == NULL); /* the last one */
    for (size_t k = 0; k < count && good; k++) {
        char *path = g_build_filename(report->folder, folders[k], NULL);
        good = g_mkdir(path, 0777) == 0 ||
               gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made", path);
        g_free(path);
    }
    return good;
}

/* A part without content has no heading; the first one is a printed page of its own. */
static bool write_part(struct gb_report *report, const struct gb_report_part *part,
                       struct gb_error *err)
{
    const gsize before[2] = {report->page.html->len, report->page.markdown->len};
    if (part == &parts[1]) {
        gb_page_break(&report->page);
    }
    gb_page_heading(&report->page, part->heading);
    const gsize empty = report->page.html->len;
    const bool good = part->write(report, err);
    if (report->page.html->len == empty) {
        g_string_truncate(report->page.html, before[0]);
        g_string_truncate(report->page.markdown, before[1]);
    }
    return good;
}

static bool fill_folder(struct gb_report *report, struct gb_error *err)
{
    bool good = make_folders(report, err);
    report->conditions = gb_report_conditions_caption(report->set);
    report->cited = g_ptr_array_new_with_free_func(g_free);
    report->sums = g_string_new(NULL);
    begin_page(report);
    for (const struct gb_report_part *part = parts; part->name != NULL && good; part++) {
        good = write_part(report, part, err);
    }
    good = good && write_page(report, err);
    gb_page_finish(&report->page);
    g_string_free(report->sums, TRUE);
    g_ptr_array_unref(report->cited);
    g_free(report->conditions);
    return good;
}

/* Removes a folder of this program; symbolic links are not followed. */
static void remove_tree(const char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    for (const char *name = dir ? g_dir_read_name(dir) : NULL; name != NULL;
         name = g_dir_read_name(dir)) {
        char *inner = g_build_filename(path, name, NULL);
        if (g_file_test(inner, G_FILE_TEST_IS_DIR) &&
            !g_file_test(inner, G_FILE_TEST_IS_SYMLINK)) {
            remove_tree(inner);
        } else {
            g_unlink(inner);
        }
        g_free(inner);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_rmdir(path);
}

static bool cannot_make(const char *output, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made: %s", output,
                        g_strerror(errno));
}

/* The folder is filled under another name beside its own and renamed when complete. */
bool gb_report_write(const struct gb_runset *set, const struct gb_table *data,
                     const char *output, struct gb_error *err)
{
    if (g_file_test(output, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: exists; a report goes to a new folder", output);
    }
    char *partial = g_strdup_printf("%s.partial-XXXXXX", output);
    if (g_mkdtemp_full(partial, 0777) == NULL) {
        g_free(partial);
        return cannot_make(output, err);
    }
    struct gb_report report = {.set = set, .folder = partial, .data = data};
    bool good = fill_folder(&report, err);
    if (good && g_rename(partial, output) != 0) {
        good = cannot_make(output, err);
    }
    if (!good) {
        remove_tree(partial);
    }
    g_free(partial);
    return good;
}
