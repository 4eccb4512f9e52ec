#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Larger blocks are zeroed by the system, which makes only the pages resident that are
 * written. */
enum { ALIGNMENT = 64, LARGE = 1 << 20 };

/* Head of a block, in the cache line before it: its size, to count freed bytes, and the
 * start of its memory. */
struct head {
    _Alignas(ALIGNMENT) size_t bytes;
    void *memory;
};

/* Mutable state: the test hook and the count of bytes. */
static _Atomic long fail_countdown;
static _Atomic size_t bytes_held;

static bool must_fail(void)
{
    return atomic_load(&fail_countdown) > 0 && atomic_fetch_sub(&fail_countdown, 1) == 1;
}

/* Allocates zeroed lines with their head; NULL: out of memory. */
static struct head *allocate(size_t total)
{
    const bool large = total >= LARGE;
    char *memory = large ? calloc(1, total + ALIGNMENT) : aligned_alloc(ALIGNMENT, total);
    if (!memory) {
        return NULL;
    }
    const size_t beyond = (uintptr_t)memory % ALIGNMENT;
    struct head *head = (void *)(memory + (beyond > 0 ? ALIGNMENT - beyond : 0));
    if (!large) {
        memset(head, 0, total);
    }
    head->bytes = total;
    head->memory = memory;
    return head;
}

void *gb_alloc_array(size_t count, size_t size, struct gb_error *err)
{
    const size_t room = SIZE_MAX / 2 - 3 * sizeof(struct head);
    if (size != 0 && count > room / size) {
        gb_error_set(err, GB_ERR_MEMORY, "%zu items of %zu bytes do not fit in memory",
                     count, size);
        return NULL;
    }
    const size_t lines = (count * size + ALIGNMENT - 1) / ALIGNMENT;
    const size_t total = sizeof(struct head) + lines * ALIGNMENT;
    struct head *head = must_fail() ? NULL : allocate(total);
    if (!head) {
        gb_error_set(err, GB_ERR_MEMORY, "out of memory: %zu bytes requested", total);
        return NULL;
    }
    atomic_fetch_add(&bytes_held, total);
    return head + 1;
}

void *gb_alloc_grow(void *old, size_t kept, size_t room, size_t size,
                    struct gb_error *err)
{
    void *grown = gb_alloc_array(room, size, err);
    if (!grown) {
        return NULL;
    }
    if (kept > 0) {
        memcpy(grown, old, kept * size);
    }
    gb_alloc_free(old);
    return grown;
}

void gb_alloc_free(void *memory)
{
    if (!memory) {
        return;
    }
    struct head *head = (struct head *)memory - 1;
    atomic_fetch_sub(&bytes_held, head->bytes);
    free(head->memory);
}

long gb_alloc_fail_after(long k)
{
    return atomic_exchange(&fail_countdown, k);
}

size_t gb_alloc_bytes(void)
{
    return atomic_load(&bytes_held);
}
