#ifndef GB_PACK_KERNEL_BATCH_F32_H
#define GB_PACK_KERNEL_BATCH_F32_H

/* The loops of batch_*.h in single precision: include this first. */

#include "law/real_f32.h"

#include "pack/kernel/batch/batch.h"

#define BATCH         struct gb_batch_f32
#define BELOW_CAP     (1.0F - 0x1p-20F)
#define PLANE(p)      ((real *)c->plane[p] + slot)
#define MOMENT_FITTED true

#endif
