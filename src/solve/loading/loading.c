#include "solve/loading/loading.h"

#include <math.h>

#include "base/alloc.h"
#include "pack/cell/world_record.h"
#include "pack/die/bed_record.h"

const struct gb_loading_mode *const gb_loading_modes[GB_LOADING_KINDS] = {
    [GB_KIND_QUASISTATIC] = &gb_loading_quasistatic,
    [GB_KIND_DYNAMIC] = &gb_loading_dynamic,
    [GB_KIND_DIE] = &gb_loading_die,
};

static struct gb_loading *allocate(const struct gb_params *params,
                                   const struct gb_model *model, struct gb_error *err)
{
    const struct gb_loading_mode *mode = gb_loading_modes[params->kind];
    mode = mode->by_path && model->path.count > 0 ? mode->by_path : mode;
    struct gb_loading *loading = gb_alloc_array(1, mode->size, err);
    if (loading) {
        loading->mode = mode;
        loading->params = params;
        loading->model = model;
    }
    return loading;
}

bool gb_loading_create(struct gb_loading **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err)
{
    struct gb_loading *loading = allocate(params, model, err);
    if (!loading || !loading->mode->build(loading, cancelled, data, err)) {
        gb_loading_destroy(loading);
        return false;
    }
    *out = loading;
    return true;
}

static bool record_members(struct gb_loading *loading, struct gb_record *record,
                           struct gb_error *err)
{
#define AT(member) offsetof(struct gb_loading, member)
    static const struct gb_record_member members[] = {
        {"run/factor", GB_RECORD_DOUBLE, 3, AT(factor), "1"},
        {"run/strain_due", GB_RECORD_BOOL, 1, AT(strain_due), "1"},
    };
#undef AT
    return gb_record_members(record, members, sizeof members / sizeof members[0], loading,
                             err);
}

bool gb_loading_create_from(struct gb_loading **out, const struct gb_params *params,
                            const struct gb_model *model, struct gb_record *record,
                            struct gb_error *err)
{
    struct gb_loading *loading = allocate(params, model, err);
    record->loading = true;
    if (!loading || !loading->mode->build_from(loading, record, err) ||
        !record_members(loading, record, err) ||
        !loading->mode->record(loading, record, err) ||
        (loading->bed && !gb_bed_record(loading->bed, record, err))) {
        gb_loading_destroy(loading);
        return false;
    }
    *out = loading;
    return true;
}

void gb_loading_destroy(struct gb_loading *loading)
{
    if (!loading) {
        return;
    }
    loading->mode->finish(loading);
    gb_world_destroy(loading->world);
    gb_bed_destroy(loading->bed);
    gb_alloc_free(loading);
}

bool gb_loading_record(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    return record_members(loading, record, err) &&
           loading->mode->record(loading, record, err) &&
           (loading->world ? gb_world_record(loading->world, record, err)
                           : gb_bed_record(loading->bed, record, err));
}

int64_t gb_loading_evaluations(const struct gb_loading *loading)
{
    return loading->world ? gb_world_evaluations(loading->world)
                          : loading->bed->evaluations;
}

struct gb_loading_report gb_loading_empty_report(void)
{
    const double none = (double)NAN;
    return (struct gb_loading_report){
        .residual = none,
        .unrelaxed = none,
        .time = none,
        .kinetic = none,
        .work = none,
        .absorbed = none,
        .pressure = {none, none, none},
        .target_pressure = none,
        .height = none,
        .height0 = none,
        .floor_over_punch = none,
        .floor = none,
        .drag = none,
        .contact = none,
        .axial = none,
        .radial = none,
        .welded = none,
    };
}
