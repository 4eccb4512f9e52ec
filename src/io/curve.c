#include "greenbody/curve.h"

#include <stdatomic.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/units.h"

/* Chunk k has FIRST_CHUNK << k points.  It is not moved or freed before the curve, so
 * pointers of readers stay valid while points are appended. 32 chunks have room for
 * more points than memory can hold. */
enum { FIRST_CHUNK = 256, CHUNKS = 32 };

struct gb_curve {
    struct gb_point *chunk[CHUNKS];
    /* Stored with release order after the point and its chunk, and loaded with acquire
     * order by readers: all points below the count are then visible. */
    _Atomic size_t count;
};

/* Chunk of a point, and its offset inside. */
static size_t locate(size_t index, size_t *offset)
{
    size_t k = 0;
    while (index >= (size_t)FIRST_CHUNK << k) {
        index -= (size_t)FIRST_CHUNK << k;
        k++;
    }
    *offset = index;
    return k;
}

bool gb_curve_create(struct gb_curve **out, struct gb_error *err)
{
    struct gb_curve *curve = gb_alloc_array(1, sizeof *curve, err);
    if (curve == NULL) {
        return false;
    }
    atomic_init(&curve->count, 0);
    *out = curve;
    return true;
}

void gb_curve_destroy(struct gb_curve *curve)
{
    if (curve == NULL) {
        return;
    }
    for (size_t k = 0; k < CHUNKS; k++) {
        gb_alloc_free(curve->chunk[k]);
    }
    gb_alloc_free(curve);
}

bool gb_curve_append(struct gb_curve *curve, const struct gb_point *point,
                     struct gb_error *err)
{
    const size_t count = atomic_load_explicit(&curve->count, memory_order_relaxed);
    size_t offset = 0;
    const size_t k = locate(count, &offset);
    if (k >= CHUNKS) {
        return gb_error_set(err, GB_ERR_MEMORY, "the curve is full: %zu points", count);
    }
    if (curve->chunk[k] == NULL) {
        curve->chunk[k] = gb_alloc_array((size_t)FIRST_CHUNK << k, sizeof *point, err);
        if (curve->chunk[k] == NULL) {
            return false;
        }
    }
    curve->chunk[k][offset] = *point;
    atomic_store_explicit(&curve->count, count + 1, memory_order_release);
    return true;
}

size_t gb_curve_count(const struct gb_curve *curve)
{
    return atomic_load_explicit(&curve->count, memory_order_acquire);
}

const struct gb_point *gb_curve_at(const struct gb_curve *curve, size_t index)
{
    size_t offset = 0;
    const size_t k = locate(index, &offset);
    return &curve->chunk[k][offset];
}

char *gb_curve_branch_name(const struct gb_point *point, char *buffer, size_t size)
{
    static const char *const names[] = {"load",   "relax", "hold",   "unload",
                                        "in-die", "eject", "ejected"};
    if (!buffer || size == 0) {
        return NULL;
    }
    if (!point || (point->branch < GB_BRANCH_LEAST && point->branch >= GB_BRANCH_LEG)) {
        buffer[0] = '\0';
        return buffer;
    }
    if (point->branch < GB_BRANCH_LEG) {
        snprintf(buffer, size, "leg:%d", GB_BRANCH_LEG - point->branch);
        return buffer;
    }
    if (point->branch <= 0) {
        snprintf(buffer, size, "%s", names[-point->branch]);
        return buffer;
    }
    char pressure[48];
    gb_units_format_short(point->branch_from_pa, GB_DIM_PRESSURE, 6, pressure,
                          sizeof pressure);
    /* one word, so that the column needs no quotes: "100MPa" */
    char *to = pressure;
    for (const char *from = pressure; *from != '\0'; from++) {
        if (*from != ' ') {
            *to++ = *from;
        }
    }
    *to = '\0';
    snprintf(buffer, size, "unload:%s", pressure);
    return buffer;
}
