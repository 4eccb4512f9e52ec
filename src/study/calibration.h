#ifndef GB_STUDY_CALIBRATION_H
#define GB_STUDY_CALIBRATION_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/listing.h"
#include "greenbody/params.h"
#include "greenbody/status.h"
#include "io/preset.h"
#include "many/compaction_data.h"
#include "many/ensemble.h"
#include "measure/surrogate.h"

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
    const double *error; /* standard errors; NULL: from the scatter of the fit */
    const double
        *weight;     /* weight of a value in the fit, in addition to its error; NULL: 1 */
    size_t replicas; /* seeds, 3 or more */
    bool coarse_stage; /* false: the full stage only */

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
 * when too many runs failed.  After success gb_calibration_result_finish must be
 * called. */
bool gb_calibration_search(const struct gb_calibrate_problem *problem,
                           struct gb_calibrate_result *result, struct gb_error *err);

void gb_calibration_result_finish(
    struct gb_calibrate_result *result); /* zeroed is fine */

/* Parameters i < j that the data cannot separate: their errors are so correlated that
 * one can stand for the other. */
bool gb_calibration_confounded(const struct gb_calibrate_result *result, size_t i,
                               size_t j);

/* Keys of a preset as plain numbers that a fit may change: SI, or the multiple where the
 * preset gives one ("0.008 d"). */
struct gb_free_key {
    const struct gb_field *field;
    bool relative;
    double low, high; /* never left */
    double from, to;  /* first region */
};

struct gb_free_keys {
    struct gb_free_key key[GB_CALIBRATE_FREE];
    size_t count;
};

/* Reads "contact.mu,contact.alpha" or
 * "contact.mu=0.05:0.4,contact.bridge_length=0.004:0.02 d": with a range the key never
 * leaves it; without, the fit begins between half and twice the value in params and may
 * go as far as the key accepts.
 *
 * Errors: GB_ERR_INPUT for unknown or unfit keys, a value of auto without a range, too
 * many. */
bool gb_calibration_keys(struct gb_free_keys *keys, const char *text,
                         const struct gb_params *params, struct gb_error *err);

/* Parameters of a preset fitted to measured densities by runs of the engine in a
 * directory.  First with cells of an eighth of the particles, where that leaves enough,
 * then with the full ones. */
struct gb_calibration {
    struct gb_free_keys keys;
    struct gb_labdata lab;
    size_t replicas;
    const char *directory; /* runs/ under it; rounds.csv during the fit */

    /* Does the runs of the ensemble that have not ended. */
    bool (*work)(struct gb_ensemble *ensemble, void *data, struct gb_error *err);
    /* Called after each round of the fit; NULL is fine. */
    void (*progress)(const struct gb_calibration *calibration,
                     enum gb_calibrate_stage stage, int round, const double *best,
                     const double *half_width, void *data);
    void *data;

    struct gb_calibrate_result result;
    struct gb_listing *rounds; /* rounds.csv */
    struct gb_error machine;   /* the first run that the machine failed; GB_OK: none */
};

/* Fits keys to lab.  Errors: those of gb_calibration_search, of work and of the machine.
 * gb_calibration_finish must be called in any case. */
bool gb_calibration_fit(struct gb_calibration *calibration, struct gb_error *err);

void gb_calibration_finish(struct gb_calibration *calibration); /* zeroed is fine */

/* "contact.mu" */
const char *gb_calibration_key_name(const struct gb_free_key *key, char *buffer,
                                    size_t size);

/* Results of a calibration as files and as text. */

/* The text of a calibration in its directory. */
#define GB_CALIBRATION_TABLE_TEXT "calibration.txt"

/* Writes calibration.csv, calibration.txt, fit.csv and calibrated.ini, the preset with the
 * fitted values, which it gives to preset. */
bool gb_calibration_write(const struct gb_calibration *calibration,
                          struct gb_preset *preset, struct gb_error *err);

/* Fitted parameters with intervals, correlations, residuals.  g_string_free. */
GString *gb_calibration_text(const struct gb_calibration *calibration);

/* Whether a line of that text warns of a value. */
bool gb_calibration_warns(const char *line);

#endif
