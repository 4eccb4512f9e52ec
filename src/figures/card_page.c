/* The page of `greenbody card`: HTML and Markdown with its figures. */
#include "figures/card_page.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <unistd.h>

#include "base/file.h"
#include "base/number.h"
#include "figures/figures.h"
#include "figures/page.h"
#include "figures/plotting.h"
#include "study/card.h"
#include "study/study_text.h"

enum { WIDTH = 900, HEIGHT = 640 };

bool gb_card_page_check(const char *output, struct gb_error *err)
{
    char *parent = g_path_get_dirname(output);
    bool good = !g_file_test(output, G_FILE_TEST_EXISTS) ||
                gb_error_set(err, GB_ERR_INPUT, "--out %.300s: exists already", output);
    if (good && g_access(parent, W_OK) != 0) {
        good = gb_error_set(err, GB_ERR_INPUT, "--out %.300s: %s", parent,
                            g_strerror(errno));
    }
    g_free(parent);
    return good;
}

/* Writes one file of the folder and frees the text. */
static bool write_text(const char *folder, const char *name, GString *text,
                       struct gb_error *err)
{
    char *path = g_build_filename(folder, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

static bool write_figure(const char *folder, const char *name, const char *file,
                         struct gb_error *err)
{
    const struct gb_figures_row *row = gb_figures_find(name);
    char *words[] = {(char *)(size_t)folder, NULL};
    const struct gb_figures_input input = {.words = words};
    const struct gb_plotting_page page = {
        .width = WIDTH, .height = HEIGHT, .name = name, .existing = GB_PLOTTING_REPLACE};
    struct gb_series series = {.rows = 0};
    char *path = g_build_filename(folder, file, NULL);
    const bool good = gb_figures_run(row, &series, &input, err) &&
                      gb_plotting_write(&series, &page, path, err);
    gb_series_finish(&series);
    g_free(path);
    return good;
}

static char *cell(const struct gb_fit_value *value, double factor)
{
    GString *text = g_string_new(NULL);
    gb_study_text_interval(text, "", "%.4g", value, factor);
    return g_string_free(text, FALSE);
}

static void add_parameters(struct gb_page *page, const struct gb_card_study *study)
{
    const char *heads[GB_CARD_QUANTITIES + 1];
    char *made[GB_CARD_QUANTITIES];
    GPtrArray *cells = g_ptr_array_new_with_free_func(g_free);
    heads[0] = "density";
    for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
        const struct gb_card_quantity_row *row = &gb_card_rows[n];
        heads[n + 1] = made[n] = row->unit[0] != '\0'
                                     ? g_strdup_printf("%s (%s)", row->symbol, row->unit)
                                     : g_strdup(row->symbol);
    }
    for (int k = 0; k < study->levels; k++) {
        g_ptr_array_add(cells, g_strdup_printf("%.4f", study->card.density[k]));
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            g_ptr_array_add(cells, cell(&study->quantity[k][n], gb_card_rows[n].factor));
        }
    }
    const struct gb_page_table_content content = {
        "Parameters against relative density with their 95 % intervals "
        "(jackknife over the cells, Student's t).",
        "card.csv", heads, GB_CARD_QUANTITIES + 1, -1};
    gb_page_table(page, &content, cells);
    g_ptr_array_free(cells, TRUE);
    for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
        g_free(made[n]);
    }
}

/* Where the surface misses its own points, or that it does not. */
static void add_misses(struct gb_page *page, const struct gb_card_study *study)
{
    GString *text = gb_card_files_misses(study);
    char **lines = g_strsplit(g_strchomp(text->str), "\n", 0);
    if (lines[0] == NULL) {
        gb_page_paragraph(page, "The surface meets its points within their 95 % "
                                "intervals at every density.");
    }
    for (int i = 0; lines[i] != NULL; i++) {
        char *line = g_strdup_printf("Poor fit at %s.", lines[i]);
        gb_page_paragraph(page, line);
        g_free(line);
    }
    g_strfreev(lines);
    g_string_free(text, TRUE);
}

/* "p_z 5.0 %, density at the same p_z 0.0044 (largest 0.0081)" */
static void add_misfit(GString *text, const struct gb_card_misfit *misfit,
                       const char *pressure)
{
    char number[3][GB_NUMBER_MAX];
    g_string_append_printf(text, "%s %s %%, density at the same %s %s (largest %s).",
                           pressure,
                           gb_number_shown("%.1f", 100.0 * misfit->pressure, number[0]),
                           pressure, gb_number_shown("%.4f", misfit->density, number[1]),
                           gb_number_shown("%.4f", misfit->density_most, number[2]));
}

