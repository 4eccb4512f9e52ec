#include "greenbody/greenbody.h"

#include "io/point_columns.h"

const char *gb_library_version(void)
{
    return GB_VERSION;
}

bool gb_library_point_member(size_t index, const char **name, size_t *offset,
                             size_t *count, char *type)
{
    const struct gb_point_column *member = gb_point_columns_at(index);
    if (!member) {
        return false;
    }
    if (name) {
        *name = member->member;
    }
    if (offset) {
        *offset = member->offset;
    }
    if (count) {
        *count = member->count;
    }
    if (type) {
        *type = member->type;
    }
    return true;
}
