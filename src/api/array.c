/* Arrays of a packing by name: one table row per array.  A row's `find` returns a
 * pointer into the memory of the engine or of a state where the data exist in this
 * form.  Otherwise it computes the array once and keeps it in struct gb_array_source
 * until gb_array_forget. gb_array_find adds shape, strides and units. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/array_private.h"
#include "base/alloc.h"
#include "io/state_forces.h"
#include "run/experiment_private.h"

/* Unit of an array. */
enum unit { PURE, LENGTH, SPEED, ROTATION_SPEED, FORCE, MOMENT, PRESSURE };

struct unit_row {
    const char *unit, *si_unit;
};
static const struct unit_row units[] = {
    [PURE] = {"", ""},         [LENGTH] = {"d", "m"},
    [SPEED] = {"d/T", "m/s"},  [ROTATION_SPEED] = {"1/T", "1/s"},
    [FORCE] = {"E d^2", "N"},  [MOMENT] = {"E d^3", "N m"},
    [PRESSURE] = {"Pa", "Pa"},
};

/* Memory of the rows of an array. */
struct rows {
    const void *data; /* NULL: the packing lacks this array */
    int64_t count;
    int64_t stride; /* bytes; 0: no gaps between rows */
    bool constant;  /* one row is valid for all */
};

struct array_row {
    const char *name;
    enum gb_array_type type;
    int columns;
    enum unit unit;
    /* False with err: GB_ERR_MEMORY. */
    bool (*find)(struct gb_array_source *packing, struct rows *rows,
                 struct gb_error *err);
    const char *doc;
};

void gb_array_forget(struct gb_array_source *packing)
{
    gb_state_destroy(packing->state);
    gb_alloc_free(packing->diameter);
    gb_alloc_free(packing->stress);
    gb_state_forces_gaps_finish(&packing->gaps);
    packing->gaps_found = false;
    packing->state = NULL;
    packing->diameter = packing->stress = NULL;
    for (size_t k = 0; k < G_N_ELEMENTS(packing->angular); k++) {
        gb_alloc_free(packing->angular[k]);
        packing->angular[k] = NULL;
    }
}

/* The state of the packing, listed at the first call.  NULL and err: GB_ERR_MEMORY. */
static const struct gb_state *state_of(struct gb_array_source *packing,
                                       struct gb_error *err)
{
    if (!packing->state &&
        !gb_experiment_state(packing->experiment, &packing->state, err)) {
        return NULL;
    }
    return packing->state;
}

static struct gb_world *world_of(const struct gb_array_source *packing)
{
    return packing->experiment ? packing->experiment->loading->world : NULL;
}

static const struct gb_bed *bed_of(const struct gb_array_source *packing)
{
    return packing->experiment ? packing->experiment->loading->bed : NULL;
}

/* Rows of four doubles of a die. */
static bool bed_rows(const struct gb_bed *bed, const gb_bed_row *row, struct rows *rows)
{
    *rows = (struct rows){.data = row, .count = bed->count, .stride = sizeof *row};
    return true;
}

static bool find_position(struct gb_array_source *packing, struct rows *rows,
                          struct gb_error *err)
{
    (void)err;
    struct gb_world *world = world_of(packing);
    const struct gb_bed *bed = bed_of(packing);
    if (bed) {
        return bed_rows(bed, (const gb_bed_row *)bed->position, rows);
    }
    if (world) {
        const struct gb_bodies bodies = gb_world_readable(world);
        *rows = (struct rows){.data = bodies.position, .count = bodies.count};
        return true;
    }
    *rows =
        (struct rows){.data = packing->state->position, .count = packing->state->count};
    return true;
}

static bool double_radii(struct gb_array_source *packing, struct gb_error *err)
{
    const struct gb_state *state = state_of(packing, err);
    if (!state) {
        return false;
    }
    packing->diameter =
        gb_alloc_array((size_t)state->count, sizeof *packing->diameter, err);
    for (int64_t i = 0; packing->diameter && i < state->count; i++) {
        packing->diameter[i] = 2.0 * state->radius[i];
    }
    return packing->diameter != NULL;
}

