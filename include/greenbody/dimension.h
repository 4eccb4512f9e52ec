#ifndef GREENBODY_DIMENSION_H
#define GREENBODY_DIMENSION_H

/* Physical dimension of a number in a preset or on the screen, with its possible units.
 * Numbers in memory are in SI units.  A unit of another dimension is an error. */
enum gb_dimension {
    GB_DIM_NONE,         /* pure number; no unit */
    GB_DIM_FRACTION,     /* "0.1 %" or "0.001" */
    GB_DIM_LENGTH,       /* m, mm, um, nm, A(ngstrom), pm */
    GB_DIM_PRESSURE,     /* Pa, kPa, MPa, GPa */
    GB_DIM_TIME,         /* s, ms, us, ns, ps, fs, min, h */
    GB_DIM_RATE,         /* 1/s, 1/ms, 1/us, 1/ns, 1/ps */
    GB_DIM_MASS_DENSITY, /* kg/m3, g/cm3 */
    GB_DIM_ENERGY,       /* J, eV, kB (times one kelvin: "1224 kB") */
    GB_DIM_VISCOSITY,    /* Pa s, mPa s */
    GB_DIM_FORCE,        /* MN, kN, N, mN, uN, nN */
    GB_DIM_SPEED,        /* m/s, mm/s */
    GB_DIM_MASS,         /* kg, g, mg */
    GB_DIM_AREA,         /* m2, cm2, mm2 */
    GB_DIM_COMPLIANCE    /* m/N, mm/N, um/N, mm/kN, um/kN */
};

#endif
