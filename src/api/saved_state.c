#include "greenbody/saved_state.h"

#include "api/arguments.h"
#include "api/array_private.h"
#include "base/alloc.h"

bool gb_saved_state_load(struct gb_saved_state **out, const char *path,
                         struct gb_error *err)
{
    if (!gb_arguments_given(out, "out", err) || !gb_arguments_given(path, "path", err)) {
        return false;
    }
    struct gb_saved_state *saved = gb_alloc_array(1, sizeof *saved, err);
    if (!saved) {
        return false;
    }
    if (!gb_state_read(&saved->packing.state, path, err)) {
        gb_alloc_free(saved);
        return false;
    }
    *out = saved;
    return true;
}

void gb_saved_state_destroy(struct gb_saved_state *saved)
{
    if (saved) {
        gb_array_forget(&saved->packing);
        gb_alloc_free(saved);
    }
}

const struct gb_point *gb_saved_state_point(const struct gb_saved_state *saved)
{
    return saved ? &saved->packing.state->point : NULL;
}

const char *gb_saved_state_title(const struct gb_saved_state *saved)
{
    return saved ? saved->packing.state->preset : NULL;
}

uint64_t gb_saved_state_seed(const struct gb_saved_state *saved)
{
    return saved ? saved->packing.state->seed : 0;
}

bool gb_saved_state_array(struct gb_saved_state *saved, const char *name,
                          struct gb_array *array, struct gb_error *err)
{
    return gb_arguments_given(saved, "saved", err) &&
           gb_array_find(&saved->packing, name, array, err);
}
