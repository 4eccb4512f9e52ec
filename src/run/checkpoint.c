#include "run/checkpoint.h"

#include <stddef.h>

#include "io/point_columns.h"
#include "run/experiment_private.h"

#define AT(member) offsetof(struct gb_experiment, member)

#define POINT(name)                                                                      \
    {#name "/branch", GB_RECORD_INT32, 1, AT(name.branch), "1"},                         \
        {#name "/branch_from", GB_RECORD_DOUBLE, 1, AT(name.branch_from_pa), "Pa"},      \
        {#name "/step", GB_RECORD_INT64, 1, AT(name.step), "1"},                         \
        {#name "/density", GB_RECORD_DOUBLE, 1, AT(name.density), "1"},                  \
        {#name "/px", GB_RECORD_DOUBLE, 1, AT(name.px_pa), "Pa"},                        \
        {#name "/py", GB_RECORD_DOUBLE, 1, AT(name.py_pa), "Pa"},                        \
        {#name "/pz", GB_RECORD_DOUBLE, 1, AT(name.pz_pa), "Pa"},                        \
        {#name "/p", GB_RECORD_DOUBLE, 1, AT(name.p_pa), "Pa"},                          \
        {#name "/coordination", GB_RECORD_DOUBLE, 1, AT(name.coordination), "1"},        \
        {#name "/bridged", GB_RECORD_DOUBLE, 1, AT(name.bridged), "1"},                  \
        {#name "/rattlers", GB_RECORD_DOUBLE, 1, AT(name.rattlers), "1"},                \
        {#name "/residual", GB_RECORD_DOUBLE, 1, AT(name.residual), "1"},                \
        {#name "/iterations", GB_RECORD_INT64, 1, AT(name.iterations), "1"},             \
        {#name "/evaluations", GB_RECORD_INT64, 1, AT(name.evaluations), "1"},           \
        {#name "/time", GB_RECORD_DOUBLE, 1, AT(name.time_s), "s"},                      \
        {#name "/kinetic", GB_RECORD_DOUBLE, 1, AT(name.kinetic), "J"},                  \
        {#name "/work", GB_RECORD_DOUBLE, 1, AT(name.work), "J"},                        \
        {#name "/elastic", GB_RECORD_DOUBLE, 1, AT(name.elastic), "J"},                  \
        {#name "/dissipated", GB_RECORD_DOUBLE, 1, AT(name.dissipated), "J"},            \
        {#name "/central", GB_RECORD_DOUBLE, 1, AT(name.central), "1"},                  \
        {#name "/height", GB_RECORD_DOUBLE, 1, AT(name.height_m), "m"},                  \
        {#name "/height_change", GB_RECORD_DOUBLE, 1, AT(name.height_change), "1"},      \
        {#name "/wanted", GB_RECORD_DOUBLE, 1, AT(name.target_pa), "Pa"},                \
        {#name "/floor_over_punch", GB_RECORD_DOUBLE, 1, AT(name.floor_over_punch),      \
         "1"},                                                                           \
    {                                                                                    \
#name "/energy_residual", GB_RECORD_DOUBLE, 1, AT(name.energy_residual), "1"     \
    }

static const struct gb_record_member members[] = {
    {"run/step", GB_RECORD_INT64, 1, AT(step), "1"},
    {"run/unrelaxed", GB_RECORD_INT64, 1, AT(unrelaxed), "1"},
    {"run/over", GB_RECORD_BOOL, 1, AT(over), "1"},
    {"run/elastic_start", GB_RECORD_DOUBLE, 1, AT(elastic_start), "E d^3"},
    POINT(point),
    POINT(shown),
};

#undef AT
#undef POINT

/* No run counts further. */
static const int64_t step_max = INT64_C(1) << 53;

enum { MEMBERS = sizeof members / sizeof members[0] };

static bool record_points(struct gb_experiment *experiment, struct gb_record *record,
                          struct gb_error *err)
{
    return gb_record_members(record, members, MEMBERS, experiment, err) &&
           gb_point_columns_record(&experiment->point, "point/tensors", record, err) &&
           gb_point_columns_record(&experiment->shown, "shown/tensors", record, err) &&
           /* what a record has not is loaded as NaN */
           ((gb_loading_kind_of(&experiment->params)->columns != GB_COLUMNS_COMMON &&
             !record->loading) ||
            (gb_point_columns_record_step(&experiment->point, "point/unrelaxed", record,
                                          err) &&
             gb_point_columns_record_step(&experiment->shown, "shown/unrelaxed", record,
                                          err))) &&
           ((gb_loading_kind_of(&experiment->params)->periodic_cell &&
             !record->loading) ||
            (gb_point_columns_record_die(&experiment->point, "point/die", record, err) &&
             gb_point_columns_record_die(&experiment->shown, "shown/die", record, err)));
}

bool gb_checkpoint_take(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err)
{
    gb_record_clear(record);
    return record_points(experiment, record, err) &&
           gb_loading_record(experiment->loading, record, err);
}

bool gb_checkpoint_load(struct gb_experiment *experiment, struct gb_record *record,
                        struct gb_error *err)
{
    record->loading = true;
    if (!record_points(experiment, record, err)) {
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
