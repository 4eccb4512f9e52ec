#ifndef GB_TESTS_DIE_H
#define GB_TESTS_DIE_H

#include <stdarg.h>

#include <glib.h>

#include "scene/model.h"

/* A die of seconds: a hundred and fifty spheres of three sizes, poured and pressed fast;
 * then assignments "group.key=value", NULL at the end. */
static inline struct gb_params die_params(const char *first, ...)
{
    static const char *const assignment[] = {
        "scene.kind=die",
        "loading.geometry=die",
        "contact.normal=hertz",
        "contact.mu=0",
        "contact.damping=0.9",
        "material.young=180 GPa",
        "material.poisson=0.3",
        "material.density=5910 kg/m3",
        "particles.count=150",
        "particles.diameter=5 um",
        "particles.distribution=table",
        "particles.table=number: 4 um 0.4; 5 um 0.4; 7 um 0.2",
        "die.diameter=25 um",
        "die.central=15 um",
        "loading.until=50 MPa",
        "loading.record_pressure=5 MPa",
        "numerics.fidelity=fast",
    };
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    for (size_t i = 0; i < G_N_ELEMENTS(assignment); i++) {
        if (!gb_params_assign(&params, assignment[i], &err)) {
            g_error("%s: %s", assignment[i], err.text);
        }
    }
    va_list more;
    va_start(more, first);
    for (const char *text = first; text; text = va_arg(more, const char *)) {
        if (!gb_params_assign(&params, text, &err)) {
            g_error("%s: %s", text, err.text);
        }
    }
    va_end(more);
    return params;
}

#endif
