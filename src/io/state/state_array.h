#ifndef GB_IO_STATE_STATE_ARRAY_H
#define GB_IO_STATE_STATE_ARRAY_H

#include <glib.h>

#include "hdf/hdf.h"
#include "io/state/state.h"

/* An array of a state as its file has it: in memory, or made by the state's source, some
 * rows at a time. */
struct gb_state_array {
    const struct gb_state *state;
    size_t member; /* offset of its pointer in gb_state */
    struct gb_hdf_array shape;
};

bool gb_state_array_exists(const struct gb_state_array *array);

/* Adds the rows to a checksum, and writes them as a dataset. */
void gb_state_array_sum(const struct gb_state_array *array, GChecksum *sum);
bool gb_state_array_put(const struct gb_state_array *array, struct gb_hdf *file,
                        struct gb_error *err);

#endif
