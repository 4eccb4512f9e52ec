/* The report: figures, pictures, provenance and preset as parts; the folder with its page. */
#include "figures/report.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/built_with.h"
#include "base/file.h"
#include "base/table.h"
#include "base/visible.h"
#include "draw/packing_image.h"
#include "draw/picture_colours.h"
#include "figures/figures.h"
#include "figures/plotting.h"
#include "figures/report_tables.h"
#include "figures/states.h"

/* Caption of the next figure, "Figure 3. ...", with the conditions of the scenes; g_free. */
static char *figure_caption(struct gb_report *report, const char *text)
{
    report->figures++;
    return g_strdup_printf("Figure %d. %s %s", report->figures, text, report->conditions);
}

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
    if (gb_file_read(from, GB_TABLE_BYTES_MAX, &text, &size, NULL)) {
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
    bool good = gb_file_read(path, GB_TABLE_BYTES_MAX, &text, &size, err) &&
                keep(report, copy, text, size, &sum, err);
    if (good) {
        gb_report_tables_begin(&table, heads);
        gb_report_tables_put(&table, "%s", path);
        gb_report_tables_put(&table, "%s", copy);
        gb_report_tables_put(&table, "%zu", gb_table_rows(report->data));
        gb_report_tables_put(&table, "%s", sum);
        good = gb_report_tables_end(report, &table, "laboratory",
                                    "Measured points, as they were read.", err);
    }
    gb_alloc_free(text);
    g_free(sum);
    g_free(copy);
    g_free(name);
    return good;
}

static bool write_provenance(struct gb_report *report, struct gb_error *err)
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
    gb_report_tables_begin(&table, heads);
    for (size_t i = 0; i < set->count && good; i++) {
        const struct gb_runset_run *run = &set->run[i];
        char *preset = NULL;
        char *curve = NULL;
        good = copy_file(report, i, "preset.ini", &preset, err) &&
               copy_file(report, i, "curve.csv", &curve, err);
        gb_report_tables_put(&table, "%zu", i + 1);
        gb_report_tables_put(&table, "%s", run->directory);
        gb_report_tables_put(&table, "%s", run->params.title);
        gb_report_tables_put(&table, "%" G_GINT64_FORMAT, run->params.count);
        gb_report_tables_put(&table, "%" G_GUINT64_FORMAT, run->params.seed);
        gb_report_tables_put(&table, "%zu",
                             run->table != NULL ? gb_table_rows(run->table) : 0);
        gb_report_tables_put(&table, "%s", curve != NULL ? curve : "");
        g_free(preset);
        g_free(curve);
    }
    return gb_report_tables_end(report, &table, "runs",
                                "Runs; the folder runs has their presets and curves as "
                                "NUMBER-preset.ini and "
                                "NUMBER-curve.csv. greenbody run NUMBER-preset.ini "
                                "repeats a run bit by bit, sha256sum -c SHA256SUMS "
                                "checks the copies.",
                                err) &&
           good && (report->data == NULL || add_laboratory(report, err));
}

static void preset_show(struct gb_page *page, const char *text)
{
    char *shown = gb_visible_text(text, "\n\t");
    char *safe = g_markup_escape_text(shown, -1);
    g_string_append_printf(page->html,
                           "<details><summary>preset.ini of the first run</summary>"
                           "<pre>%s</pre></details>\n",
                           safe);
    g_string_append_printf(page->markdown, "\n```\n%s\n```\n", shown);
    g_free(safe);
    g_free(shown);
}

static bool write_preset(struct gb_report *report, struct gb_error *err)
{
    char *text = gb_states_preset(report->set->run[0].directory);
    char *path = g_build_filename(report->folder, "preset.ini", NULL);
    const bool good = text == NULL || gb_file_replace(path, text, strlen(text), err);
    if (good && text != NULL) {
        preset_show(&report->page, text);
    }
    g_free(path);
    g_free(text);
    return good;
}

#if GB_WITH_PICTURES

/* Thickness of the slab of forces, d. */
static const double slab_d = 3.0;

static void set_packing(struct gb_packing_image *packing_image,
                        const struct gb_state *state)
{
    (void)state;
    packing_image->height = 900; /* two panels side by side */
}

static void set_stress(struct gb_packing_image *packing_image,
                       const struct gb_state *state)
{
    packing_image->style.particles = gb_picture_colours_find("pressure");
    packing_image->style.cut_corner = state->dimension == 3;
}

