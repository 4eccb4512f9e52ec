#ifndef GB_PACK_F32_F32_CONVERT_H
#define GB_PACK_F32_F32_CONVERT_H

#include <stdint.h>

struct gb_engine;

/* Conversions between the arrays of gb_particles and those of gb_f32_state. */

/* Fixed-point positions and rotations of particles begin .. end - 1, from doubles. */
void gb_f32_convert_particles(struct gb_engine *engine, int64_t begin, int64_t end);

/* `position` follows the fixed-point positions, if it is stale. */
void gb_f32_convert_synchronise(struct gb_engine *engine);

/* Forces and torques as doubles, if they are in f32 only; and back, after a load. */
void gb_f32_convert_forces_to_f64(struct gb_engine *engine);
void gb_f32_convert_forces_from_f64(struct gb_engine *engine);

#endif
