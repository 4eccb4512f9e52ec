/* The public library, driven by a small program: one call a line, its first letter the call,
 * the rest its argument.  No program may crash or hang, and a call that fails has one line.
 *
 *   =KEY=VALUE  set a parameter         ?KEY     print a parameter
 *   &PRESET     read a preset           *        create a simulation
 *   +           advance by a point      #NAME    read an array of the simulation
 *   !           save, load and forget   %        record the run, read it back
 *   @LAW        compute a contact law   ~        copy the state, read its arrays */
#include "fuzz/target.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "../common/tree.h"
#include "greenbody/greenbody.h"

static struct {
    struct gb_parameters *parameters;
    struct gb_simulation *simulation;
    char folder[TARGET_PATH];
    int budget; /* points that may still be computed */
} all;

/* A file in the folder of this input, which is made when first needed; g_free. */
static char *in_folder(const char *name)
{
    if (all.folder[0] == '\0') {
        snprintf(all.folder, sizeof all.folder, "%s/greenbody-library-XXXXXX",
                 access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
        if (mkdtemp(all.folder) == NULL) {
            abort();
        }
    }
    return g_build_filename(all.folder, name, NULL);
}

static void refused(const struct gb_error *err)
{
    if (err->text[0] == '\0' || strchr(err->text, '\n') != NULL) {
        fprintf(stderr, "refused with: \"%s\"\n", err->text);
        abort();
    }
}

/* A scene that takes long is cancelled; the next advance continues it. */
static void progress(void *data, struct gb_simulation *simulation, double share)
{
    (void)data;
    (void)share;
    gb_simulation_cancel(simulation, NULL);
}

static void touch(const struct gb_array *array)
{
    volatile uint8_t sink = 0;
    static const size_t width[] = {sizeof(double), sizeof(int32_t), sizeof(uint8_t)};
    for (int64_t i = 0; i < array->shape[0]; i++) {
        for (int64_t k = 0; k < array->shape[1]; k++) {
            const uint8_t *item = (const uint8_t *)array->data + i * array->stride[0] +
                                  k * array->stride[1];
            sink = (uint8_t)(sink ^ item[0] ^ item[width[array->type] - 1]);
        }
    }
    (void)sink;
}

static void forget(void)
{
    gb_simulation_destroy(all.simulation);
    all.simulation = NULL;
}

static void create(void)
{
    struct gb_error err = {0};
    forget();
    if (!gb_parameters_set(all.parameters, "numerics.threads=1", &err)) {
        abort();
    }
    /* as small as the scene allows: the calls are tested, not the physics */
    if (!gb_parameters_set(all.parameters, "particles.count=40", &err)) {
        refused(&err);
    }
    if (!gb_parameters_check(all.parameters, &err) ||
        !gb_simulation_create(&all.simulation, all.parameters, &err)) {
        refused(&err);
        return;
    }
    gb_simulation_on_progress(all.simulation, progress, NULL, 0.2);
}

static void read_state(void)
{
    struct gb_saved_state *saved = NULL;
    struct gb_error err = {0};
    if (!gb_simulation_state(all.simulation, &saved, &err)) {
        refused(&err);
        return;
    }
    for (size_t i = 0; gb_array_name(i) != NULL; i++) {
        struct gb_array array = {.size = sizeof array};
        if (gb_saved_state_array(saved, gb_array_name(i), &array, &err)) {
            touch(&array);
        } else {
            refused(&err);
        }
    }
    (void)gb_saved_state_point(saved);
    gb_saved_state_destroy(saved);
}

static void save_and_load(void)
{
    struct gb_error err = {0};
    struct gb_simulation *loaded = NULL;
    char *path = in_folder("state.h5");
    if (!gb_simulation_save(all.simulation, path, &err)) {
        refused(&err);
    } else if (!gb_simulation_load(&loaded, all.parameters, path, &err)) {
        refused(&err);
    } else {
        forget();
        all.simulation = loaded;
        gb_simulation_on_progress(all.simulation, progress, NULL, 0.2);
    }
    g_free(path);
}

static void record_and_read(void)
{
    struct gb_error err = {0};
    struct gb_recorded_run *run = NULL;
    char *path = in_folder("run");
    if (!gb_simulation_record(all.simulation, path, true, &err)) {
        refused(&err);
    } else {
        (void)gb_simulation_advance(all.simulation, 1, &err);
        forget();
        if (gb_recorded_run_open(&run, path, &err)) {
            for (size_t i = 0; i <= gb_recorded_run_points(run); i++) {
                (void)gb_recorded_run_point(run, i);
            }
            (void)gb_recorded_run_state(run);
        } else {
            refused(&err);
        }
        gb_recorded_run_destroy(run);
    }
    g_free(path);
}

static void law(const char *name)
{
    static const double x[] = {-0.1, 0.0, 1e-9, 0.03, 0.4, 0.9, 1e300, -1e300};
    static double out[4096];
    struct gb_error err = {0};
    struct gb_contact_law_request request = {.size = sizeof request,
                                             .law = name,
                                             .lattice = "fcc",
                                             .x = x,
                                             .count = G_N_ELEMENTS(x),
                                             .h_min = (double)NAN};
    for (request.history = 0; request.history < 2; request.history++) {
        if (!gb_contact_law_compute(&request, all.parameters, out, G_N_ELEMENTS(out),
                                    &err)) {
            refused(&err);
        }
    }
}

static void preset(const char *name)
{
    struct gb_parameters *read = NULL;
    struct gb_error err = {0};
    if (gb_parameters_create(&read, name, &err)) {
        gb_parameters_destroy(all.parameters);
        all.parameters = read;
    } else {
        refused(&err);
    }
}

static void print(const char *key)
{
    char text[GB_PARAMETERS_VALUE];
    struct gb_error err = {0};
    if (!gb_parameters_get(all.parameters, key, text, sizeof text, &err) ||
        !gb_parameters_label(all.parameters, key, text, sizeof text, &err)) {
        refused(&err);
    }
}

static void call(const char *line)
{
    const char *argument = line + 1;
    struct gb_error err = {0};
    struct gb_array array = {.size = sizeof array};
    switch (line[0]) {
    case '=':
        if (!gb_parameters_set(all.parameters, argument, &err)) {
            refused(&err);
        }
        return;
    case '?':
        print(argument);
        return;
    case '&':
        preset(argument);
        return;
    case '@':
        law(argument);
        return;
    case '*':
        create();
        return;
    default:
        break;
    }
    if (all.simulation == NULL) {
        return;
    }
    switch (line[0]) {
    case '+':
        if (all.budget-- > 0) {
            (void)gb_simulation_advance(all.simulation, 1, &err);
        }
        return;
    case '#':
        if (gb_simulation_array(all.simulation, argument, &array, &err)) {
            touch(&array);
        } else {
            refused(&err);
        }
        return;
    case '!':
        save_and_load();
        return;
    case '%':
        if (all.budget-- > 0) {
            record_and_read();
        }
        return;
    case '~':
        read_state();
        return;
    default:
        return;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct gb_error err = {0};
    if (size > 4096) {
        return 0;
    }
    if (!gb_parameters_create(&all.parameters, NULL, &err)) {
        abort();
    }
    all.folder[0] = '\0';
    all.budget = 4;
    char *text = g_strndup((const char *)data, size);
    char **line = g_strsplit(text, "\n", 64);
    for (char **next = line; *next != NULL; next++) {
        if ((*next)[0] != '\0') {
            call(*next);
        }
    }
    g_strfreev(line);
    g_free(text);
    forget();
    gb_parameters_destroy(all.parameters);
    all.parameters = NULL;
    if (all.folder[0] != '\0') {
        remove_tree(all.folder);
    }
    return 0;
}
