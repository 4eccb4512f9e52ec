#include "run/checkpoint.h"

#include <stddef.h>

#include "io/point_columns.h"
#include "run/experiment_private.h"

#define AT(member) offsetof(struct gb_experiment, member)

static const struct gb_record_member members[] = {
    {"run/step", GB_RECORD_INT64, 1, AT(step), "1"},
    {"run/unrelaxed", GB_RECORD_INT64, 1, AT(unrelaxed), "1"},
    {"run/over", GB_RECORD_BOOL, 1, AT(over), "1"},
    {"run/elastic_start", GB_RECORD_DOUBLE, 1, AT(elastic_start), "E d^3"},
};

#undef AT

/* No run counts further. */
static const int64_t step_max = INT64_C(1) << 53;

enum { MEMBERS = sizeof members / sizeof members[0] };

bool gb_checkpoint_take(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err)
{
    const enum gb_curve_columns scene = gb_loading_kind_of(&experiment->params)->columns;
    gb_record_clear(record);
    return gb_record_members(record, members, MEMBERS, experiment, err) &&
           gb_point_columns_save(&experiment->point, "point", scene, record, err) &&
           gb_point_columns_save(&experiment->shown, "shown", scene, record, err) &&
           gb_loading_record(experiment->loading, record, err);
}

bool gb_checkpoint_load(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err)
{
    const enum gb_curve_columns scene = gb_loading_kind_of(&experiment->params)->columns;
    record->loading = true;
    gb_point_columns_clear(&experiment->point);
    gb_point_columns_clear(&experiment->shown);
    if (!gb_record_members(record, members, MEMBERS, experiment, err) ||
        !gb_point_columns_load(&experiment->point, "point", scene, record, err) ||
        !gb_point_columns_load(&experiment->shown, "shown", scene, record, err)) {
        return false;
    }
    if (experiment->step < 0 || experiment->step > step_max) {
        return gb_error_set(err, GB_ERR_INPUT, "run/step: is out of range");
    }
    return true;
}

int64_t gb_checkpoint_step(const struct gb_record *record)
{
    const struct gb_record_item *item = gb_record_find(record, "run/step");
    const bool is =
        item && item->type == GB_RECORD_INT64 && item->rows == 1 && item->columns == 1;
    const int64_t step = is ? *(const int64_t *)item->data : -1;
    return step < 0 ? -1 : step;
}
