#ifndef GB_PACK_KERNEL_FABRIC_SUMS_H
#define GB_PACK_KERNEL_FABRIC_SUMS_H

#include "pack/kernel/batch/batch.h"

/* Contacts that a fabric tensor is the mean of. */
enum gb_fabric_of {
    GB_FABRIC_ALL,
    GB_FABRIC_BRIDGED,
    GB_FABRIC_TENSION, /* f_n < 0 */
    GB_FABRIC_FORCE,   /* all, weighted by |f_n| */
    GB_FABRIC_KINDS
};

/* Sums over contacts of their weights, and of weight times n_i n_j: xx, yy, zz, xy, xz,
 * yz, n the unit vector along the contact. */
struct gb_fabric_sums {
    double weight[GB_FABRIC_KINDS];
    double tensor[GB_FABRIC_KINDS][6];
};

/* Pairs side by side: branch vectors (d), forces (E d^2), h_min as in a contact record. */
struct gb_fabric_sums_batch {
    int n;
    double r[3][GB_BATCH], force[3][GB_BATCH], deepest[GB_BATCH];
};

/* Adds the contacts of a batch, lane by lane: the same bits from every vector width. */
void gb_fabric_sums_add(struct gb_fabric_sums *sums, struct gb_fabric_sums_batch *batch);

#endif
