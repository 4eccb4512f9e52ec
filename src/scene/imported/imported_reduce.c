#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/number.h"
#include "scene/imported/imported_private.h"

/* The q near value/factor of which q * factor rounds to value, where there is one: what is
 * written in the unit again has the digits that were read. */
static double divide_back(double value, double factor)
{
    const double q = value / factor;
    const double tried[] = {q, nextafter(q, -INFINITY), nextafter(q, INFINITY)};
    for (size_t k = 0; k < G_N_ELEMENTS(tried); k++) {
        if (tried[k] * factor == value) {
            return tried[k];
        }
    }
    return q;
}

/* The unit of length of a file, in the program's: d in m is the mean diameter times it. */
static double mean_diameter(const struct gb_imported_raw *raw)
{
    const double *diameter = (const double *)(void *)raw->diameter->data;
    double sum = 0.0;
    bool same = true;
    for (guint i = 0; i < raw->diameter->len; i++) {
        sum += diameter[i];
        same = same && diameter[i] == diameter[0];
    }
    return raw->reduced ? 1.0 : same ? diameter[0] : sum / raw->diameter->len;
}

/* d in m.  1.8 um is the number that 1.8e-6 reads as, but in nm, the unit of exports, the
 * one that is written with the same digits again. */
static double unit_metres(const struct gb_imported_raw *raw, double mean)
{
    char number[GB_NUMBER_MAX], text[GB_NUMBER_MAX + 16];
    if (raw->reduced || isnan(raw->unit_m)) {
        return raw->unit_m;
    }
    if (strchr(gb_number_write(mean, number), 'e') != NULL) {
        return mean * raw->unit_m;
    }
    g_snprintf(text, sizeof text, "%se%d", number, (int)lround(log10(raw->unit_m)));
    const double metres = g_ascii_strtod(text, NULL);
    return raw->unit_m == 1e-9 && metres * 1e9 != mean ? divide_back(mean, 1e9) : metres;
}

static void measure(struct gb_imported *packing)
{
    packing->least = packing->largest = packing->diameter[0];
    for (int64_t i = 0; i < packing->count; i++) {
        double power = 1.0;
        for (int k = 0; k < 4; k++) {
            packing->moment[k] += power;
            power *= packing->diameter[i];
        }
        packing->least = fmin(packing->least, packing->diameter[i]);
        packing->largest = fmax(packing->largest, packing->diameter[i]);
    }
    for (int k = 0; k < 4; k++) {
        packing->moment[k] /= (double)packing->count;
    }
    packing->moment[1] = 1.0; /* by definition of d; the sum differs in the last bit */
    packing->one_size = packing->least == 1.0 && packing->largest == 1.0;
}

/* Whether all y are one, and then discs in the plane y = 0. */
static void flatten(struct gb_imported *packing)
{
    double *x = packing->position;
    packing->planar = true;
    for (int64_t i = 1; i < packing->count && packing->planar; i++) {
        packing->planar = x[3 * i + 1] == x[1];
    }
    for (int64_t i = 0; i < packing->count && packing->planar; i++) {
        x[3 * i + 1] = 0.0;
    }
    packing->edges[1] = packing->planar ? 1.0 : packing->edges[1];
}

/* The same lattice with tilts of at most half an edge. */
static void fold(struct gb_imported *packing)
{
    const double *edges = packing->edges;
    double *xy = &packing->tilts[0], *xz = &packing->tilts[1], *yz = &packing->tilts[2];
    const double along_y = rint(*yz / edges[1]);
    *yz -= along_y * edges[1];
    *xz -= along_y * *xy;
    *xz -= rint(*xz / edges[0]) * edges[0];
    *xy -= rint(*xy / edges[0]) * edges[0];
}

