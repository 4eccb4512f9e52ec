#ifndef GB_PACK_KERNEL_VIRIAL_H
#define GB_PACK_KERNEL_VIRIAL_H

struct gb_fabric_sums;
struct gb_world;

/* sum[a][b]: sum of f_a r_b over all pairs, in contact or attracting across a gap (E d^3),
 * as of the last evaluation: f is the force on the first particle, r the branch vector from
 * the second to the first.  Over the volume it is the pressure tensor (P1 eq. 16).  Computed
 * once an evaluation. */
void gb_virial_sum(const struct gb_world *world, double sum[3][3]);

/* The same in one pass with the sums of the fabric tensors (NULL: without). */
void gb_virial_sum_fabric(const struct gb_world *world, double sum[3][3],
                          struct gb_fabric_sums *fabric);

#endif
