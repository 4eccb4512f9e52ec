/* Laws as tables: what each law gives at one argument, and rows along points, a range or a
 * path. */
#include "study/law_table.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/units.h"
#include "greenbody/status.h"
#include "scene/contact_pair.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/normal_law.h"

/* Values of the laws of P3 for one pair of bodies, SI units, at overlap input->x. */

/* --- laws of a pair, in SI ------------------------------------------------------------ */

static void set_branch(double h, struct gb_law_branch branch, double *out)
{
    out[0] = h;
    out[1] = branch.force;
    out[2] = branch.stiffness;
}

enum formula { LESSER_OF_BOTH, AS_PRINTED };

static struct gb_law_branch elastic(const struct gb_law_table_input *input)
{
    const struct gb_law_hertz *law = &input->pair->law.hertz;
    const double radius = input->pair->radius;
    return (struct gb_law_branch){gb_law_hertz_force(law, radius, input->x),
                                  gb_law_hertz_stiffness(law, radius, input->x)};
}

static struct gb_law_branch plastic(const struct gb_law_table_input *input,
                                    enum formula formula)
{
    struct gb_law_storakers law = input->pair->law;
    law.printed = formula == AS_PRINTED;
    return gb_law_storakers_loading(&law, input->pair->radius, input->x);
}

/* Overlap, force, stiffness; storakers is the loading curve. */
static void law_pair_hertz(const struct gb_law_table_input *input, double *out)
{
    set_branch(input->x, elastic(input), out);
}

static void law_pair_storakers(const struct gb_law_table_input *input, double *out)
{
    const bool printed = input->pair->law.printed;
    set_branch(input->x, plastic(input, printed ? AS_PRINTED : LESSER_OF_BOTH), out);
}

/* The same along a path; Hertz has no history. */
static void law_pair_follow_hertz(const struct gb_law_table_input *input, double *deepest,
                                  double *out)
{
    (void)deepest;
    law_pair_hertz(input, out);
}

static void law_pair_follow_storakers(const struct gb_law_table_input *input,
                                      double *deepest, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    set_branch(input->x,
               gb_law_storakers_update(&pair->law, pair->radius, input->x, deepest), out);
}

/* k_t of Hertz' contact, (12), and Coulomb's cap without the dashpot, (14). */
static void law_pair_mindlin(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    out[0] = input->x;
    out[1] = gb_law_hertz_shear_stiffness(&pair->law.hertz, pair->radius, input->x);
    out[2] = pair->mu * elastic(input).force;
}

/* Force of the elastic and of both plastic laws side by side; their critical steps. */
static void law_pair_models(const struct gb_law_table_input *input, double *out)
{
    out[0] = input->x;
    out[1] = elastic(input).force;
    out[2] = plastic(input, LESSER_OF_BOTH).force;
    out[3] = plastic(input, AS_PRINTED).force;
}

static void law_pair_steps(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    out[0] = input->x;
    out[1] = gb_contact_pair_critical_step(pair, elastic(input).stiffness);
    out[2] =
        gb_contact_pair_critical_step(pair, plastic(input, LESSER_OF_BOTH).stiffness);
    out[3] = gb_contact_pair_critical_step(pair, plastic(input, AS_PRINTED).stiffness);
}

/* Overlap and force at which the weaker body starts to flow, (30). */
static void law_pair_yield(const struct gb_law_table_input *input, double *out)
{
    const struct gb_contact_pair *pair = input->pair;
    const struct gb_law_hertz *law = &pair->law.hertz;
    const double force = gb_law_hertz_yield_force(law, pair->radius, pair->yield_pa);
    out[0] = gb_law_hertz_overlap(law, pair->radius, force);
    out[1] = force;
}

/* --- laws in reduced units ------------------------------------------------------------ */

static const struct gb_law_table_lattice lattices[] = {
    {"sc", 6.0, 1.0},
    {"fcc", 12.0, M_SQRT1_2},
    {"bcc", 8.0, 0.76980035891950102},    /* 4 / (3 sqrt 3) */
    {"diamond", 4.0, 1.5396007178390020}, /* 8 / (3 sqrt 3) */
};

static double newton(const struct gb_model *model, double force)
{
    return force * model->newton_per_force * 1e9;
}

