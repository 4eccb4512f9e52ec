/* What is exported of a state makes up its stress: the sum of force times branch vector over
 * the rows of contacts, and the mean of the particle stresses, in every format with text,
 * for every kind of periodic cell.  tests/cli/read_vtkhdf.py compares VTKHDF with tables. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "common/scene.h"
#include "io/export.h"
#include "io/state_record.h"
#include "run/checkpoint.h"
#include "run/experiment.h"

enum { COMPONENTS = 6, KEYS = 5 };

static const struct scene {
    const char *name, *more[KEYS]; /* assignments */
    int points;
    bool gaps; /* attraction across them is seen */
} scenes[] = {
    {"single", {"numerics.precision=single"}, 60, true},
    {"double", {"numerics.precision=double"}, 60, true},
    {"unloaded", {"loading.until=20 MPa", "loading.unload_from=20 MPa"}, 400, true},
    {"no bridges", {"contact.bridge_length=1 d"}, 200, true},
    {"sizes",
     {"particles.distribution=lognormal", "particles.sigma=0.1",
      "particles.largest=13 nm"},
     60,
     true},
    {"plane", {"scene.dimension=2"}, 120, true},
    {"tilted", {"loading.path=isotropic to 50 MPa; shear xz to 20 %"}, 80, true},
    {"dynamic",
     {"scene.kind=dynamic", "loading.relax=0.02 ns", "loading.until=density=0.4"},
     6,
     true},
    {"dynamic plane",
     {"scene.kind=dynamic", "loading.relax=0.02 ns", "scene.dimension=2",
      "loading.until=density=0.7"},
     80,
     true},
    {"no attraction", {"contact.normal=hertz"}, 60, false},
};

static void run(const struct scene *scene, struct gb_params *params,
                struct gb_state **shown, struct gb_state **stored)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    struct gb_record record = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    *params = scene_params("numerics.fidelity=fast", "loading.unload_from=", NULL);
    for (int k = 0; k < KEYS && scene->more[k]; k++) {
        if (!gb_params_assign(params, scene->more[k], &err)) {
            g_error("%s", err.text);
        }
    }
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s: %s", scene->name, err.text);
    }
    for (int points = 0; points < scene->points && how != GB_STEP_DONE;) {
        how = gb_experiment_advance(experiment, 100000, &err);
        if (how == GB_STEP_STOPPED) {
            g_error("%s: %s", scene->name, err.text);
        }
        points += how == GB_STEP_POINT;
    }
    if (!gb_experiment_state(experiment, shown, &err) ||
        !gb_checkpoint_take(experiment, &record, &err) ||
        !gb_state_record(stored, &record, params, gb_experiment_model(experiment),
                         &err)) {
        g_error("%s: %s", scene->name, err.text);
    }
    gb_record_finish(&record);
    gb_experiment_destroy(experiment);
}

/* The state as its file has it. */
static struct gb_state *reread(const struct gb_state *state)
{
    struct gb_state *read = NULL;
    struct gb_error err = {0};
    char *folder = g_dir_make_tmp("export-stress-XXXXXX", NULL);
    char *path = g_build_filename(folder, "state.h5", NULL);
    if (!gb_state_write(state, NULL, path, &err) || !gb_state_read(&read, path, &err)) {
        g_error("%s", err.text);
    }
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return read;
}

/* Rows of a table under the line that begins with `head`, split at `between`; calls back
 * with each. */
static void each_row(const char *text, const char *head, const char *between,
                     void (*call)(char **word, void *data), void *data)
{
    char **line = g_strsplit(text, "\n", -1);
    int k = 0;
    while (!g_str_has_prefix(line[k], head)) {
        k++;
        g_assert_nonnull(line[k]);
    }
    for (k++; line[k] && line[k][0]; k++) {
        char **word = g_strsplit(line[k], between, -1);
        call(word, data);
        g_strfreev(word);
    }
    g_strfreev(line);
}

/* Where a format has what is summed. */
struct columns {
    const char *name;
    const char *contact_head, *particle_head, *between, *contact_between;
    int first, stress; /* of forces, branch vectors and overlap; of particle stresses */
    int size, overlap;
};

