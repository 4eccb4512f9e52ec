#include "scene/thread_count.h"

#include <glib.h>

int gb_thread_count(const struct gb_model *model)
{
    const int64_t useful = model->count / GB_PARTICLES_PER_THREAD;
    const int64_t cores = g_get_num_processors(); /* available to this process */
    const int64_t automatic = useful < 1 ? 1 : useful < cores ? useful : cores;
    return model->numerics.threads > 0 ? model->numerics.threads : (int)automatic;
}
