#ifndef GREENBODY_ARRAY_H
#define GREENBODY_ARRAY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum gb_array_type { GB_ARRAY_DOUBLE, GB_ARRAY_INT32, GB_ARRAY_UINT8 };

/* An array of a packing as it lies in memory, to be read only.  Item (i, k) is at
 * data + i stride[0] + k stride[1]; a stride of 0 is one value for all.
 *
 * Numbers are in the reduced units of the engine: lengths in particle diameters d, forces in
 * E d^2 with Young's modulus E; `si` converts them. */
struct gb_array {
    size_t size; /* sizeof(struct gb_array), set by the caller before the call */
    const void *data;
    int type;          /* enum gb_array_type */
    int dimensions;    /* 1 or 2 */
    int64_t shape[2];  /* rows, columns; columns 1 of one dimension */
    int64_t stride[2]; /* bytes */
    const char *unit;  /* of the numbers: "d", "E d^2", "Pa"; "" of counts and indices */
    const char *si_unit; /* "m", "N", "N m", "Pa"; "" likewise */
    double si;           /* one unit in the SI unit */
};

/* Name of array `index` (0, 1, ...) and its meaning with shape and unit; NULL behind the
 * last. */
const char *gb_array_name(size_t index);
const char *gb_array_doc(size_t index);

#ifdef __cplusplus
}
#endif

#endif
