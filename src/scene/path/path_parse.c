#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/units.h"
#include "greenbody/dimension.h"
#include "greenbody/status.h"
#include "scene/path/path.h"

/* Parser of loading.path. gb_path_parse_split separates the legs, and split_words turns
 * the text of a leg into words.  The read_... functions take words from the left and
 * fill the leg.  A table of shorthands has the kinds of legs (uniaxial, shear, unload,
 * ...): `set` reads what follows the first word and sets the components, `end` reads
 * where the leg ends.  After a shorthand come optional controls ("at z = 50 MPa"). */

/* The words of one leg: "shear", "xz", "to", "20", "%", "at", "z", "=", "50", "MPa". */
enum { WORDS_MAX = 48 };

struct path_words {
    int count, next;
    char *word[WORDS_MAX]; /* into the text of `storage` */
    char *storage;
};

/* A leg that is being read.  The read functions take words and fill the leg.  On error
 * they fill err with the word and what is expected instead. */
struct path_reading {
    struct path_words words;
    struct gb_leg *leg;
    const struct gb_path *before; /* the earlier legs */
    int dimension;
    unsigned given; /* bits of the components that the leg has named */
    struct gb_error *err;
};

static bool stands_alone(char c)
{
    return c == '=' || c == ',';
}

/* Copies text with blanks around '=' and ',' and before '%'. */
static char *spread(const char *text)
{
    GString *out = g_string_new(NULL);
    for (const char *c = text; *c != '\0'; c++) {
        if (stands_alone(*c)) {
            g_string_append_printf(out, " %c ", *c);
        } else if (*c == '%') {
            g_string_append(out, " %");
        } else {
            g_string_append_c(out, *c);
        }
    }
    return g_string_free(out, FALSE);
}

/* Errors: GB_ERR_INPUT if the leg has too many words. */
static bool split_words(struct path_words *words, const char *text, struct gb_error *err)
{
    *words = (struct path_words){.storage = spread(text)};
    char *rest = words->storage;
    for (;;) {
        rest += strspn(rest, " \t");
        if (*rest == '\0') {
            return true;
        }
        if (words->count == WORDS_MAX) {
            return gb_error_set(err, GB_ERR_INPUT, "must be at most %d words", WORDS_MAX);
        }
        words->word[words->count++] = rest;
        rest += strcspn(rest, " \t");
        if (*rest != '\0') {
            *rest++ = '\0';
        }
    }
}

static void free_words(struct path_words *words)
{
    g_free(words->storage);
    words->storage = NULL;
}

/* The next word, or "" after the last. */
static const char *peek_word(const struct path_words *words)
{
    return words->next < words->count ? words->word[words->next] : "";
}

/* Takes the next word if it equals `word`. */
static bool accept_word(struct path_words *words, const char *word)
{
    const bool same = strcmp(peek_word(words), word) == 0;
    words->next += same;
    return same;
}

/* Takes a number with its unit: "50 MPa", "20 %", "0.2".  Returns false and takes
 * nothing if the next words are not a quantity. */
static bool take_quantity(struct path_words *words, enum gb_dimension dimension,
                          double *value)
{
    const int left = words->count - words->next;
    for (int used = left < 2 ? left : 2; used >= 1; used--) {
        char *text = used == 2 ? g_strjoin(" ", words->word[words->next],
                                           words->word[words->next + 1], NULL)
                               : g_strdup(words->word[words->next]);
        const bool good = gb_units_parse(text, dimension, value, NULL);
        g_free(text);
        if (good) {
            words->next += used;
            return true;
        }
    }
    return false;
}

/* Takes the name of a component.  Returns -1 if the next word is not one. */
static int take_component(struct path_words *words)
{
    const char *word = peek_word(words);
    const int component = gb_path_component_find(word, strlen(word));
    words->next += component >= 0;
    return component;
}

static bool is_number(const char *word)
{
    const char *end = word;
    double value = 0.0;
    return gb_units_number(word, &end, &value) && end != word && *end == '\0';
}

