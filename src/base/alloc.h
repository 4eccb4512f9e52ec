#ifndef GB_BASE_ALLOC_H
#define GB_BASE_ALLOC_H

#include <stddef.h>

#include "greenbody/status.h"

/* Zeroed memory for count items of size bytes, aligned to 64 bytes for vector loads.
 * Returns NULL and sets err (GB_ERR_MEMORY) if count * size overflows or memory is
 * exhausted.  Free with gb_alloc_free. */
void *gb_alloc_array(size_t count, size_t size, struct gb_error *err);

/* Memory for `room` items that begins with the first `kept` items of `old` and is
 * zeroed after them.  Frees `old`, which may be NULL if kept is 0.  Returns NULL like
 * gb_alloc_array; `old` does not change then. */
void *gb_alloc_grow(void *old, size_t kept, size_t room, size_t size,
                    struct gb_error *err);

/* Frees memory from gb_alloc_array or gb_alloc_grow; NULL is fine. */
void gb_alloc_free(void *memory);

/* Test hook: the k-th allocation from now on fails (k = 1 is the next one); 0 disables
 * the hook.  Returns the previous count of remaining allocations, 0 after the failure.
 * Thread-safe. */
long gb_alloc_fail_after(long k);

/* Bytes currently allocated, for reports of memory per particle. */
size_t gb_alloc_bytes(void);

#endif
