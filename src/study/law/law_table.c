#include "study/law/law_table.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "study/law/law_pair.h"

static const struct gb_law_table_lattice lattices[] = {
    {"sc", 6.0, 1.0},
    {"fcc", 12.0, M_SQRT1_2},
    {"bcc", 8.0, 0.76980035891950102},    /* 4 / (3 sqrt 3) */
    {"diamond", 4.0, 1.5396007178390020}, /* 8 / (3 sqrt 3) */
};

static double newton(const struct gb_model *model, double force)
{
    return force * model->newton_per_force * 1e9;
}

static void set_force(const struct gb_model *model, double h, double force,
                      double stiffness, double *out)
{
    out[0] = h;
    out[1] = force;
    out[2] = stiffness;
    out[3] = newton(model, force);
}

static void get_rod(const struct gb_law_table_input *input, double *out)
{
    const struct gb_law_rod *rod = &input->model->rod;
    set_force(input->model, input->x, gb_law_rod_force(rod, input->x),
              gb_law_rod_stiffness(rod, input->x), out);
}

static void get_dispersion(const struct gb_law_table_input *input, double *out)
{
    const double force = gb_law_dispersion_force(&input->model->dispersion, input->x);
    out[0] = input->x;
    out[1] = force;
    out[2] = newton(input->model, force);
}

/* f_n = f_e - f_a: overlap, force, df_n/dh of the active branch, force in nN.  h_min is
 * the deepest overlap of the bridge, 0: no bridge. */
static void set_contact(const struct gb_model *model, double h, double h_min, double *out)
{
    const struct gb_law_dispersion *dispersion = &model->dispersion;
    const double attraction = gb_law_dispersion_force(dispersion, 1.0 - h);
    double force = gb_law_rod_force(&model->rod, h);
    double stiffness = gb_law_rod_stiffness(&model->rod, h);
    if (h_min > 0.0 && h_min > h) {
        force = gb_law_bridge_force(&model->rod, h_min, h);
        stiffness = gb_law_rod_stiffness(&model->rod, h_min);
    } else if (h < 0.0) {
        stiffness += gb_law_dispersion_slope(dispersion, 1.0 - h);
    }
    set_force(model, h, force - attraction, stiffness, out);
}

static void get_normal(const struct gb_law_table_input *input, double *out)
{
    set_contact(input->model, input->x, 0.0, out);
}

/* Bridges form and break on the way, where the scene has them. */
static void follow_contact(const struct gb_law_table_input *input, double *h_min,
                           double *out)
{
    const struct gb_model *model = input->model;
    *h_min = model->terms.bridges
                 ? gb_law_bridge_deepest(&model->bridge, *h_min, input->x)
                 : 0.0;
    set_contact(model, input->x, *h_min, out);
}

/* A bridge opens by its length at most: beyond that h_min follows the overlap. */
static void get_bridge(const struct gb_law_table_input *input, double *out)
{
    const double deepest = input->x + input->model->bridge.length;
    const double h_min = isnan(input->h_min) ? deepest : fmin(input->h_min, deepest);
    set_contact(input->model, input->x, h_min, out);
}

static double contact_radius(double h)
{
    return 0.5 * sqrt(fmax(h, 0.0));
}

static void get_shear(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = input->x;
    out[1] = gb_law_slip_shear_stiffness(&model->slip, contact_radius(input->x));
    out[2] = gb_law_slip_shear_cap(&model->slip, &model->rod, input->x);
}

static void get_pivot(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = input->x;
    out[1] = gb_law_slip_pivot_stiffness(&model->slip, contact_radius(input->x));
    out[2] = gb_law_slip_pivot_cap(&model->slip, &model->rod, input->x);
}

static void get_roll(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double a = contact_radius(input->x);
    out[0] = input->x;
    out[1] = gb_law_slip_roll_stiffness(&model->slip, a);
    out[2] = gb_law_slip_roll_cap(a, gb_law_rod_force(&model->rod, input->x));
}

static void get_equilibrium(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = model->h_eq;
    out[1] = model->adhesion;
    out[2] = newton(model, model->adhesion);
}

static void get_strength(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double stress =
        gb_law_bridge_peel_stress(&model->bridge, &model->rod, input->x);
    out[0] = input->x;
    out[1] = stress * model->pascal_per_stress * 1e-9;
}

/* Pressure of a perfect lattice from the virial of its nearest neighbours. */
static void get_lattice(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double r = 1.0 - input->x;
    const double volume = input->lattice->volume * r * r * r;
    const double force = gb_law_rod_force(&model->rod, input->x) -
                         gb_law_dispersion_force(&model->dispersion, r);
    const double pressure = input->lattice->neighbours * force * r / (6.0 * volume);
    out[0] = input->x;
    out[1] = M_PI / 6.0 / volume;
    out[2] = pressure * model->pascal_per_stress * 1e-9;
}

