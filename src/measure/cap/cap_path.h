#ifndef GB_MEASURE_CAP_CAP_PATH_H
#define GB_MEASURE_CAP_CAP_PATH_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/cap/cap.h"

/* The card as a material: a rate law of isotropic elasticity with the Drucker-Prager cap,
 * driven by strains.  Its parameters depend on the relative density, which follows the
 * strain (ln of the density grows by the volumetric strain); p_b depends on the plastic
 * volumetric strain, *CAP HARDENING.  All are linear between the rows and constant beyond
 * them. */
struct gb_cap_row {
    double density;
    double bulk, shear_modulus; /* K and G, Pa */
    struct gb_cap cap;          /* p_a of this row is not used: p_b gives it */
    double p_b;                 /* Pa, ascending */
    double plastic_volume;      /* plastic volumetric strain at p_b, ascending */
};

struct gb_cap_material {
    const struct gb_cap_row *row; /* ascending densities, 1 or more */
    size_t count;
};

/* Components in the order xx, yy, zz, xy, xz, yz.  Pressures, Pa. */
struct gb_cap_state {
    double pressure[6];
    double density;
    double plastic_volume; /* compression positive */
    double plastic_shear;  /* equivalent plastic strain */
};

/* Parameters at a density; the cap ends at the p_b of the plastic volumetric strain. */
struct gb_cap_row gb_cap_path_at(const struct gb_cap_material *material, double density,
                                 double plastic_volume);
/* Errors: GB_ERR_INPUT naming the row: order, moduli, cohesion, R, beta. */
bool gb_cap_path_check(const struct gb_cap_material *material, struct gb_error *err);

/* Strains the material: elastic prediction, return to the surface along the plastic flow.
 * On the cap the return is implicit in stress and hardening; on the shear failure and
 * transition surfaces p_a is that of the beginning of the sub-step.
 *
 * strain   increments, compression positive; the last three engineering shears with the
 *          sign of the pressures that they cause
 * The increment is taken in equal sub-steps of at most GB_CAP_SUBSTEP (scene/tolerances.h).
 * Errors: GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_cap_path_strain(const struct gb_cap_material *material,
                        struct gb_cap_state *state, const double strain[6],
                        struct gb_error *err);

/* p and q of pressures. */
double gb_cap_path_mean(const double pressure[6]);
double gb_cap_path_deviator(const double pressure[6]);

#endif
