#ifndef GB_CLI_LAWPAIR_H
#define GB_CLI_LAWPAIR_H

#include "cli/lawtable.h"

/* Rows of the laws of P3 for one pair of bodies, SI units, at overlap input->x. */

/* Overlap, force, stiffness; storakers is the loading curve. */
void gb_lawpair_hertz(const struct gb_lawtable_input *input);
void gb_lawpair_storakers(const struct gb_lawtable_input *input);
/* The same along a path: Hertz has no history. */
void gb_lawpair_follow_hertz(const struct gb_lawtable_input *input, double *deepest);
void gb_lawpair_follow_storakers(const struct gb_lawtable_input *input, double *deepest);

/* k_t of Hertz' contact, (12), and Coulomb's cap without the dashpot, (14). */
void gb_lawpair_mindlin(const struct gb_lawtable_input *input);
/* Force of the elastic and of both plastic laws side by side; their critical steps. */
void gb_lawpair_models(const struct gb_lawtable_input *input);
void gb_lawpair_steps(const struct gb_lawtable_input *input);
/* Overlap and force at which the weaker body starts to flow, (30). */
void gb_lawpair_yield(const struct gb_lawtable_input *input);

#endif
