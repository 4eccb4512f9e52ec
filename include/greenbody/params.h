#ifndef GREENBODY_PARAMS_H
#define GREENBODY_PARAMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/dimension.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parameters of a scene as the user gives them, in SI units; the name of a member ends
 * with its unit.  They are constant after gb_params_check.
 *
 * The field table has one row per preset key.  Preset files, --set, the editor,
 * `greenbody params` and the run directory use this table.  P1, P2 and P3 are the
 * papers that the presets name. */

enum gb_kind { GB_KIND_QUASISTATIC, GB_KIND_DYNAMIC, GB_KIND_DIE };
enum gb_distribution {
    GB_DISTRIBUTION_MONO,
    GB_DISTRIBUTION_LOGNORMAL,
    GB_DISTRIBUTION_TABLE
};
enum gb_normal {
    GB_NORMAL_ROD,
    GB_NORMAL_HERTZ,
    GB_NORMAL_STORAKERS,
    GB_NORMAL_LAWS /* number of laws */
};
enum gb_storakers { GB_STORAKERS_CAPPED, GB_STORAKERS_PRINTED };
enum gb_structure {
    GB_STRUCTURE_GROWN,
    GB_STRUCTURE_SC,
    GB_STRUCTURE_FCC,
    GB_STRUCTURE_BCC,
    GB_STRUCTURE_DIAMOND,
    GB_STRUCTURE_SQUARE,
    GB_STRUCTURE_HEXAGONAL
};
enum gb_bridge_radius { GB_BRIDGE_RADIUS_DEEPEST, GB_BRIDGE_RADIUS_CURRENT };
enum gb_relative_motion { GB_MOTION_HALF, GB_MOTION_FULL };
/* Forces that have a viscous partner. */
enum gb_viscous_forces {
    GB_VISCOUS_ALL,
    GB_VISCOUS_TRANSLATION, /* without rolling and pivoting */
    GB_VISCOUS_NORMAL
};
enum gb_geometry {
    GB_GEOMETRY_UNIAXIAL,
    GB_GEOMETRY_BIAXIAL,
    GB_GEOMETRY_ISOTROPIC,
    GB_GEOMETRY_DIE
};
enum gb_die_cycle { GB_DIE_CYCLE_PRESS, GB_DIE_CYCLE_FULL };
enum gb_ramp { GB_RAMP_AUTO, GB_RAMP_LINEAR, GB_RAMP_QUADRATIC };
/* Unit of numerics.tolerance: the mean contact force; the attraction at contact; or the
 * equilibrium overlap d - r_eq, for the largest displacement of P1 (15). */
enum gb_tolerance_scale {
    GB_TOLERANCE_CONTACT,
    GB_TOLERANCE_ATTRACTION,
    GB_TOLERANCE_DISPLACEMENT
};
enum gb_precision { GB_PRECISION_AUTO, GB_PRECISION_DOUBLE, GB_PRECISION_SINGLE };
enum gb_fidelity { GB_FIDELITY_FAST, GB_FIDELITY_BALANCED, GB_FIDELITY_REFERENCE };
/* What a loading path does if a stress has no equilibrium. */
enum gb_on_collapse { GB_COLLAPSE_STOP, GB_COLLAPSE_STRAIN };
/* Formats of io/export.h, in the same order. */
enum gb_live_format {
    GB_LIVE_NONE,
    GB_LIVE_EXTXYZ,
    GB_LIVE_LAMMPS_DUMP,
    GB_LIVE_LAMMPS_DATA,
    GB_LIVE_CSV,
    GB_LIVE_VTKHDF
};
enum gb_on_hangup { GB_ON_HANGUP_DETACH, GB_ON_HANGUP_STOP };

enum { GB_UNLOAD_MAX = 16, GB_SIZES_MAX = 128 };

/* Buffer size for any value that gb_params_format writes.  The longest is a full table of
 * sizes. */
enum { GB_PARAMS_VALUE_MAX = 8192 };

/* A quantity in SI units, or a multiple of the particle diameter ("0.008 d"), of
 * Young's modulus ("0.018 E") or of the reduced time ("0.04 T").  A multiple stays a
 * multiple when the diameter changes. */
struct gb_relative {
    double value; /* SI, or the multiple */
    bool relative;
};

/* One size of a powder. */
struct gb_sizetable_row {
    double diameter_m;
    double fraction; /* the fractions of a table sum to 1 within 0.002 */
};

/* Sizes of a powder with their fractions, diameters ascending. */
struct gb_sizetable {
    int count;      /* 0: no table */
    bool by_volume; /* fractions by volume, not by number */
    struct gb_sizetable_row row[GB_SIZES_MAX];
};

/* A packing in a file. */
struct gb_packing_file {
    char path[512]; /* "": none */
    uint64_t sum;   /* checksum of the packing, not of the file */
};

