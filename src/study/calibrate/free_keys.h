#ifndef GB_STUDY_CALIBRATE_FREE_KEYS_H
#define GB_STUDY_CALIBRATE_FREE_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
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
bool gb_free_keys_parse(struct gb_free_keys *keys, const char *text,
                        const struct gb_params *params, struct gb_error *err);

/* The value of a key as a preset would write it, ten digits.  Returns buffer. */
char *gb_free_keys_text(const struct gb_free_key *key, double value, char *buffer,
                        size_t size);

/* Gives params the values. */
bool gb_free_keys_apply(const struct gb_free_keys *keys, const double *value,
                        struct gb_params *params, struct gb_error *err);

#endif
