#ifndef GB_LAW_LAW_SLIP_H
#define GB_LAW_LAW_SLIP_H

#include "law/law_bridge.h"
#include "law/law_rod.h"

/* Shear (4), (5), pivoting (6)-(11) and rolling (12) of P1: three springs with one
 * stick-slip rule.  Stiffnesses refer to half of the relative motion, which is P1's
 * displacement and angle of the contact area.  Reduced units. */
struct gb_law_slip {
    double shear;    /* 4 / ((2-nu)(1+nu)); times a: stiffness */
    double pivot;    /* 8 / (3 (1+nu)); times a^3 */
    double roll;     /* 4 / (3 (1-nu^2)); times a_ch^3 */
    double mu;       /* Coulomb cap of shear, mu f_e */
    double mu_pivot; /* cap of pivoting, mu_f M(a) */
    double strength; /* sigma_b, E */
    double motion;   /* loads a spring per relative motion: 1/2, or 1 ("full") */
};

/* Sets the factors. mu, mu_pivot and motion are pure numbers; strength is in E.
 * Source: P1 (4), (6), (12). */
void gb_law_slip_init(struct gb_law_slip *law, double poisson, double mu, double mu_pivot,
                      double strength, double motion);

/* Stiffnesses at contact radius a (d; a_ch for a bridge): shear in E d, pivoting and
 * rolling in E d^3 per radian.  Source: P1 (4), (6), (12). */
double gb_law_slip_shear_stiffness(const struct gb_law_slip *law, double a);
double gb_law_slip_pivot_stiffness(const struct gb_law_slip *law, double a);
double gb_law_slip_roll_stiffness(const struct gb_law_slip *law, double a);

/* Caps of a bridge with radius a.  They are also the limits that sigma_b sets for a
 * contact of radius a without a bridge. */
double gb_law_slip_bridge_shear_cap(const struct gb_law_slip *law, double a);
double gb_law_slip_bridge_pivot_cap(const struct gb_law_slip *law, double a);

/* Cap of the rolling moment of a bridge (E d^3), a_ch max(f_e, 0) / 3.  Source: P1
 * (12). */
double gb_law_slip_roll_cap(double a, double force);

/* Caps of a contact without a bridge at overlap h (d): shear force in E d^2, pivoting
 * moment in E d^3; 0 for h <= 0.  Source: P1 (5), (8)-(11). */
double gb_law_slip_shear_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h);
double gb_law_slip_pivot_cap(const struct gb_law_slip *law, const struct gb_law_rod *rod,
                             double h);

#endif
