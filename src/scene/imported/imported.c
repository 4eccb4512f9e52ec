#include "scene/imported/imported.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "scene/imported/imported_private.h"
#include "scene/loading_kind.h"

/* Bytes of a file at most: ten million particles of a hundred each. */
static const size_t bytes_max = (size_t)1 << 30;

/* Packings of this process, by checksum; they are never freed. */
static GMutex lock;
static GHashTable *known;

static void destroy(struct gb_imported *packing)
{
    gb_alloc_free(packing->position);
    gb_alloc_free(packing->diameter);
    gb_alloc_free(packing);
}

/* The one that is known with the same checksum, or the new one. */
static const struct gb_imported *keep(struct gb_imported *packing)
{
    g_mutex_lock(&lock);
    if (known == NULL) {
        known = g_hash_table_new(g_int64_hash, g_int64_equal);
    }
    const struct gb_imported *kept = g_hash_table_lookup(known, &packing->sum);
    if (kept == NULL) {
        g_hash_table_insert(known, &packing->sum, packing);
        kept = packing;
    } else {
        destroy(packing);
    }
    g_mutex_unlock(&lock);
    return kept;
}

static const struct gb_imported *find(uint64_t sum)
{
    g_mutex_lock(&lock);
    const struct gb_imported *found =
        known != NULL ? g_hash_table_lookup(known, &sum) : NULL;
    g_mutex_unlock(&lock);
    return found;
}

static bool read_text(const char *path, char *text, struct gb_imported_raw *raw,
                      struct gb_error *err)
{
    static const struct gb_imported_format *const formats[] = {
        &gb_imported_lammps_dump, &gb_imported_extxyz, &gb_imported_lammps_data,
        &gb_imported_table};
    struct gb_imported_lines lines = {.path = path, .next = text};
    size_t k = 0;
    while (!formats[k]->recognise(text)) {
        k++; /* the last one recognises everything */
    }
    return formats[k]->read(&lines, raw, err);
}

static bool read_bytes(const char *path, char *bytes, size_t length,
                       struct gb_imported_raw *raw, struct gb_error *err)
{
    static const char hdf5[] = "\x89HDF\r\n\x1a\n";
    if (length >= sizeof hdf5 && memcmp(bytes, hdf5, sizeof hdf5 - 1) == 0) {
        return gb_imported_vtkhdf_read(path, raw, err);
    }
    if (memchr(bytes, '\0', length) != NULL ||
        !g_utf8_validate(bytes, (gssize)length, NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: is not a text file: expected extended XYZ, a dump or "
                            "data file of LAMMPS, VTKHDF, or a table",
                            path);
    }
    return read_text(path, bytes, raw, err);
}

static struct gb_imported *read_packing(const char *path, struct gb_error *err)
{
    char *bytes = NULL;
    size_t length = 0;
    if (!gb_file_read(path, bytes_max, &bytes, &length, err)) {
        return NULL;
    }
    struct gb_imported_raw raw = {
        .position = g_array_new(FALSE, FALSE, sizeof(double)),
        .diameter = g_array_new(FALSE, FALSE, sizeof(double)),
        .unit_m = (double)NAN,
    };
    struct gb_imported *packing = gb_alloc_array(1, sizeof *packing, err);
    if (packing != NULL && (!read_bytes(path, bytes, length, &raw, err) ||
                            !gb_imported_reduce(packing, &raw, path, err))) {
        destroy(packing);
        packing = NULL;
    }
    gb_alloc_free(bytes);
    g_array_free(raw.position, TRUE);
    g_array_free(raw.diameter, TRUE);
    return packing;
}

const struct gb_imported *gb_imported_load(const char *path, struct gb_error *err)
{
    struct gb_imported *packing = read_packing(path, err);
    return packing != NULL ? keep(packing) : NULL;
}

bool gb_imported_given(const struct gb_params *params)
{
    return params->from.path[0] != '\0';
}

const struct gb_imported *gb_imported_of(const struct gb_params *params,
                                         struct gb_error *err)
{
    if (!gb_imported_given(params)) {
        return NULL;
    }
    const struct gb_imported *packing = find(params->from.sum);
    if (packing != NULL) { /* the usual case: read when the key was set */
        return packing;
    }
    packing = gb_imported_load(params->from.path, err);
    if (packing != NULL && packing->sum != params->from.sum) {
        gb_error_set(err, GB_ERR_INPUT,
                     "structure.from = %.200s: has changed since it was read",
                     params->from.path);
        return NULL;
    }
    return packing;
}

