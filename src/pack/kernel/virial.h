#ifndef GB_PACK_KERNEL_VIRIAL_H
#define GB_PACK_KERNEL_VIRIAL_H

struct gb_world;

/* sum[a][b]: sum over all pairs, in contact or attracting across a gap, of f_a r_b (E
 * d^3), with the force on the first particle and the way to it from the second, as of the
 * last evaluation.  Over the volume it is the pressure tensor (P1, eq. 16). */
void gb_virial_sum(const struct gb_world *world, double sum[3][3]);

#endif
