#include "base/record.h"

#include <math.h>
#include <string.h>

#include <glib.h>

enum { ROWS = 5, COLUMNS = 3, COUNT = ROWS * COLUMNS };

/* Numbers of every kind of a float: signs, zeros, the smallest and the largest one. */
static void make_floats(float number[COUNT])
{
    static const float special[] = {0.0f, -0.0f, 1e-45f, -3.4028235e38f, 1.0f / 3.0f};
    for (int k = 0; k < COUNT; k++) {
        number[k] =
            k < (int)G_N_ELEMENTS(special) ? special[k] : ldexpf(1.1f, 7 * k - 60);
    }
}

static void add_doubles(struct gb_record *record, const float number[COUNT])
{
    struct gb_record_item *item =
        gb_record_add(record, "a", GB_RECORD_DOUBLE, ROWS, COLUMNS, "d", NULL);
    g_assert_nonnull(item);
    g_assert_false(item->f32);
    for (int k = 0; k < COUNT; k++) {
        ((double *)item->data)[k] = (double)number[k];
    }
}

/* A record of floats is that of the same doubles, in half the memory. */
static void test_f32(void)
{
    struct gb_record single = {0}, wide = {0};
    float number[COUNT];
    int64_t row = 0;
    make_floats(number);
    add_doubles(&wide, number);
    g_assert_true(gb_record_f32(&single, "a", ROWS, COLUMNS, "d", number, NULL));
    g_assert_cmpuint(2 * gb_record_bytes(&single.item[0]), ==,
                     gb_record_bytes(&wide.item[0]));
    g_assert_null(gb_record_difference(&single, &wide, &row));
    g_assert_null(gb_record_difference(&wide, &single, &row));
    g_assert_cmphex(gb_record_hash(&single), ==, gb_record_hash(&wide));
    ((float *)single.item[0].data)[7] = nextafterf(number[7], 1e30f);
    g_assert_cmpstr(gb_record_difference(&wide, &single, &row), ==, "a");
    g_assert_cmpint(row, ==, 7 / COLUMNS);
    g_assert_cmphex(gb_record_hash(&single), !=, gb_record_hash(&wide));
    ((float *)single.item[0].data)[7] = number[7];
    ((float *)single.item[0].data)[0] = -number[0]; /* equal, but not its bits */
    g_assert_cmpstr(gb_record_difference(&single, &wide, &row), ==, "a");
    g_assert_cmpint(row, ==, 0);
    gb_record_finish(&single);
    gb_record_finish(&wide);
}

/* Either kind of item is loaded into floats and into doubles. */
static void test_load(void)
{
    struct gb_record records[2] = {{0}, {0}};
    float number[COUNT], single[COUNT];
    double twice[COUNT];
    make_floats(number);
    add_doubles(&records[0], number);
    g_assert_true(gb_record_f32(&records[1], "a", ROWS, COLUMNS, "d", number, NULL));
    for (int k = 0; k < 2; k++) {
        memset(single, 1, sizeof single);
        memset(twice, 1, sizeof twice);
        records[k].loading = true;
        g_assert_true(gb_record_f32(&records[k], "a", ROWS, COLUMNS, "d", single, NULL));
        g_assert_true(gb_record_array(&records[k], "a", GB_RECORD_DOUBLE, ROWS, COLUMNS,
                                      "d", twice, NULL));
        g_assert_true(memcmp(single, number, sizeof number) == 0);
        for (int i = 0; i < COUNT; i++) {
            const double wanted = (double)number[i];
            g_assert_true(memcmp(&twice[i], &wanted, sizeof wanted) == 0);
        }
        gb_record_finish(&records[k]);
    }
}

/* A nested record keeps how its items are held, and memory serves either kind in turn. */
static void test_nest(void)
{
    struct gb_record outer = {0}, inner = {0}, again = {0};
    float number[COUNT];
    int64_t row = 0;
    make_floats(number);
    add_doubles(&outer, number);
    gb_record_clear(&outer);
    g_assert_true(gb_record_f32(&inner, "a", ROWS, COLUMNS, "d", number, NULL));
    g_assert_true(gb_record_nest(&outer, "b/", &inner, NULL));
    g_assert_true(outer.item[0].f32);
    outer.loading = true;
    g_assert_true(gb_record_nest(&outer, "b/", &again, NULL));
    g_assert_null(gb_record_difference(&inner, &again, &row));
    gb_record_clear(&again);
    add_doubles(&again, number);
    g_assert_null(gb_record_difference(&inner, &again, &row));
    gb_record_finish(&outer);
    gb_record_finish(&inner);
    gb_record_finish(&again);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/record/f32", test_f32);
    g_test_add_func("/record/load", test_load);
    g_test_add_func("/record/nest", test_nest);
    return g_test_run();
}
