#ifndef GREENBODY_ARRAY_H
#define GREENBODY_ARRAY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum gb_array_type { GB_ARRAY_DOUBLE, GB_ARRAY_INT32, GB_ARRAY_UINT8 };

/* Read-only view of an array of a packing in memory.  Item (i, k) is at the address
 * data + i stride[0] + k stride[1].  A stride of 0 means that all items are one value.
 *
 * Numbers are in the reduced units of the engine: lengths in particle diameters d,
 * forces in E d^2 with Young's modulus E.  Multiply by `si` for SI units. */
struct gb_array {
    size_t size; /* sizeof(struct gb_array), set by the caller before the call */
    const void *data;
    int type;            /* enum gb_array_type */
    int dimensions;      /* 1 or 2 */
    int64_t shape[2];    /* rows, columns; one dimension: 1 column */
    int64_t stride[2];   /* bytes */
    const char *unit;    /* of the numbers: "d", "E d^2", "Pa"; counts and indices: "" */
    const char *si_unit; /* "m", "N", "N m", "Pa", or "" */
    double si;           /* one `unit` in SI units */
};

/* Name of array `index` (0, 1, ...), and its meaning with shape and unit.  NULL after the
 * last array. */
const char *gb_array_name(size_t index);
const char *gb_array_doc(size_t index);

#ifdef __cplusplus
}
#endif

#endif
