#ifndef GB_STUDY_LAW_LAW_PAIR_H
#define GB_STUDY_LAW_LAW_PAIR_H

#include "study/law/law_table.h"

/* Values of the laws of P3 for one pair of bodies, SI units, at overlap input->x. */

/* Overlap, force, stiffness; storakers is the loading curve. */
void gb_law_pair_hertz(const struct gb_law_table_input *input, double *out);
void gb_law_pair_storakers(const struct gb_law_table_input *input, double *out);
/* The same along a path; Hertz has no history. */
void gb_law_pair_follow_hertz(const struct gb_law_table_input *input, double *deepest,
                              double *out);
void gb_law_pair_follow_storakers(const struct gb_law_table_input *input, double *deepest,
                                  double *out);

/* k_t of Hertz' contact, (12), and Coulomb's cap without the dashpot, (14). */
void gb_law_pair_mindlin(const struct gb_law_table_input *input, double *out);
/* Force of the elastic and of both plastic laws side by side; their critical steps. */
void gb_law_pair_models(const struct gb_law_table_input *input, double *out);
void gb_law_pair_steps(const struct gb_law_table_input *input, double *out);
/* Overlap and force at which the weaker body starts to flow, (30). */
void gb_law_pair_yield(const struct gb_law_table_input *input, double *out);

#endif
