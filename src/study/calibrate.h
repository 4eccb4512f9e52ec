#ifndef GB_STUDY_CALIBRATE_H
#define GB_STUDY_CALIBRATE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/fit/surrogate.h"

/* Fits free parameters of a noisy simulation to measured values.
 *
 * Around a centre a design of parameters is simulated with the same seeds at every point.
 * Each seed gives a quadratic surrogate of all values; their mean is fitted to the data,
 * the centre moves there, the region shrinks to a few standard errors.  What seeds differ
 * by at the best fit is the noise of the simulation; it goes into the intervals beside
 * the errors of the data.  First on a cheap stage (small cells) to find the place, then
 * on the full one. */

enum { GB_CALIBRATE_FREE = GB_SURROGATE_VARIABLES, GB_CALIBRATE_STAGES = 2 };

struct gb_calibrate_problem {
    size_t free;                   /* parameters, 1 to GB_CALIBRATE_FREE */
    double low[GB_CALIBRATE_FREE]; /* never left */
    double high[GB_CALIBRATE_FREE];
    double from[GB_CALIBRATE_FREE]; /* first region */
    double to[GB_CALIBRATE_FREE];
    size_t data; /* measured values, not fewer than free; more without errors */
    const double *value;
    const double *error; /* standard errors; NULL: from the scatter of the fit */
    size_t replicas;     /* seeds, 3 or more */
    bool coarse;         /* is there a cheap stage? */

    /* Simulates points x free parameters; out[points x replicas x data] gets the values,
     * NaN where a run failed.  stage 0 is the cheap one, 1 the full. */
    bool (*simulate)(const double *parameters, size_t points, int stage, double *out,
                     void *context, struct gb_error *err);
    /* After every round; NULL is fine. */
    void (*told)(int stage, int round, const double *best, const double *half_width,
                 void *context);
    void *context;
};

struct gb_calibrate_result {
    double value[GB_CALIBRATE_FREE];
    double error[GB_CALIBRATE_FREE]; /* standard error; infinite: not determined */
    double low[GB_CALIBRATE_FREE];   /* 95 % interval */
    double high[GB_CALIBRATE_FREE];
    double correlation[GB_CALIBRATE_FREE][GB_CALIBRATE_FREE];
    bool at_limit[GB_CALIBRATE_FREE]; /* the fit wants to leave the allowed range */
    double *fitted;                   /* data: simulated at the best fit */
    double *fitted_error;             /* their standard errors over the seeds */
    double chi_squared;               /* NaN where the data have no errors */
    double rms;                       /* of the residuals */
    size_t degrees;                   /* data less free */
    size_t simulated, failed;         /* runs */
    bool settled;                     /* the region stopped shrinking and moving */
};

/* Errors: GB_ERR_INPUT (too few data), those of simulate, and GB_ERR_GUARD
 * when too many runs failed to go on.  gb_calibrate_finish is due on success. */
bool gb_calibrate_fit(const struct gb_calibrate_problem *problem,
                      struct gb_calibrate_result *result, struct gb_error *err);
void gb_calibrate_finish(struct gb_calibrate_result *result); /* zeroed is fine */

/* Parameters i < j that the data cannot tell apart: their errors are so correlated that
 * one can stand for the other. */
bool gb_calibrate_confused(const struct gb_calibrate_result *result, size_t i, size_t j);

#endif
