#include "io/measured.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* A column and the factor that converts it to SI. */
struct quantity {
    char name[48];
    const double *value, *error; /* error may be NULL */
    double unit;
};

static bool find(const struct gb_table *table, const char *name, double unit,
                 struct quantity *out)
{
    char error[64];
    out->value = gb_table_column(table, name, NULL);
    g_snprintf(error, sizeof error, "%s_error", name);
    out->error = gb_table_column(table, error, NULL);
    out->unit = unit;
    g_strlcpy(out->name, name, sizeof out->name);
    return out->value != NULL;
}

static bool find_density(const struct gb_table *table, struct quantity *out)
{
    return find(table, "density", 1.0, out) || find(table, "density_percent", 0.01, out);
}

static bool find_pressure(const struct gb_table *table, struct quantity *out)
{
    static const struct {
        const char *name;
        double pascal;
    } units[] = {{"MPa", 1e6}, {"GPa", 1e9}, {"kPa", 1e3}, {"Pa", 1.0}};
    static const char *const words[] = {"p", "pressure"};
    for (size_t u = 0; u < G_N_ELEMENTS(units); u++) {
        for (size_t w = 0; w < G_N_ELEMENTS(words); w++) {
            char name[32];
            g_snprintf(name, sizeof name, "%s_%s", words[w], units[u].name);
            if (find(table, name, units[u].pascal, out)) {
                return true;
            }
        }
    }
    return false;
}

static bool check_row(const struct gb_table *table, size_t row, const struct quantity *q,
                      bool from_zero, double most, struct gb_error *err)
{
    const double value = q->value[row] * q->unit;
    const double error = q->error != NULL ? q->error[row] * q->unit : (double)NAN;
    if (!((value > 0.0 || (from_zero && value == 0.0)) && value <= most)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.200s:%d: %s %g: expected %s 0, up to %g",
                            gb_table_path(table), gb_table_line(table, row), q->name,
                            q->value[row], from_zero ? "from" : "above", most / q->unit);
    }
    if (error < 0.0) {
        return gb_error_set(
            err, GB_ERR_INPUT, "%.200s:%d: %s_error %g: expected 0 or more, or empty",
            gb_table_path(table), gb_table_line(table, row), q->name, q->error[row]);
    }
    return true;
}

/* Upper limit of densities: pressing flattens contacts, so 0.74 of the densest sphere
 * packing can be exceeded.  Pressures have the limits of loading.until. */
static const double density_most = 1.0;
static const double pressure_most_pa = 1e12;

static bool fill(struct gb_measured *measured, const struct gb_table *table,
                 bool from_zero, struct gb_error *err)
{
    struct quantity density;
    struct quantity pressure;
    if (!find_density(table, &density) || !find_pressure(table, &pressure)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.200s: its header needs density (or density_percent) and "
                            "p_MPa (or pressure_MPa; Pa, kPa, GPa)",
                            gb_table_path(table));
    }
    for (size_t i = 0; i < measured->count; i++) {
        if (!check_row(table, i, &density, false, density_most, err) ||
            !check_row(table, i, &pressure, from_zero, pressure_most_pa, err)) {
            return false;
        }
        measured->density[i] = density.value[i] * density.unit;
        measured->pressure_pa[i] = pressure.value[i] * pressure.unit;
        measured->density_error[i] =
            density.error != NULL ? density.error[i] * density.unit : (double)NAN;
        measured->pressure_error_pa[i] =
            pressure.error != NULL ? pressure.error[i] * pressure.unit : (double)NAN;
    }
    return true;
}

static bool reserve(struct gb_measured *measured, const char *path, size_t count,
                    struct gb_error *err)
{
    double *all = gb_alloc_array(4 * count, sizeof *all, err);
    if (all == NULL) {
        return false;
    }
    measured->path = g_strdup(path);
    measured->count = count;
    measured->density = all;
    measured->pressure_pa = all + count;
    measured->density_error = all + 2 * count;
    measured->pressure_error_pa = all + 3 * count;
    return true;
}

bool gb_measured_take(struct gb_measured **out, const struct gb_table *table,
                      bool from_zero, struct gb_error *err)
{
    const char *path = gb_table_path(table);
    const size_t count = gb_table_rows(table);
    struct gb_measured *measured = NULL;
    bool good = count > 0 || gb_error_set(err, GB_ERR_INPUT, "%.200s: has no rows", path);
    if (good) {
        measured = gb_alloc_array(1, sizeof *measured, err);
        good = measured != NULL && reserve(measured, path, count, err) &&
               fill(measured, table, from_zero, err);
    }
    if (!good) {
        gb_measured_destroy(measured);
        return false;
    }
    *out = measured;
    return true;
}

void gb_measured_destroy(struct gb_measured *measured)
{
    if (measured != NULL) {
        g_free(measured->path);
        gb_alloc_free(measured->density);
        gb_alloc_free(measured);
    }
}

double gb_measured_density_at(const struct gb_curve *curve, size_t points,
                              double pressure_pa)
{
    const struct gb_point *before = NULL;
    for (size_t i = 0; i < points; i++) {
        const struct gb_point *now = gb_curve_at(curve, i);
        if (now->branch > 0) {
            continue;
        }
        if (now->p_pa >= pressure_pa && before != NULL && before->p_pa < pressure_pa) {
            const double t = (pressure_pa - before->p_pa) / (now->p_pa - before->p_pa);
            return before->density + t * (now->density - before->density);
        }
        before = now;
    }
    return NAN;
}

void gb_measured_compare(const struct gb_measured *measured, const struct gb_curve *curve,
                         size_t points, struct gb_measured_misfit *out)
{
    double sum = 0.0;
    double squares = 0.0;
    double weighted = 0.0;
    *out = (struct gb_measured_misfit){0, NAN, NAN, NAN};
    for (size_t i = 0; i < measured->count; i++) {
        const double found =
            gb_measured_density_at(curve, points, measured->pressure_pa[i]);
        if (!isnan(found)) {
            const double off = found - measured->density[i];
            const double error = measured->density_error[i];
            out->reached++;
            sum += off;
            squares += off * off;
            weighted += error > 0.0 ? off * off / (error * error) : (double)NAN;
        }
    }
    if (out->reached > 0) {
        const double n = (double)out->reached;
        out->mean = sum / n;
        out->rms = sqrt(squares / n);
        out->weighted = sqrt(weighted / n);
    }
}
