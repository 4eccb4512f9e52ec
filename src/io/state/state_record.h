#ifndef GB_IO_STATE_STATE_RECORD_H
#define GB_IO_STATE_STATE_RECORD_H

#include "base/record.h"
#include "io/state/state.h"
#include "scene/model.h"

/* The packing that a record was taken of, for pictures and other programs.  Touches no
 * experiment: it can be made in another thread. */
bool gb_state_record(struct gb_state **out, const struct gb_record *record,
                     const struct gb_params *params, const struct gb_model *model,
                     struct gb_error *err);

#endif
