#include <glib.h>
#include <math.h>
#include <string.h>

#include "scene/path/path_reading.h"

static void lead(struct gb_leg *leg, int component)
{
    leg->leading = component;
    leg->component[component] = (struct gb_leg_component){GB_LEG_STRAIN, 1.0, component};
}

static void hold(struct gb_leg *leg, int component, double stress)
{
    leg->component[component] =
        (struct gb_leg_component){GB_LEG_STRESS, stress, component};
}

/* What moves, and what is held unless `at` says otherwise. */

static unsigned lateral(const struct gb_path_reading *in)
{
    unsigned members = 0;
    for (int k = 0; k < 3; k++) {
        const bool other = k != in->leg->leading;
        members |= other && gb_path_has_component(in->dimension, k) ? 1u << k : 0u;
    }
    return members;
}

static void hold_members(struct gb_path_reading *in, unsigned members, double stress)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if ((members >> k & 1u) != 0) {
            hold(in->leg, k, stress);
        }
    }
}

/* An axis, z when none is named. */
static bool read_axis(struct gb_path_reading *in)
{
    const int next = in->words.next;
    const int axis = gb_path_words_component(&in->words);
    if (axis >= 0 && (axis > 2 || !gb_path_has_component(in->dimension, axis))) {
        in->words.next = next;
        return gb_path_reading_expected(in, in->dimension == 3 ? "x, y or z" : "x or z");
    }
    lead(in->leg, axis >= 0 ? axis : 2);
    in->leg->extension = gb_path_words_accept(&in->words, "extension");
    return true;
}

static bool set_uniaxial(struct gb_path_reading *in, unsigned *own)
{
    (void)own;
    return read_axis(in);
}

static bool set_biaxial(struct gb_path_reading *in, unsigned *own)
{
    (void)own;
    if (in->dimension == 2) {
        return gb_error_set(in->err, GB_ERR_INPUT,
                            "biaxial: must be uniaxial or isotropic with "
                            "scene.dimension = 2");
    }
    lead(in->leg, 1);
    lead(in->leg, 2);
    in->leg->extension = gb_path_words_accept(&in->words, "extension");
    return true;
}

static bool set_isotropic(struct gb_path_reading *in, unsigned *own)
{
    (void)own;
    for (int k = 0; k < 3; k++) {
        if (gb_path_has_component(in->dimension, k)) {
            lead(in->leg, k);
        }
    }
    in->leg->extension = gb_path_words_accept(&in->words, "extension");
    return true;
}

static bool set_triaxial(struct gb_path_reading *in, unsigned *own)
{
    if (!read_axis(in)) {
        return false;
    }
    *own = lateral(in);
    hold_members(in, *own, (double)NAN);
    return true;
}

static bool set_shear(struct gb_path_reading *in, unsigned *own)
{
    int component = -1;
    (void)own;
    if (!gb_path_reading_component(in, &component)) {
        return false;
    }
    if (component < 3) {
        in->words.next--; /* the message names it */
        return gb_path_reading_expected(in, in->dimension == 3 ? "xy, xz or yz" : "xz");
    }
    lead(in->leg, component);
    return true;
}

static bool set_radial(struct gb_path_reading *in, unsigned *own)
{
    double ratio = (double)NAN;
    if (!read_axis(in)) {
        return false;
    }
    gb_path_words_quantity(&in->words, GB_DIM_NONE, &ratio);
    if (ratio == 0.0) {
        return gb_error_set(
            in->err, GB_ERR_INPUT,
            "'radial 0': a fraction must not be 0; to hold the other axes "
            "at a pressure, write triaxial");
    }
    *own = lateral(in);
    for (int k = 0; k < 3; k++) {
        if ((*own >> k & 1u) != 0) {
            in->leg->component[k] =
                (struct gb_leg_component){GB_LEG_RATIO, ratio, in->leg->leading};
        }
    }
    return true;
}

/* "strain z = 1, x = -0.5 to 5 %": the first component leads. */
static bool set_strain(struct gb_path_reading *in, unsigned *own)
{
    (void)own;
    do {
        struct gb_leg_component control = {GB_LEG_STRAIN, 1.0, -1};
        int component = -1;
        if (!gb_path_reading_component(in, &component) ||
            !gb_path_reading_give(in, component) ||
            !gb_path_reading_number(in, &control.value)) {
            return false;
        }
        if (in->leg->leading < 0 && control.value == 0.0) {
            return gb_error_set(in->err, GB_ERR_INPUT,
                                "the first strain leads: must not be 0");
        }
        in->leg->leading = in->leg->leading < 0 ? component : in->leg->leading;
        in->leg->component[component] = control;
    } while (gb_path_words_accept(&in->words, ","));
    const double scale = in->leg->component[in->leg->leading].value;
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        in->leg->component[k].value /= scale;
    }
    return true;
}

