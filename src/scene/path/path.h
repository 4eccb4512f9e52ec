#ifndef GB_SCENE_PATH_PATH_H
#define GB_SCENE_PATH_PATH_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A loading path, loading.path: a list of legs.  In each leg each of the six components
 * of the cell is controlled by strain or by stress.  One component leads: the others
 * follow its strain.
 *
 * Components are in the order xx, yy, zz, xy, xz, yz (in 2D xx, zz, xz).  Normal
 * strains are logarithmic and, like pressures, positive in compression.  A shear stress
 * has the sign of the engineering shear that causes it, which is opposite to pxy, pxz,
 * pyz. */
enum { GB_PATH_LEGS_MAX = 24, GB_PATH_COMPONENTS = 6, GB_PATH_ENDS_MAX = 2 };

enum gb_leg_control {
    GB_LEG_STRAIN, /* value: strain over the strain of the leading component; 0: fixed */
    GB_LEG_STRESS, /* value: stress to hold, Pa; NaN: as the leg begins */
    GB_LEG_RATIO,  /* value: stress over the stress of `of`; NaN: ratio at the start */
    GB_LEG_FOLLOW  /* value: change of stress since the start, over the change of `of` */
};

struct gb_leg_component {
    enum gb_leg_control control;
    double value;
    int of;
};

enum gb_leg_end_kind {
    GB_LEG_END_STEPS,    /* recorded points */
    GB_LEG_END_STRAIN,   /* strain of the leading component since the leg began */
    GB_LEG_END_DENSITY,  /* relative density */
    GB_LEG_END_PRESSURE, /* mean of the components moved by strain (all alike), Pa */
    GB_LEG_END_STRESS,   /* of component `of`, Pa */
    GB_LEG_END_MEAN,     /* p = tr/3 (2D: tr/2), Pa */
    GB_LEG_END_Q,        /* sqrt(3/2 s:s), Pa */
    GB_LEG_END_RATIO     /* q/p */
};

struct gb_leg_end {
    enum gb_leg_end_kind kind;
    double value;
    int of;
};

enum { GB_LEG_TEXT = 120 };

struct gb_leg {
    char text[GB_LEG_TEXT]; /* as typed, with one blank between words */
    struct gb_leg_component component[GB_PATH_COMPONENTS];
    int leading;    /* component; -1: none, stresses are only held */
    bool extension; /* direction if the end does not define it: q and q/p */
    int end_count;  /* the leg ends at the first of these that is reached ... */
    struct gb_leg_end end[GB_PATH_ENDS_MAX];
    int cycles; /* ... or cycles between end[0] and end[1] this many times; 0: no cycle */
};

struct gb_path {
    int count;
    struct gb_leg leg[GB_PATH_LEGS_MAX];
};

/* Reads "isotropic to 50 MPa; shear xz to 20 % at z = 50 MPa; unload".  Legs are
 * separated by ';' or the word `then`.  Empty text: no legs.  Errors: GB_ERR_INPUT
 * naming the leg and what is expected; path is undefined then. */
bool gb_path_parse(struct gb_path *path, const char *text, int dimension,
                   struct gb_error *err);

/* Adds one leg to the path.  Errors: GB_ERR_INPUT with what is wrong and expected,
 * without naming the leg; path does not change then. */
bool gb_path_parse_leg(struct gb_path *path, const char *text, int dimension,
                       struct gb_error *err);
/* Splits a path into the texts of its legs, without blanks at their ends; g_strfreev. */
char **gb_path_parse_split(const char *text);

/* Does the component exist in 2 or 3 dimensions? */
bool gb_path_has_component(int dimension, int component);
/* Name of a component: "x", "y", "z", "xy", "xz", "yz". gb_path_component_find returns
 * the component with a name of `length` characters ("zz" is "z"); -1: none. */
const char *gb_path_component_name(int component);
int gb_path_component_find(const char *name, size_t length);

/* The main strained component of the path: the sheared one, or the leading axis; z if
 * no leg has one. */
int gb_path_strained(const struct gb_path *path);

/* True if a leg tilts the cell. */
bool gb_path_sheared(const struct gb_path *path);
/* Axes whose mean pressure is p_MPa of the curve, an enum gb_geometry: the axes that
 * strain moves in the first leg, or all axes if it holds a stress or shears. */
int gb_path_geometry(const struct gb_path *path, int dimension);

/* Row `index` of the table of shorthands, as "triaxial to END [at STRESS]" and a
 * sentence; false after the last. */
bool gb_path_parse_shorthand(int index, const char **usage, const char **doc);

#endif
