#include "figures/report/report.h"

#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"
#include "figures/figures.h"
#include "figures/plotting.h"
#include "figures/provenance.h"
#include "figures/report/report_tables.h"
#include "figures/states.h"
#if GB_WITH_PICTURES
#include "draw/image/contact_sheet.h"
#endif

/* Figures that need to be told more than their runs. */
static const char *const not_alone[] = {"difference", "rate", NULL};

static bool is_alone(const struct gb_figures_row *row)
{
    for (int k = 0; not_alone[k] != NULL; k++) {
        if (strcmp(row->name, not_alone[k]) == 0) {
            return false;
        }
    }
    return row->takes == GB_FIGURES_RUNS || row->takes == GB_FIGURES_STATES;
}

static bool write_kinds(const struct gb_series *series, const struct gb_report *report,
                        const struct gb_figures_row *row, struct gb_error *err)
{
    static const char *const endings[] = {"png", "svg", "pdf"};
    const struct gb_plotting_page page = {1600, 1200, row->name, NULL, report->set};
    bool good = true;
    for (size_t k = 0; k < G_N_ELEMENTS(endings) && good; k++) {
        char *path =
            g_strdup_printf("%s/figures/%s.%s", report->folder, row->name, endings[k]);
        good = gb_plotting_write(series, &page, path, err);
        g_free(path);
    }
    return good;
}

static void show_figure(struct gb_report *report, const struct gb_figures_row *row)
{
    char *png = g_strdup_printf("figures/%s.png", row->name);
    char *svg = g_strdup_printf("figures/%s.svg", row->name);
    char *pdf = g_strdup_printf("figures/%s.pdf", row->name);
    char *csv = g_strdup_printf("figures/%s.csv", row->name);
    char *caption = g_strdup_printf("%c%s.", g_ascii_toupper(row->doc[0]), row->doc + 1);
    const char *const others[] = {png, pdf, csv, NULL};
    gb_page_image(&report->page, svg, caption, others);
    g_free(caption);
    g_free(csv);
    g_free(pdf);
    g_free(svg);
    g_free(png);
}

/* One figure; what the runs have no data for is left out, what cannot be written ends the
 * report. */
static bool add_figure(struct gb_report *report, const struct gb_figures_row *row,
                       struct gb_error *err)
{
    struct gb_runset set = *report->set; /* in the groups of this figure */
    set.run = g_memdup2(set.run, set.count * sizeof *set.run);
    gb_runset_merge(&set, gb_figures_ignored(row));
    const struct gb_figures_input input = {.set = &set};
    struct gb_series series = {0};
    struct gb_error why = {0};
    bool good = true;
    bool made = row->compute(&series, &input, &why);
    if (made && report->data != NULL && series.x.label != NULL) {
        (void)gb_plotting_data(&series, report->data, row->name, NULL);
    }
    if (!made) {
        good = why.code == GB_ERR_INPUT || why.code == GB_ERR_NOT_CONVERGED;
        g_string_append_printf(report->left_out, "%s%s (%s)",
                               report->left_out->len > 0 ? "; " : "", row->name,
                               why.text);
    } else if (series.curves->len > 0) {
        good = write_kinds(&series, report, row, &why);
        show_figure(report, row);
    }
    gb_series_finish(&series);
    g_free(set.run);
    if (!good && err != NULL) {
        *err = why;
    }
    return good;
}

static bool add_figures(struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    gb_page_heading(&report->page, "Figures");
    for (const struct gb_figures_row *row = gb_figures_all(); row->name && good; row++) {
        if (is_alone(row)) {
            good = add_figure(report, row, err);
        }
    }
    return good;
}

#if GB_WITH_PICTURES

/* A picture of the last state of a group's first run. */
static bool add_picture(struct gb_report *report, size_t group, struct gb_state *state,
                        const char *name, const char *caption,
                        const struct gb_packing_image *picture, bool rose,
                        struct gb_error *err)
{
    char *file = g_strdup_printf("pictures/%zu-%s.png", group + 1, name);
    char *path = g_build_filename(report->folder, file, NULL);
    char *text = g_strdup_printf("%s: %s", state->preset, caption);
    struct gb_error why = {0};
    const bool drawn = gb_contact_sheet_write(picture, rose, &state, 1, path, &why);
    if (drawn) {
        gb_page_image(&report->page, file, text, NULL);
    } else if (why.code == GB_ERR_INPUT) {
        g_string_append_printf(report->left_out, "%s%s (%s)",
                               report->left_out->len > 0 ? "; " : "", file, why.text);
    }
    g_free(text);
    g_free(path);
    g_free(file);
    if (!drawn && why.code != GB_ERR_INPUT && err != NULL) {
        *err = why;
    }
    return drawn || why.code == GB_ERR_INPUT;
}

