#ifndef GB_PACK_KERNEL_SHARE_H
#define GB_PACK_KERNEL_SHARE_H

#include <stdint.h>

/* Part t of `parts` nearly equal ones of count items: gb_share(t) .. gb_share(t + 1) - 1. */
static inline int64_t gb_share(int64_t count, int t, int parts)
{
    return count * t / parts;
}

#endif
