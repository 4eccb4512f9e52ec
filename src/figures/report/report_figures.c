#include "figures/figures.h"
#include "figures/plotting.h"
#include "figures/report/report.h"
#include "figures/report/report_references.h"

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
    char *caption = gb_report_figure_caption(report, sentence);
    gb_report_references_cite(report, row->source);
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

bool gb_report_figures(struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    for (const struct gb_figures_row *row = gb_figures_table(); row->name && good;
         row++) {
        if (row->report == GB_FIGURES_IN_REPORT) {
            good = add_figure(report, row, err);
        }
    }
    return good;
}
