#include "figures/report/report.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"

static const struct gb_report_part parts[] = {
    {"figures", "Figures", "every figure that the runs have data for", gb_report_figures},
    {"tables", "Tables", "densities at round pressures, ends of branches",
     gb_report_tables},
    {"fits", "Equations of compaction", "parameters of all equations with intervals",
     gb_report_fits},
    {"pictures", "Pictures", "last state of each scene: coordination, stress, forces",
     gb_report_pictures},
    {"provenance", "Provenance", "runs with seeds, presets, curves and checksums",
     gb_report_provenance},
    {"preset", "Preset", "preset.ini of the first run", gb_report_preset},
    {0},
};

/* Folders of the files of the parts. */
static const char *const folders[] = {"figures", "pictures", "tables", "runs"};

const struct gb_report_part *gb_report_parts(void)
{
    return parts;
}

void gb_report_leave_out(struct gb_report *report, const char *what, const char *reason)
{
    g_string_append_printf(report->left_out, "%s%s (%s)",
                           report->left_out->len > 0 ? "; " : "", what, reason);
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
    if (report->left_out->len > 0) {
        char *line = g_strdup_printf("Left out: %s.", report->left_out->str);
        gb_page_paragraph(&report->page, line);
        g_free(line);
    }
    gb_page_end(&report->page);
    const bool good =
        gb_file_replace(html, report->page.html->str, report->page.html->len, err) &&
        gb_file_replace(markdown, report->page.markdown->str, report->page.markdown->len,
                        err);
    g_free(markdown);
    g_free(html);
    return good;
}

static bool make_folders(const struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < G_N_ELEMENTS(folders) && good; k++) {
        char *path = g_build_filename(report->folder, folders[k], NULL);
        good = g_mkdir(path, 0777) == 0 ||
               gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made", path);
        g_free(path);
    }
    return good;
}

static bool fill_folder(struct gb_report *report, struct gb_error *err)
{
    bool good = make_folders(report, err);
    report->left_out = g_string_new(NULL);
    begin_page(report);
    for (const struct gb_report_part *part = parts; part->name != NULL && good; part++) {
        gb_page_heading(&report->page, part->heading);
        good = part->write(report, err);
    }
    good = good && write_page(report, err);
    gb_page_finish(&report->page);
    g_string_free(report->left_out, TRUE);
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