static void set_force(const struct gb_model *model, double h, double force,
                      double stiffness, double *out)
{
    out[0] = h;
    out[1] = force;
    out[2] = stiffness;
    out[3] = newton(model, force);
}

static void get_rod(const struct gb_law_table_input *input, double *out)
{
    const struct gb_law_rod *rod = &input->model->rod;
    set_force(input->model, input->x, gb_law_rod_force(rod, input->x),
              gb_law_rod_stiffness(rod, input->x), out);
}

static void get_dispersion(const struct gb_law_table_input *input, double *out)
{
    const double force = gb_law_dispersion_force(&input->model->dispersion, input->x);
    out[0] = input->x;
    out[1] = force;
    out[2] = newton(input->model, force);
}

/* f_n = f_e - f_a: overlap, force, df_n/dh of the active branch, force in nN.  h_min is
 * the deepest overlap of the bridge, 0: no bridge. */
static void set_contact(const struct gb_model *model, double h, double h_min, double *out)
{
    const struct gb_law_dispersion *dispersion = &model->dispersion;
    const double attraction = gb_law_dispersion_force(dispersion, 1.0 - h);
    double force = gb_law_rod_force(&model->rod, h);
    double stiffness = gb_law_rod_stiffness(&model->rod, h);
    if (h_min > 0.0 && h_min > h) {
        force = gb_law_bridge_force(&model->rod, h_min, h);
        stiffness = gb_law_rod_stiffness(&model->rod, h_min);
    } else if (h < 0.0) {
        stiffness += gb_law_dispersion_slope(dispersion, 1.0 - h);
    }
    set_force(model, h, force - attraction, stiffness, out);
}

static void get_normal(const struct gb_law_table_input *input, double *out)
{
    set_contact(input->model, input->x, 0.0, out);
}

/* Bridges form and break on the way, where the scene has them. */
static void follow_contact(const struct gb_law_table_input *input, double *h_min,
                           double *out)
{
    const struct gb_model *model = input->model;
    *h_min = model->terms.bridges
                 ? gb_law_bridge_deepest(&model->bridge, *h_min, input->x)
                 : 0.0;
    set_contact(model, input->x, *h_min, out);
}

/* A bridge opens by its length at most: beyond that h_min follows the overlap. */
static void get_bridge(const struct gb_law_table_input *input, double *out)
{
    const double deepest = input->x + input->model->bridge.length;
    const double h_min = isnan(input->h_min) ? deepest : fmin(input->h_min, deepest);
    set_contact(input->model, input->x, h_min, out);
}

static double contact_radius(double h)
{
    return 0.5 * sqrt(fmax(h, 0.0));
}

static void get_shear(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = input->x;
    out[1] = gb_law_slip_shear_stiffness(&model->slip, contact_radius(input->x));
    out[2] = gb_law_slip_shear_cap(&model->slip, &model->rod, input->x);
}

static void get_pivot(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = input->x;
    out[1] = gb_law_slip_pivot_stiffness(&model->slip, contact_radius(input->x));
    out[2] = gb_law_slip_pivot_cap(&model->slip, &model->rod, input->x);
}

static void get_roll(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double a = contact_radius(input->x);
    out[0] = input->x;
    out[1] = gb_law_slip_roll_stiffness(&model->slip, a);
    out[2] = gb_law_slip_roll_cap(a, gb_law_rod_force(&model->rod, input->x));
}

static void get_equilibrium(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    out[0] = model->h_eq;
    out[1] = model->adhesion;
    out[2] = newton(model, model->adhesion);
}

static void get_strength(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double stress =
        gb_law_bridge_peel_stress(&model->bridge, &model->rod, input->x);
    out[0] = input->x;
    out[1] = stress * model->pascal_per_stress * 1e-9;
}

/* Pressure of a perfect lattice from the virial of its nearest neighbours. */
static void get_lattice(const struct gb_law_table_input *input, double *out)
{
    const struct gb_model *model = input->model;
    const double r = 1.0 - input->x;
    const double volume = input->lattice->volume * r * r * r;
    const double force = gb_law_rod_force(&model->rod, input->x) -
                         gb_law_dispersion_force(&model->dispersion, r);
    const double pressure = input->lattice->neighbours * force * r / (6.0 * volume);
    out[0] = input->x;
    out[1] = M_PI / 6.0 / volume;
    out[2] = pressure * model->pascal_per_stress * 1e-9;
}

