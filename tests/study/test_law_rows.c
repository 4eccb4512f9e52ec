/* Rows of contact laws as values: points, ranges and paths, and what ends them. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/scene.h"
#include "scene/model.h"
#include "study/law_table.h"

enum { ROWS_MAX = 1024 };

struct rows {
    double value[ROWS_MAX][GB_LAW_TABLE_COLUMNS];
    int count, columns;
    int limit; /* rows after which take fails */
};

static bool take(const double *value, int columns, void *data, struct gb_error *err)
{
    struct rows *rows = data;
    if (rows->count == rows->limit) {
        return gb_error_set(err, GB_ERR_MACHINE, "limit");
    }
    memcpy(rows->value[rows->count++], value, (size_t)columns * sizeof *value);
    rows->columns = columns;
    return true;
}

static bool compute(struct rows *rows, const struct gb_law_table_request *request,
                    struct gb_error *err)
{
    struct gb_params params = scene_params("contact.bridge_length=0.01 d", NULL);
    params.normal = request->law->normal;
    *rows = (struct rows){.limit = rows->limit > 0 ? rows->limit : ROWS_MAX};
    return gb_law_table_compute(request, &params, take, rows, err);
}

/* The columns of law rod are those of gb_law_rod_force at evenly spaced overlaps. */
static void test_range(void)
{
    const struct gb_params params = scene_params("contact.bridge_length=0.01 d", NULL);
    struct rows rows = {0};
    struct gb_error err = {0};
    struct gb_model model;
    char range[] = "h=0:0.1:11";
    const struct gb_law_table_request request = {.law = gb_law_table_find("rod"),
                                                 .range = range};
    g_assert_true(gb_model_init(&model, &params, &err));
    g_assert_true(compute(&rows, &request, &err));
    g_assert_cmpint(rows.count, ==, 11);
    g_assert_cmpint(rows.columns, ==, gb_law_table_columns(request.law));
    g_assert_cmpfloat(rows.value[10][0], ==, 0.1);
    for (int i = 0; i < rows.count; i++) {
        g_assert_cmpfloat(rows.value[i][1], ==,
                          gb_law_rod_force(&model.rod, rows.value[i][0]));
    }
}

/* A bridge forms on the way in and holds on the way out. */
static void test_path(void)
{
    struct rows rows = {0};
    struct gb_error err = {0};
    char path[] = "0,0.03,0.025";
    const struct gb_law_table_request request = {.law = gb_law_table_find("normal"),
                                                 .path = path};
    g_assert_true(compute(&rows, &request, &err));
    g_assert_cmpint(rows.count, ==, 1 + 2 * 200);
    const double in = rows.value[167][1], out = rows.value[400][1];
    g_assert_cmpfloat_with_epsilon(rows.value[167][0], 0.02505, 1e-9);
    g_assert_cmpfloat(out, <, in);
}

/* Every row of the table has a text for the help and gives finite values. */
static void test_table(void)
{
    size_t count = 0;
    const struct gb_law_table_law *laws = gb_law_table_laws(&count);
    for (size_t i = 0; i < count; i++) {
        const char *variable = laws[i].pair ? "h" : laws[i].variable;
        char *range =
            laws[i].variable != NULL ? g_strdup_printf("%s=0.01:0.02:3", variable) : NULL;
        const struct gb_law_table_request request = {
            .law = &laws[i],
            .lattice = gb_law_table_find_lattice("sc"),
            .range = range,
        };
        struct rows rows = {0};
        struct gb_error err = {0};
        const bool done = compute(&rows, &request, &err);
        g_test_message("%s: %s", laws[i].name, err.text);
        g_assert_true(done);
        g_assert_cmpuint(strlen(laws[i].doc), >, 0);
        g_assert_true(gb_law_table_find(laws[i].name) == &laws[i]);
        g_assert_cmpint(rows.columns, <=, GB_LAW_TABLE_COLUMNS);
        g_assert_cmpint(rows.count, ==, range != NULL ? 3 : 1);
        for (int k = 0; k < rows.count * GB_LAW_TABLE_COLUMNS; k++) {
            const int column = k % GB_LAW_TABLE_COLUMNS;
            g_assert_true(column >= rows.columns ||
                          isfinite(rows.value[k / GB_LAW_TABLE_COLUMNS][column]));
        }
        g_free(range);
    }
}

/* The error of the receiver ends the rows; wrong requests give none. */
static void test_errors(void)
{
    struct rows rows = {.limit = 3};
    struct gb_error err = {0};
    char range[] = "h=0:0.1:11", beyond[] = "h=0:2:11";
    struct gb_law_table_request request = {.law = gb_law_table_find("rod"),
                                           .range = range};
    g_assert_false(compute(&rows, &request, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_MACHINE);
    g_assert_cmpint(rows.count, ==, 3);
    request.range = beyond;
    g_assert_false(compute(&rows, &request, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_cmpint(rows.count, ==, 0);
    g_assert_null(gb_law_table_find("storm"));
    g_assert_null(gb_law_table_find_lattice("hcp"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/law-rows/range", test_range);
    g_test_add_func("/law-rows/path", test_path);
    g_test_add_func("/law-rows/errors", test_errors);
    g_test_add_func("/law-rows/table", test_table);
    return g_test_run();
}