static void set_forces(struct gb_packing_image *packing_image,
                       const struct gb_state *state)
{
    packing_image->style.show = GB_PICTURE_STYLE_FORCES;
    if (state->dimension == 3) {
        packing_image->style.slice_axis = 1;
        packing_image->style.slice_at = 0.5;
        packing_image->style.slice_width = slab_d;
        gb_view_parse("front", &packing_image->viewpoint, NULL);
    }
}

enum contacts { CONTACTS_OPTIONAL, CONTACTS_REQUIRED };

/* Pictures of the last state of the first run of each scene. */
static const struct picture {
    const char *name, *caption;
    enum contacts contacts;
    enum gb_packing_image_panels content; /* with contacts */
    void (*set)(struct gb_packing_image *packing_image, const struct gb_state *state);
} pictures[] = {
    {"packing",
     "particles by coordination number, and the mean normal force by direction",
     CONTACTS_OPTIONAL, GB_PACKING_IMAGE_WITH_ROSE, set_packing},
    {"pressure", "particles by their mean stress", CONTACTS_REQUIRED,
     GB_PACKING_IMAGE_ALONE, set_stress},
    {"forces", "forces between particles, in 3D in a slab 3 diameters thick",
     CONTACTS_REQUIRED, GB_PACKING_IMAGE_ALONE, set_forces},
};

static void show(struct gb_report *report, const struct gb_state *state, const char *file,
                 const char *content)
{
    char *text = g_strdup_printf("%s: %s.", state->preset, content);
    char *caption = figure_caption(report, text);
    gb_page_image(&report->page, file, caption, NULL);
    g_free(caption);
    g_free(text);
}

static bool add_picture(struct gb_report *report, size_t group, struct gb_state *state,
                        const struct picture *picture, const char *preset,
                        struct gb_error *err)
{
    char *file = g_strdup_printf("pictures/%zu-%s.png", group + 1, picture->name);
    char *path = g_build_filename(report->folder, file, NULL);
    struct gb_packing_image packing_image;
    struct gb_error cause = {0};
    gb_packing_image_init(&packing_image);
    packing_image.crop = GB_CAPTION_CROP_BOTH;
    packing_image.preset = preset;
    picture->set(&packing_image, state);
    const bool drawn = gb_packing_image_write_panels(
        &packing_image, state->pair_count > 0 ? picture->content : GB_PACKING_IMAGE_ALONE,
        &state, 1, path, &cause);
    const bool no_data = !drawn && cause.code == GB_ERR_INPUT;
    if (drawn) {
        show(report, state, file, picture->caption);
    } else if (!no_data && err != NULL) {
        *err = cause;
    }
    g_free(path);
    g_free(file);
    return drawn || no_data;
}

static bool add_scene(struct gb_report *report, size_t group, struct gb_error *err)
{
    const char *directory = gb_runset_first(report->set, group)->directory;
    struct gb_state *state = NULL;
    struct gb_error cause = {0};
    bool good = true;
    if (!gb_states_read(&state, directory, NULL, &cause)) {
        return true; /* of a run without a state */
    }
    char *preset = gb_states_preset(directory);
    for (size_t k = 0; k < G_N_ELEMENTS(pictures) && good; k++) {
        if (pictures[k].contacts == CONTACTS_OPTIONAL || state->pair_count > 0) {
            good = add_picture(report, group, state, &pictures[k], preset, err);
        }
    }
    g_free(preset);
    gb_state_destroy(state);
    return good;
}

static bool write_pictures(struct gb_report *report, struct gb_error *err)
{
    const int before = report->figures;
    bool good = true;
    for (size_t g = 0; g < report->set->groups && good; g++) {
        good = add_scene(report, g, err);
    }
    if (report->figures > before) {
        gb_page_paragraph(&report->page,
                          "The last kept state of the first run of each scene. Each file "
                          "contains its preset: greenbody run --from FILE.png repeats "
                          "the run.");
    }
    return good;
}

#else

static bool write_pictures(struct gb_report *report, struct gb_error *err)
{
    (void)report;
    (void)err;
    return true;
}

#endif

/* Formats of every figure: the page shows the SVG and links to the others. */
static const char *const extensions[] = {"svg", "png", "pdf"};

enum { WIDTH = 1600, HEIGHT = 1200 }; /* pixels of the PNG */