static bool find_diameter(struct gb_array_source *packing, struct rows *rows,
                          struct gb_error *err)
{
    static const double one = 1.0;
    const struct gb_world *world = world_of(packing);
    if (world) {
        const double *diameter = gb_world_diameters(world);
        *rows = (struct rows){.data = diameter ? diameter : &one,
                              .count = gb_world_model(world)->count,
                              .constant = !diameter};
        return true;
    }
    if (!packing->diameter && !double_radii(packing, err)) {
        return false;
    }
    *rows = (struct rows){.data = packing->diameter, .count = packing->state->count};
    return true;
}

/* Rows of a member of the state; no rows if the state lacks it. */
static bool listed(struct gb_array_source *packing, size_t member, size_t count,
                   struct rows *rows, struct gb_error *err)
{
    const struct gb_state *state = state_of(packing, err);
    if (!state) {
        return false;
    }
    const char *bytes = (const char *)state;
    memcpy(&rows->data, bytes + member, sizeof rows->data);
    memcpy(&rows->count, bytes + count, sizeof rows->count);
    rows->count = rows->data ? rows->count : 0;
    return true;
}

#define LISTED(function, member, rows_of)                                                \
    static bool function(struct gb_array_source *packing, struct rows *rows,             \
                         struct gb_error *err)                                           \
    {                                                                                    \
        return listed(packing, offsetof(struct gb_state, member),                        \
                      offsetof(struct gb_state, rows_of), rows, err);                    \
    }

static bool world_rows(const struct gb_world *world, const double *data,
                       struct rows *rows)
{
    *rows = (struct rows){.data = data, .count = gb_world_model(world)->count};
    return true;
}

/* The world stores arcs (diameter times angle) instead of angles.  Multiplies by the
 * diameter to the power 1 or -1 and keeps the result in the packing. */
static bool angular_rows(struct gb_array_source *packing, enum gb_array_angular which,
                         const double *arcs, int power, struct rows *rows,
                         struct gb_error *err)
{
    const struct gb_world *world = world_of(packing);
    const double *diameter = gb_world_diameters(world);
    const int64_t count = 3 * gb_world_model(world)->count;
    double **angles = &packing->angular[which];
    if (!diameter) {
        return world_rows(world, arcs, rows);
    }
    if (!*angles) {
        *angles = gb_alloc_array((size_t)count, sizeof **angles, err);
        for (int64_t k = 0; *angles && k < count; k++) {
            const double d = diameter[k / 3];
            (*angles)[k] = arcs[k] * (power > 0 ? d : 1.0 / d); /* as in state files */
        }
    }
    return *angles && world_rows(world, *angles, rows);
}

/* The same for a bed, which stores radius times angle. */
static bool bed_angles(struct gb_array_source *packing, enum gb_array_angular which,
                       const gb_bed_row *arcs, int power, struct rows *rows,
                       struct gb_error *err)
{
    const struct gb_bed *bed = bed_of(packing);
    double **angles = &packing->angular[which];
    if (!*angles) {
        *angles = gb_alloc_array(3 * (size_t)bed->count, sizeof **angles, err);
        for (int64_t k = 0; *angles && k < 3 * bed->count; k++) {
            const double radius = bed->position[k / 3][3];
            (*angles)[k] = arcs[k / 3][k % 3] * (power > 0 ? radius : 1.0 / radius);
        }
    }
    *rows = (struct rows){.data = *angles, .count = bed->count};
    return *angles != NULL;
}

static bool find_force(struct gb_array_source *packing, struct rows *rows,
                       struct gb_error *err)
{
    struct gb_world *world = world_of(packing);
    const struct gb_bed *bed = bed_of(packing);
    return bed     ? bed_rows(bed, (const gb_bed_row *)bed->force, rows)
           : world ? world_rows(world, gb_world_readable(world).force, rows)
                   : listed(packing, offsetof(struct gb_state, force),
                            offsetof(struct gb_state, count), rows, err);
}

