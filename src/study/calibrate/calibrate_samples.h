#ifndef GB_STUDY_CALIBRATE_CALIBRATE_SAMPLES_H
#define GB_STUDY_CALIBRATE_CALIBRATE_SAMPLES_H

#include "study/calibrate/calibrate.h"

/* The region of parameters in which a fit is sought. */
struct gb_calibrate_region {
    double centre[GB_CALIBRATE_FREE];
    double half[GB_CALIBRATE_FREE]; /* half widths */
};

/* All points simulated so far, of both stages. */
struct gb_calibrate_samples {
    const struct gb_calibrate_problem *problem;
    size_t count, capacity;
    double *at;    /* count x free: parameters */
    double *value; /* count x replicas x data */
    enum gb_calibrate_stage *stage;
};

/* Simulates the design of a region, as far as it is new, and counts runs and failures in
 * result.  gb_calibrate_samples_finish is due. */
bool gb_calibrate_samples_add(struct gb_calibrate_samples *samples,
                              const struct gb_calibrate_region *region,
                              enum gb_calibrate_stage stage,
                              struct gb_calibrate_result *result, struct gb_error *err);
void gb_calibrate_samples_finish(struct gb_calibrate_samples *samples);

/* Points of a stage near the region where a seed did not fail: at (in half widths from the
 * centre) and values; both have room for all samples.  Returns their number. */
size_t gb_calibrate_samples_near(const struct gb_calibrate_samples *samples,
                                 const struct gb_calibrate_region *region,
                                 enum gb_calibrate_stage stage, size_t seed, double *at,
                                 double *value);

#endif