/* Is the word a unit of any dimension, or does it look like a pressure unit? */
static bool is_unit(const char *word)
{
    char *one = g_strdup_printf("1 %s", word);
    double value = 0.0;
    bool found = g_ascii_isalpha(word[0]) && g_str_has_suffix(word, "Pa");
    for (int k = GB_DIM_FRACTION; !found && word[0] != '\0' && k <= GB_DIM_COMPLIANCE;
         k++) {
        found = gb_units_parse(one, (enum gb_dimension)k, &value, NULL);
    }
    g_free(one);
    return found;
}

/* Fills err with the word and what is expected.  Always false. */
static bool expected(struct path_reading *in, const char *what)
{
    const char *word = peek_word(&in->words);
    if (in->words.next > 0 && is_number(in->words.word[in->words.next - 1]) &&
        is_unit(word)) {
        return gb_error_set(in->err, GB_ERR_INPUT,
                            "'%.24s %.24s': its unit must be one of %s for a "
                            "pressure, %% for a strain, none for a density or a ratio",
                            in->words.word[in->words.next - 1], word,
                            gb_units_accepted(GB_DIM_PRESSURE));
    }
    return word[0] != '\0'
               ? gb_error_set(in->err, GB_ERR_INPUT, "'%.24s': must be %s", word, what)
               : gb_error_set(in->err, GB_ERR_INPUT,
                              "ends too early: must continue with %s", what);
}

/* Reads a component that exists in this scene. */
static bool read_component(struct path_reading *in, int *component)
{
    const int next = in->words.next;
    *component = take_component(&in->words);
    if (*component >= 0 && gb_path_has_component(in->dimension, *component)) {
        return true;
    }
    in->words.next = next;
    return expected(in, in->dimension == 3 ? "x, y, z, xy, xz or yz"
                                           : "x, z or xz with scene.dimension = 2");
}

/* Marks a component as named.  Errors: it was named before. */
static bool mark_given(struct path_reading *in, int component)
{
    if ((in->given >> component & 1u) != 0) {
        return gb_error_set(in->err, GB_ERR_INPUT, "'%s': must be given once in a leg",
                            gb_path_component_name(component));
    }
    in->given |= 1u << component;
    return true;
}

static bool read_pressure(struct path_reading *in, double *value)
{
    accept_word(&in->words, "=");
    return take_quantity(&in->words, GB_DIM_PRESSURE, value) ||
           expected(in, "a pressure with its unit, as in 50 MPa");
}

/* Reads "0.5" or "= 0.5". */
static bool read_number(struct path_reading *in, double *value)
{
    accept_word(&in->words, "=");
    return take_quantity(&in->words, GB_DIM_NONE, value) || expected(in, "a number");
}

static bool read_density_end(struct path_reading *in, struct gb_leg_end *end)
{
    end->kind = GB_LEG_END_DENSITY;
    return read_number(in, &end->value) &&
           ((end->value > 0.0 && end->value < 1.0) ||
            gb_error_set(in->err, GB_ERR_INPUT, "density %g: must be between 0 and 1",
                         end->value));
}

static bool read_stress_end(struct path_reading *in, int component,
                            struct gb_leg_end *end)
{
    end->kind = GB_LEG_END_STRESS;
    end->of = component;
    return gb_path_has_component(in->dimension, component)
               ? read_pressure(in, &end->value)
               : gb_error_set(in->err, GB_ERR_INPUT,
                              "%s: must be x, z or xz with scene.dimension = 2",
                              gb_path_component_name(component));
}

/* Reads an end without a name. "50 MPa" is the pressure of the strained axes, or the
 * shear stress of a shear leg; "20 %" is the strain. */
static bool read_own_end(struct path_reading *in, struct gb_leg_end *end)
{
    if (take_quantity(&in->words, GB_DIM_PRESSURE, &end->value)) {
        const int leading = in->leg->leading;
        end->kind = leading >= 3 ? GB_LEG_END_STRESS : GB_LEG_END_PRESSURE;
        end->of = leading;
        return true;
    }
    end->kind = GB_LEG_END_STRAIN;
    return take_quantity(&in->words, GB_DIM_FRACTION, &end->value) ||
           expected(in, "an end: a pressure (50 MPa, z = 50 MPa), a strain (20 %), "
                        "density 0.5, p, q or q/p");
}