/* Overlaps and distances of most laws, in diameters. */
#define OVERLAPS  .low = -1e6, .high = 1.0
#define DISTANCES .low = 0.0, .high = 1e6

static const char force_header[] = "h,force,stiffness,force_nN";
static const char slip_header[] = "h,stiffness,cap";
static const char pair_header[] = "h_m,force_N,stiffness_N_per_m";

static const struct gb_law_table_law laws[] = {
    {.name = "rod",
     .doc = "elastic force f_e of two spheres, P1 (1)",
     .header = force_header,
     .variable = "h",
     OVERLAPS,
     .values = get_rod},
    {.name = "bridge",
     .doc = "f_e - f_a of a bridged contact; h_min is its deepest overlap\n"
            "(--at h_min=0.02,h=0.012), by default h + bridge_length",
     .header = force_header,
     .variable = "h",
     .h_min = true,
     .bridged = true,
     .low = 0.0,
     .high = 1.0,
     .values = get_bridge,
     .follow = follow_contact},
    {.name = "dispersion",
     .doc = "attraction f_a at distance r, P1 (3)",
     .header = "r,force,force_nN",
     .variable = "r",
     DISTANCES,
     .values = get_dispersion},
    {.name = "normal",
     .doc = "f_e - f_a without a bridge; h below 0 is a gap",
     .header = force_header,
     .variable = "h",
     OVERLAPS,
     .values = get_normal,
     .follow = follow_contact},
    {.name = "shear",
     .doc = "stiffness per half of the relative motion, and cap, no bridge",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_shear},
    {.name = "pivot",
     .doc = "the same for pivoting",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_pivot},
    {.name = "roll",
     .doc = "the same for a bridge whose deepest overlap is h",
     .header = slip_header,
     .variable = "h",
     OVERLAPS,
     .values = get_roll},
    {.name = "equilibrium",
     .doc = "overlap where f_e = f_a, and the greatest attraction",
     .header = "h_eq,force_max,force_max_nN",
     .values = get_equilibrium},
    {.name = "bridge-strength",
     .doc = "bridge strength: breaking normal stress at overlap h",
     .header = "h,strength_GPa",
     .variable = "h",
     .bridged = true,
     .low = 0.0,
     .high = 1.0,
     .values = get_strength},
    {.name = "lattice",
     .doc = "density and pressure of a perfect lattice, nearest neighbours",
     .header = "h,density,pressure_GPa",
     .variable = "h",
     OVERLAPS,
     .values = get_lattice},
    {.name = "hertz",
     .doc = "elastic force and stiffness, P3 (2), (9)",
     .header = pair_header,
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = law_pair_hertz,
     .follow = law_pair_follow_hertz},
    {.name = "storakers",
     .doc = "plastic loading, the lesser of Hertz and P3 (16); (16) alone\n"
            "with contact.storakers=printed",
     .header = pair_header,
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = law_pair_storakers,
     .follow = law_pair_follow_storakers},
    {.name = "mindlin",
     .doc = "k_t of Hertz' contact, P3 (12), and its cap mu F",
     .header = "h_m,stiffness_N_per_m,cap_N",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = law_pair_mindlin},
    {.name = "models",
     .doc = "the force by hertz, storakers and as printed, side by side",
     .header = "h_m,hertz_N,storakers_N,printed_N",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = law_pair_models},
    {.name = "critical-step",
     .doc = "the critical time step of the two by each, P3 (27)-(29)",
     .header = "h_m,hertz_s,storakers_s,printed_s",
     .variable = "h_m",
     .pair = true,
     OVERLAPS,
     .values = law_pair_steps},
    {.name = "yield",
     .doc = "overlap and force where the weaker body starts to flow, P3 (30)",
     .header = "h_m,force_N",
     .pair = true,
     .values = law_pair_yield},
};

const struct gb_law_table_law *gb_law_table_laws(size_t *count)
{
    *count = G_N_ELEMENTS(laws);
    return laws;
}

const struct gb_law_table_lattice *gb_law_table_lattices(size_t *count)
{
    *count = G_N_ELEMENTS(lattices);
    return lattices;
}

const struct gb_law_table_law *gb_law_table_find(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(laws); i++) {
        if (strcmp(laws[i].name, name) == 0) {
            return &laws[i];
        }
    }
    return NULL;
}

