#include "scene/normal_law.h"

#include "scene/model.h"
#include "scene/tolerances.h"

static double rod_force(const struct gb_model *model, double h)
{
    return gb_law_rod_force(&model->rod, h);
}

static double rod_stiffness(const struct gb_model *model, double h)
{
    return gb_law_rod_stiffness(&model->rod, h);
}

/* No rod term, attraction, bridges or pivoting.  Shear is Mindlin with Coulomb
 * friction: (5) without its strength limit.  A spring of half the relative motion with
 * the stiffness (4) is Mindlin's. */
static void freeze_cohesionless(struct gb_model *model)
{
    model->cohesionless = true;
    model->rod.rod = model->rod.pivot = 0.0;
    model->dispersion.strength = model->dispersion.contact = 0.0;
    model->adhesion = 0.0;
    model->bridge.length = 1.0;
    model->bridge.strength = model->slip.strength = GB_STRENGTH_COHESIONLESS;
    model->slip.mu_pivot = 0.0;
    model->slip.motion = 0.5;
}

/* Hertz' law is the first term of (1). */
static void freeze_hertz(struct gb_model *model, const struct gb_params *params)
{
    (void)params;
    freeze_cohesionless(model);
}

static const struct gb_normal_law rows[GB_NORMAL_LAWS] = {
    [GB_NORMAL_ROD] =
        {
            .name = "rod",
            .force = rod_force,
            .stiffness = rod_stiffness,
        },
    [GB_NORMAL_HERTZ] =
        {
            .name = "hertz",
            .one_size = true,
            .pair = true,
            .freeze = freeze_hertz,
            .force = rod_force,
            .stiffness = rod_stiffness,
        },
    [GB_NORMAL_STORAKERS] =
        {
            .name = "storakers",
            .pair = true,
        },
};

const struct gb_normal_law *gb_normal_law_at(int normal)
{
    return &rows[normal];
}

const struct gb_normal_law *gb_normal_law_of(const struct gb_params *params)
{
    return gb_normal_law_at(params->normal);
}

double gb_normal_law_force(const struct gb_model *model, double h)
{
    return gb_normal_law_at(model->normal)->force(model, h);
}

double gb_normal_law_stiffness(const struct gb_model *model, double h)
{
    return gb_normal_law_at(model->normal)->stiffness(model, h);
}