/* Moves a particle by whole edge vectors along axis k; vector: the one of that axis. */
static void wrap_axis(double *x, int k, double edge, const double vector[3], double skew)
{
    const double from = x[k] - skew; /* of the face at which the cell begins */
    if (from >= 0.0 && from < edge) {
        return;
    }
    const double whole = floor(from / edge);
    for (int c = 0; c <= k; c++) {
        x[c] -= whole * vector[c];
    }
    if (skew == 0.0 && (x[k] >= edge || x[k] < 0.0)) {
        x[k] = 0.0; /* by rounding */
    }
}

/* Into the cell; in a tilted one within rounding. */
static void wrap(struct gb_imported *packing)
{
    const double *edges = packing->edges;
    const double xy = packing->tilts[0], xz = packing->tilts[1], yz = packing->tilts[2];
    const double a[3] = {edges[0], 0.0, 0.0}, b[3] = {xy, edges[1], 0.0},
                 c[3] = {xz, yz, edges[2]};
    for (int64_t i = 0; i < packing->count; i++) {
        double *x = &packing->position[3 * i];
        wrap_axis(x, 2, edges[2], c, 0.0);
        wrap_axis(x, 1, edges[1], b, x[2] / edges[2] * yz);
        const double v = (x[1] - x[2] / edges[2] * yz) / edges[1];
        wrap_axis(x, 0, edges[0], a, v * xy + x[2] / edges[2] * xz);
    }
}

static uint64_t checksum(const struct gb_imported *packing)
{
    const size_t n = (size_t)packing->count;
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    guint8 bytes[32];
    gsize size = sizeof bytes;
    uint64_t number;
    const double unit_m = isnan(packing->unit_m) ? 0.0 : packing->unit_m;
    g_checksum_update(sum, (const guchar *)&unit_m, sizeof unit_m);
    g_checksum_update(sum, (const guchar *)packing->edges, sizeof packing->edges);
    if (gb_imported_tilted(packing)) {
        g_checksum_update(sum, (const guchar *)packing->tilts, sizeof packing->tilts);
    }
    g_checksum_update(sum, (const guchar *)packing->position,
                      (gssize)(3 * n * sizeof(double)));
    g_checksum_update(sum, (const guchar *)packing->diameter,
                      (gssize)(n * sizeof(double)));
    g_checksum_get_digest(sum, bytes, &size);
    g_checksum_free(sum);
    memcpy(&number, bytes, sizeof number);
    return number;
}

bool gb_imported_reduce(struct gb_imported *packing, const struct gb_imported_raw *raw,
                        const char *path, struct gb_error *err)
{
    const int64_t count = raw->diameter->len;
    const double *x = (const double *)(void *)raw->position->data;
    const double *diameter = (const double *)(void *)raw->diameter->data;
    if (count < 2) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %d particles: must be 2 or more",
                            path, (int)count);
    }
    if (!raw->cell ||
        !(raw->edges[0] > 0.0 && raw->edges[1] > 0.0 && raw->edges[2] > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: has no periodic cell: expected one, in a table by a "
                            "line such as # cell, um: 12 12 20",
                            path);
    }
    packing->count = count;
    packing->position = gb_alloc_array(3 * (size_t)count, sizeof(double), err);
    packing->diameter = gb_alloc_array((size_t)count, sizeof(double), err);
    if (!packing->position || !packing->diameter) {
        return false;
    }
    const double mean = mean_diameter(raw);
    packing->unit_m = unit_metres(raw, mean);
    for (int c = 0; c < 3; c++) {
        packing->edges[c] = divide_back(raw->edges[c], mean);
        packing->tilts[c] = divide_back(raw->tilts[c], mean);
    }
    for (int64_t i = 0; i < count; i++) {
        packing->diameter[i] = divide_back(diameter[i], mean);
        for (int c = 0; c < 3; c++) {
            packing->position[3 * i + c] = divide_back(x[3 * i + c] - raw->low[c], mean);
        }
    }
    flatten(packing);
    fold(packing);
    if (packing->planar && (packing->tilts[0] != 0.0 || packing->tilts[2] != 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: tilts xy and yz of a cell of discs: must be 0", path);
    }
    wrap(packing);
    measure(packing);
    packing->sum = checksum(packing);
    return true;
}
