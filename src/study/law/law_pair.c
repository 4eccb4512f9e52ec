#include "study/law/law_pair.h"

static void set_branch(double h, struct gb_law_branch branch, double *out)
{
    out[0] = h;
    out[1] = branch.force;
    out[2] = branch.stiffness;
}

enum formula { LESSER_OF_BOTH, AS_PRINTED };

static struct gb_law_branch elastic(const struct gb_law_table_input *input)
{
    const struct gb_law_hertz *law = &input->pair->law.hertz;
    const double radius = input->pair->radius;
    return (struct gb_law_branch){gb_law_hertz_force(law, radius, input->x),
                                  gb_law_hertz_stiffness(law, radius, input->x)};
}

static struct gb_law_branch plastic(const struct gb_law_table_input *input,
                                    enum formula formula)
{
    struct gb_law_storakers law = input->pair->law;
    law.printed = formula == AS_PRINTED;
    return gb_law_storakers_loading(&law, input->pair->radius, input->x);
}

void gb_law_pair_hertz(const struct gb_law_table_input *input, double *out)
{
    set_branch(input->x, elastic(input), out);
}

void gb_law_pair_storakers(const struct gb_law_table_input *input, double *out)
{
    const bool printed = input->pair->law.printed;
    set_branch(input->x, plastic(input, printed ? AS_PRINTED : LESSER_OF_BOTH), out);
}

void gb_law_pair_follow_hertz(const struct gb_law_table_input *input, double *deepest,
                              double *out)
{
    (void)deepest;
    gb_law_pair_hertz(input, out);
}

void gb_law_pair_follow_storakers(const struct gb_law_table_input *input, double *deepest,
                                  double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    set_branch(input->x,
               gb_law_storakers_update(&pair->law, pair->radius, input->x, deepest), out);
}

void gb_law_pair_mindlin(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    out[0] = input->x;
    out[1] = gb_law_hertz_shear_stiffness(&pair->law.hertz, pair->radius, input->x);
    out[2] = pair->mu * elastic(input).force;
}

void gb_law_pair_models(const struct gb_law_table_input *input, double *out)
{
    out[0] = input->x;
    out[1] = elastic(input).force;
    out[2] = plastic(input, LESSER_OF_BOTH).force;
    out[3] = plastic(input, AS_PRINTED).force;
}

void gb_law_pair_steps(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    out[0] = input->x;
    out[1] = gb_contact_pair_critical_step(pair, elastic(input).stiffness);
    out[2] =
        gb_contact_pair_critical_step(pair, plastic(input, LESSER_OF_BOTH).stiffness);
    out[3] = gb_contact_pair_critical_step(pair, plastic(input, AS_PRINTED).stiffness);
}

void gb_law_pair_yield(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    const struct gb_law_hertz *law = &pair->law.hertz;
    const double force = gb_law_hertz_yield_force(law, pair->radius, pair->yield_pa);
    out[0] = gb_law_hertz_overlap(law, pair->radius, force);
    out[1] = force;
}