static bool moves(const struct gb_leg_component *component)
{
    return component->control != GB_LEG_STRAIN || component->value != 0.0;
}

/* The axis that leads the unloading of a leg: one that strain moved, or one whose stress it
 * held; -1: none. */
static int unloaded_axis(const struct gb_leg *last)
{
    int axis = -1;
    for (int k = 0; k < 3 && last->leading >= 0; k++) {
        const bool strained = last->component[k].control == GB_LEG_STRAIN;
        if (moves(&last->component[k]) &&
            (axis < 0 || strained || last->component[axis].control != GB_LEG_STRAIN)) {
            axis = k;
        }
    }
    return axis;
}

/* Axes that strain moved move back alike; held stresses fall in proportion; axes of fixed
 * width stay, like the walls of a die. */
static void reverse(struct gb_leg *leg, const struct gb_leg *last, int leading)
{
    const double scale = last->component[leading].control == GB_LEG_STRAIN
                             ? last->component[leading].value
                             : 1.0;
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const struct gb_leg_component *then = &last->component[k];
        struct gb_leg_component *now = &leg->component[k];
        if (then->control != GB_LEG_STRAIN) {
            *now = (struct gb_leg_component){GB_LEG_RATIO, (double)NAN, leading};
        } else if (k < 3) {
            *now = (struct gb_leg_component){GB_LEG_STRAIN, then->value / scale, -1};
        }
    }
    lead(leg, leading);
}

static bool set_unload(struct gb_path_reading *in, unsigned *own)
{
    (void)own;
    for (int l = in->before->count - 1; l >= 0; l--) {
        const struct gb_leg *last = &in->before->leg[l];
        const int leading = unloaded_axis(last);
        if (leading >= 0) {
            reverse(in->leg, last, leading);
            return true;
        }
    }
    return gb_error_set(in->err, GB_ERR_INPUT,
                        "unload: must follow a leg that moves or holds an axis");
}

static bool set_hold(struct gb_path_reading *in, unsigned *own)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const bool there = k < 3 && gb_path_has_component(in->dimension, k);
        *own |= there ? 1u << k : 0u;
    }
    hold_members(in, *own, (double)NAN);
    return true;
}

static bool end_steps(struct gb_path_reading *in)
{
    struct gb_leg *leg = in->leg;
    double times = 1.0;
    if (gb_path_words_quantity(&in->words, GB_DIM_NONE, &times) &&
        !gb_path_words_accept(&in->words, "times")) {
        return gb_path_reading_expected(in, "'times', as in hold 5 times");
    }
    leg->end[0] = (struct gb_leg_end){GB_LEG_END_STEPS, times, -1};
    leg->end_count = 1;
    return (times >= 1.0 && times <= 1e6 && floor(times) == times) ||
           gb_error_set(in->err, GB_ERR_INPUT,
                        "%g times: must be a whole number from 1 to 1000000", times);
}

static bool end_unload(struct gb_path_reading *in)
{
    if (strcmp(gb_path_words_peek(&in->words), "to") == 0) {
        return gb_path_reading_ends(in);
    }
    in->leg->end[0] = (struct gb_leg_end){GB_LEG_END_PRESSURE, 0.0, in->leg->leading};
    in->leg->end_count = 1;
    return true;
}

/* THE table of shorthands. */
static const struct shorthand {
    const char *word, *usage, *doc;
    bool (*set)(struct gb_path_reading *in, unsigned *own);
    bool (*end)(struct gb_path_reading *in);
} table[] = {
    {"uniaxial", "uniaxial [x|y|z] to END", "one axis is strained, the others are fixed",
     set_uniaxial, gb_path_reading_ends},
    {"biaxial", "biaxial to END", "y and z are strained alike, x is fixed", set_biaxial,
     gb_path_reading_ends},
    {"isotropic", "isotropic to END", "all axes are strained alike", set_isotropic,
     gb_path_reading_ends},
    {"triaxial", "triaxial [x|y|z] [extension] to END [at STRESS]",
     "one axis is strained, the stresses of the other two are held", set_triaxial,
     gb_path_reading_ends},
    {"shear", "shear xy|xz|yz to END [at HELD]",
     "simple shear at constant volume, or at held stresses", set_shear,
     gb_path_reading_ends},
    {"radial", "radial [RATIO] to END",
     "one axis is strained, the stresses of the others are a fraction of its own",
     set_radial, gb_path_reading_ends},
    {"strain", "strain z = 1, x = -0.5, ... to END [at HELD]",
     "any strains in proportion; the first leads, those not named are fixed", set_strain,
     gb_path_reading_ends},
    {"hold", "hold [HELD] [N times]", "stresses stay while the packing relaxes", set_hold,
     end_steps},
    {"unload", "unload [to END]",
     "the axes that were strained or held are unloaded in proportion", set_unload,
     end_unload},
};

