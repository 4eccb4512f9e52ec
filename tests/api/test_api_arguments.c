/* Every public function with every combination of wrong arguments: NULL, zero, huge and
 * foreign values.  None may crash, hang or write outside of what it was given, and a failure
 * has a code and one line.
 *
 * Usage: test_api_arguments HEADER...
 * A function that a header declares and no row calls fails the test. */
#include <sys/wait.h>
#include <unistd.h>

#include "../common/tree.h"
#include "library_user.h"

/* --- values of arguments ----------------------------------------------------------- */

/* An odometer with a digit for each argument of a call: choose(n) is the next digit, of n
 * values, and next() goes on to the next combination. */
static struct {
    size_t digit[16], values[16], used;
} odometer;

static size_t choose(size_t values)
{
    const size_t k = odometer.used++;
    g_assert_cmpuint(k, <, G_N_ELEMENTS(odometer.digit));
    odometer.values[k] = values;
    return odometer.digit[k];
}

/* False after the last combination. */
static bool next(void)
{
    const size_t used = odometer.used;
    odometer.used = 0;
    for (size_t k = 0; k < used; k++) {
        if (++odometer.digit[k] < odometer.values[k]) {
            return true;
        }
        odometer.digit[k] = 0;
    }
    return false;
}

/* What all calls share.  Objects that a call makes are destroyed after it. */
static struct {
    struct gb_parameters *parameters, *made_parameters;
    struct gb_simulation *new_simulation, *simulation, *made_simulation;
    struct gb_saved_state *saved, *made_saved;
    struct gb_recorded_run *run, *made_run;
    struct gb_contact_law_request request;
    struct gb_array array;
    struct gb_error err;
    char *folder, *state, *kept, *directory, *long_text; /* a row may replace the state */
    double numbers[4096];
    char text[GB_PARAMETERS_VALUE];
} all;

enum { ABSURD = 77 }; /* no value of any enumeration */

#define PICK(type, ...)                                                                  \
    ((type[]){__VA_ARGS__}[choose(sizeof((type[]){__VA_ARGS__}) / sizeof(type))])

static struct gb_error *an_error(void)
{
    all.err = (struct gb_error){0};
    return PICK(struct gb_error *, NULL, &all.err);
}

static const char *a_text(void)
{
    return PICK(const char *, NULL, "", "contact.mu", "mu=0.5", "position", "rod",
                "default", "no such thing", "\xff\xfe=\x80", "%s%n", all.long_text,
                all.state, all.directory);
}

/* Of things that are no file of the kind, or cannot be written. */
static const char *a_path(void)
{
    return PICK(const char *, NULL, "", "/dev/null/x", "/proc/self/x", "\xff/\xfe",
                all.long_text, all.state, all.directory);
}

static size_t a_size(void)
{
    return PICK(size_t, 0, 1, 3, sizeof all.text);
}

static size_t an_index(void)
{
    return PICK(size_t, 0, 1, 1000, SIZE_MAX / 2, SIZE_MAX);
}

static struct gb_contact_law_request *a_request(void)
{
    all.request = (struct gb_contact_law_request){
        .size = PICK(size_t, sizeof all.request, 0),
        .law = PICK(const char *, "rod", "normal", "lattice", "pair", NULL, "\xff", ""),
        .lattice = PICK(const char *, NULL, "sc", "\xff"),
        .x = PICK(const double *, all.numbers, NULL),
        .count = PICK(size_t, 2, 0, 1000, SIZE_MAX / 400, SIZE_MAX),
        .h_min = (double)NAN,
        .history = PICK(int, GB_CONTACT_LAW_POINTS, GB_CONTACT_LAW_PATH, ABSURD)};
    return PICK(struct gb_contact_law_request *, &all.request, NULL);
}

static struct gb_array *an_array(void)
{
    all.array = (struct gb_array){.size = PICK(size_t, sizeof all.array, 0, SIZE_MAX)};
    return PICK(struct gb_array *, &all.array, NULL);
}