const struct gb_law_table_lattice *gb_law_table_find_lattice(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(lattices); i++) {
        if (strcmp(lattices[i].name, name) == 0) {
            return &lattices[i];
        }
    }
    return NULL;
}

int gb_law_table_columns(const struct gb_law_table_law *law)
{
    int columns = 1;
    for (const char *c = law->header; *c != '\0'; c++) {
        columns += *c == ',';
    }
    return columns;
}

/* --- points, ranges and paths --------------------------------------------------------- */

enum { GB_LAW_POINTS_FIXED = 4, GB_LAW_POINTS_CORNERS = 4096 };

enum { GB_LAW_POINTS_MAX = 10000000 };

/* A number as typed: pure, or a length in m ("20 nm"). */
struct law_points_number {
    double value;
    bool length;
};

/* A variable with its value. */
struct law_points_value {
    char name[16];
    struct law_points_number number;
};

/* "h=0.01" or "h_min=0.02,h=0.012". */
struct law_points_at {
    struct law_points_value item[GB_LAW_POINTS_FIXED];
    int count;
};

/* "h=0:0.1:101": ends, number of points. */
struct law_points_range {
    char name[16];
    struct law_points_number from, to;
    int64_t count;
};

/* "0,0.02,-0.01" or "h_m=0,2e-8,1e-8": at least two values. */
struct law_points_path {
    char name[16]; /* may be empty */
    struct law_points_number corner[GB_LAW_POINTS_CORNERS];
    int count;
};

/* A whole text that is one number, or one length. */
static bool read_number(const char *text, struct law_points_number *number)
{
    number->length = !gb_units_parse(text, GB_DIM_NONE, &number->value, NULL);
    return !number->length || gb_units_parse(text, GB_DIM_LENGTH, &number->value, NULL);
}

/* Splits "name=rest"; rest is NULL when there is no name. */
static const char *read_name(const char *text, char name[16])
{
    const char *equals = strchr(text, '=');
    const size_t length = equals ? (size_t)(equals - text) : 0;
    if (length == 0 || length >= 16) {
        return NULL;
    }
    memcpy(name, text, length);
    name[length] = '\0';
    g_strstrip(name);
    return equals + 1;
}

static bool refuse(const char *option, const char *text, const char *accepted,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s %.80s: expected %s", option, text,
                        accepted);
}

/* All errors are GB_ERR_INPUT: option, what was given, what is expected. */
static bool law_points_at(struct law_points_at *at, const char *text,
                          struct gb_error *err)
{
    *at = (struct law_points_at){0};
    char **parts = g_strsplit(text, ",", GB_LAW_POINTS_FIXED + 1);
    bool good = parts[0] != NULL;
    for (int i = 0; parts[i] && good; i++) {
        struct law_points_value *item = &at->item[at->count];
        good = at->count < GB_LAW_POINTS_FIXED;
        if (good) {
            const char *number = read_name(parts[i], item->name);
            good = number && read_number(number, &item->number);
            at->count++;
        }
    }
    g_strfreev(parts);
    return good || refuse("--at", text,
                          "name=number, as in h=0.01, h_min=0.02,h=0.015 or h=20nm", err);
}

/* The error of a range; also for `from` not below `to`, which is known only once both have
 * the same unit.  Returns false. */
static bool law_points_refuse_range(const char *text, struct gb_error *err)
{
    return refuse("--range", text,
                  "name=from:to:count, from below to, count 1 to 10000000, as in "
                  "h=0:0.1:101",
                  err);
}

static bool law_points_range(struct law_points_range *range, const char *text,
                             struct gb_error *err)
{
    const char *rest = read_name(text, range->name);
    char **parts = g_strsplit(rest ? rest : "", ":", 4);
    double count = 0.0;
    const bool good = g_strv_length(parts) == 3 && read_number(parts[0], &range->from) &&
                      read_number(parts[1], &range->to) &&
                      gb_units_parse(parts[2], GB_DIM_NONE, &count, NULL) &&
                      count == floor(count) && count >= 1.0 && count <= GB_LAW_POINTS_MAX;
    g_strfreev(parts);
    range->count = good ? (int64_t)count : 0;
    return good || law_points_refuse_range(text, err);
}

