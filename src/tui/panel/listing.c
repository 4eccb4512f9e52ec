#include "tui/panel/listing.h"

#include <string.h>

#include "scene/applies.h"

void gb_listing_init(struct gb_listing *listing, const struct gb_params *params, bool all)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    const char *group = "";
    int line = -1;
    listing->count = 0;
    for (size_t i = 0; i < count && listing->count < GB_LISTING_MOST; i++) {
        if (!all && !gb_applies_field(params, &field[i])) {
            continue;
        }
        const bool first = strcmp(field[i].group, group) != 0;
        line += !first ? 1 : listing->count > 0 ? 3 : 2;
        group = field[i].group;
        listing->field[listing->count] = (int)i;
        listing->first[listing->count] = first;
        listing->line[listing->count++] = line;
    }
}

int gb_listing_place(const struct gb_listing *listing, int field)
{
    int place = 0;
    while (place + 1 < listing->count && listing->field[place + 1] <= field) {
        place++;
    }
    return place;
}