#define INDEX       an_index()
#define SIZE        a_size()
#define ERR         an_error()
#define TEXT        a_text()
#define PATH        a_path()
#define BUFFER      PICK(char *, NULL, all.text)
#define REQUEST     a_request()
#define ARRAY       an_array()
#define PARAMETERS  PICK(struct gb_parameters *, NULL, all.parameters)
#define SIMULATION  PICK(struct gb_simulation *, NULL, all.new_simulation, all.simulation)
#define SAVED       PICK(struct gb_saved_state *, NULL, all.saved)
#define RUN         PICK(struct gb_recorded_run *, NULL, all.run)
#define OUT(member) (choose(2) ? &all.made_##member : NULL)

/* --- a row for each function --------------------------------------------------------- */

#define ROW(function, ...)                                                               \
    static void row_##function(void)                                                     \
    {                                                                                    \
        (void)gb_##function(__VA_ARGS__);                                                \
    }

ROW(array_name, INDEX)
ROW(array_doc, INDEX)
ROW(contact_law_name, INDEX)
ROW(contact_law_doc, INDEX)
ROW(contact_law_columns, TEXT)
ROW(contact_law_variable, TEXT)
ROW(contact_law_rows, REQUEST)
ROW(contact_law_compute, REQUEST, PARAMETERS, PICK(double *, NULL, all.numbers),
    PICK(size_t, 0, 1, 12, G_N_ELEMENTS(all.numbers)), ERR)
ROW(library_point_member, INDEX, PICK(const char **, NULL, &(const char *){NULL}),
    PICK(size_t *, NULL, &(size_t){0}), PICK(size_t *, NULL, &(size_t){0}),
    PICK(char *, NULL, all.text))
ROW(parameters_create, OUT(parameters), TEXT, ERR)
ROW(parameters_copy, OUT(parameters), PARAMETERS, ERR)
ROW(parameters_set, PARAMETERS, TEXT, ERR)
ROW(parameters_get, PARAMETERS, TEXT, BUFFER, SIZE, ERR)
ROW(parameters_label, PARAMETERS, TEXT, BUFFER, SIZE, ERR)
ROW(parameters_check, PARAMETERS, ERR)
ROW(parameters_check_cells, PARAMETERS, INDEX, ERR)
ROW(parameters_save, PARAMETERS, PATH, ERR)
ROW(parameters_text, INDEX,
    PICK(enum gb_parameters_text, GB_PARAMETERS_KEY, (enum gb_parameters_text)ABSURD),
    BUFFER, SIZE)
ROW(parameters_presets, BUFFER, SIZE)
ROW(recorded_run_open, OUT(run), PATH, ERR)
ROW(recorded_run_state, RUN)
ROW(recorded_run_reason, RUN)
ROW(recorded_run_points, RUN)
ROW(recorded_run_point, RUN, INDEX)
ROW(recorded_run_parameters, RUN, OUT(parameters), ERR)
ROW(recorded_run_saved, RUN, INDEX)
ROW(saved_state_load, OUT(saved), PATH, ERR)
ROW(saved_state_point, SAVED)
ROW(saved_state_title, SAVED)
ROW(saved_state_seed, SAVED)
ROW(saved_state_array, SAVED, TEXT, ARRAY, ERR)
ROW(simulation_create, OUT(simulation), PARAMETERS, ERR)
ROW(simulation_resume, OUT(simulation), PATH, ERR)
ROW(simulation_resume_before, OUT(simulation), PATH, ERR)
ROW(simulation_load, OUT(simulation), PARAMETERS, PATH, ERR)
ROW(simulation_record, SIMULATION, PATH, choose(2) == 1, ERR)
ROW(simulation_points, SIMULATION)
ROW(simulation_point, SIMULATION, INDEX)
ROW(simulation_progress, SIMULATION)
ROW(simulation_parameters, SIMULATION, OUT(parameters), ERR)
ROW(simulation_array, SIMULATION, TEXT, ARRAY, ERR)
ROW(simulation_state, SIMULATION, OUT(saved), ERR)
ROW(simulation_save, SIMULATION, PATH, ERR)
ROW(simulation_advance, PICK(struct gb_simulation *, NULL, all.simulation),
    PICK(int64_t, 0, -1, INT64_MIN, 1, INT64_MAX), ERR)
