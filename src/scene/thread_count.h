#ifndef GB_SCENE_THREAD_COUNT_H
#define GB_SCENE_THREAD_COUNT_H

#include "scene/model.h"

/* Particles per thread below which a second thread costs more than it saves.  Above it
 * the team measures how many threads pay off (base/team.h). */
enum { GB_PARTICLES_PER_THREAD = 500 };

/* Number of threads that a run may use: numerics.threads, or if that is automatic, the
 * available cores, limited by GB_PARTICLES_PER_THREAD. */
int gb_thread_count(const struct gb_model *model);

#endif
