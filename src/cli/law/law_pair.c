#include "cli/law/law_pair.h"

#include <stdio.h>

static void print_branch(double h, struct gb_law_branch branch)
{
    printf("%.17g,%.17g,%.17g\n", h, branch.force, branch.stiffness);
}

static struct gb_law_branch elastic(const struct gb_law_table_input *input)
{
    const struct gb_law_hertz *law = &input->pair->law.hertz;
    const double radius = input->pair->radius;
    return (struct gb_law_branch){gb_law_hertz_force(law, radius, input->x),
                                  gb_law_hertz_stiffness(law, radius, input->x)};
}

static struct gb_law_branch plastic(const struct gb_law_table_input *input, bool printed)
{
    struct gb_law_storakers law = input->pair->law;
    law.printed = printed;
    return gb_law_storakers_loading(&law, input->pair->radius, input->x);
}

void gb_law_pair_hertz(const struct gb_law_table_input *input)
{
    print_branch(input->x, elastic(input));
}

void gb_law_pair_storakers(const struct gb_law_table_input *input)
{
    print_branch(input->x, plastic(input, input->pair->law.printed));
}

void gb_law_pair_follow_hertz(const struct gb_law_table_input *input, double *deepest)
{
    (void)deepest;
    gb_law_pair_hertz(input);
}

void gb_law_pair_follow_storakers(const struct gb_law_table_input *input, double *deepest)
{
    const struct gb_contact_pair *pair = input->pair;
    print_branch(input->x,
                 gb_law_storakers_update(&pair->law, pair->radius, input->x, deepest));
}

void gb_law_pair_mindlin(const struct gb_law_table_input *input)
{
    const struct gb_contact_pair *pair = input->pair;
    printf("%.17g,%.17g,%.17g\n", input->x,
           gb_law_hertz_shear_stiffness(&pair->law.hertz, pair->radius, input->x),
           pair->mu * elastic(input).force);
}

void gb_law_pair_models(const struct gb_law_table_input *input)
{
    printf("%.17g,%.17g,%.17g,%.17g\n", input->x, elastic(input).force,
           plastic(input, false).force, plastic(input, true).force);
}

void gb_law_pair_steps(const struct gb_law_table_input *input)
{
    const struct gb_contact_pair *pair = input->pair;
    printf("%.17g,%.17g,%.17g,%.17g\n", input->x,
           gb_contact_pair_critical_step(pair, elastic(input).stiffness),
           gb_contact_pair_critical_step(pair, plastic(input, false).stiffness),
           gb_contact_pair_critical_step(pair, plastic(input, true).stiffness));
}

void gb_law_pair_yield(const struct gb_law_table_input *input)
{
    const struct gb_contact_pair *pair = input->pair;
    const struct gb_law_hertz *law = &pair->law.hertz;
    const double force = gb_law_hertz_yield_force(law, pair->radius, pair->yield_pa);
    printf("%.17g,%.17g\n", gb_law_hertz_overlap(law, pair->radius, force), force);
}