ROW(simulation_leave, PICK(struct gb_simulation *, NULL, all.new_simulation))
ROW(simulation_on_point, SIMULATION, NULL, NULL)
ROW(simulation_on_event, SIMULATION, NULL, NULL)
ROW(simulation_on_progress, SIMULATION, NULL, NULL,
    PICK(double, 0.0, -1.0, HUGE_VAL, (double)NAN))
ROW(simulation_cancel, SIMULATION, PICK(const char *, NULL, "", all.long_text))
ROW(parameters_destroy, NULL)
ROW(recorded_run_destroy, NULL)
ROW(saved_state_destroy, NULL)
ROW(simulation_destroy, NULL)
ROW(curve_branch_name,
    PICK(const struct gb_point *, NULL, &(struct gb_point){.branch = INT_MIN},
         &(struct gb_point){.branch = -50}, &(struct gb_point){.branch = INT_MAX}),
    BUFFER, SIZE)
ROW(status_exit_code, PICK(enum gb_status, GB_OK, (enum gb_status)ABSURD))

static void row_library_version(void)
{
    g_assert_nonnull(gb_library_version());
}

static void row_error_set(void)
{
    struct gb_error *err = ERR;
    const enum gb_status code =
        PICK(enum gb_status, GB_ERR_INPUT, (enum gb_status)ABSURD);
    const char *text = PICK(const char *, "", "\xff\x1b\n", all.long_text);
    g_assert_false(gb_error_set(err, code, "%s", text));
}

#define R(function)                                                                      \
    {                                                                                    \
        "gb_" #function, row_##function                                                  \
    }
static const struct row {
    const char *name;
    void (*call)(void);
} rows[] = {
    R(array_name),
    R(array_doc),
    R(contact_law_name),
    R(contact_law_doc),
    R(contact_law_columns),
    R(contact_law_variable),
    R(contact_law_rows),
    R(contact_law_compute),
    R(curve_branch_name),
    R(error_set),
    R(library_version),
    R(library_point_member),
    R(parameters_create),
    R(parameters_copy),
    R(parameters_set),
    R(parameters_get),
    R(parameters_label),
    R(parameters_check),
    R(parameters_check_cells),
    R(parameters_save),
    R(parameters_text),
    R(parameters_presets),
    R(parameters_destroy),
    R(recorded_run_open),
    R(recorded_run_state),
    R(recorded_run_reason),
    R(recorded_run_points),
    R(recorded_run_point),
    R(recorded_run_parameters),
    R(recorded_run_saved),
    R(recorded_run_destroy),
    R(saved_state_load),
    R(saved_state_point),
    R(saved_state_title),
    R(saved_state_seed),
    R(saved_state_array),
    R(saved_state_destroy),
    R(simulation_create),
    R(simulation_resume),
    R(simulation_resume_before),
    R(simulation_load),
    R(simulation_record),
    R(simulation_points),
    R(simulation_point),
    R(simulation_progress),
    R(simulation_parameters),
    R(simulation_array),
    R(simulation_state),
    R(simulation_save),
    R(simulation_leave),
    R(simulation_on_point),
    R(simulation_on_event),
    R(simulation_on_progress),
    R(simulation_cancel),
    R(simulation_advance),
    R(simulation_destroy),
    R(status_exit_code),
};

/* --- the calls ------------------------------------------------------------------------- */

