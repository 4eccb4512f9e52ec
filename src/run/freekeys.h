#ifndef GB_RUN_FREEKEYS_H
#define GB_RUN_FREEKEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "run/calibrate.h"

/* Keys of a preset as plain numbers that a fit may change: SI, or the multiple where the
 * preset gives one ("0.008 d"). */
struct gb_freekey {
    const struct gb_field *field;
    bool relative;
    double low, high; /* never left */
    double from, to;  /* first region */
};

struct gb_freekeys {
    struct gb_freekey key[GB_CALIBRATE_FREE];
    size_t count;
};

/* Reads "contact.mu,contact.alpha" or
 * "contact.mu=0.05:0.4,contact.bridge_length=0.004:0.02 d": with a range the key never
 * leaves it; without, the fit begins between half and twice the value in params and may
 * go as far as the key accepts.
 *
 * Errors: GB_ERR_INPUT for unknown or unfit keys, a value of auto without a range, too
 * many. */
bool gb_freekeys_parse(struct gb_freekeys *keys, const char *text,
                       const struct gb_params *params, struct gb_error *err);

/* The value of a key as a preset would write it, ten digits.  Returns buffer. */
char *gb_freekeys_text(const struct gb_freekey *key, double value, char *buffer,
                       size_t size);

/* Gives params the values. */
bool gb_freekeys_apply(const struct gb_freekeys *keys, const double *value,
                       struct gb_params *params, struct gb_error *err);

#endif
