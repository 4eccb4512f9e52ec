#ifndef GB_API_PARAMETERS_PRIVATE_H
#define GB_API_PARAMETERS_PRIVATE_H

#include "greenbody/parameters.h"
#include "greenbody/params.h"
#include "io/preset.h"

/* Contents of the opaque gb_parameters. */
struct gb_parameters {
    struct gb_preset *preset; /* owned */
};

/* Parameters with a copy of params and no file. */
bool gb_parameters_wrap(struct gb_parameters **out, const struct gb_params *params,
                        struct gb_error *err);

#endif
