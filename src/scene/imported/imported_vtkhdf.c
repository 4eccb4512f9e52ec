#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "hdf/hdf.h"
#include "scene/imported/imported_private.h"

/* VTKHDF as this program exports it: points, diameters and the edges of the cell in nm. */
static const struct gb_hdf_array points = {"/VTKHDF/Points", GB_HDF_DOUBLE, 0, 3, "nm"};
static const struct gb_hdf_array diameters = {"/VTKHDF/PointData/diameter_nm",
                                              GB_HDF_DOUBLE, 0, 1, "nm"};
static const struct gb_hdf_array cell = {"/VTKHDF/FieldData/cell_nm", GB_HDF_DOUBLE, 9, 1,
                                         "nm"};

/* All rows of a dataset behind those of `to`. */
static bool take(struct gb_hdf *file, const struct gb_hdf_array *array, GArray *to,
                 struct gb_error *err)
{
    struct gb_hdf_array shape = *array;
    if (!gb_hdf_rows(file, array, &shape.rows, err)) {
        return false;
    }
    const size_t numbers = (size_t)shape.rows * (size_t)shape.columns;
    double *values = gb_alloc_array(numbers + 1, sizeof *values, err);
    const bool good = values != NULL && gb_hdf_get_array(file, &shape, values, err);
    if (good) {
        g_array_append_vals(to, values, (guint)numbers);
    }
    gb_alloc_free(values);
    return good;
}

static bool take_edges(struct gb_imported_raw *raw, const double edges[9],
                       struct gb_error *err)
{
    const char *why = "";
    return gb_imported_lines_vectors(raw, edges, &why) ||
           gb_error_set(err, GB_ERR_INPUT, "cell_nm: %s", why);
}

/* What a text cannot hold is not in a binary file either. */
static bool check(const struct gb_imported_raw *raw, struct gb_error *err)
{
    const double *x = (const double *)(void *)raw->position->data;
    const double *diameter = (const double *)(void *)raw->diameter->data;
    const guint count = raw->diameter->len;
    bool good = raw->position->len == 3 * count;
    for (guint i = 0; good && i < count; i++) {
        good = isfinite(x[3 * i]) && isfinite(x[3 * i + 1]) && isfinite(x[3 * i + 2]) &&
               isfinite(diameter[i]) && diameter[i] > 0.0;
    }
    return good ||
           gb_error_set(err, GB_ERR_INPUT,
                        "Points and diameter_nm: expected as many rows in both, finite "
                        "values, and diameters above 0");
}

bool gb_imported_vtkhdf_read(const char *path, struct gb_imported_raw *raw,
                             struct gb_error *err)
{
    struct gb_hdf *file = NULL;
    struct gb_error why = {0};
    double edges[9];
    if (!gb_hdf_open(&file, path, err)) {
        return false;
    }
    const bool good = take(file, &points, raw->position, &why) &&
                      take(file, &diameters, raw->diameter, &why) &&
                      gb_hdf_get_array(file, &cell, edges, &why) &&
                      take_edges(raw, edges, &why) && check(raw, &why);
    raw->unit_m = gb_imported_lines_unit("nm");
    gb_hdf_destroy(file);
    return good || gb_error_set(err, why.code, "%s: %s", path, why.text);
}
