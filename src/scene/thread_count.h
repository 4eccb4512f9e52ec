#ifndef GB_SCENE_THREAD_COUNT_H
#define GB_SCENE_THREAD_COUNT_H

#include "scene/model.h"

/* Particles per thread below which a second thread costs more than it gains; above it the
 * team finds out (base/team.h). */
enum { GB_PARTICLES_PER_THREAD = 500 };

/* Threads that a run may use: numerics.threads or, if that is automatic, the cores of this
 * process for which there are particles enough. */
int gb_thread_count(const struct gb_model *model);

#endif
