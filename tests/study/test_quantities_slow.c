/* Every study on small cells with its defaults and with numerics five times tighter: no
 * reported quantity moves by more than half of its 95 % interval. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/tree.h"
#include "io/preset.h"
#include "study/quantity_chart.h"

/* The scene of a study, and cells enough to tell a shift of half an interval from scatter:
 * what was pressed with other numerics is another cell. */
static const struct scene {
    const char *study, *preset;
    int cells;
    const char *keys[5];
} scenes[] = {
    {"moduli", "default", 24, {"particles.count=300", "structure.base=auto"}},
    {"fit",
     "default",
     24,
     {"particles.count=300", "structure.base=auto", "loading.until=300 MPa",
      "loading.unload_from="}},
    {"strength", "p1-yield-set2", 24, {"particles.count=200", "structure.base=auto"}},
    {"yield", "p1-yield-set2", 24, {"particles.count=200", "structure.base=auto"}},
    {"card", "default", 12, {"particles.count=200", "structure.base=auto"}},
    {"die",
     "p3-cycle",
     8,
     {"particles.count=150", "die.diameter=25 um", "die.central=15 um",
      "particles.table=number: 4 um 0.4; 5 um 0.4; 7 um 0.2"}},
};

static char *folder;

static const struct scene *scene_of(const struct gb_quantity_study *study)
{
    for (size_t i = 0; i < G_N_ELEMENTS(scenes); i++) {
        if (strcmp(scenes[i].study, study->name) == 0) {
            return &scenes[i];
        }
    }
    g_error("%s: no scene for its quantities", study->name);
}

static void read_scene(struct gb_params *params, const struct scene *scene)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    if (!gb_preset_load(&preset, scene->preset, &err)) {
        g_error("%s", err.text);
    }
    *params = *gb_preset_params(preset);
    gb_preset_destroy(preset);
    for (size_t k = 0; k < G_N_ELEMENTS(scene->keys) && scene->keys[k] != NULL; k++) {
        if (!gb_params_assign(params, scene->keys[k], &err)) {
            g_error("%s: %s", scene->keys[k], err.text);
        }
    }
}

/* A line of the table; false: it moves too far. */
static bool compare(const struct gb_quantity_chart *chart,
                    const struct gb_quantity *quantity)
{
    struct gb_quantity_table table;
    gb_quantity_chart_table_init(&table, chart, quantity, NAN);
    const struct gb_quantity_result *tight = gb_quantity_chart_table_at(&table, 0);
    const struct gb_quantity_result *own = gb_quantity_chart_table_at(&table, 1);
    const double shift = tight->value - own->value;
    g_test_message("%-20s %-5s %10.4g +- %-9.2g %10.4g +- %-9.2g %6.2f  %5.1f",
                   quantity->name, quantity->unit, own->value, table.half_interval,
                   tight->value, own->error_95, shift / table.half_interval, tight->cost);
    const bool good =
        own->failed == 0 && tight->failed == 0 && fabs(shift) <= table.half_interval;
    gb_quantity_chart_table_finish(&table);
    return good;
}

static void test_study(const void *data)
{
    static const char *const none[] = {NULL};
    const struct gb_quantity_study *study = data;
    const struct scene *scene = scene_of(study);
    struct gb_quantity_chart chart;
    struct gb_params params;
    struct gb_error err = {0};
    char *directory = g_build_filename(folder, study->name, NULL);
    read_scene(&params, scene);
    if (!gb_quantity_chart_init(&chart, study, &params, NULL, none, NULL, scene->cells,
                                directory, &err) ||
        !gb_quantity_chart_work(&chart, 0, NULL, &err)) {
        g_error("%s: %s", study->name, err.text);
    }
    int moved = 0;
    g_test_message("quantity             unit     default    interval     tighter    "
                   "shift     /half  cost");
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         row->name != NULL; row++) {
        moved += row->study == study && !compare(&chart, row);
    }
    if (moved > 0) {
        g_test_message("%d quantities move by more than half of their intervals", moved);
        g_test_fail();
    }
    gb_quantity_chart_finish(&chart);
    g_free(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("gb-tighter-XXXXXX", NULL);
    const struct gb_quantity_study *last = NULL;
    for (const struct gb_quantity *row = gb_quantity_chart_quantities();
         row->name != NULL; row++) {
        if (row->study != last) { /* rows of a study follow each other */
            char *path = g_strconcat("/tighter/", row->study->name, NULL);
            g_test_add_data_func(path, row->study, test_study);
            g_free(path);
        }
        last = row->study;
    }
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