static bool read_one_end(struct path_reading *in, struct gb_leg_end *end)
{
    struct path_words *words = &in->words;
    *end = (struct gb_leg_end){.of = in->leg->leading};
    if (accept_word(words, "density")) {
        return read_density_end(in, end);
    }
    if (accept_word(words, "q/p")) {
        end->kind = GB_LEG_END_RATIO;
        return read_number(in, &end->value);
    }
    if (accept_word(words, "q")) {
        end->kind = GB_LEG_END_Q;
        return read_pressure(in, &end->value);
    }
    if (accept_word(words, "p")) {
        end->kind = GB_LEG_END_MEAN;
        return read_pressure(in, &end->value);
    }
    const int component = take_component(words);
    return component >= 0 ? read_stress_end(in, component, end) : read_own_end(in, end);
}

/* Reads "to 50 MPa", "to q/p = 0.8 or 20 %". */
static bool read_ends(struct path_reading *in)
{
    struct gb_leg *leg = in->leg;
    if (!accept_word(&in->words, "to")) {
        return expected(in, "'to' and an end, as in to 50 MPa or to 20 %");
    }
    do {
        if (leg->end_count == GB_PATH_ENDS_MAX) {
            return gb_error_set(in->err, GB_ERR_INPUT, "must have at most %d ends",
                                GB_PATH_ENDS_MAX);
        }
        if (!read_one_end(in, &leg->end[leg->end_count++])) {
            return false;
        }
    } while (accept_word(&in->words, "or"));
    return true;
}

/* Reads "between -1 % and 1 %" of a cycle. */
static bool read_reversals(struct path_reading *in)
{
    struct gb_leg *leg = in->leg;
    leg->end_count = 2;
    if (!accept_word(&in->words, "between")) {
        return expected(in, "'between', as in between 20 MPa and 100 MPa");
    }
    if (!read_one_end(in, &leg->end[0])) {
        return false;
    }
    if (!accept_word(&in->words, "and")) {
        return expected(in, "'and' and the other end");
    }
    if (!read_one_end(in, &leg->end[1])) {
        return false;
    }
    return (leg->end[0].kind == leg->end[1].kind && leg->end[0].of == leg->end[1].of &&
            leg->end[0].value != leg->end[1].value) ||
           gb_error_set(in->err, GB_ERR_INPUT,
                        "between: must be two different values of one quantity");
}

/* Reads "x = y =" or "x = y by" and collects bits of the components; none if no
 * component is named.  False: '=' or 'by' is missing, or a component was named before. */
static bool read_members(struct path_reading *in, unsigned *members)
{
    for (int next = take_component(&in->words); next >= 0;
         next = take_component(&in->words)) {
        if (!mark_given(in, next)) {
            return false;
        }
        *members |= 1u << next;
        if (strcmp(peek_word(&in->words), "by") == 0) {
            return true;
        }
        if (!accept_word(&in->words, "=")) {
            return expected(in, "'=' or 'by'");
        }
    }
    return true;
}

/* Reads "50 MPa", "0.5 z", "held", "by 0.5 z". */
static bool read_value(struct path_reading *in, struct gb_leg_component *control)
{
    const bool by = accept_word(&in->words, "by");
    if (!by && (accept_word(&in->words, "held") ||
                take_quantity(&in->words, GB_DIM_PRESSURE, &control->value))) {
        return true;
    }
    control->control = by ? GB_LEG_FOLLOW : GB_LEG_RATIO;
    if (!take_quantity(&in->words, GB_DIM_NONE, &control->value)) {
        return expected(
            in, by ? "a fraction of the change of another component, as in by 0.5 z"
                   : "a pressure (50 MPa), a fraction of another component (0.5 z) or "
                     "'held'");
    }
    if (control->value == 0.0) {
        return gb_error_set(in->err, GB_ERR_INPUT,
                            "'0': a fraction must not be 0; write 0 MPa or held");
    }
    return read_component(in, &control->of);
}

