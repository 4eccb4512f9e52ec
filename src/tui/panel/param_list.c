#include "tui/panel/param_list.h"

#include <string.h>

#include "scene/field/applies.h"

void gb_param_list_init(struct gb_param_list *list, const struct gb_params *params,
                        bool all)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    const char *group = "";
    int line = -1;
    list->count = 0;
    for (size_t i = 0; i < count && list->count < GB_PARAM_LIST_MAX; i++) {
        if (!all && !gb_applies_field(params, &field[i])) {
            continue;
        }
        const bool first = strcmp(field[i].group, group) != 0;
        line += !first ? 1 : list->count > 0 ? 3 : 2;
        group = field[i].group;
        list->field[list->count] = (int)i;
        list->first[list->count] = first;
        list->line[list->count++] = line;
    }
}

int gb_param_list_index(const struct gb_param_list *list, int field)
{
    int position = 0;
    while (position + 1 < list->count && list->field[position + 1] <= field) {
        position++;
    }
    return position;
}