/* Overlaps and distances of most laws, in diameters. */
#define OVERLAPS  .low = -1e6, .high = 1.0
#define DISTANCES .low = 0.0, .high = 1e6

static const char force_header[] = "h,force,stiffness,force_nN";
static const char slip_header[] = "h,stiffness,cap";
static const char pair_header[] = "h_m,force_N,stiffness_N_per_m";

static const struct gb_law_table_law laws[] = {
    {.name = "rod",
     .doc = "elastic force f_e of two spheres, P1 (1)",
     .header = force_header,
     .variable = "h",
     OVERLAPS,
     .values = get_rod},
    {.name = "bridge",
     .doc = "f_e - f_a of a bridged contact; h_min is its deepest overlap\n"
            "(--at h_min=0.02,h=0.012), by default h + bridge_length",
     .header = force_header,
     .variable = "h",
     .h_min = true,
     .bridged = true,
     .low = 0.0,
     .high = 1.0,
     .values = get_bridge,
     .follow = follow_contact},
    {.name = "dispersion",
     .doc = "attraction f_a at distance r, P1 (3)",
     .header = "r,force,force_nN",
     .variable = "r",
     DISTANCES,
     .values = get_dispersion},
    {.name = "normal",
     .doc = "f_e - f_a without a bridge; h below 0 is a gap",
     .header = force_header,
     .variable = "h",
     OVERLAPS,
     .values = get_normal,
     .follow = follow_contact},
    {.name = "shear",
     .doc = "stiffness per half of the relative motion, and cap, no bridge",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_shear},
    {.name = "pivot",
     .doc = "the same for pivoting",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_pivot},
    {.name = "roll",
     .doc = "the same for a bridge whose deepest overlap is h",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_roll},
    {.name = "equilibrium",
     .doc = "overlap where f_e = f_a, and the greatest attraction",
     .header = "h_eq,force_max,force_max_nN",
     .values = get_equilibrium},
    {.name = "bridge-strength",
     .doc = "bridge strength: breaking normal stress at overlap h",
     .header = "h,strength_GPa",
     .variable = "h",
     .bridged = true,
     .low = 0.0,
     .high = 1.0,
     .values = get_strength},
    {.name = "lattice",
     .doc = "density and pressure of a perfect lattice, nearest neighbours",
     .header = "h,density,pressure_GPa",
     .variable = "h",
     OVERLAPS,
     .values = get_lattice},
    {.name = "hertz",
     .doc = "elastic force and stiffness, P3 (2), (9)",
     .header = pair_header,
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = gb_law_pair_hertz,
     .follow = gb_law_pair_follow_hertz},
    {.name = "storakers",
     .doc = "plastic loading, the lesser of Hertz and P3 (16); (16) alone\n"
            "with contact.storakers=printed",
     .header = pair_header,
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = gb_law_pair_storakers,
     .follow = gb_law_pair_follow_storakers},
    {.name = "mindlin",
     .doc = "k_t of Hertz' contact, P3 (12), and its cap mu F",
     .header = "h_m,stiffness_N_per_m,cap_N",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = gb_law_pair_mindlin},
    {.name = "models",
     .doc = "the force by hertz, storakers and as printed, side by side",
     .header = "h_m,hertz_N,storakers_N,printed_N",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = gb_law_pair_models},
    {.name = "critical-step",
     .doc = "the critical time step of the two by each, P3 (27)-(29)",
     .header = "h_m,hertz_s,storakers_s,printed_s",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = gb_law_pair_steps},
    {.name = "yield",
     .doc = "overlap and force where the weaker body starts to flow, P3 (30)",
     .header = "h_m,force_N",
     .pair = true,
     .values = gb_law_pair_yield},
};

const struct gb_law_table_law *gb_law_table_laws(size_t *count)
{
    *count = G_N_ELEMENTS(laws);
    return laws;
}

const struct gb_law_table_lattice *gb_law_table_lattices(size_t *count)
{
    *count = G_N_ELEMENTS(lattices);
    return lattices;
}

const struct gb_law_table_law *gb_law_table_find(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(laws); i++) {
        if (strcmp(laws[i].name, name) == 0) {
            return &laws[i];
        }
    }
    return NULL;
}

const struct gb_law_table_lattice *gb_law_table_find_lattice(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(lattices); i++) {
        if (strcmp(lattices[i].name, name) == 0) {
            return &lattices[i];
        }
    }
    return NULL;
}

int gb_law_table_columns(const struct gb_law_table_law *law)
{
    int columns = 1;
    for (const char *c = law->header; *c != '\0'; c++) {
        columns += *c == ',';
    }
    return columns;
}