static void begin(void)
{
    struct gb_error err = {0};
    all.folder = g_dir_make_tmp("greenbody-test-XXXXXX", NULL);
    all.directory = g_build_filename(all.folder, "run", NULL);
    all.state = g_build_filename(all.folder, "state.h5", NULL);
    all.kept = g_build_filename(all.folder, "kept.h5", NULL);
    all.long_text = g_strnfill(100000, 'x');
    all.parameters = parameters_of("loading.until=5 MPa", NULL);
    all.new_simulation = simulation_of(parameters_of("loading.until=5 MPa", NULL));
    all.simulation = simulation_of(parameters_of("loading.until=5 MPa", NULL));
    g_assert_true(gb_simulation_record(all.simulation, all.directory, false, &err));
    g_assert_cmpint(gb_simulation_advance(all.simulation, 2, &err), ==,
                    GB_RUN_OUTCOME_NONE);
    g_assert_true(gb_simulation_save(all.simulation, all.state, &err));
    g_assert_true(gb_simulation_save(all.simulation, all.kept, &err));
    g_assert_true(gb_saved_state_load(&all.saved, all.kept, &err));
    g_assert_true(gb_recorded_run_open(&all.run, all.directory, &err));
    for (size_t k = 0; k < G_N_ELEMENTS(all.numbers); k++) {
        all.numbers[k] = 1e-6 * (double)k;
    }
}

static void destroy_made(void)
{
    gb_parameters_destroy(all.made_parameters);
    gb_simulation_destroy(all.made_simulation);
    gb_saved_state_destroy(all.made_saved);
    gb_recorded_run_destroy(all.made_run);
    all.made_parameters = NULL;
    all.made_simulation = NULL;
    all.made_saved = NULL;
    all.made_run = NULL;
}

static void test_row(gconstpointer data)
{
    const struct row *row = data;
    size_t calls = 0;
    do {
        row->call();
        calls++;
        if (all.err.code != GB_OK) {
            g_assert_cmpuint(strlen(all.err.text), <, sizeof all.err.text);
            g_assert_true(g_utf8_validate(all.err.text, -1, NULL));
            g_assert_null(strchr(all.err.text, '\n'));
        }
        all.err = (struct gb_error){0};
        destroy_made();
    } while (next());
    g_test_message("%zu calls", calls);
}

/* What was asked for and does not exist is a value, not memory of something else. */
static void test_values(void)
{
    struct gb_error err = {0};
    char text[8] = "before";
    const size_t points = gb_simulation_points(all.simulation);
    g_assert_nonnull(gb_simulation_point(all.simulation, points - 1));
    g_assert_null(gb_simulation_point(all.simulation, points));
    g_assert_null(gb_recorded_run_point(all.run, gb_recorded_run_points(all.run)));
    g_assert_null(gb_contact_law_columns(NULL));
    g_assert_false(gb_parameters_get(all.parameters, "scene.kind", text, 3, &err));
    g_assert_cmpstr(err.text, ==, "size = 3: expected at least 12");
    g_assert_cmpstr(text, ==, "before");
    g_assert_false(gb_simulation_array(all.simulation, NULL, &all.array, &err));
    g_assert_cmpstr(err.text, ==, "name = NULL: expected a pointer");
    g_assert_cmpint(gb_simulation_advance(all.simulation, -1, &err), ==,
                    GB_RUN_OUTCOME_FAILED);
    g_assert_cmpstr(err.text, ==, "points = -1: expected 0 or more");
    struct gb_contact_law_request request = {.size = sizeof request,
                                             .law = "rod",
                                             .x = all.numbers,
                                             .count = 3,
                                             .h_min = (double)NAN};
    double out[5] = {7.0, 7.0, 7.0, 7.0, 7.0};
    g_assert_false(gb_contact_law_compute(&request, all.parameters, out, 5, &err));
    g_assert_nonnull(strstr(err.text, "room = 5: expected at least "));
    g_assert_cmpfloat(out[0], ==, 7.0); /* room is looked at first */
}