static bool find_torque(struct gb_array_source *packing, struct rows *rows,
                        struct gb_error *err)
{
    struct gb_world *world = world_of(packing);
    const struct gb_bed *bed = bed_of(packing);
    return bed ? bed_angles(packing, GB_ARRAY_TORQUE, (const gb_bed_row *)bed->moment, 1,
                            rows, err)
           : world ? angular_rows(packing, GB_ARRAY_TORQUE,
                                  gb_world_readable(world).torque, 1, rows, err)
                   : listed(packing, offsetof(struct gb_state, torque),
                            offsetof(struct gb_state, count), rows, err);
}

/* NULL: a scene without time, or a packing from a file. */
static const struct gb_verlet *verlet_of(const struct gb_array_source *packing)
{
    const struct gb_loading *loading =
        packing->experiment ? packing->experiment->loading : NULL;
    return loading && loading->mode->motion ? loading->mode->motion(loading) : NULL;
}

static bool find_velocity(struct gb_array_source *packing, struct rows *rows,
                          struct gb_error *err)
{
    const struct gb_bed *bed = bed_of(packing);
    const struct gb_verlet *verlet = verlet_of(packing);
    return bed      ? bed_rows(bed, (const gb_bed_row *)bed->velocity, rows)
           : verlet ? world_rows(world_of(packing), verlet->velocity, rows)
                    : listed(packing, offsetof(struct gb_state, velocity),
                             offsetof(struct gb_state, count), rows, err);
}

static bool find_spin(struct gb_array_source *packing, struct rows *rows,
                      struct gb_error *err)
{
    const struct gb_bed *bed = bed_of(packing);
    const struct gb_verlet *verlet = verlet_of(packing);
    return bed ? bed_angles(packing, GB_ARRAY_SPIN, (const gb_bed_row *)bed->roll, -1,
                            rows, err)
           : verlet ? angular_rows(packing, GB_ARRAY_SPIN, verlet->spin, -1, rows, err)
                    : listed(packing, offsetof(struct gb_state, spin),
                             offsetof(struct gb_state, count), rows, err);
}

/* Edges of the cell, or its tilts. */
static bool cell_rows(struct gb_array_source *packing, bool tilts, struct rows *rows,
                      struct gb_error *err)
{
    const struct gb_world *world = world_of(packing);
    const struct gb_state *state = world ? NULL : state_of(packing, err);
    if (world) {
        const struct gb_cell *cell = gb_world_cell(world);
        *rows = (struct rows){.data = tilts ? cell->tilt : cell->edge, .count = 3};
    } else if (state) {
        *rows = (struct rows){.data = tilts ? state->tilt : state->cell, .count = 3};
    }
    return world || state;
}

static bool find_cell(struct gb_array_source *packing, struct rows *rows,
                      struct gb_error *err)
{
    return cell_rows(packing, false, rows, err);
}

static bool find_tilt(struct gb_array_source *packing, struct rows *rows,
                      struct gb_error *err)
{
    return cell_rows(packing, true, rows, err);
}

LISTED(find_coordination, contacts, count)
LISTED(find_contact, pair, pair_count)
LISTED(find_contact_force, pair_force, pair_count)
LISTED(find_contact_normal, pair_normal, pair_count)
LISTED(find_contact_bridged, pair_bridged, pair_count)
LISTED(find_contact_radius, contact_radius, pair_count)
LISTED(find_wall, wall, wall_count)
LISTED(find_wall_force, wall_force, wall_count)

/* The pairs that attract across gaps, found at the first call.  NULL and err: errors of
 * gb_state_forces_gaps_init. */
static const struct gb_state_gaps *gaps_of(struct gb_array_source *packing,
                                           struct gb_error *err)
{
    const struct gb_state *state = state_of(packing, err);
    if (state && !packing->gaps_found) {
        packing->gaps_found = gb_state_forces_gaps_init(&packing->gaps, state, err);
    }
    return packing->gaps_found ? &packing->gaps : NULL;
}

