#ifndef GB_IO_STATE_STATE_CHECK_H
#define GB_IO_STATE_STATE_CHECK_H

#include "io/state/state.h"

/* Name of the first dataset or attribute with a value that no packing has (and its row,
 * for datasets), or NULL when all is well. */
const char *gb_state_check(const struct gb_state *state, int64_t *row);

#endif
