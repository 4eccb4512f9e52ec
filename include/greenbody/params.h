#ifndef GREENBODY_PARAMS_H
#define GREENBODY_PARAMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* What the user typed: SI, unit in the field's name.  Const after gb_params_check.  The
 * reduced twin is struct gb_model; the two never meet.
 * One row per field in the field table (phys/params.c): preset files, --set, the editor,
 * `greenbody params` and the run directory follow from it. */

enum gb_kind { GB_KIND_QUASISTATIC, GB_KIND_DYNAMIC };
enum gb_distribution { GB_DISTRIBUTION_MONO };
enum gb_normal { GB_NORMAL_ROD };
enum gb_bridge_radius { GB_BRIDGE_RADIUS_DEEPEST, GB_BRIDGE_RADIUS_CURRENT };
enum gb_relative_motion { GB_MOTION_HALF, GB_MOTION_FULL };
enum gb_geometry { GB_GEOMETRY_UNIAXIAL, GB_GEOMETRY_BIAXIAL, GB_GEOMETRY_ISOTROPIC };
enum gb_fidelity { GB_FIDELITY_FAST, GB_FIDELITY_BALANCED, GB_FIDELITY_REFERENCE };

enum { GB_UNLOAD_MAX = 16 };

/* A quantity given either in SI or as a multiple of the particle diameter ("0.008 d"), of
 * Young's modulus ("0.018 E") or of the reduced time ("0.04 T").  Kept as typed, so that
 * changing the diameter keeps its meaning. */
struct gb_relative {
    double value; /* SI, or the multiple */
    bool relative;
};

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
    /* [particles] */
    int64_t count;
    double diameter_m;
    int distribution; /* enum gb_distribution */
    /* [contact] */
    int normal; /* enum gb_normal */
    double alpha;
    double mu;
    double mu_pivot; /* NaN in memory: follows mu ("auto" in files) */
    struct gb_relative bridge_length;
    struct gb_relative shear_strength; /* NaN: auto, by whether there are bridges */
    int bridge_radius;                 /* enum gb_bridge_radius */
    int relative_motion;               /* enum gb_relative_motion */
    double viscosity_pa_s;             /* dynamic scenes */
    /* [structure] */
    double structure_density; /* NaN: auto, gb_params_structure_density */
    struct gb_relative base;  /* relative with value 0: auto, P1's aspect ratio */
    struct gb_relative r_meso;
    uint64_t seed;
    /* [loading] */
    int geometry; /* enum gb_geometry */
    double strain_step;
    double until_pressure_pa; /* NaN when the run stops at a density */
    double until_density;     /* NaN when the run stops at a pressure */
    double unload_from_pa[GB_UNLOAD_MAX];
    int unload_count;
    double rate_per_s; /* (1/rho) d rho/dt; this and the next four: dynamic scenes */
    double relax_s, hold_s;
    double record_density; /* relative growth of density between recorded points */
    double record_time_s;  /* between recorded points of relax and hold */
    /* [numerics]: NaN or negative means "auto", picked by fidelity when the model is made
     */
    int fidelity;     /* enum gb_fidelity */
    char relaxer[24]; /* name in the relaxer table, or "auto" */
    double tolerance;
    struct gb_relative cutoff;
    int64_t threads;
    int64_t max_evaluations;      /* per strain step */
    struct gb_relative time_step; /* dynamic scenes; NaN: auto */
    double step_error;            /* what auto may err by */
    /* [output] */
    double checkpoint_every_s;
};

/* How a field is read and written. */
enum gb_field_type {
    GB_FIELD_NUMBER,   /* double, unit by dimension */
    GB_FIELD_RELATIVE, /* struct gb_relative */
    GB_FIELD_INTEGER,  /* int64_t */
    GB_FIELD_SEED,     /* uint64_t */
    GB_FIELD_CHOICE,   /* int, one of choices */
    GB_FIELD_TEXT,     /* char[] */
    GB_FIELD_UNTIL,    /* pressure, or "density = x": until_pressure_pa / until_density */
    GB_FIELD_PRESSURES /* list separated by ';' */
};

struct gb_field {
    const char *group; /* "contact" */
    const char *key;   /* "mu" */
    enum gb_field_type type;
    size_t offset;
    size_t size;          /* of the member, for text */
    int dimension;        /* enum gb_dimension of base/units.h */
    const char *relative; /* "d", "E" or "T" for GB_FIELD_RELATIVE */
    double min, max;      /* inclusive, in SI (for relative fields: of the multiple) */
    bool auto_allowed;    /* "auto" is a value */
    double automatic;     /* what "auto" is in memory */
    const char *const *choices; /* NULL-terminated, for GB_FIELD_CHOICE (numbers stand for
                                 * themselves, names for their index) and closed texts */
    const char *fallback;       /* default as typed in a preset */
    const char *meaning;        /* one sentence */
    const char *source;         /* paper and equation, or "numerical" */
};

/* The field table and its length. */
const struct gb_field *gb_params_fields(size_t *count);

/* Row of "group.key", or NULL. */
const struct gb_field *gb_params_find(const char *group, const char *key);

/* Every field at its fallback. */
void gb_params_init(struct gb_params *params);

/* Reads text into one field.  On error params is untouched and err says what was given
 * and what is accepted (the caller adds file, line and key). */
bool gb_params_set(struct gb_params *params, const struct gb_field *field,
                   const char *text, struct gb_error *err);

/* Writes the value as a preset would ("9.7 nm", "0.008 d", "auto").  Returns buffer. */
char *gb_params_format(const struct gb_params *params, const struct gb_field *field,
                       char *buffer, size_t size);

/* What the field accepts: "0 to 2", "auto, or 1 nm to 1 mm".  Returns buffer. */
char *gb_params_accepted(const struct gb_field *field, char *buffer, size_t size);

/* "group.key=value" as on the command line. */
bool gb_params_assign(struct gb_params *params, const char *assignment,
                      struct gb_error *err);

/* Checks what no single field can know: cell against cutoff, unload against until,
 * dimension against geometry, finite numbers.  Errors name the keys. */
bool gb_params_check(const struct gb_params *params, struct gb_error *err);

/* Resolved lengths and pressures, SI. */
double gb_params_bridge_length_m(const struct gb_params *params);
double gb_params_shear_strength_pa(const struct gb_params *params);
/* Density of the initial structure; auto is 0.24 in 3D and 0.5 in 2D (P1, P2). */
double gb_params_structure_density(const struct gb_params *params);

/* The reduced unit of time T = sqrt(m/(E d)) = sqrt(pi rho_m d^2/(6 E)), 0.74 ps for
 * alumina of 10 nm.  Source: P2 section 2. */
double gb_params_unit_time_s(const struct gb_params *params);
/* Time step of dynamic scenes; NaN: auto. */
double gb_params_time_step_s(const struct gb_params *params);

/* Edges of the initial cell in particle diameters (x, y, z); y is 1 in 2D, where the
 * scene lies in the x-z plane.  base = auto: in 3D the aspect ratio of P1's cells (18 x
 * 18 x 53.87 for 8000 particles), in 2D a square. */
void gb_params_cell(const struct gb_params *params, double edges[3]);

#endif
