#ifndef GB_STUDY_CALIBRATE_CALIBRATE_H
#define GB_STUDY_CALIBRATE_CALIBRATE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "measure/surrogate.h"

/* Fits free parameters of a noisy simulation to measured values.
 *
 * Around a centre a design of parameters is simulated with the same seeds at every point.
 * Each seed gives a quadratic surrogate of all values; their mean is fitted to the data,
 * the centre moves to the fit, the region shrinks to a few standard errors.  The scatter
 * between seeds at the best fit is the noise of the simulation; it enters the intervals
 * beside the errors of the data.  A coarse stage (small cells) finds the region for the
 * full one. */

enum { GB_CALIBRATE_FREE = 4 };

enum gb_calibrate_stage { GB_CALIBRATE_COARSE, GB_CALIBRATE_FULL };

struct gb_calibrate_problem {
    size_t free;                   /* parameters, 1 to GB_CALIBRATE_FREE */
    double low[GB_CALIBRATE_FREE]; /* limits */
    double high[GB_CALIBRATE_FREE];
    double from[GB_CALIBRATE_FREE]; /* first region */
    double to[GB_CALIBRATE_FREE];
    size_t data; /* measured values, not fewer than free; more without errors */
    const double *value;
    const double *error;  /* standard errors; NULL: from the scatter of the fit */
    const double *weight; /* what a value counts in the fit beside its error; NULL: 1 */
    size_t replicas;      /* seeds, 3 or more */
    bool coarse_stage;    /* false: the full stage only */

    /* Simulates points x free parameters; out[points x replicas x data] gets the values,
     * NaN where a run failed. */
    bool (*simulate)(const double *parameters, size_t points,
                     enum gb_calibrate_stage stage, double *out, void *context,
                     struct gb_error *err);
    /* Called after each round; NULL is fine. */
    void (*progress)(enum gb_calibrate_stage stage, int round, const double *best,
                     const double *half_width, void *context);
    void *context;
};

struct gb_calibrate_result {
    double value[GB_CALIBRATE_FREE];
    double error[GB_CALIBRATE_FREE]; /* standard error; infinite: not determined */
    double low[GB_CALIBRATE_FREE];   /* 95 % interval, within the limits */
    double high[GB_CALIBRATE_FREE];
    bool low_open[GB_CALIBRATE_FREE]; /* it ends at the limit, not in the data */
    bool high_open[GB_CALIBRATE_FREE];
    double correlation[GB_CALIBRATE_FREE][GB_CALIBRATE_FREE];
    bool at_limit[GB_CALIBRATE_FREE]; /* the best fit may lie beyond the limits */
    double *fitted;                   /* data: simulated at the best fit */
    double *fitted_error;             /* their standard errors over the seeds */
    double chi_squared;               /* NaN where the data have no errors */
    double rms;                       /* of the residuals */
    size_t degrees;                   /* data less free */
    size_t simulated, failed;         /* runs */
    bool converged;                   /* the region neither moves nor shrinks any more */
};

/* Errors: GB_ERR_INPUT (too few data), those of simulate, and GB_ERR_GUARD
 * when too many runs failed.  gb_calibrate_finish is due on success. */
bool gb_calibrate_fit(const struct gb_calibrate_problem *problem,
                      struct gb_calibrate_result *result, struct gb_error *err);
void gb_calibrate_finish(struct gb_calibrate_result *result); /* zeroed is fine */

/* Parameters i < j that the data cannot separate: their errors are so correlated that
 * one can stand for the other. */
bool gb_calibrate_confounded(const struct gb_calibrate_result *result, size_t i,
                             size_t j);

#endif