static const struct columns formats[] = {
    {"csv", "frame,i,j", "id,x_nm", ",", ",", 3, 6, 4, 10},
    {"extxyz", "frame,i,j", "Lattice=", " ", ",", 3, 7, 5, 10},
    {"lammps-dump", "ITEM: ENTRIES", "ITEM: ATOMS", " ", " ", 3, 7, 5, 10},
};

struct sums {
    const struct columns *columns;
    double tensor[3][3], stress[COMPONENTS], weight;
    int dimension, gaps, contacts;
};

static double number(char **word, int k)
{
    return g_ascii_strtod(word[k], NULL);
}

static void add_contact(char **word, void *data)
{
    struct sums *sums = data;
    const int first = sums->columns->first;
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            sums->tensor[a][b] += number(word, first + a) * number(word, first + 4 + b);
        }
    }
    const bool gap = number(word, sums->columns->overlap) < 0.0;
    sums->gaps += gap;
    sums->contacts += !gap;
}

static void add_particle(char **word, void *data)
{
    struct sums *sums = data;
    const double weight = pow(number(word, sums->columns->size), sums->dimension);
    sums->weight += weight;
    for (int c = 0; c < COMPONENTS; c++) {
        sums->stress[c] += weight * number(word, sums->columns->stress + c);
    }
}

static void check_format(const struct scene *scene, const struct gb_state *state,
                         const struct columns *columns)
{
    static const int row[COMPONENTS] = {0, 1, 2, 0, 0, 1};
    static const int column[COMPONENTS] = {0, 1, 2, 1, 2, 2};
    const struct gb_point *point = &state->point;
    const double want[COMPONENTS] = {point->px_pa,       point->py_pa,
                                     point->pz_pa,       point->shear_pa[0],
                                     point->shear_pa[1], point->shear_pa[2]};
    const struct gb_cell cell = gb_state_cell(state);
    const double nm = 1e9 * state->metre_per_length;
    const double volume = gb_cell_volume(&cell) * nm * nm * nm;
    struct sums sums = {.columns = columns, .dimension = state->dimension};
    struct gb_error err = {0};
    GString *particles = g_string_new(NULL), *contacts = g_string_new(NULL);
    g_assert_true(gb_export_add(gb_export_find(columns->name, &err), state, NAN, 0,
                                particles, contacts, &err));
    each_row(contacts->str, columns->contact_head, columns->contact_between, add_contact,
             &sums);
    each_row(particles->str, columns->particle_head, columns->between, add_particle,
             &sums);
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
        largest = fmax(largest, fabs(isfinite(want[c]) ? want[c] : 0.0));
    }
    for (int c = 0; c < COMPONENTS; c++) {
        const double pairs =
            0.5e9 * (sums.tensor[row[c]][column[c]] + sums.tensor[column[c]][row[c]]) /
            volume;
        const double mean = 1e6 * sums.stress[c] / sums.weight;
        g_assert_cmpfloat(fabs(mean - pairs), <=, 1e-9 * largest);
        if (isfinite(want[c]) && !(fabs(pairs - want[c]) <= 1e-6 * largest)) {
            g_error("%s, %s: component %d is %.9g instead of %.9g Pa", scene->name,
                    columns->name, c, pairs, want[c]);
        }
    }
    g_assert_cmpint(sums.contacts, ==, state->pair_count);
    g_assert_true((sums.gaps > 0) == scene->gaps);
    g_string_free(particles, TRUE);
    g_string_free(contacts, TRUE);
}

static void test_scene(gconstpointer data)
{
    const struct scene *scene = data;
    struct gb_params params;
    struct gb_state *states[3];
    run(scene, &params, &states[0], &states[1]);
    states[2] = reread(states[1]);
    g_test_message("p %.4g MPa at density %.4f", 1e-6 * states[0]->point.p_pa,
                   states[0]->point.density);
    for (int s = 0; s < 3; s++) {
        for (size_t k = 0; k < G_N_ELEMENTS(formats); k++) {
            check_format(scene, states[s], &formats[k]);
        }
        gb_state_destroy(states[s]);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(scenes); k++) {
        char *path = g_strdup_printf("/export-stress/%s", scenes[k].name);
        g_test_add_data_func(path, &scenes[k], test_scene);
        g_free(path);
    }
    return g_test_run();
}
