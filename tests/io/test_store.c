#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <json-glib/json-glib.h>

#include "io/curve_csv.h"
#include "io/follow.h"
#include "io/point_columns.h"
#include "io/preset.h"
#include "io/rundir.h"
#include "io/status_json.h"
#include "io/store.h"

static char *base; /* a folder of its own for each test */

static char *in_base(const char *name)
{
    return g_build_filename(base, name, NULL);
}

static bool exists(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static char *content(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_free(path);
    return text;
}

static void put(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    g_assert_true(g_file_set_contents(path, "x", 1, NULL));
    g_free(path);
}

static struct gb_params some_params(void)
{
    struct gb_params params;
    gb_params_init(&params);
    g_strlcpy(params.title, "a title", sizeof params.title);
    params.seed = 77;
    return params;
}

static struct gb_point some_point(void)
{
    return (struct gb_point){.step = 3,
                             .density = 0.1 + 0.2,
                             .px_pa = 1e6 / 3.0,
                             .py_pa = (double)NAN,
                             .pz_pa = 2.5e6,
                             .p_pa = 2.5e6,
                             .coordination = 4.0,
                             .bridged = 0.25,
                             .rattlers = 0.0,
                             .residual = 1e-3,
                             .iterations = 40,
                             .evaluations = 45,
                             .seconds = 1.25,
                             .shear_pa = {0.0, -4e6, 0.0},
                             .strain = {[4] = 0.25},
                             .leg = 2.0};
}

static struct gb_store *new_store(const char *directory)
{
    const struct gb_params params = some_params();
    struct gb_error err = {0};
    struct gb_store *store = NULL;
    g_assert_true(gb_store_create(&store, directory, &params, GB_RUNDIR_KEEP, &err));
    return store;
}

static void refused(const char *directory, enum gb_rundir_mode mode, enum gb_status code,
                    const char *word)
{
    const struct gb_params params = some_params();
    struct gb_error err = {0};
    struct gb_store *store = NULL;
    g_assert_false(gb_store_create(&store, directory, &params, mode, &err));
    g_assert_null(store);
    g_assert_cmpint(err.code, ==, code);
    g_assert_nonnull(strstr(err.text, word));
    g_assert_null(strchr(err.text, '\n'));
}

#define TENSORS                                                                          \
    "pxy_MPa,pxz_MPa,pyz_MPa,q_MPa,asymmetry,exx,eyy,ezz,gxy,gxz,gyz,fxx,fyy,fzz,fxy,"   \
    "fxz,fyz,anisotropy,anisotropy_bridged,anisotropy_tension,anisotropy_force,leg"

static void test_rows(void)
{
    char *directory = in_base("deep/er/run");
    struct gb_store *store = new_store(directory);
    struct gb_error err = {0};
    struct gb_point point = some_point();
    g_assert_true(gb_store_point(store, &point, &err));
    point.branch = 1;
    point.branch_from_pa = 1e8;
    g_assert_true(gb_store_point(store, &point, &err));
    g_assert_true(gb_store_event(store, 3, "two\nlines", &err));
    g_assert_true(gb_store_sync(store, &err));
    gb_store_destroy(store);

    char *curve = content(directory, "curve.csv");
    char **lines = g_strsplit(curve, "\n", -1);
    int at = 0;
    while (lines[at][0] == '#') {
        at++;
    }
    g_assert_nonnull(strstr(curve, "# seed: 77\n"));
    g_assert_nonnull(strstr(curve, "# preset: a title\n"));
    g_assert_cmpstr(lines[at], ==,
                    "branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,coordination,bridged,"
                    "rattlers,residual,iterations,evaluations,seconds," TENSORS
                    ",unrelaxed");
    g_assert_cmpstr(
        lines[at + 1], ==,
        "load,3,0.30000000000000004,0.3333333333333333,,2.5,2.5,4,0.25,0,"
        "0.001,40,45,1.250,0,-4,0,0,0,0,0,0,0,0.25,0,0,0,0,0,0,0,0,0,0,0,2,0");
    g_assert_true(g_str_has_prefix(lines[at + 2], "unload:100MPa,3,"));
    g_assert_cmpstr(lines[at + 3], ==, "");
    char *events = content(directory, "events.log");
    g_assert_cmpstr(events, ==, "step 3: two?lines\n");
    g_free(events);
    g_strfreev(lines);
    g_free(curve);
    g_free(directory);
}

/* The contract columns first and unchanged, then those of dynamic runs. */
static void test_dynamic_rows(void)
{
    char *directory = in_base("run");
    struct gb_params params = some_params();
    struct gb_error err = {0};
    struct gb_store *store = NULL;
    params.kind = GB_KIND_DYNAMIC;
    g_assert_true(gb_store_create(&store, directory, &params, GB_RUNDIR_KEEP, &err));
    struct gb_point point = some_point();
    point.branch = GB_BRANCH_HOLD;
    point.time_s = 1.5e-9;
    point.kinetic = 1e-18;
    point.work = 4e-17;
    point.elastic = 3e-17;
    point.dissipated = (double)NAN;
    point.energy_residual = -2e-4;
    g_assert_true(gb_store_point(store, &point, &err));
    gb_store_destroy(store);

    char *curve = content(directory, "curve.csv");
    g_assert_nonnull(
        strstr(curve, "rattlers,residual,iterations,evaluations,seconds,time_ns,"
                      "kinetic,work,elastic,dissipated,energy_residual," TENSORS "\n"));
    g_assert_nonnull(strstr(curve,
                            "\nhold,3,0.30000000000000004,0.3333333333333333,,2.5,2.5,"
                            "4,0.25,0,0.001,40,45,1.250,1.5,1e-18,4e-17,3e-17,,"
                            "-0.0002,0,-4,0,0,0,0,0,0,0,0.25,0,"));
    g_free(curve);
    g_free(directory);
}

/* A row of each kind of scene, read back: every member that it measures has its value, the
 * others are NaN. */
static void test_read_back(void)
{
    for (int kind = GB_KIND_QUASISTATIC; kind <= GB_KIND_DIE; kind++) {
        char *name = g_strdup_printf("run%d", kind), *directory = in_base(name);
        struct gb_params params = some_params();
        struct gb_error err = {0};
        struct gb_store *store = NULL;
        struct gb_curve *curve = NULL;
        struct gb_point point = {0};
        const struct gb_point_column *row;
        params.kind = kind;
        for (size_t r = 1; (row = gb_point_columns_at(r)) != NULL; r++) {
            for (size_t k = 0; row->columns != NULL && k < row->count; k++) {
                gb_point_columns_set(row, &point, k, (double)(1 + 10 * r + k));
            }
        }
        g_assert_true(gb_store_create(&store, directory, &params, GB_RUNDIR_KEEP, &err));
        g_assert_true(gb_store_point(store, &point, &err));
        gb_store_destroy(store);
        g_assert_true(gb_curve_create(&curve, &err));
        g_assert_true(gb_curve_csv_read(directory, &params, curve, &err));
        g_assert_cmpuint(gb_curve_count(curve), ==, 1);
        for (size_t r = 1; (row = gb_point_columns_at(r)) != NULL; r++) {
            const bool has = row->scenes >> gb_loading_kind_of(&params)->columns & 1U;
            for (size_t k = 0; row->columns != NULL && k < row->count; k++) {
                const double value =
                    gb_point_columns_value(row, gb_curve_at(curve, 0), k);
                if (has) {
                    g_assert_cmpfloat_with_epsilon(value, (double)(1 + 10 * r + k), 1e-9);
                } else {
                    g_assert_true(isnan(value));
                }
            }
        }
        gb_curve_destroy(curve);
        g_free(directory);
        g_free(name);
    }
}

static void test_preset(void)
{
    char *directory = in_base("run");
    gb_store_destroy(new_store(directory));
    char *text = content(directory, "preset.ini");
    g_assert_nonnull(strstr(text, "greenbody " GB_VERSION));
    g_free(text);
    char *path = g_build_filename(directory, "preset.ini", NULL);
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_preset_load(&preset, path, &err));
    g_assert_cmpstr(gb_preset_params(preset)->title, ==, "a title");
    g_assert_cmpuint(gb_preset_params(preset)->seed, ==, 77);
    gb_preset_destroy(preset);
    g_free(path);
    g_free(directory);
}