static bool find_gap(struct gb_array_source *packing, struct rows *rows,
                     struct gb_error *err)
{
    static const int32_t none;
    const struct gb_state_gaps *gaps = gaps_of(packing, err);
    if (gaps) {
        rows->data = gaps->pair ? gaps->pair : &none;
        rows->count = gaps->count;
    }
    return gaps != NULL;
}

static bool find_gap_force(struct gb_array_source *packing, struct rows *rows,
                           struct gb_error *err)
{
    static const double none;
    const struct gb_state_gaps *gaps = gaps_of(packing, err);
    if (gaps) {
        rows->data = gaps->force ? gaps->force : &none;
        rows->count = gaps->count;
    }
    return gaps != NULL;
}

static bool find_stress(struct gb_array_source *packing, struct rows *rows,
                        struct gb_error *err)
{
    const struct gb_state *state = state_of(packing, err);
    const struct gb_state_gaps *gaps = state ? gaps_of(packing, err) : NULL;
    if (gaps && !packing->stress) {
        packing->stress =
            gb_alloc_array(6 * (size_t)state->count, sizeof *packing->stress, err);
        if (packing->stress) {
            gb_state_forces_stress_tensor(state, gaps, packing->stress);
        }
    }
    if (!packing->stress) {
        return false;
    }
    *rows = (struct rows){.data = packing->stress, .count = state->count};
    return true;
}

static const struct array_row table[] = {
    {"position", GB_ARRAY_DOUBLE, 3, LENGTH, find_position, "particles x 3, d"},
    {"diameter", GB_ARRAY_DOUBLE, 1, LENGTH, find_diameter, "particles, d"},
    {"force", GB_ARRAY_DOUBLE, 3, FORCE, find_force, "particles x 3, E d^2: resultant"},
    {"torque", GB_ARRAY_DOUBLE, 3, MOMENT, find_torque,
     "particles x 3, E d^3: resultant"},
    {"velocity", GB_ARRAY_DOUBLE, 3, SPEED, find_velocity,
     "particles x 3, d/T with T = sqrt(m/(E d)); of scenes with time, in a periodic cell "
     "in addition to its affine motion"},
    {"spin", GB_ARRAY_DOUBLE, 3, ROTATION_SPEED, find_spin,
     "particles x 3, 1/T: angular velocity; of scenes with time"},
    {"coordination", GB_ARRAY_INT32, 1, PURE, find_coordination,
     "particles: contacts with other particles"},
    {"stress", GB_ARRAY_DOUBLE, 6, PRESSURE, find_stress,
     "particles x 6, Pa: xx, yy, zz, xy, xz, yz, positive in compression"},
    {"contact", GB_ARRAY_INT32, 2, PURE, find_contact, "contacts x 2: the two particles"},
    {"contact_force", GB_ARRAY_DOUBLE, 3, FORCE, find_contact_force,
     "contacts x 3, E d^2: whole force on the first"},
    {"contact_normal", GB_ARRAY_DOUBLE, 1, FORCE, find_contact_normal,
     "contacts, E d^2: normal force, positive when pressed"},
    {"contact_bridged", GB_ARRAY_UINT8, 1, PURE, find_contact_bridged,
     "contacts: 1 with a bridge"},
    {"contact_radius", GB_ARRAY_DOUBLE, 1, LENGTH, find_contact_radius,
     "contacts, d: of the contact, or of its bridge; of a state from a file"},
    {"gap", GB_ARRAY_INT32, 2, PURE, find_gap,
     "gaps x 2: pairs of particles that attract across a gap"},
    {"gap_force", GB_ARRAY_DOUBLE, 3, FORCE, find_gap_force,
     "gaps x 3, E d^2: attraction on the first"},
    {"wall", GB_ARRAY_INT32, 2, PURE, find_wall,
     "contacts with walls x 2: particle, wall (0 floor, 1 side, 2 punch, 3 funnel)"},
    {"wall_force", GB_ARRAY_DOUBLE, 3, FORCE, find_wall_force,
     "contacts with walls x 3, E d^2: whole force on the particle"},
    {"cell", GB_ARRAY_DOUBLE, 1, LENGTH, find_cell,
     "3, d: edges of the periodic cell, or of the box of a die"},
    {"tilt", GB_ARRAY_DOUBLE, 1, LENGTH, find_tilt, "3, d: tilts xy, xz, yz of the cell"},
};

