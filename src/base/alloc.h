#ifndef GB_BASE_ALLOC_H
#define GB_BASE_ALLOC_H

#include <stddef.h>

#include "greenbody/status.h"

/* Zeroed memory for count items of size bytes, aligned to 64 bytes so that batches of
 * particles vectorise.  Returns NULL and sets err (GB_ERR_MEMORY) when count * size
 * overflows or memory is out.  Free with gb_alloc_free. */
void *gb_alloc_array(size_t count, size_t size, struct gb_error *err);

/* Memory for `room` items that begins with the first `kept` of those of `old`, which is freed (NULL
 * is fine with none); the rest is zeroed.  NULL as gb_alloc_array; `old` is as it was then. */
void *gb_alloc_grow(void *old, size_t kept, size_t room, size_t size,
                    struct gb_error *err);

/* Frees what gb_alloc_array gave; NULL is fine. */
void gb_alloc_free(void *memory);

/* Test hook: the k-th allocation from now on fails (k = 1 is the next one); 0 switches
 * the hook off.  Returns how many were left before: 0 after the failure.  Thread-safe.
 */
long gb_alloc_fail_after(long k);

/* Bytes now held by gb_alloc_array, for reports of memory per particle. */
size_t gb_alloc_bytes(void);

#endif