static bool set_control(struct path_reading *in, int k,
                        const struct gb_leg_component *control)
{
    const char *why = k == in->leg->leading ? "it leads the leg"
                      : k == control->of    ? "it would be a fraction of itself"
                      : gb_path_has_component(in->dimension, k)
                          ? NULL
                          : "scene.dimension = 2 has x, z and xz";
    if (why != NULL) {
        return gb_error_set(in->err, GB_ERR_INPUT, "%s: cannot be held here: %s",
                            gb_path_component_name(k), why);
    }
    in->leg->component[k] = *control;
    return true;
}

/* Reads "x = y = z = 50 MPa", "x = y = 0.5 z", "z = held", "x = y by -0.5 z".  The
 * components may be omitted if the leg has its own (triaxial, hold): "50 MPa". */
static bool read_control(struct path_reading *in, unsigned own)
{
    struct gb_leg_component control = {GB_LEG_STRESS, (double)NAN, -1};
    unsigned members = 0;
    if (!read_members(in, &members)) {
        return false;
    }
    members = members != 0 ? members : own;
    if (members == 0) {
        return expected(in, "a component to hold, as in z = 50 MPa");
    }
    bool good = read_value(in, &control);
    for (int k = 0; k < GB_PATH_COMPONENTS && good; k++) {
        good = (members >> k & 1u) == 0 || set_control(in, k, &control);
    }
    return good;
}

/* Reads "z = 50 MPa, x = y = 0.5 z". own: bits of the components that apply if none is
 * named. */
static bool read_controls(struct path_reading *in, unsigned own)
{
    do {
        if (!read_control(in, own)) {
            return false;
        }
    } while (accept_word(&in->words, ",") || accept_word(&in->words, "and"));
    return true;
}

/* Reads "at z = 50 MPa", or nothing. */
static bool read_at(struct path_reading *in, unsigned own)
{
    return !accept_word(&in->words, "at") || read_controls(in, own);
}

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

/* The axes other than the leading one.  A shorthand holds them unless `at` gives other
 * controls. */

static unsigned lateral(const struct path_reading *in)
{
    unsigned members = 0;
    for (int k = 0; k < 3; k++) {
        const bool other = k != in->leg->leading;
        members |= other && gb_path_has_component(in->dimension, k) ? 1u << k : 0u;
    }
    return members;
}

static void hold_members(struct path_reading *in, unsigned members, double stress)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if ((members >> k & 1u) != 0) {
            hold(in->leg, k, stress);
        }
    }
}

/* Reads an axis; z if none is named. */
static bool read_axis(struct path_reading *in)
{
    const int next = in->words.next;
    const int axis = take_component(&in->words);
    if (axis >= 0 && (axis > 2 || !gb_path_has_component(in->dimension, axis))) {
        in->words.next = next;
        return expected(in, in->dimension == 3 ? "x, y or z" : "x or z");
    }
    lead(in->leg, axis >= 0 ? axis : 2);
    in->leg->extension = accept_word(&in->words, "extension");
    return true;
}

static bool set_uniaxial(struct path_reading *in, unsigned *own)
{
    (void)own;
    return read_axis(in);
}

static bool set_biaxial(struct path_reading *in, unsigned *own)
{
    (void)own;
    if (in->dimension == 2) {
        return gb_error_set(in->err, GB_ERR_INPUT,
                            "biaxial: must be uniaxial or isotropic with "
                            "scene.dimension = 2");
    }
    lead(in->leg, 1);
    lead(in->leg, 2);
    in->leg->extension = accept_word(&in->words, "extension");
    return true;
}

static bool set_isotropic(struct path_reading *in, unsigned *own)
{
    (void)own;
    for (int k = 0; k < 3; k++) {
        if (gb_path_has_component(in->dimension, k)) {
            lead(in->leg, k);
        }
    }
    in->leg->extension = accept_word(&in->words, "extension");
    return true;
}

