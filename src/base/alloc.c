#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

/* The size of a block stands in the line before it, so that freeing can keep the count.
 */
struct head {
    _Alignas(ALIGNMENT) size_t bytes;
};

/* The only mutable state of this layer: the test hook and the count it reports. */
static _Atomic long fail_countdown;
static _Atomic size_t bytes_held;

static bool must_fail(void)
{
    return atomic_load(&fail_countdown) > 0 && atomic_fetch_sub(&fail_countdown, 1) == 1;
}

void *gb_alloc_array(size_t count, size_t size, struct gb_error *err)
{
    const size_t room = SIZE_MAX / 2 - 2 * sizeof(struct head);
    if (size != 0 && count > room / size) {
        gb_error_set(err, GB_ERR_MEMORY, "%zu items of %zu bytes do not fit in memory",
                     count, size);
        return NULL;
    }
    const size_t lines = (count * size + ALIGNMENT - 1) / ALIGNMENT;
    const size_t total = sizeof(struct head) + lines * ALIGNMENT;
    struct head *head = must_fail() ? NULL : aligned_alloc(ALIGNMENT, total);
    if (!head) {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory: %zu bytes requested", total);
        return NULL;
    }
    memset(head, 0, total);
    head->bytes = total;
    atomic_fetch_add(&bytes_held, total);
    return head + 1;
}

void gb_alloc_free(void *memory)
{
    if (!memory) {
        return;
    }
    struct head *head = (struct head *)memory - 1;
    atomic_fetch_sub(&bytes_held, head->bytes);
    free(head);
}

long gb_alloc_fail_after(long k)
{
    return atomic_exchange(&fail_countdown, k);
}

size_t gb_alloc_bytes(void)
{
    return atomic_load(&bytes_held);
}