/* Value `index` of `count` evenly spaced ones; the first and last are exact. */
static double law_points_between(double from, double to, int64_t count, int64_t index)
{
    if (index + 1 == count && index > 0) {
        return to;
    }
    const double share = count > 1 ? (double)index / (double)(count - 1) : 0.0;
    return from + (to - from) * share;
}

static bool law_points_path(struct law_points_path *path, const char *text,
                            struct gb_error *err)
{
    const char *rest = read_name(text, path->name);
    if (!rest) {
        path->name[0] = '\0';
        rest = text;
    }
    char **parts = g_strsplit(rest, ",", GB_LAW_POINTS_CORNERS + 1);
    const guint length = g_strv_length(parts);
    bool good = length >= 2 && length <= GB_LAW_POINTS_CORNERS;
    for (guint i = 0; i < length && good; i++) {
        good = read_number(parts[i], &path->corner[i]);
    }
    g_strfreev(parts);
    path->count = (int)length;
    return good || refuse("--path", text,
                          "two or more overlaps, as in 0,0.02,-0.01 or 0,20nm,5nm", err);
}

/* --- rows ----------------------------------------------------------------------------- */

/* Points between two corners of a path. */
enum { PATH_STEPS = 200 };

size_t gb_law_table_of_path(size_t corners)
{
    return corners > 0 ? 1 + (corners - 1) * PATH_STEPS : 0;
}

/* A request for one scene. */
struct rows {
    const struct gb_law_table_request *request;
    const struct gb_law_table_law *law;
    struct gb_law_table_input input;
    double diameter;         /* in units of the variable: 1, or m for a pair */
    double metre;            /* 1 m in units of the variable */
    gb_law_table_take *take; /* NULL: only check */
    void *data;
};

/* The variable from a typed number: pure numbers are multiples of the diameter, except
 * where the name of the variable is in m. */
static double to_variable(const struct rows *rows, const char *name,
                          struct law_points_number number)
{
    if (number.length) {
        return number.value * rows->metre;
    }
    const bool metres = rows->law->pair && strcmp(name, rows->law->variable) == 0;
    return number.value * (metres ? rows->metre : rows->diameter);
}

/* A pair's overlap may also be given as h or h/2R. */
static bool names_variable(const struct gb_law_table_law *law, const char *name)
{
    return strcmp(name, law->variable) == 0 ||
           (law->pair && (strcmp(name, "h") == 0 || strcmp(name, "h/2R") == 0));
}

static bool check_value(const struct rows *rows, double value, struct gb_error *err)
{
    const struct gb_law_table_law *law = rows->law;
    const double room = law->bridged ? rows->input.model->bridge.length : 0.0;
    const double low = law->low * rows->diameter;
    const double high = (law->high - room) * rows->diameter;
    if (value >= low && value < high) {
        return true;
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s = %g: expected %g up to below %g for %s",
                        law->variable, value, low, high, law->name);
}

static bool take_row(struct rows *rows, double x, struct gb_error *err)
{
    double value[GB_LAW_TABLE_COLUMNS];
    if (rows->take == NULL) {
        return true;
    }
    rows->input.x = x;
    rows->law->values(&rows->input, value);
    return rows->take(value, gb_law_table_columns(rows->law), rows->data, err);
}

static bool set_h_min(struct rows *rows, double value, struct gb_error *err)
{
    if (!(value > 0.0 && value < 1.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "h_min = %g: expected above 0 and below 1",
                            value);
    }
    rows->input.h_min = value;
    return true;
}

/* Reads the variables of one --at; *x stays NaN when only h_min is there. */
static bool read_at(struct rows *rows, const char *text, double *x, struct gb_error *err)
{
    struct law_points_at at;
    if (!law_points_at(&at, text, err)) {
        return false;
    }
    const struct gb_law_table_law *law = rows->law;
    *x = NAN;
    rows->input.h_min = NAN;
    for (int i = 0; i < MIN(at.count, GB_LAW_POINTS_FIXED); i++) {
        const struct law_points_value *item = &at.item[i];
        const double value = to_variable(rows, item->name, item->number);
        const bool h_min = law->h_min && strcmp(item->name, "h_min") == 0;
        if (h_min && isnan(rows->input.h_min)) {
            if (!set_h_min(rows, value, err)) {
                return false;
            }
        } else if (!h_min && names_variable(law, item->name) && isnan(*x)) {
            *x = value;
        } else {
            return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: expected %s%s, each once",
                                text, law->variable,
                                law->h_min  ? " and h_min"
                                : law->pair ? ", h or h/2R"
                                            : "");
        }
    }
    if (!isnan(*x) && !isnan(rows->input.h_min) && *x > rows->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--at %.80s: expected h up to h_min",
                            text);
    }
    return true;
}