static void test_status(void)
{
    char *directory = in_base("run");
    struct gb_store *store = new_store(directory);
    struct gb_error err = {0};
    struct gb_snapshot shot = {.state = GB_RUN_STOPPED, .seconds_left = -1.0};
    gb_error_set(&shot.error, GB_ERR_GUARD, "a \"quoted\" reason \xff");
    g_assert_true(gb_store_status(store, &shot, &err));
    shot.now = some_point();
    shot.now_valid = true;
    shot.progress = 1e-8;
    g_assert_true(gb_store_status(store, &shot, &err));
    gb_store_destroy(store);

    char *text = content(directory, "status.json");
    g_assert_null(strstr(text, "e-08.0")); /* no JSON */
    JsonNode *root = json_from_string(text, NULL);
    g_assert_nonnull(root);
    JsonObject *object = json_node_get_object(root);
    g_assert_cmpstr(json_object_get_string_member(object, "state"), ==, "stopped");
    g_assert_cmpfloat(json_object_get_double_member(object, "pressure_MPa"), ==, 2.5);
    g_assert_true(json_object_get_null_member(object, "seconds_left"));
    g_assert_true(g_str_has_prefix(json_object_get_string_member(object, "error"),
                                   "a \"quoted\" reason"));
    json_node_unref(root);
    g_free(text);
    g_free(directory);
}