static bool set_triaxial(struct path_reading *in, unsigned *own)
{
    if (!read_axis(in)) {
        return false;
    }
    *own = lateral(in);
    hold_members(in, *own, (double)NAN);
    return true;
}

static bool set_shear(struct path_reading *in, unsigned *own)
{
    int component = -1;
    (void)own;
    if (!read_component(in, &component)) {
        return false;
    }
    if (component < 3) {
        in->words.next--; /* so that the message names this word */
        return expected(in, in->dimension == 3 ? "xy, xz or yz" : "xz");
    }
    lead(in->leg, component);
    return true;
}

static bool set_radial(struct path_reading *in, unsigned *own)
{
    double ratio = (double)NAN;
    if (!read_axis(in)) {
        return false;
    }
    take_quantity(&in->words, GB_DIM_NONE, &ratio);
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

/* Reads "strain z = 1, x = -0.5 to 5 %".  The first component leads. */
static bool set_strain(struct path_reading *in, unsigned *own)
{
    (void)own;
    do {
        struct gb_leg_component control = {GB_LEG_STRAIN, 1.0, -1};
        int component = -1;
        if (!read_component(in, &component) || !mark_given(in, component) ||
            !read_number(in, &control.value)) {
            return false;
        }
        if (in->leg->leading < 0 && control.value == 0.0) {
            return gb_error_set(in->err, GB_ERR_INPUT,
                                "the first strain leads: must not be 0");
        }
        in->leg->leading = in->leg->leading < 0 ? component : in->leg->leading;
        in->leg->component[component] = control;
    } while (accept_word(&in->words, ","));
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

/* The axis that leads the unloading of a leg: an axis moved by strain, or else one
 * whose stress was held; -1: none. */
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

/* Reverses a leg.  Axes moved by strain return in the same proportion, held stresses
 * fall in proportion, and fixed axes stay fixed, like the walls of a die. */
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

static bool set_unload(struct path_reading *in, unsigned *own)
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

static bool set_hold(struct path_reading *in, unsigned *own)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const bool there = k < 3 && gb_path_has_component(in->dimension, k);
        *own |= there ? 1u << k : 0u;
    }
    hold_members(in, *own, (double)NAN);
    return true;
}

static bool end_steps(struct path_reading *in)
{
    struct gb_leg *leg = in->leg;
    double times = 1.0;
    if (take_quantity(&in->words, GB_DIM_NONE, &times) &&
        !accept_word(&in->words, "times")) {
        return expected(in, "'times', as in hold 5 times");
    }
    leg->end[0] = (struct gb_leg_end){GB_LEG_END_STEPS, times, -1};
    leg->end_count = 1;
    return (times >= 1.0 && times <= 1e6 && floor(times) == times) ||
           gb_error_set(in->err, GB_ERR_INPUT,
                        "%g times: must be a whole number from 1 to 1000000", times);
}

static bool end_unload(struct path_reading *in)
{
    if (strcmp(peek_word(&in->words), "to") == 0) {
        return read_ends(in);
    }
    in->leg->end[0] = (struct gb_leg_end){GB_LEG_END_PRESSURE, 0.0, in->leg->leading};
    in->leg->end_count = 1;
    return true;
}

/* The table of shorthands. */
static const struct shorthand {
    const char *word, *usage, *doc;
    bool (*set)(struct path_reading *in, unsigned *own);
    bool (*end)(struct path_reading *in);
} table[] = {
    {"uniaxial", "uniaxial [x|y|z] to END", "one axis is strained, the others are fixed",
     set_uniaxial, read_ends},
    {"biaxial", "biaxial to END", "y and z are strained alike, x is fixed", set_biaxial,
     read_ends},
    {"isotropic", "isotropic to END", "all axes are strained alike", set_isotropic,
     read_ends},
    {"triaxial", "triaxial [x|y|z] [extension] to END [at STRESS]",
     "one axis is strained, the stresses of the other two are held", set_triaxial,
     read_ends},
    {"shear", "shear xy|xz|yz to END [at HELD]",
     "simple shear at constant volume, or at held stresses", set_shear, read_ends},
    {"radial", "radial [RATIO] to END",
     "one axis is strained, the stresses of the others are a fraction of its own",
     set_radial, read_ends},
    {"strain", "strain z = 1, x = -0.5, ... to END [at HELD]",
     "any strains in proportion; the first leads, those not named are fixed", set_strain,
     read_ends},
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

static const struct shorthand *find_shorthand(struct path_reading *in)
{
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        if (accept_word(&in->words, table[i].word)) {
            return &table[i];
        }
    }
    expected(in, "uniaxial, biaxial, isotropic, triaxial, shear, radial, strain, hold, "
                 "unload or cycle");
    return NULL;
}

