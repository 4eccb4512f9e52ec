#ifndef GB_TESTS_LIBRARY_USER_H
#define GB_TESTS_LIBRARY_USER_H

/* A user of the library: only the installed headers. */
#include <greenbody/greenbody.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static inline struct gb_parameters *parameters_of(const char *first,
                                                  ...) G_GNUC_NULL_TERMINATED;

/* A small packing with changes, NULL at the end. */
static inline struct gb_parameters *parameters_of(const char *first, ...)
{
    static const char *const small[] = {"particles.count=200",
                                        "loading.unload_from=", "loading.until=30 MPa"};
    struct gb_parameters *parameters = NULL;
    struct gb_error err = {0};
    va_list more;
    g_assert_true(gb_parameters_create(&parameters, NULL, &err));
    for (size_t i = 0; i < G_N_ELEMENTS(small); i++) {
        g_assert_true(gb_parameters_set(parameters, small[i], &err));
    }
    va_start(more, first);
    for (const char *text = first; text; text = va_arg(more, const char *)) {
        if (!gb_parameters_set(parameters, text, &err)) {
            g_error("%s", err.text);
        }
    }
    va_end(more);
    return parameters;
}

static inline struct gb_simulation *simulation_of(struct gb_parameters *parameters)
{
    struct gb_simulation *simulation = NULL;
    struct gb_error err = {0};
    if (!gb_simulation_create(&simulation, parameters, &err)) {
        g_error("%s", err.text);
    }
    gb_parameters_destroy(parameters);
    return simulation;
}

static inline struct gb_array array_of(struct gb_simulation *simulation, const char *name)
{
    struct gb_array array = {.size = sizeof array};
    struct gb_error err = {0};
    if (!gb_simulation_array(simulation, name, &array, &err)) {
        g_error("%s", err.text);
    }
    return array;
}

static inline double at(const struct gb_array *array, int64_t row, int64_t column)
{
    const char *data = array->data;
    double value;
    g_assert_cmpint(array->type, ==, GB_ARRAY_DOUBLE);
    memcpy(&value, data + row * array->stride[0] + column * array->stride[1],
           sizeof value);
    return value;
}

static inline int whole(const struct gb_array *array, int64_t row, int64_t column)
{
    const char *data = array->data;
    int32_t value;
    g_assert_cmpint(array->type, ==, GB_ARRAY_INT32);
    memcpy(&value, data + row * array->stride[0] + column * array->stride[1],
           sizeof value);
    return value;
}

static inline bool equal(const char *one, const char *other, size_t count, char type)
{
    for (size_t k = 0; type == 'd' && k < count; k++) {
        double a, b;
        memcpy(&a, one + k * sizeof a, sizeof a);
        memcpy(&b, other + k * sizeof b, sizeof b);
        if (!(a == b || (isnan(a) && isnan(b)))) {
            return false;
        }
    }
    return type == 'd' || memcmp(one, other, type == 'i' ? sizeof(int) : 8) == 0;
}

/* Every member but the seconds, which depend on the machine. */
static inline void assert_same(const struct gb_point *one, const struct gb_point *other)
{
    const char *name = NULL;
    size_t offset = 0, count = 0;
    char type = 0;
    for (size_t k = 0; gb_library_point_member(k, &name, &offset, &count, &type); k++) {
        if (strcmp(name, "seconds") != 0 &&
            !equal((const char *)one + offset, (const char *)other + offset, count,
                   type)) {
            g_error("step %" G_GINT64_FORMAT ": %s differs", one->step, name);
        }
    }
}

static inline void assert_same_points(const struct gb_simulation *one,
                                      const struct gb_simulation *other)
{
    const size_t points = gb_simulation_points(one);
    g_assert_cmpuint(points, ==, gb_simulation_points(other));
    for (size_t i = 0; i < points; i++) {
        assert_same(gb_simulation_point(one, i), gb_simulation_point(other, i));
    }
}

#endif