const char *gb_array_name(size_t index)
{
    return index < G_N_ELEMENTS(table) ? table[index].name : NULL;
}

const char *gb_array_doc(size_t index)
{
    return index < G_N_ELEMENTS(table) ? table[index].doc : NULL;
}

double gb_array_second_per_time(const struct gb_array_source *packing)
{
    const struct gb_model *model =
        packing->experiment ? packing->experiment->model : NULL;
    if (!model) {
        return packing->state->second_per_time;
    }
    return bed_of(packing)      ? model->die.second_per_time
           : verlet_of(packing) ? model->dynamics.second_per_time
                                : (double)NAN;
}

/* Value of one unit in SI units. */
static double si_factor(const struct gb_array_source *packing, enum unit unit)
{
    const struct gb_model *model =
        packing->experiment ? packing->experiment->model : NULL;
    const double metre =
        model ? model->metre_per_length : packing->state->metre_per_length;
    const double pascal =
        model ? model->pascal_per_stress : packing->state->pascal_per_stress;
    const double second = gb_array_second_per_time(packing);
    const double factors[] = {[PURE] = 1.0,
                              [LENGTH] = metre,
                              [SPEED] = metre / second,
                              [ROTATION_SPEED] = 1.0 / second,
                              [FORCE] = pascal * metre * metre,
                              [MOMENT] = pascal * metre * metre * metre,
                              [PRESSURE] = 1.0};
    return factors[unit];
}

static const struct array_row *find_row(const char *name, struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    const struct array_row *found = NULL;
    for (size_t i = 0; !found && i < G_N_ELEMENTS(table); i++) {
        found = strcmp(table[i].name, name) == 0 ? &table[i] : NULL;
        g_string_append_printf(names, "%s%s", i ? ", " : "", table[i].name);
    }
    if (!found) {
        gb_error_set(err, GB_ERR_INPUT, "%.40s: no such array; must be one of %s", name,
                     names->str);
    }
    g_string_free(names, TRUE);
    return found;
}

/* Copies the members that fit into the caller's struct, which may be an older version. */
static bool hand_over(struct gb_array *out, struct gb_array *array, struct gb_error *err)
{
    const size_t size = MIN(out->size, sizeof *array);
    if (size < offsetof(struct gb_array, si) + sizeof array->si) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "gb_array.size = %zu: must be sizeof(struct gb_array), %zu",
                            out->size, sizeof *array);
    }
    array->size = out->size;
    memcpy(out, array, size);
    return true;
}

bool gb_array_find(struct gb_array_source *packing, const char *name,
                   struct gb_array *array, struct gb_error *err)
{
    static const int64_t sizes[] = {[GB_ARRAY_DOUBLE] = sizeof(double),
                                    [GB_ARRAY_INT32] = sizeof(int32_t),
                                    [GB_ARRAY_UINT8] = sizeof(uint8_t)};
    struct rows rows = {0};
    if (!gb_arguments_given(name, "name", err) ||
        !gb_arguments_given(array, "array", err)) {
        return false;
    }
    const struct array_row *row = find_row(name, err);
    if (!row || !row->find(packing, &rows, err)) {
        return false;
    }
    if (!rows.data && rows.count == 0 && row->find != find_wall &&
        row->find != find_wall_force) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: this packing has none (%s)", name,
                            row->doc);
    }
    struct gb_array found = {.data = rows.data,
                             .type = (int)row->type,
                             .dimensions = row->columns > 1 ? 2 : 1,
                             .shape = {rows.count, row->columns},
                             .stride = {rows.constant ? 0
                                        : rows.stride ? rows.stride
                                                      : row->columns * sizes[row->type],
                                        sizes[row->type]},
                             .unit = units[row->unit].unit,
                             .si_unit = units[row->unit].si_unit,
                             .si = si_factor(packing, row->unit)};
    return hand_over(array, &found, err);
}