static bool read_cycles(struct path_reading *in)
{
    double times = 0.0;
    if (!take_quantity(&in->words, GB_DIM_NONE, &times) ||
        !accept_word(&in->words, "times") || !(times >= 1.0 && times <= 1e6) ||
        floor(times) != times) {
        return expected(in, "a whole number and 'times', as in cycle 5 times");
    }
    in->leg->cycles = (int)times;
    return true;
}

static bool read_leg(struct path_reading *in)
{
    struct gb_leg *leg = in->leg;
    unsigned own = 0;
    const bool cycle = accept_word(&in->words, "cycle");
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
    const bool holds = shorthand->end == end_steps; /* controls before the end */
    const bool named = accept_word(&in->words, "at") ||
                       (holds && (peek_word(&in->words)[0] != '\0' &&
                                  !g_ascii_isdigit(peek_word(&in->words)[0])));
    if (named && !read_controls(in, own)) {
        return false;
    }
    if (!(cycle ? read_reversals(in) : shorthand->end(in))) {
        return false;
    }
    if (named && strcmp(peek_word(&in->words), "at") == 0) {
        return gb_error_set(in->err, GB_ERR_INPUT, "'at': must be given once in a leg");
    }
    if (!read_at(in, own)) {
        return false;
    }
    return peek_word(&in->words)[0] == '\0' ||
           expected(in, "the end of the leg; legs are separated by ';'");
}

/* All components are fixed until words of the leg say otherwise.  The text is kept with one
 * blank between words. */
static bool init_leg(struct gb_leg *leg, const char *text, struct gb_error *err)
{
    size_t length = 0;
    *leg = (struct gb_leg){.leading = -1};
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        leg->component[k].of = -1;
    }
    for (; *text != '\0'; text++) {
        const bool blank = *text == ' ' || *text == '\t';
        if (blank && (length == 0 || leg->text[length - 1] == ' ')) {
            continue;
        }
        if (length + 1 == sizeof leg->text) {
            return gb_error_set(err, GB_ERR_INPUT, "must be at most %zu bytes",
                                sizeof leg->text - 1);
        }
        leg->text[length++] = blank ? ' ' : *text;
    }
    return true;
}

bool gb_path_parse_leg(struct gb_path *path, const char *text, int dimension,
                       struct gb_error *err)
{
    struct path_reading in = {.before = path, .dimension = dimension, .err = err};
    if (path->count == GB_PATH_LEGS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "must be at most %d legs",
                            GB_PATH_LEGS_MAX);
    }
    in.leg = &path->leg[path->count];
    const bool good = init_leg(in.leg, text, err) &&
                      split_words(&in.words, in.leg->text, err) && read_leg(&in);
    free_words(&in.words);
    path->count += good;
    return good;
}

char **gb_path_parse_split(const char *text)
{
    /* raw: the text may be no UTF-8 */
    char **phrases = g_regex_split_simple("\\s*;\\s*|\\s+then\\s+", text, G_REGEX_RAW, 0);
    GPtrArray *legs = g_ptr_array_new();
    for (int i = 0; phrases[i] != NULL; i++) {
        const bool last = phrases[i + 1] == NULL;
        if (g_strstrip(phrases[i])[0] == '\0' && (last || legs->len == 0)) {
            g_free(phrases[i]); /* GLib ends a list with ';' */
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