static void test_existing(void)
{
    char *directory = in_base("run");
    struct gb_store *store = new_store(directory);
    refused(directory, GB_RUNDIR_REPLACE, GB_ERR_INPUT, "under way");
    gb_store_destroy(store);
    refused(directory, GB_RUNDIR_KEEP, GB_ERR_INPUT, "--force");
    put(directory, "status.json.AB12CD");
    put(directory, "state.h5");

    char *snapshots = g_build_filename(directory, "snapshots", NULL);
    g_assert_cmpint(g_mkdir(snapshots, 0777), ==, 0);
    put(snapshots, "a.h5");
    put(snapshots, "point-000051.h5.P0O6Y3"); /* a killed writer's */
    put(snapshots, "b.png.P0O6Y3");
    gb_rundir_files_tidy(directory);
    g_assert_false(exists(snapshots, "point-000051.h5.P0O6Y3"));
    g_assert_true(exists(snapshots, "a.h5"));
    g_assert_true(exists(snapshots, "b.png.P0O6Y3")); /* maybe another command's */
    g_assert_false(exists(directory, "status.json.AB12CD"));
    put(directory, "status.json.AB12CD");
    put(snapshots, "point-000051.h5.P0O6Y3");
    put(snapshots, "mine.txt");
    refused(directory, GB_RUNDIR_REPLACE, GB_ERR_INPUT, "mine.txt");
    g_assert_true(exists(directory, "curve.csv"));
    char *mine = g_build_filename(snapshots, "mine.txt", NULL);
    g_unlink(mine);
    g_free(mine);

    const struct gb_params params = some_params();
    struct gb_error err = {0};
    g_assert_true(gb_store_create(&store, directory, &params, GB_RUNDIR_REPLACE, &err));
    gb_store_destroy(store);
    g_assert_false(exists(directory, "state.h5"));
    g_assert_false(exists(directory, "snapshots"));
    g_assert_false(exists(directory, "status.json.AB12CD"));
    g_free(snapshots);
    g_free(directory);
}

static void test_foreign(void)
{
    char *directory = in_base("notes");
    g_assert_cmpint(g_mkdir(directory, 0777), ==, 0);
    put(directory, "thesis.tex");
    refused(directory, GB_RUNDIR_REPLACE, GB_ERR_INPUT, "thesis.tex");
    refused(directory, GB_RUNDIR_KEEP, GB_ERR_INPUT, "thesis.tex");
    g_assert_true(exists(directory, "thesis.tex"));
    g_assert_false(exists(directory, "curve.csv"));

    char *file = g_build_filename(directory, "thesis.tex", NULL);
    char *below = g_build_filename(file, "run", NULL);
    refused(file, GB_RUNDIR_REPLACE, GB_ERR_INPUT, "is a file");
    refused(below, GB_RUNDIR_REPLACE, GB_ERR_INPUT, "is a file");
    refused("", GB_RUNDIR_REPLACE, GB_ERR_INPUT, "empty");
    refused("/proc/greenbody/run", GB_RUNDIR_KEEP, GB_ERR_MACHINE, "cannot be made");
    g_free(below);
    g_free(file);
    g_free(directory);
}

static void test_discard(void)
{
    char *directory = in_base("one/two/three");
    gb_store_discard(new_store(directory));
    g_assert_false(exists(base, "one"));
    g_free(directory);

    directory = in_base("there");
    g_assert_cmpint(g_mkdir(directory, 0777), ==, 0);
    gb_store_discard(new_store(directory));
    g_assert_true(exists(base, "there"));
    g_assert_false(exists(directory, "curve.csv"));
    g_free(directory);
}

static void limit_files(rlim_t bytes)
{
    struct rlimit limit;
    g_assert_cmpint(getrlimit(RLIMIT_FSIZE, &limit), ==, 0);
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    g_assert_cmpint(setrlimit(RLIMIT_FSIZE, &limit), ==, 0);
}