/* An advance within an advance changes nothing. */
static void advance_again(void *data, struct gb_simulation *simulation,
                          const struct gb_point *point)
{
    struct gb_error err = {0};
    size_t *refused = data;
    (void)point;
    g_assert_cmpint(gb_simulation_advance(simulation, 1, &err), ==,
                    GB_RUN_OUTCOME_FAILED);
    g_assert_nonnull(strstr(err.text, "an advance is under way"));
    gb_simulation_leave(simulation);
    ++*refused;
}

static void test_within(void)
{
    size_t refused = 0;
    struct gb_error err = {0};
    struct gb_simulation *plain = simulation_of(parameters_of("until=5 MPa", NULL));
    struct gb_simulation *nested = simulation_of(parameters_of("until=5 MPa", NULL));
    gb_simulation_on_point(nested, advance_again, &refused);
    g_assert_cmpint(gb_simulation_advance(nested, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    g_assert_cmpint(gb_simulation_advance(plain, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    g_assert_cmpuint(refused, ==, gb_simulation_points(plain));
    assert_same_points(plain, nested);
    gb_simulation_destroy(plain);
    gb_simulation_destroy(nested);
}

/* --- fork -------------------------------------------------------------------------------- */

/* In the child: everything that is inherited is read, refused or freed.  Returns the number
 * of the check that does not hold; 0: none. */
static int use_inherited(struct gb_simulation *simulation)
{
    struct gb_error err = {0};
    struct gb_array array = {.size = sizeof array};
    struct gb_saved_state *state = NULL;
    if (gb_simulation_points(simulation) == 0 || !gb_simulation_point(simulation, 0)) {
        return 1;
    }
    if (gb_simulation_advance(simulation, 1, &err) != GB_RUN_OUTCOME_FAILED ||
        err.code != GB_ERR_INPUT || !strstr(err.text, "belongs to process")) {
        return 2;
    }
    if (gb_simulation_array(simulation, "position", &array, &err) ||
        gb_simulation_state(simulation, &state, &err) ||
        gb_simulation_save(simulation, all.kept, &err)) {
        return 3;
    }
    gb_simulation_leave(simulation);
    gb_simulation_destroy(simulation);
    /* HDF5 can be used */
    if (!gb_saved_state_load(&state, all.kept, &err)) {
        return 4;
    }
    gb_saved_state_destroy(state);
    return 0;
}

static char *contents(const char *name)
{
    char *text = NULL, *path = g_build_filename(all.folder, "forked", name, NULL);
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_free(path);
    return text;
}

static void check_child(struct gb_simulation *simulation)
{
    int status = 0;
    const pid_t child = fork();
    g_assert_cmpint(child, >=, 0);
    if (child == 0) {
        alarm(120); /* a hang is a failure */
        _exit(use_inherited(simulation));
    }
    g_assert_cmpint(waitpid(child, &status, 0), ==, child);
    g_assert_true(WIFEXITED(status));
    g_assert_cmpint(WEXITSTATUS(status), ==, 0);
}

/* A recorded run with threads of its own, and a child that ends before it. */
static void test_fork(void)
{
    struct gb_error err = {0};
    char *directory = g_build_filename(all.folder, "forked", NULL);
    struct gb_simulation *simulation =
        simulation_of(parameters_of("particles.count=2000", "threads=3", NULL));
    g_assert_true(gb_simulation_record(simulation, directory, false, &err));
    g_assert_cmpint(gb_simulation_advance(simulation, 3, &err), ==, GB_RUN_OUTCOME_NONE);
    char *events = contents("events.log");
    check_child(simulation);
    char *after = contents("events.log");
    g_assert_cmpstr(events, ==, after);
    g_assert_null(strstr(after, "left before its end"));
    g_assert_cmpint(gb_simulation_advance(simulation, 2, &err), ==, GB_RUN_OUTCOME_NONE);
    g_assert_cmpuint(gb_simulation_points(simulation), ==, 5);
    gb_simulation_destroy(simulation);
    g_free(events);
    g_free(after);
    g_free(directory);
}

/* The lock of a directory ends with its run, while a child that has inherited it lives. */
static void test_fork_lock(void)
{
    struct gb_error err = {0};
    int pipe_of[2];
    char *directory = g_build_filename(all.folder, "locked", NULL);
    struct gb_simulation *simulation = simulation_of(parameters_of(NULL, NULL)), *again;
    g_assert_true(gb_simulation_record(simulation, directory, false, &err));
    g_assert_cmpint(gb_simulation_advance(simulation, 3, &err), ==, GB_RUN_OUTCOME_NONE);
    g_assert_cmpint(pipe(pipe_of), ==, 0);
    const pid_t child = fork();
    if (child == 0) {
        char end;
        close(pipe_of[1]);
        _exit(read(pipe_of[0], &end, 1) == 0 ? 0 : 1); /* until the parent is done */
    }
    gb_simulation_destroy(simulation);
    const bool resumed = gb_simulation_resume(&again, directory, &err);
    close(pipe_of[1]);
    close(pipe_of[0]);
    g_assert_cmpint(waitpid(child, NULL, 0), ==, child);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(resumed);
    gb_simulation_destroy(again);
    g_free(directory);
}

/* --- completeness ------------------------------------------------------------------------ */

static bool has_row(const char *name)
{
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        if (strcmp(rows[k].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* Names in front of a parenthesis, outside of comments. */
static size_t check_header(const char *path)
{
    size_t found = 0;
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    GRegex *comment = g_regex_new("/\\*.*?\\*/", G_REGEX_DOTALL, 0, NULL);
    GRegex *call = g_regex_new("\\b(gb_[a-z0-9_]+)\\(", 0, 0, NULL);
    char *code = g_regex_replace_literal(comment, text, -1, 0, "", 0, NULL);
    GMatchInfo *match = NULL;
    for (g_regex_match(call, code, 0, &match); g_match_info_matches(match);
         g_match_info_next(match, NULL)) {
        char *name = g_match_info_fetch(match, 1);
        if (!has_row(name)) {
            g_error("%s: %s has no row in the table of this test", path, name);
        }
        g_free(name);
        found++;
    }
    g_match_info_free(match);
    g_regex_unref(comment);
    g_regex_unref(call);
    g_free(code);
    g_free(text);
    return found;
}

static int header_count;
static char **headers;

static void test_complete(void)
{
    size_t found = 0;
    for (int k = 0; k < header_count; k++) {
        found += check_header(headers[k]);
    }
    g_assert_cmpuint(found, ==, G_N_ELEMENTS(rows));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    header_count = argc - 1;
    headers = argv + 1;
    begin();
    g_test_add_func("/api/arguments/complete", test_complete);
    g_test_add_func("/api/arguments/values", test_values);
    g_test_add_func("/api/arguments/within", test_within);
    g_test_add_func("/api/fork/inherited", test_fork);
    g_test_add_func("/api/fork/lock", test_fork_lock);
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char *path = g_strconcat("/api/arguments/rows/", rows[k].name, NULL);
        g_test_add_data_func(path, &rows[k], test_row);
        g_free(path);
    }
    const int failed = g_test_run();
    gb_parameters_destroy(all.parameters);
    gb_simulation_destroy(all.new_simulation);
    gb_simulation_destroy(all.simulation);
    gb_saved_state_destroy(all.saved);
    gb_recorded_run_destroy(all.run);
    remove_tree(all.folder);
    g_free(all.folder);
    g_free(all.kept);
    g_free(all.directory);
    g_free(all.state);
    g_free(all.long_text);
    return failed;
}