/* Members are in the order of the groups of a preset.  The comment of an int names its
 * enum. */
struct gb_params {
    /* [scene] */
    char title[128];
    int kind;      /* enum gb_kind */
    int dimension; /* 3 or 2 */
    /* [material] */
    char material[64];
    double young_pa;
    double poisson;
    double density_kg_m3;
    double d0_m;
    double n_d0_cubed;
    double epsilon_j;
    double yield_pa;
    double hardening;   /* exponent m */
    double hollomon_pa; /* NaN: auto, through the yield point */
    double young_j_pa;  /* this and the next three: the second body of a pair; */
    double poisson_j;   /* NaN: as the first */
    double density_j_kg_m3;
    double yield_j_pa;
    /* [particles] */
    int64_t count;
    double diameter_m;
    int distribution;                      /* enum gb_distribution */
    double median_m;                       /* of lognormal; NaN: auto, diameter_m */
    double sigma;                          /* of lognormal: deviation of ln d */
    double diameter_min_m, diameter_max_m; /* limits of lognormal; NaN: none */
    struct gb_sizetable sizes;             /* of table */
    /* [contact] */
    int normal; /* enum gb_normal */
    double alpha;
    double mu;
    double mu_wall;  /* of the walls of a die */
    double mu_pivot; /* NaN: auto, as mu */
    struct gb_relative bridge_length;
    struct gb_relative shear_strength; /* NaN: auto, differs with and without bridges */
    int bridge_radius;                 /* enum gb_bridge_radius */
    int relative_motion;               /* enum gb_relative_motion */
    double viscosity_pa_s;             /* dynamic scenes */
    int viscous_forces;                /* enum gb_viscous_forces */
    double damping;                    /* xi, fraction of critical damping */
    double shear_ratio;                /* k_t/k_n of plastic contacts */
    int storakers;                     /* enum gb_storakers */
    double radius_i_m, radius_j_m;     /* of a pair; NaN: d/2, infinite: a wall */
    /* [structure] */
    int structure; /* enum gb_structure */
    struct gb_packing_file from;
    double overlap;           /* of nearest neighbours in a lattice, h/d */
    double structure_density; /* NaN: auto, 0.24 in 3D, 0.5 in 2D */
    struct gb_relative base;  /* relative and 0: auto, aspect ratio of P1 */
    struct gb_relative r_meso;
    double single_contact; /* fraction of particles placed in contact with one other */
    uint64_t seed;
    /* [die] */
    double die_diameter_m;
    double die_height_m;   /* of the outlet of the funnel above the floor; NaN: auto */
    double die_outlet_m;   /* diameter of the outlet; NaN: auto */
    double die_angle_deg;  /* between the wall of the funnel and the axis */
    double fill_gravity;   /* while pouring, in g = 9.80665 m/s2 */
    double rest_gravity;   /* after pouring, in g */
    double gravity_ramp_s; /* time between the two gravities */
    double flatten_m;
    double punch_mass; /* in masses of the powder */
    double central_m;  /* diameter of the sphere in which central density is measured */
    int die_cycle;     /* enum gb_die_cycle */
    double eject_m_s;
    double weld_strength_pa; /* 0: no cold welds */
    /* [loading] */
    int geometry; /* enum gb_geometry */
    double strain_step;
    double until_pressure_pa; /* NaN: the run stops at a density */
    double until_density;     /* NaN: the run stops at a pressure */
    double unload_from_pa[GB_UNLOAD_MAX];
    int unload_count;
    char path[512];    /* the legs of a loading path; empty: the keys above */
    int on_collapse;   /* enum gb_on_collapse */
    char changes[768]; /* "120 contact.mu=0.3; ...": changes after recorded steps */
    double rate_per_s; /* (1/rho) d rho/dt; this and the next four: dynamic scenes */
    double relax_s, hold_s;
    double record_density;     /* relative growth of density between recorded points */
    double record_time_s;      /* between recorded points of relax and hold */
    int ramp;                  /* enum gb_ramp; this and the next two: dies */
    double ramp_s;             /* NaN: auto */
    double record_pressure_pa; /* between recorded points */
    double unload_s;           /* this and rest_s: dies; NaN: auto */
    double rest_s;
    /* [numerics]: NaN or negative is "auto"; fidelity sets the value when the model is
     * frozen. */
    int fidelity;     /* enum gb_fidelity */
    char relaxer[24]; /* name in the relaxer table, or "auto" */
    double tolerance;
    int tolerance_scale; /* enum gb_tolerance_scale */
    double strain_part;  /* largest strain relaxed at once */
    struct gb_relative cutoff;
    int precision; /* enum gb_precision */
    int64_t threads;
    int64_t max_evaluations;      /* per strain step */
    struct gb_relative time_step; /* dynamic scenes; NaN: auto */
    double step_error;            /* error that an automatic time step may make */
    double safety;                /* of the automatic step of a die; NaN: auto */
    double inertia_scale; /* factor of the rotational inertia of particles in a die */
    /* [output] */
    char snapshots_at[192]; /* "100 MPa; density = 0.5; every 20" */
    int export_format;      /* enum gb_live_format, for the kept states */
    double checkpoint_every_s;
    int on_hangup; /* enum gb_on_hangup */
};

