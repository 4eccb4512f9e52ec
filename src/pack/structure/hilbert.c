#include "pack/structure/hilbert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"

/* Cells of the curve along an edge, as a power of two: a cell holds about one particle in
 * packings of a hundred million. */
enum { BITS = 9 };

uint64_t gb_hilbert_index(const uint32_t *cell, int n, int bits)
{
    uint32_t x[3] = {0};
    memcpy(x, cell, (size_t)n * sizeof *x);
    /* undo the turns and reflections of the larger cells, from the largest down */
    for (uint32_t q = 1U << (bits - 1); q > 1; q >>= 1) {
        const uint32_t below = q - 1;
        for (int k = 0; k < n; k++) {
            if (x[k] & q) {
                x[0] ^= below;
            } else {
                const uint32_t swap = (x[0] ^ x[k]) & below;
                x[0] ^= swap;
                x[k] ^= swap;
            }
        }
    }
    /* Gray code */
    for (int k = 1; k < n; k++) {
        x[k] ^= x[k - 1];
    }
    uint32_t flip = 0;
    for (uint32_t q = 1U << (bits - 1); q > 1; q >>= 1) {
        flip ^= x[n - 1] & q ? q - 1 : 0;
    }
    uint64_t index = 0;
    for (int b = bits - 1; b >= 0; b--) {
        for (int k = 0; k < n; k++) {
            index = index << 1 | ((x[k] ^ flip) >> b & 1U);
        }
    }
    return index;
}

static int compare(const void *a, const void *b)
{
    const struct gb_hilbert_entry *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                            : (x->particle > y->particle) - (x->particle < y->particle);
}

void gb_hilbert_order(struct gb_hilbert_entry *entry, int64_t count)
{
    qsort(entry, (size_t)count, sizeof *entry, compare);
}

static uint64_t key_of(const double x[3], int dimension, double longest)
{
    const double most = (double)((1U << BITS) - 1U);
    uint32_t cell[3];
    int n = 0;
    for (int c = 0; c < 3; c++) {
        if (dimension == 3 || c != 1) {
            const double at = x[c] / longest * (most + 1.0);
            cell[n++] = (uint32_t)(at < 0.0 ? 0.0 : at > most ? most : at);
        }
    }
    return gb_hilbert_index(cell, n, BITS);
}

bool gb_hilbert_sort(const struct gb_model *model, double *position, struct gb_error *err)
{
    const int dimension = model->dimension;
    const int64_t count = model->count;
    const double flat = fmax(model->edges[0], model->edges[2]);
    const double longest = dimension == 3 ? fmax(flat, model->edges[1]) : flat;
    const size_t n = (size_t)count;
    if (model->polydisperse) {
        return true;
    }
    struct gb_hilbert_entry *order = gb_alloc_array(n, sizeof *order, err);
    double *sorted = gb_alloc_array(3 * n, sizeof *sorted, err);
    const bool room = order && sorted;
    for (int64_t i = 0; room && i < count; i++) {
        order[i] =
            (struct gb_hilbert_entry){key_of(position + 3 * i, dimension, longest), i};
    }
    if (room) {
        gb_hilbert_order(order, count);
        for (int64_t i = 0; i < count; i++) {
            memcpy(sorted + 3 * i, position + 3 * order[i].particle, 3 * sizeof *sorted);
        }
        memcpy(position, sorted, 3 * n * sizeof *sorted);
    }
    gb_alloc_free(order);
    gb_alloc_free(sorted);
    return room;
}
