#ifndef GB_PACK_KERNEL_LANES_H
#define GB_PACK_KERNEL_LANES_H

#include <stdint.h>

/* Four numbers at a time; the compiler divides the vector where the processor has shorter ones,
 * with the same bits. */
typedef double gb_lanes __attribute__((vector_size(32), aligned(8), may_alias));
typedef int64_t gb_lanes_mask __attribute__((vector_size(32))); /* -1: true */
typedef int32_t gb_lanes_index
    __attribute__((vector_size(16), aligned(4), may_alias)); /* of four particles */

/* Four from `at` on of an array.  So many numbers behind an array are read with its last one. */
enum { GB_LANES_BEYOND = 3 };
#define GB_LANES_AT(numbers, at)       (*(const gb_lanes *)((numbers) + (at)))
#define GB_LANES_INDEX_AT(indices, at) (*(const gb_lanes_index *)((indices) + (at)))

#define GB_LANES_ALL(x)       ((gb_lanes){(x), (x), (x), (x)})
#define GB_LANES_INDEX_ALL(x) ((gb_lanes_index){(x), (x), (x), (x)})
#define GB_LANES_SELECTED(mask, a, b)                                                    \
    ((gb_lanes)(((gb_lanes_mask)(a) & (mask)) | ((gb_lanes_mask)(b) & ~(mask))))
#define GB_LANES_MAGNITUDE(x)                                                            \
    ((gb_lanes)((gb_lanes_mask)(x) & ~(gb_lanes_mask)GB_LANES_ALL(-0.0)))

#endif