static bool group_pictures(struct gb_report *report, size_t group, struct gb_error *err)
{
    const char *directory = gb_runset_first(report->set, group)->directory;
    struct gb_state *state = NULL;
    struct gb_packing_image picture;
    struct gb_error why = {0};
    if (!gb_states_read(&state, directory, NULL, &why)) {
        g_string_append_printf(report->left_out, "%spictures (%s)",
                               report->left_out->len > 0 ? "; " : "", why.text);
        return true;
    }
    char *preset = gb_provenance_preset(directory);
    gb_packing_image_init(&picture);
    picture.preset = preset;
    picture.height = 900; /* two panels side by side */
    bool good = add_picture(report, group, state, "packing",
                            "particles by coordination number, and the mean normal force "
                            "over all directions",
                            &picture, state->pair_count > 0, err);
    picture.height = 1200;
    picture.dress.colour = GB_PICTURE_STYLE_PRESSURE;
    picture.dress.cut_corner = state->dimension == 3;
    good = good && (state->pair_count == 0 ||
                    add_picture(report, group, state, "pressure",
                                "particles by the pressure of their contacts", &picture,
                                false, err));
    gb_picture_style_init(&picture.dress);
    picture.dress.show = GB_PICTURE_STYLE_FORCES;
    if (state->dimension == 3) {
        picture.dress.slice_axis = 1;
        picture.dress.slice_at = 0.5;
        picture.dress.slice_width = 3.0;
        gb_view_parse("front", &picture.look, NULL);
    }
    good = good && (state->pair_count == 0 ||
                    add_picture(report, group, state, "forces",
                                "forces between particles, in 3D of a slab 3 diameters "
                                "thick",
                                &picture, false, err));
    g_free(preset);
    gb_state_destroy(state);
    return good;
}

static bool add_pictures(struct gb_report *report, struct gb_error *err)
{
    bool good = true;
    gb_page_heading(&report->page, "Pictures");
    gb_page_paragraph(&report->page,
                      "The last kept state of the first run of each "
                      "experiment. Each file carries its preset: greenbody "
                      "run --from FILE.png makes the run again.");
    for (size_t g = 0; g < report->set->groups && good; g++) {
        good = group_pictures(report, g, err);
    }
    return good;
}

#else

static bool add_pictures(struct gb_report *report, struct gb_error *err)
{
    (void)err;
    g_string_append_printf(report->left_out, "%spictures (this build has none)",
                           report->left_out->len > 0 ? "; " : "");
    return true;
}

#endif

static void begin_page(struct gb_report *report)
{
    const struct gb_runset *set = report->set;
    GDateTime *now = g_date_time_new_now_utc();
    char *day = g_date_time_format(now, "%Y-%m-%d %H:%M UTC");
    char *below = g_strdup_printf("%zu run%s of %zu experiment%s \xc2\xb7 greenbody %s "
                                  "\xc2\xb7 %s",
                                  set->count, set->count == 1 ? "" : "s", set->groups,
                                  set->groups == 1 ? "" : "s", GB_VERSION, day);
    gb_page_begin(&report->page, set->run[0].params.title, below);
    g_free(below);
    g_free(day);
    g_date_time_unref(now);
}

static bool add_preset(struct gb_report *report, struct gb_error *err)
{
    char *text = gb_provenance_preset(report->set->run[0].directory);
    char *path = g_build_filename(report->folder, "preset.ini", NULL);
    const bool good = text == NULL || gb_file_replace(path, text, strlen(text), err);
    if (good && text != NULL) {
        char *safe = g_markup_escape_text(text, -1);
        gb_page_heading(&report->page, "Preset");
        g_string_append_printf(report->page.html,
                               "<details><summary>preset.ini of the first run</summary>"
                               "<pre>%s</pre></details>\n",
                               safe);
        g_string_append_printf(report->page.markdown, "\n```\n%s\n```\n", text);
        g_free(safe);
    }
    g_free(path);
    g_free(text);
    return good;
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
    static const char *const names[] = {"figures", "pictures", "tables", "runs"};
    bool good = true;
    for (size_t k = 0; k < G_N_ELEMENTS(names) && good; k++) {
        char *path = g_build_filename(report->folder, names[k], NULL);
        good = g_mkdir(path, 0777) == 0 ||
               gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made", path);
        g_free(path);
    }
    return good;
}

bool gb_report_write(struct gb_report *report, struct gb_error *err)
{
    report->left_out = g_string_new(NULL);
    begin_page(report);
    bool good = make_folders(report, err) && add_figures(report, err);
    if (good) {
        gb_page_heading(&report->page, "Tables");
    }
    good = good && gb_report_tables(report, err) && add_pictures(report, err);
    if (good) {
        gb_page_heading(&report->page, "Where it comes from");
    }
    good = good && gb_report_tables_runs(report, err) && add_preset(report, err) &&
           write_page(report, err);
    gb_page_finish(&report->page);
    g_string_free(report->left_out, TRUE);
    return good;
}
