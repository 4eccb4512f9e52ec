#include "io/export/export_vectors.h"

#include <math.h>

#include "io/export/export_text.h"

void gb_export_vectors_list(const struct gb_export_frame *frame,
                            struct gb_export_vector vectors[GB_EXPORT_VECTORS])
{
    const struct gb_state *state = frame->state;
    const bool timed = isfinite(frame->ns);
    const double moment = frame->nn * frame->nm;
    const struct gb_export_vector all[GB_EXPORT_VECTORS] = {
        [GB_EXPORT_VECTOR_VELOCITY] = {"vx_m_per_s,vy_m_per_s,vz_m_per_s", "vx vy vz",
                                       "velo:R:3", "velocity_m_per_s", "m/s",
                                       timed ? state->velocity : NULL,
                                       frame->nm / frame->ns, frame->nm / frame->ns},
        [GB_EXPORT_VECTOR_SPIN] = {"omegax_per_ns,omegay_per_ns,omegaz_per_ns",
                                   "omegax omegay omegaz", "omega:R:3", "omega_per_ns",
                                   "1/ns", timed ? state->spin : NULL, 1.0 / frame->ns,
                                   1.0 / frame->ns},
        [GB_EXPORT_VECTOR_FORCE] = {"fx_nN,fy_nN,fz_nN", "fx fy fz", "forces:R:3",
                                    "force_nN", "nN", state->force, frame->nn,
                                    1e3 * frame->nn},
        [GB_EXPORT_VECTOR_TORQUE] = {"tqx_nN_nm,tqy_nN_nm,tqz_nN_nm", "tqx tqy tqz",
                                     "torques:R:3", "torque_nN_nm", "nN nm",
                                     state->torque, moment, 1e3 * moment},
    };
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        vectors[k] = all[k];
    }
}

void gb_export_vectors_append(GString *text,
                              const struct gb_export_vector vectors[GB_EXPORT_VECTORS],
                              bool nano, int64_t particle, char between)
{
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        const struct gb_export_vector *vector = &vectors[k];
        for (int c = 0; vector->data != NULL && c < 3; c++) {
            g_string_append_c(text, between);
            gb_export_text_number(text,
                                  (nano ? vector->nano : vector->factor) *
                                      vector->data[3 * particle + c],
                                  '\0');
        }
    }
}