static void add_test(struct gb_page *page, const struct gb_card_study *study)
{
    const struct gb_card_misfit *uniaxial = &study->misfit[GB_CARD_UNIAXIAL];
    static const char *const data[] = {"card_uniaxial.csv", "card_isotropic.csv", NULL};
    const bool own = study->options.path == GB_CARD_UNIAXIAL;
    char number[2][GB_NUMBER_MAX];
    GString *text = g_string_new(NULL);
    g_string_append_printf(
        text,
        "The card as a material, strained from the unloaded compact of the lowest density "
        "on, against the simulated pressing of the loose powder. Points of yield come from "
        "%s pressed compacts; p_x/p_z and the %s path are not fitted to. Misfit (rms) "
        "between the densities %.3f and %.3f. Uniaxial: p_x/p_z %s (largest %s), ",
        own ? "uniaxially" : "isotropically", own ? "isotropic" : "uniaxial",
        study->compared_from, study->card.density[study->levels - 1],
        gb_number_shown("%.3f", uniaxial->ratio, number[0]),
        gb_number_shown("%.3f", uniaxial->ratio_most, number[1]));
    add_misfit(text, uniaxial, "p_z");
    g_string_append(text, " Isotropic: ");
    add_misfit(text, &study->misfit[GB_CARD_ISOTROPIC], "p");
    gb_page_heading(page, "Test on uniaxial and isotropic pressing");
    gb_page_paragraph(page, text->str);
    gb_page_image(page, "uniaxial.png",
                  "p_x/p_z of uniaxial pressing, simulated and predicted.", data);
    g_string_free(text, TRUE);
}

static bool write_page(const struct gb_card_study *study, const struct gb_params *preset,
                       const char *command, const char *folder, struct gb_error *err)
{
    static const char *const data[] = {"card_points.csv", NULL};
    struct gb_page page = {NULL, NULL};
    const struct gb_card_options *options = &study->options;
    char *title = g_strdup_printf("Card of %s", preset->title);
    char *how = g_strdup_printf(
        "%d cells of %lld particles, pressed %s to %d densities, unloaded to "
        "%g of the pressure and probed on copies by strain in %d directions of the (p, "
        "q) "
        "plane. A point is where the plastic strain reaches %g %%. Points that lose "
        "volume "
        "as they flow lie on the cap, those that gain it fail in shear; where the volume "
        "grows more than twice the shear it is failure in tension, which the surface "
        "does "
        "not describe. Transition a = %g; R and p_a follow positions and directions of flow "
        "of the points of the cap, with weights 1 and %g.",
        options->replicas, (long long)preset->count,
        options->path == GB_CARD_UNIAXIAL ? "uniaxially" : "isotropically", study->levels,
        options->inside, options->directions, 100.0 * options->offset,
        options->transition, options->flow);
    gb_page_begin(&page, title, command);
    gb_page_paragraph(&page, how);
    gb_page_heading(&page, "Yield surfaces");
    gb_page_image(&page, "surfaces.png", "Drucker-Prager cap fitted to the yield points.",
                  data);
    add_misses(&page, study);
    gb_page_heading(&page, "Parameters");
    add_parameters(&page, study);
    gb_page_paragraph(&page, "The fragment for Abaqus is card.inp.");
    add_test(&page, study);
    gb_page_end(&page);
    /* each frees its text, whatever became of the other */
    const bool html = write_text(folder, "card.html", page.html, err);
    const bool good = write_text(folder, "card.md", page.markdown, err) && html;
    g_free(title);
    g_free(how);
    return good;
}

static bool fill(const struct gb_card_study *study, const struct gb_params *preset,
                 const char *command, const char *folder, struct gb_error *err)
{
    return write_text(folder, "card.csv", gb_card_files_card(study, command), err) &&
           write_text(folder, "card_points.csv", gb_card_files_points(study, command),
                      err) &&
           write_text(folder, "card_uniaxial.csv",
                      gb_card_files_path(study, GB_CARD_UNIAXIAL, command), err) &&
           write_text(folder, "card_isotropic.csv",
                      gb_card_files_path(study, GB_CARD_ISOTROPIC, command), err) &&
           write_text(folder, "card.inp",
                      gb_card_files_abaqus(study, command, preset->density_kg_m3), err) &&
           write_figure(folder, "card", "surfaces.png", err) &&
           write_figure(folder, "card-uniaxial", "uniaxial.png", err) &&
           write_page(study, preset, command, folder, err);
}

/* Removes a folder of files. */
static void discard(const char *folder)
{
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(folder, name, NULL);
        g_unlink(path);
        g_free(path);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_rmdir(folder);
}

bool gb_card_page_write(const struct gb_card_study *study, const struct gb_params *preset,
                        const char *command, const char *output, struct gb_error *err)
{
    char *parent = g_path_get_dirname(output);
    char *folder = g_build_filename(parent, ".card-XXXXXX", NULL);
    bool good =
        g_mkdtemp_full(folder, 0777) != NULL ||
        gb_error_set(err, GB_ERR_MACHINE, "%.300s: %s", parent, g_strerror(errno));
    if (good) {
        good =
            fill(study, preset, command, folder, err) &&
            (g_rename(folder, output) == 0 ||
             gb_error_set(err, GB_ERR_MACHINE, "%.300s: %s", output, g_strerror(errno)));
        if (!good) {
            discard(folder);
        }
    }
    g_free(folder);
    g_free(parent);
    return good;
}