static bool write_files(const struct gb_series *series, const struct gb_report *report,
                        const char *name, struct gb_error *err)
{
    const struct gb_plotting_page page = {
        WIDTH, HEIGHT, name, NULL, report->set, GB_PLOTTING_REPLACE, 0};
    bool good = true;
    for (size_t k = 0; k < G_N_ELEMENTS(extensions) && good; k++) {
        char *path =
            g_strdup_printf("%s/figures/%s.%s", report->folder, name, extensions[k]);
        good = gb_plotting_write(series, &page, path, err);
        g_free(path);
    }
    return good;
}

static void show_files(struct gb_report *report, const struct gb_figures_row *row)
{
    char *svg = g_strdup_printf("figures/%s.svg", row->name);
    char *png = g_strdup_printf("figures/%s.png", row->name);
    char *pdf = g_strdup_printf("figures/%s.pdf", row->name);
    char *csv = g_strdup_printf("figures/%s.csv", row->name);
    char *text = gb_figures_describe(row);
    char *sentence = g_strdup_printf("%c%s.", g_ascii_toupper(text[0]), text + 1);
    char *caption = figure_caption(report, sentence);
    gb_report_tables_cite(report, row->source);
    const char *const others[] = {png, pdf, csv, NULL};
    gb_page_image(&report->page, svg, caption, others);
    char *const texts[] = {svg, png, pdf, csv, text, sentence, caption};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_free(texts[k]);
    }
}

/* Computes a figure over the runs in its own groups.  False with cause set: the runs have no
 * data for it, or an error of the machine. */
static bool compute(struct gb_series *series, const struct gb_report *report,
                    const struct gb_figures_row *row, struct gb_error *cause)
{
    struct gb_runset set = *report->set;
    set.run = g_memdup2(set.run, set.count * sizeof *set.run);
    gb_figures_group(row, &set);
    const struct gb_figures_input input = {.set = &set};
    const bool done = gb_figures_run(row, series, &input, cause);
    if (done && report->data != NULL) {
        (void)gb_plotting_data(series, report->data, NULL); /* where it has the columns */
    }
    g_free(set.run);
    return done && gb_series_check_drawable(series, row->name, cause);
}

static bool is_missing_data(const struct gb_error *cause)
{
    return cause->code == GB_ERR_INPUT || cause->code == GB_ERR_NOT_CONVERGED;
}

static bool add_figure(struct gb_report *report, const struct gb_figures_row *row,
                       struct gb_error *err)
{
    struct gb_series series = {0};
    struct gb_error cause = {0};
    bool good = true;
    if (!compute(&series, report, row, &cause)) {
        good = is_missing_data(&cause);
    } else if (series.curves->len > 0 || series.map != NULL) {
        good = write_files(&series, report, row->name, &cause);
        show_files(report, row);
    }
    gb_series_finish(&series);
    if (!good && err != NULL) {
        *err = cause;
    }
    return good;
}

static bool write_figures(struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL && good; k++) {
        if (row->report == GB_FIGURES_IN_REPORT) {
            good = add_figure(report, row, err);
        }
    }
    return good;
}

static const struct gb_report_part parts[] = {
    {"results", "Results", "first page: conditions, key results with errors",
     gb_report_tables_results},
    {"figures", "Figures", "every figure that the runs have data for", write_figures},
    {"tables", "Tables", "densities at round pressures, ends of branches",
     gb_report_tables_densities},
    {"fits", "Equations of compaction", "parameters of all equations with intervals",
     gb_report_tables_fits},
    {"pictures", "Pictures", "last state of each scene: coordination, stress, forces",
     write_pictures},
    {"keys", "Parameters", "keys in use with symbols, units and sources",
     gb_report_tables_keys},
    {"references", "References", "papers whose laws and equations are used",
     gb_report_tables_references},
    {"provenance", "Provenance", "runs with seeds, presets, curves and checksums",
     write_provenance},
    {"preset", "Preset", "preset.ini of the first run", write_preset},
    {0},
};

/* Folders of the files of the parts. */
static const char *const folders[] = {"figures", "pictures", "tables", "runs", "data"};

const struct gb_report_part *gb_report_parts(void)
{
    return parts;
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
    char *subtitle = g_strdup_printf("%zu run%s of %zu scene%s · greenbody %s · %s",
                                     set->count, plural(set->count), set->groups,
                                     plural(set->groups), GB_VERSION, date);
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
    report->conditions = gb_report_tables_conditions(report->set);
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
