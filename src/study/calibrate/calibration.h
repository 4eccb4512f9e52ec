#ifndef GB_STUDY_CALIBRATE_CALIBRATION_H
#define GB_STUDY_CALIBRATE_CALIBRATION_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/listing.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "many/compaction_data.h"
#include "many/ensemble.h"
#include "study/calibrate/calibrate.h"

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

/* Fits keys to lab.  Errors: those of gb_calibrate_fit, of work and of the machine.
 * gb_calibration_finish is due in any case. */
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