void gb_imported_take(struct gb_params *params, const char *path,
                      const struct gb_imported *packing)
{
    g_strlcpy(params->from.path, path, sizeof params->from.path);
    params->from.sum = packing->sum;
    params->count = packing->count;
    params->distribution = GB_DISTRIBUTION_MONO;
    if (!isnan(packing->unit_m)) {
        params->diameter_m = packing->unit_m;
    }
}

bool gb_imported_check_params(const struct gb_params *params, struct gb_error *err)
{
    const char *path = params->from.path;
    if (!gb_imported_given(params)) {
        return true;
    }
    const struct gb_imported *packing = gb_imported_of(params, err);
    if (packing == NULL) {
        return false;
    }
    if (!gb_loading_kind_of(params)->periodic_cell) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "structure.from: must be empty with scene.kind = %s, which "
                            "has no periodic cell",
                            gb_loading_kind_of(params)->name);
    }
    if (params->count != packing->count) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "particles.count = %" PRId64 ": must be %" PRId64
                            ", as many as %.200s has",
                            params->count, packing->count, path);
    }
    if (params->distribution != GB_DISTRIBUTION_MONO) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "particles.distribution: must be mono with structure.from: "
                            "the sizes come from %.200s",
                            path);
    }
    if (packing->planar != (params->dimension == 2)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "scene.dimension = %d: must be %d for the particles of "
                            "%.200s, which lie %s",
                            params->dimension, packing->planar ? 2 : 3, path,
                            packing->planar ? "in a plane of one y" : "in space");
    }
    return true;
}

double gb_imported_density(const struct gb_imported *packing)
{
    const double shape = packing->planar ? M_PI / 4.0 : M_PI / 6.0;
    const double *edges = packing->edges;
    return (double)packing->count * packing->moment[packing->planar ? 2 : 3] * shape /
           (edges[0] * edges[1] * edges[2]);
}

bool gb_imported_tilted(const struct gb_imported *packing)
{
    return packing->tilts[0] != 0.0 || packing->tilts[1] != 0.0 ||
           packing->tilts[2] != 0.0;
}

double gb_imported_spacing(const struct gb_imported *packing, int k)
{
    const double *edges = packing->edges;
    const double xy = packing->tilts[0], xz = packing->tilts[1], yz = packing->tilts[2];
    const double across = yz / edges[2]; /* rows of the inverse, times their edge */
    switch (k) {
    case 0:
        return edges[0] /
               hypot(hypot(1.0, xy / edges[1]), (xz - xy * yz / edges[1]) / edges[2]);
    case 1:
        return edges[1] / hypot(1.0, across);
    default:
        return edges[2];
    }
}

static void add_numbers(GString *text, const double *numbers, int count, char between)
{
    char buffer[GB_NUMBER_MAX];
    for (int k = 0; k < count; k++) {
        if (k > 0) {
            g_string_append_c(text, between);
        }
        g_string_append(text, gb_number_write(numbers[k], buffer));
    }
}

char *gb_imported_text(const struct gb_imported *packing)
{
    GString *text = g_string_new(NULL);
    if (!isnan(packing->unit_m)) {
        g_string_append(text, "# d = ");
        add_numbers(text, &packing->unit_m, 1, ' ');
        g_string_append(text, " m\n");
    }
    g_string_append(text, "# cell, d: ");
    add_numbers(text, packing->edges, 3, ' ');
    if (gb_imported_tilted(packing)) {
        g_string_append(text, " tilt xy xz yz, d: ");
        add_numbers(text, packing->tilts, 3, ' ');
    }
    g_string_append(text, "\nx_d,y_d,z_d,diameter_d\n");
    for (int64_t i = 0; i < packing->count; i++) {
        add_numbers(text, &packing->position[3 * i], 3, ',');
        g_string_append_c(text, ',');
        add_numbers(text, &packing->diameter[i], 1, ',');
        g_string_append_c(text, '\n');
    }
    return g_string_free(text, FALSE);
}