bool gb_path_parse_shorthand(int index, const char **usage, const char **doc)
{
    const int count = (int)(sizeof table / sizeof table[0]);
    if (index == count) {
        *usage = "cycle N times LEG between END and END [at HELD]";
        *doc = "goes to the first end and to the second, N times";
        return true;
    }
    if (index > count) {
        return false;
    }
    *usage = table[index].usage;
    *doc = table[index].doc;
    return true;
}

static const struct shorthand *find_shorthand(struct gb_path_reading *in)
{
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (gb_path_words_accept(&in->words, table[i].word)) {
            return &table[i];
        }
    }
    gb_path_reading_expected(
        in, "uniaxial, biaxial, isotropic, triaxial, shear, radial, strain, hold, "
            "unload or cycle");
    return NULL;
}

static bool read_cycles(struct gb_path_reading *in)
{
    double times = 0.0;
    if (!gb_path_words_quantity(&in->words, GB_DIM_NONE, &times) ||
        !gb_path_words_accept(&in->words, "times") || !(times >= 1.0 && times <= 1e6) ||
        floor(times) != times) {
        return gb_path_reading_expected(
            in, "a whole number and 'times', as in cycle 5 times");
    }
    in->leg->cycles = (int)times;
    return true;
}

static bool read_leg(struct gb_path_reading *in)
{
    struct gb_leg *leg = in->leg;
    unsigned own = 0;
    const bool cycle = gb_path_words_accept(&in->words, "cycle");
    if (cycle && !read_cycles(in)) {
        return false;
    }
    const struct shorthand *shorthand = find_shorthand(in);
    if (shorthand == NULL || !shorthand->set(in, &own)) {
        return false;
    }
    if (cycle && leg->leading < 0) {
        return gb_error_set(in->err, GB_ERR_INPUT, "cycle: must be of a leg that moves");
    }
    const bool holds = shorthand->end == end_steps; /* what is held stands before */
    const bool named = gb_path_words_accept(&in->words, "at") ||
                       (holds && (gb_path_words_peek(&in->words)[0] != '\0' &&
                                  !g_ascii_isdigit(gb_path_words_peek(&in->words)[0])));
    if (named && !gb_path_reading_controls(in, own)) {
        return false;
    }
    if (!(cycle ? gb_path_reading_reversals(in) : shorthand->end(in))) {
        return false;
    }
    if (named && strcmp(gb_path_words_peek(&in->words), "at") == 0) {
        return gb_error_set(in->err, GB_ERR_INPUT, "'at': must be given once in a leg");
    }
    if (!gb_path_reading_at(in, own)) {
        return false;
    }
    return gb_path_words_peek(&in->words)[0] == '\0' ||
           gb_path_reading_expected(in, "the end of the leg; legs are separated by ';'");
}

/* Everything is fixed but what the leg says. */
static void init_leg(struct gb_leg *leg, const char *text)
{
    *leg = (struct gb_leg){.leading = -1};
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        leg->component[k].of = -1;
    }
    g_strlcpy(leg->text, text, sizeof leg->text);
}

bool gb_path_parse_leg(struct gb_path *path, const char *text, int dimension,
                       struct gb_error *err)
{
    struct gb_path_reading in = {.before = path, .dimension = dimension, .err = err};
    if (path->count == GB_PATH_LEGS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "must be at most %d legs",
                            GB_PATH_LEGS_MAX);
    }
    in.leg = &path->leg[path->count];
    init_leg(in.leg, text);
    const bool good = gb_path_words_init(&in.words, text, err) && read_leg(&in);
    gb_path_words_finish(&in.words);
    path->count += good;
    return good;
}

char **gb_path_parse_split(const char *text)
{
    char **phrases = g_regex_split_simple("\\s*;\\s*|\\s+then\\s+", text, 0, 0);
    GPtrArray *legs = g_ptr_array_new();
    for (int i = 0; phrases[i] != NULL; i++) {
        const bool last = phrases[i + 1] == NULL;
        if (g_strstrip(phrases[i])[0] == '\0' && (last || legs->len == 0)) {
            g_free(phrases[i]); /* GLib ends a list by ';' */
        } else {
            g_ptr_array_add(legs, phrases[i]);
        }
    }
    g_free(phrases);
    g_ptr_array_add(legs, NULL);
    return (char **)g_ptr_array_free(legs, FALSE);
}

bool gb_path_parse(struct gb_path *path, const char *text, int dimension,
                   struct gb_error *err)
{
    char **legs = gb_path_parse_split(text);
    bool good = true;
    path->count = 0;
    for (int i = 0; legs[i] != NULL && good; i++) {
        struct gb_error why = {0};
        good = gb_path_parse_leg(path, legs[i], dimension, &why) ||
               gb_error_set(err, GB_ERR_INPUT, "loading.path, leg %d '%.60s': %s", i + 1,
                            legs[i], why.text);
    }
    g_strfreev(legs);
    return good;
}