static bool missing_variable(const struct gb_law_table_law *law, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT, "law %s needs --at %s=VALUE or --range %s=FROM:TO:COUNT%s",
        law->name, law->variable, law->variable, law->follow ? " or --path H,H,..." : "");
}

static bool take_points(struct rows *rows, struct gb_error *err)
{
    for (int i = 0; rows->request->at[i]; i++) {
        double x = NAN;
        if (!read_at(rows, rows->request->at[i], &x, err)) {
            return false;
        }
        if (isnan(x)) {
            return missing_variable(rows->law, err);
        }
        if (!check_value(rows, x, err) || !take_row(rows, x, err)) {
            return false;
        }
    }
    return true;
}

/* Beside --range one --at may hold h_min. */
static bool read_fixed(struct rows *rows, struct gb_error *err)
{
    char **at = rows->request->at;
    double x = NAN;
    if (!at) {
        return true;
    }
    if (!read_at(rows, at[0], &x, err)) {
        return false;
    }
    return (isnan(x) && !at[1]) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--at %.80s: %s is in --range already; expected one --at h_min=H",
                        at[0], rows->law->variable);
}

static bool read_range(struct rows *rows, double ends[2], int64_t *count,
                       struct gb_error *err)
{
    const char *text = rows->request->range;
    struct law_points_range range;
    if (!law_points_range(&range, text, err) || !read_fixed(rows, err)) {
        return false;
    }
    if (!names_variable(rows->law, range.name)) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: expected %s for law %s",
                            text, rows->law->variable, rows->law->name);
    }
    ends[0] = to_variable(rows, range.name, range.from);
    ends[1] = to_variable(rows, range.name, range.to);
    *count = range.count;
    if (!(ends[0] < ends[1] || (ends[0] == ends[1] && range.count == 1))) {
        return law_points_refuse_range(text, err);
    }
    if (!isnan(rows->input.h_min) && ends[1] > rows->input.h_min) {
        return gb_error_set(err, GB_ERR_INPUT, "--range %.80s: expected h up to h_min",
                            text);
    }
    return true;
}

static bool take_range(struct rows *rows, struct gb_error *err)
{
    double ends[2] = {0.0, 0.0};
    int64_t count = 0;
    if (!read_range(rows, ends, &count, err)) {
        return false;
    }
    if (!check_value(rows, ends[0], err) || !check_value(rows, ends[1], err)) {
        return false;
    }
    for (int64_t i = 0; rows->take != NULL && i < count; i++) {
        if (!take_row(rows, law_points_between(ends[0], ends[1], count, i), err)) {
            return false;
        }
    }
    return true;
}

/* Follows the history of one contact through the corners. */
static bool follow(struct rows *rows, const double *corners, int count,
                   struct gb_error *err)
{
    const int columns = gb_law_table_columns(rows->law);
    double value[GB_LAW_TABLE_COLUMNS], deepest = 0.0;
    for (int leg = 0; leg < count; leg++) {
        const double from = corners[leg > 0 ? leg - 1 : 0];
        const int steps = leg > 0 ? PATH_STEPS : 1;
        for (int i = 1; i <= steps; i++) {
            rows->input.x = law_points_between(from, corners[leg], steps + 1, i);
            rows->law->follow(&rows->input, &deepest, value);
            if (!rows->take(value, columns, rows->data, err)) {
                return false;
            }
        }
    }
    return true;
}

/* The corners in units of the variable.  The range of the law is not checked along a path,
 * but the centres must not meet. */