/* A size limit fails in write like a full disk does, after a part of the row is out. */
static void test_full(void)
{
    char *directory = in_base("run");
    signal(SIGXFSZ, SIG_IGN);
    for (rlim_t bytes = 0; bytes < 600; bytes += 7) {
        const struct gb_params params = some_params();
        struct gb_error err = {0};
        struct gb_store *store = NULL;
        limit_files(bytes);
        const bool made =
            gb_store_create(&store, directory, &params, GB_RUNDIR_KEEP, &err);
        limit_files(RLIM_INFINITY);
        g_assert_false(made);
        g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
        g_assert_nonnull(strstr(err.text, directory));
        g_assert_false(g_file_test(directory, G_FILE_TEST_EXISTS));
    }
    struct gb_store *store = new_store(directory);
    char *before = content(directory, "curve.csv");
    const struct gb_point point = some_point();
    struct gb_error err = {0};
    limit_files(strlen(before) + 10);
    const bool written = gb_store_point(store, &point, &err);
    limit_files(RLIM_INFINITY);
    g_assert_false(written);
    g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
    g_assert_nonnull(strstr(err.text, "curve.csv"));
    char *after = content(directory, "curve.csv");
    g_assert_cmpstr(before, ==, after);
    g_free(after);
    g_free(before);
    gb_store_destroy(store);
    g_free(directory);
}

static void test_default_directory(void)
{
    char *before = g_get_current_dir();
    g_assert_cmpint(g_chdir(base), ==, 0);
    char *first = gb_store_default_directory("/some/where/p1.ini");
    g_assert_cmpstr(first, ==, "runs/p1-1");
    gb_store_destroy(new_store(first));
    char *second = gb_store_default_directory("/some/where/p1.ini");
    g_assert_cmpstr(second, ==, "runs/p1-2");
    char *unnamed = gb_store_default_directory("");
    g_assert_cmpstr(unnamed, ==, "runs/default-1");
    g_free(unnamed);
    g_free(second);
    g_free(first);
    g_assert_cmpint(g_chdir(before), ==, 0);
    g_free(before);
}

static void remove_tree(const char *path)
{
    if (g_file_test(path, G_FILE_TEST_IS_DIR)) {
        GDir *dir = g_dir_open(path, 0, NULL);
        const char *name;
        while ((name = g_dir_read_name(dir)) != NULL) {
            char *below = g_build_filename(path, name, NULL);
            remove_tree(below);
            g_free(below);
        }
        g_dir_close(dir);
    }
    g_remove(path);
}

/* Files in place of status.json: brackets without end, which json-glib would follow into a
 * stack overflow, too long, no object; and one with brackets in a text. */
static void test_foreign_status(void)
{
    struct gb_error err = {0};
    char *path = g_build_filename(base, "status.json", NULL);
    char *nested = g_strnfill(100000, '[');
    char *wide = g_strnfill(2 << 20, ' ');
    const char *const bad[] = {nested, wide, "[]", "{\"state\" : ", ""};
    g_assert_null(gb_status_json_open(path, &err)); /* absent */
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        g_assert_true(g_file_set_contents(path, bad[i], -1, NULL));
        g_assert_null(gb_status_json_open(path, &err));
        g_test_message("%s", err.text);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_true(g_str_has_prefix(err.text, path));
    }
    static const char text[] =
        "{\"event\" : \"[[[[[[[[[[\\\"[[[[\", \"state\" : \"done\"}";
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    JsonParser *parser = gb_status_json_open(path, &err);
    g_assert_nonnull(parser);
    g_object_unref(parser);
    g_free(nested);
    g_free(wide);
    g_free(path);
}

/* Numbers of any size are valid JSON and keep their bits; strings keep their characters. */
static void test_json_numbers(void)
{
    static const double value[] = {1e-8, -2e-7, 1e22, 5e-324, 1.5e-9, 0.25, 3.0, 1e15};
    static const char word[] = "1e-08.0 \"2e-07.0\" \\";
    JsonBuilder *json = json_builder_new();
    json_builder_begin_array(json);
    json_builder_add_string_value(json, word);
    for (size_t i = 0; i < G_N_ELEMENTS(value); i++) {
        json_builder_add_double_value(json, value[i]);
    }
    json_builder_add_boolean_value(json, true);
    json_builder_end_array(json);
    JsonNode *root = json_builder_get_root(json);
    char *text = gb_status_json_print(root);
    json_node_unref(root);
    g_object_unref(json);
    char **part = g_strsplit(strrchr(text, '"') + 1, ",", -1);
    g_assert_cmpuint(g_strv_length(part), ==, G_N_ELEMENTS(value) + 2);
    for (size_t i = 0; i < G_N_ELEMENTS(value); i++) {
        const char *number = g_strstrip(part[i + 1]);
        g_assert_true(g_regex_match_simple(
            "^-?(0|[1-9][0-9]*)(\\.[0-9]+)?(e[+-]?[0-9]+)?$", number, 0, 0));
        g_assert_cmpfloat(g_ascii_strtod(number, NULL), ==, value[i]);
    }
    root = json_from_string(text, NULL);
    g_assert_nonnull(root);
    g_assert_cmpstr(json_array_get_string_element(json_node_get_array(root), 0), ==,
                    word);
    json_node_unref(root);
    g_strfreev(part);
    g_free(text);
}

