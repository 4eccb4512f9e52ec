#ifndef GB_PACK_KERNEL_BATCH_F64_H
#define GB_PACK_KERNEL_BATCH_F64_H

/* The loops of batch_*.h in double precision: include this first. */

#include "law/real_f64.h"

#include "pack/kernel/batch/batch.h"

#define BATCH     struct gb_batch
#define BELOW_CAP (1.0 - 0x1p-40)
#define PLANE(p)  ((real *)c->plane[p] + slot)

/* M(a) of contacts without a bridge is computed by the scalar law, contact by contact. */
#define MOMENT_FITTED false

INLINE real moment_tail(real h)
{
    (void)h;
    return 0.0;
}

#endif