static bool read_path(const struct rows *rows, double *corners, int *count,
                      struct gb_error *err)
{
    const char *text = rows->request->path;
    struct law_points_path *path = g_new0(struct law_points_path, 1);
    bool good = law_points_path(path, text, err);
    if (good && path->name[0] && !names_variable(rows->law, path->name)) {
        good = gb_error_set(err, GB_ERR_INPUT, "--path %.80s: expected %s for law %s",
                            text, rows->law->variable, rows->law->name);
    }
    for (int i = 0; good && i < path->count; i++) {
        corners[i] = to_variable(rows, path->name, path->corner[i]);
        if (!(corners[i] > -1e6 * rows->diameter && corners[i] < rows->diameter)) {
            good = gb_error_set(err, GB_ERR_INPUT, "--path %.80s: expected %s below %g",
                                text, rows->law->variable, rows->diameter);
        }
    }
    *count = path->count;
    g_free(path);
    return good;
}

static bool take_path(struct rows *rows, struct gb_error *err)
{
    double *corners = g_new(double, GB_LAW_POINTS_CORNERS);
    int count = 0;
    const bool good = read_path(rows, corners, &count, err) &&
                      (rows->take == NULL || follow(rows, corners, count, err));
    g_free(corners);
    return good;
}

/* Which options this law takes, and that the scene has what it describes. */
static bool check_request(const struct rows *rows, struct gb_error *err)
{
    const struct gb_law_table_request *request = rows->request;
    const struct gb_law_table_law *law = rows->law;
    const int given = (request->path ? 1 : 0) + (request->range || request->at ? 1 : 0);
    if (law->bridged && !rows->input.model->terms.bridges) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "law %s: the scene has no bridges; expected "
                            "contact.bridge_length below 1 d",
                            law->name);
    }
    if ((request->path && !law->follow) || given > 1 || (!law->variable && given > 0)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: expected %s", law->name,
                            !law->variable ? "no --at, --range or --path"
                            : law->follow  ? "--at, --range or --path alone"
                                           : "--at or --range");
    }
    return !law->variable || given > 0 || missing_variable(law, err);
}

static bool take_rows(struct rows *rows, struct gb_error *err)
{
    if (!check_request(rows, err)) {
        return false;
    }
    if (!rows->law->variable) {
        return take_row(rows, NAN, err);
    }
    return rows->request->path    ? take_path(rows, err)
           : rows->request->range ? take_range(rows, err)
                                  : take_points(rows, err);
}

/* The laws of P3: two bodies, SI units. */
static bool take_pair(struct rows *rows, const struct gb_params *params,
                      struct gb_error *err)
{
    struct gb_contact_pair pair;
    if (!gb_params_check_fields(params, err) ||
        !gb_contact_pair_init(&pair, params, err)) {
        return false;
    }
    rows->input.pair = &pair;
    rows->diameter = pair.diameter;
    rows->metre = 1.0;
    return take_rows(rows, err);
}

/* The laws of P1 also show the constants of a die's powder. */
static bool has_law(const struct gb_model *model, int normal)
{
    return gb_loading_kind_at(model->kind)->periodic_cell ? model->normal == normal
                                                          : normal == GB_NORMAL_ROD;
}

/* Particles of one size, reduced units. */
static bool take_reduced(struct rows *rows, const struct gb_params *params,
                         struct gb_error *err)
{
    struct gb_model model;
    if (!gb_params_check(params, err) || !gb_model_init(&model, params, err)) {
        return false;
    }
    if (!has_law(&model, rows->law->normal)) {
        return gb_error_set(err, GB_ERR_INPUT, "law %s: expected contact.normal = %s%s",
                            rows->law->name, gb_normal_law_at(rows->law->normal)->name,
                            model.normal == GB_NORMAL_HERTZ
                                ? "; law hertz is for grains without cohesion"
                                : "");
    }
    rows->input.model = &model;
    rows->diameter = 1.0;
    rows->metre = 1.0 / model.metre_per_length;
    return take_rows(rows, err);
}

bool gb_law_table_compute(const struct gb_law_table_request *request,
                          const struct gb_params *params, gb_law_table_take *take,
                          void *data, struct gb_error *err)
{
    struct rows rows = {
        .request = request,
        .law = request->law,
        .input = {.lattice = request->lattice, .h_min = NAN},
        .take = take,
        .data = data,
    };
    return request->law->pair ? take_pair(&rows, params, err)
                              : take_reduced(&rows, params, err);
}

bool gb_law_table_check(const struct gb_law_table_request *request,
                        const struct gb_params *params, struct gb_error *err)
{
    return gb_law_table_compute(request, params, NULL, NULL, err);
}
