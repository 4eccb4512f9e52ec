#ifndef GB_STUDY_CALIBRATE_CALIBRATION_H
#define GB_STUDY_CALIBRATE_CALIBRATION_H

#include <glib.h>

#include "io/preset.h"
#include "many/ensemble.h"
#include "many/lab/labdata.h"
#include "study/calibrate/calibrate.h"
#include "study/calibrate/free_keys.h"

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
    GString *rounds;         /* content of rounds.csv */
    struct gb_error machine; /* the first run that the machine failed; GB_OK: none */
};

/* Fits keys to lab.  Errors: those of gb_calibrate_fit, of work and of the machine.
 * gb_calibration_finish is due in any case. */
bool gb_calibration_fit(struct gb_calibration *calibration, struct gb_error *err);
void gb_calibration_finish(struct gb_calibration *calibration); /* zeroed is fine */

/* "contact.mu" */
const char *gb_calibration_name(const struct gb_free_key *key, char *buffer, size_t size);

#endif
