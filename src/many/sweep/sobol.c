#include "many/sweep/sobol.h"

#include <gsl/gsl_qrng.h>

#include "base/alloc.h"

enum { COORDINATES_MOST = 40 };

bool gb_sobol_coordinate(size_t axis, size_t points, double *share, struct gb_error *err)
{
    const unsigned int dimension = (unsigned int)axis + 1;
    double coordinate[COORDINATES_MOST];
    void *state = gb_alloc_array(1, gsl_qrng_sobol->state_size(dimension), err);
    if (state == NULL) {
        return false;
    }
    gsl_qrng_sobol->init_state(state, dimension);
    for (size_t p = 0; p < points; p++) {
        gsl_qrng_sobol->get(state, dimension, coordinate);
        share[p] = coordinate[axis];
    }
    gb_alloc_free(state);
    return true;
}