/* Type of a field: how it is read and written. */
enum gb_field_type {
    GB_FIELD_NUMBER,   /* double, unit by dimension */
    GB_FIELD_RELATIVE, /* struct gb_relative */
    GB_FIELD_INTEGER,  /* int64_t */
    GB_FIELD_SEED,     /* uint64_t */
    GB_FIELD_CHOICE,   /* int, one of choices */
    GB_FIELD_TEXT,     /* char[] */
    GB_FIELD_UNTIL,    /* pressure, or "density = x": until_pressure_pa / until_density */
    GB_FIELD_PRESSURES, /* list separated by ';' */
    GB_FIELD_SIZES,     /* struct gb_sizetable: a CSV file, or the table in one line */
    GB_FIELD_PACKING    /* struct gb_packing_file; also sets count and sizes */
};

/* A row of the field table. */
struct gb_field {
    const char *group; /* "contact" */
    const char *key;   /* "mu" */
    enum gb_field_type type;
    size_t offset;
    size_t size;          /* of the member; for texts */
    int dimension;        /* enum gb_dimension */
    const char *relative; /* "d", "E" or "T" for GB_FIELD_RELATIVE */
    double min, max;      /* inclusive, in SI units; relative fields: of the multiple */
    const char *infinite; /* word for an infinite number, or NULL */
    bool auto_allowed;    /* "auto" is a valid value */
    double automatic;     /* value of "auto" in memory */
    /* NULL-terminated; for GB_FIELD_CHOICE and texts with a fixed list.  The value of a
     * number is the number, and the value of a name is its index. */
    const char *const *choices;
    const char *fallback; /* default as typed in a preset */
    const char *meaning;  /* one sentence */
    const char *source;   /* paper and equation, or "numerical" */
    /* Markup with <i>, <sub> and <sup>, quantities in italics (ISO 80000-1); NULL:
     * none. */
    const char *symbol;
    const char *words; /* synonyms, "friction, sliding friction"; NULL: none */
    unsigned kinds;    /* bits of enum gb_kind that use the key; 0: all */
    unsigned laws;     /* bits of enum gb_normal that use the key; 0: all */
    bool (*applies)(const struct gb_params *params); /* further condition; NULL: none */
    bool may_change; /* during a run, by loading.changes */
    bool no_result;  /* changes no result: runs resume with another value */
};

/* The field table and its length. */
const struct gb_field *gb_params_fields(size_t *count);

/* Row of "group.key", or NULL. */
const struct gb_field *gb_params_find(const char *group, const char *key);

/* Row of "group.key", or of "key" if only one group has it.  NULL if there is none;
 * err is then GB_ERR_INPUT and lists the possible keys. */
const struct gb_field *gb_params_find_name(const char *name, struct gb_error *err);

/* Sets every field to its default. */
void gb_params_init(struct gb_params *params);

/* Reads text into one field.  On error params does not change, and err has the given text
 * and what is expected; the caller adds file, line and key. */
bool gb_params_set(struct gb_params *params, const struct gb_field *field,
                   const char *text, struct gb_error *err);

/* Writes a value as in a preset: "9.7 nm", "0.008 d", "auto".  Returns buffer. */
char *gb_params_format(const struct gb_params *params, const struct gb_field *field,
                       char *buffer, size_t size);

/* Writes the expected values of a field: "0 to 2", "auto, or 1 nm to 1 mm".  Returns
 * buffer. */
char *gb_params_accepted(const struct gb_field *field, char *buffer, size_t size);

/* Sets a field from "group.key=value", or from "key=value" if only one group has the key,
 * as on the command line.  Errors: GB_ERR_INPUT; params does not change then. */
bool gb_params_assign(struct gb_params *params, const char *assignment,
                      struct gb_error *err);

/* Checks each field and the relations between fields, such as cell and cutoff, unload and
 * until, dimension and geometry.  Errors: GB_ERR_INPUT naming the keys. */
bool gb_params_check(const struct gb_params *params, struct gb_error *err);

/* Checks each field alone, without relations: for the parameters of a contact law
 * without a scene.  Errors: GB_ERR_INPUT naming the key. */
bool gb_params_check_fields(const struct gb_params *params, struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