/* A process named by a forged or old status.json is not asked to stop, unless it has the
 * directory open; one that has is. */
static void test_named_process(void)
{
    for (int works = 0; works < 2; works++) {
        struct gb_error err = {0};
        int status = 0;
        int ready[2];
        g_assert_cmpint(pipe(ready), ==, 0);
        const pid_t named = fork();
        if (named == 0) {
            const int there = works ? open(base, O_RDONLY | O_DIRECTORY) : -1;
            g_assert_cmpint(write(ready[1], "r", 1), ==, 1);
            while (there >= -1) {
                pause();
            }
        }
        char sign = '\0';
        g_assert_cmpint(read(ready[0], &sign, 1), ==, 1);
        char *path = in_base("status.json");
        char *text = g_strdup_printf("{\"pid\" : %d, \"host\" : \"%s\"}", (int)named,
                                     g_get_host_name());
        g_assert_true(g_file_set_contents(path, text, -1, NULL));
        g_assert_true(gb_follow_request_stop(base, &err) == (works == 1));
        if (works == 0) {
            g_assert_nonnull(strstr(err.text, "does not work in this directory"));
            g_assert_cmpint(waitpid(named, &status, WNOHANG), ==, 0);
            kill(named, SIGKILL);
        }
        g_assert_cmpint(waitpid(named, &status, 0), ==, named);
        g_assert_cmpint(WTERMSIG(status), ==, works ? SIGTERM : SIGKILL);
        close(ready[0]);
        close(ready[1]);
        g_free(text);
        g_free(path);
    }
}

/* The process that asks all the time whether a run is under way. */
static pid_t ask_for_ever(void)
{
    const pid_t asks = fork();
    while (asks == 0) {
        (void)gb_rundir_busy(base);
    }
    g_assert_cmpint(asks, >, 0);
    return asks;
}

/* To ask is no writing: none that takes the lock meanwhile is refused. */
static void test_busy_probe(void)
{
    struct gb_error err = {0};
    struct gb_rundir dir;
    put(base, "preset.ini");
    const pid_t asks[] = {ask_for_ever(), ask_for_ever()};
    int refusals = 0;
    for (int k = 0; k < 20000; k++) {
        if (gb_rundir_open(&dir, base, &err)) {
            gb_rundir_finish(&dir);
        } else {
            refusals++;
        }
    }
    for (size_t k = 0; k < G_N_ELEMENTS(asks); k++) {
        g_assert_cmpint(kill(asks[k], SIGKILL), ==, 0);
        g_assert_cmpint(waitpid(asks[k], NULL, 0), ==, asks[k]);
    }
    g_test_message("%d refusals, the last: %s", refusals, err.text);
    g_assert_cmpint(refusals, ==, 0);
}

static void in_folder(gconstpointer data)
{
    void (*const *test)(void) = data;
    base = g_dir_make_tmp("greenbody-store-XXXXXX", NULL);
    g_assert_nonnull(base);
    (*test)();
    remove_tree(base);
    g_free(base);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *path;
        void (*test)(void);
    } tests[] = {
        {"/store/rows", test_rows},
        {"/store/dynamic-rows", test_dynamic_rows},
        {"/store/read-back", test_read_back},
        {"/store/preset", test_preset},
        {"/store/status", test_status},
        {"/store/foreign-status", test_foreign_status},
        {"/store/json-numbers", test_json_numbers},
        {"/store/existing", test_existing},
        {"/store/named-process", test_named_process},
        {"/store/busy-probe", test_busy_probe},
        {"/store/foreign", test_foreign},
        {"/store/discard", test_discard},
        {"/store/full", test_full},
        {"/store/directory", test_default_directory},
    };
    g_test_init(&argc, &argv, NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(tests); k++) {
        g_test_add_data_func(tests[k].path, &tests[k].test, in_folder);
    }
    return g_test_run();
}
