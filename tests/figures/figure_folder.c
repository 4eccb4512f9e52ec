#include "figure_folder.h"
#include "common/tree.h"

#include <glib/gstdio.h>
#include <gsl/gsl_errno.h>
#include <string.h>

#include "io/preset.h"

static char *folder;

char *figure_folder_path(const char *directory, const char *file)
{
    return g_build_filename(folder, directory, file, NULL);
}

void figure_folder_write(const char *directory, const char *file, const char *text)
{
    char *path = figure_folder_path(directory, NULL);
    char *full = figure_folder_path(directory, file);
    g_mkdir_with_parents(path, 0700);
    g_assert_true(g_file_set_contents(full, text, -1, NULL));
    g_free(full);
    g_free(path);
}

bool figure_folder_scene(const struct gb_figures_row *row, struct gb_series *series,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    g_assert_true(gb_preset_load(&preset, row->preset, err));
    const struct gb_figures_input input = {.scene = gb_preset_params(preset)};
    const bool done = gb_figures_run(row, series, &input, err);
    gb_preset_destroy(preset);
    return done;
}

/* Computes a figure from directories of the folder. */
bool figure_folder_run(const struct gb_figures_row *row, const char *const *words,
                       struct gb_series *series, struct gb_error *err)
{
    struct gb_runset set = {0};
    char *paths[6] = {NULL};
    size_t count = 0;
    for (; words[count] != NULL; count++) {
        paths[count] = figure_folder_path(words[count], NULL);
    }
    struct gb_figures_input input = {.words = paths};
    bool done = row->takes == GB_FIGURES_TABLE || gb_runset_read(&set, paths, count, err);
    if (done) {
        input.set = &set;
        input.reference = set.groups > 1 ? 1 : 0;
        gb_figures_group(row, &set);
        done = gb_figures_run(row, series, &input, err);
    }
    gb_runset_finish(&set);
    for (size_t k = 0; k < count; k++) {
        g_free(paths[k]);
    }
    return done;
}

bool figure_folder_named(const char *name, const char *const *words,
                         struct gb_series *series, struct gb_error *err)
{
    return figure_folder_run(gb_figures_find(name), words, series, err);
}

void figure_folder_assert_drawn(const struct gb_figures_row *row,
                                const struct gb_series *series)
{
    struct gb_figure figure;
    struct gb_figure_layout layout;
    struct gb_figure_curve *curves = NULL;
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    g_assert_nonnull(series->x.name);
    g_assert_nonnull(series->x.label);
    g_assert_nonnull(series->y.name);
    g_assert_nonnull(series->y.label);
    g_assert_true(series->curves->len > 0 || series->map != NULL);
    gb_series_figure(series, &figure, &curves);
    g_assert_true(gb_figure_render(&image, &figure, 640, 480, &layout, &err));
    g_assert_cmpstr(err.text, ==, "");
    g_test_message("%s: %u curves", row->name, series->curves->len);
    gb_image_destroy(image);
    g_free(curves);
}

const double *figure_folder_column(const struct gb_series *series, const char *name)
{
    for (guint k = 0; k < series->names->len; k++) {
        if (strcmp(g_ptr_array_index(series->names, k), name) == 0) {
            return g_ptr_array_index(series->columns, k);
        }
    }
    g_error("no column %s", name);
}

void figure_folder_init(void)
{
    gsl_set_error_handler_off(); /* as main does */
    folder = g_dir_make_tmp("figures-XXXXXX", NULL);
}

void figure_folder_finish(void)
{
    remove_tree(folder);
    g_free(folder);
}
