#ifndef GREENBODY_STAGE_H
#define GREENBODY_STAGE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Stages of a run in a die, in their order. */
enum gb_stage {
    GB_STAGE_NONE, /* a run without stages, or after the last one */
    GB_STAGE_FILLING,
    GB_STAGE_SETTLING,   /* poured, but not yet at rest */
    GB_STAGE_EASING,     /* gravity falls to its value for flattening */
    GB_STAGE_RESETTLING, /* under the lower gravity */
    GB_STAGE_FLATTENING,
    GB_STAGE_LIFTING, /* of the flattening punch */
    GB_STAGE_RESTING,
    GB_STAGE_PRESS,
    GB_STAGE_UNLOADING,
    GB_STAGE_WITHDRAWAL, /* of the punch */
    GB_STAGE_CONFINED,   /* rest in the die */
    GB_STAGE_EJECTION,
    GB_STAGE_EJECTED, /* rest outside the die */
    GB_STAGES
};

/* Quantity by which a stage ends. */
enum gb_stage_measure {
    GB_STAGE_MEASURE_NONE,
    GB_STAGE_MEASURE_POURED,     /* particles below the funnel */
    GB_STAGE_MEASURE_KINETIC,    /* kinetic energy / its limit at rest */
    GB_STAGE_MEASURE_UNBALANCED, /* unbalanced force / its limit at rest */
    GB_STAGE_MEASURE_GRAVITY,    /* gravity / gravity at rest */
    GB_STAGE_MEASURE_TRAVEL,     /* of the punch or of the compact, m */
    GB_STAGE_MEASURE_PRESSURE,   /* of the punch, Pa */
    GB_STAGE_MEASURE_TIME,       /* simulated, s */
    GB_STAGE_MEASURES
};

/* Progress of a run before, between and after its recorded points.  NaN: unknown. */
struct gb_stage_report {
    enum gb_stage stage;
    enum gb_stage_measure measure;
    double value, goal; /* of the measure; the stage ends near the goal */
    double share;       /* fraction of the stage that is done, 0..1 */
    /* Fraction done of the stages with a fixed simulated time, 0..1.  NaN before them,
     * because the time until the powder is at rest is unknown. */
    double timed;
    int64_t poured;  /* particles */
    double time_s;   /* simulated, since the start */
    double height_m; /* of the powder in the die */
    double kinetic_j;
    double coordination;
};

#ifdef __cplusplus
}
#endif

#endif
