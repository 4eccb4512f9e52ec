#include "scene/path/path_reading.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"

static bool is_number(const char *word)
{
    const char *end = word;
    double value = 0.0;
    return gb_units_number(word, &end, &value) && end != word && *end == '\0';
}

/* A unit of any dimension, or one that looks like a pressure. */
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

bool gb_path_reading_expected(struct gb_path_reading *in, const char *what)
{
    const char *word = gb_path_words_peek(&in->words);
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

/* A component that exists in this scene. */
bool gb_path_reading_component(struct gb_path_reading *in, int *component)
{
    const int next = in->words.next;
    *component = gb_path_words_component(&in->words);
    if (*component >= 0 && gb_path_has_component(in->dimension, *component)) {
        return true;
    }
    in->words.next = next;
    return gb_path_reading_expected(in, in->dimension == 3
                                            ? "x, y, z, xy, xz or yz"
                                            : "x, z or xz with scene.dimension = 2");
}

bool gb_path_reading_give(struct gb_path_reading *in, int component)
{
    if ((in->given >> component & 1u) != 0) {
        return gb_error_set(in->err, GB_ERR_INPUT, "'%s': must be given once in a leg",
                            gb_path_component_name(component));
    }
    in->given |= 1u << component;
    return true;
}

static bool read_pressure(struct gb_path_reading *in, double *value)
{
    gb_path_words_accept(&in->words, "=");
    return gb_path_words_quantity(&in->words, GB_DIM_PRESSURE, value) ||
           gb_path_reading_expected(in, "a pressure with its unit, as in 50 MPa");
}

bool gb_path_reading_number(struct gb_path_reading *in, double *value)
{
    gb_path_words_accept(&in->words, "=");
    return gb_path_words_quantity(&in->words, GB_DIM_NONE, value) ||
           gb_path_reading_expected(in, "a number");
}

static bool read_density_end(struct gb_path_reading *in, struct gb_leg_end *end)
{
    end->kind = GB_LEG_END_DENSITY;
    return gb_path_reading_number(in, &end->value) &&
           ((end->value > 0.0 && end->value < 1.0) ||
            gb_error_set(in->err, GB_ERR_INPUT, "density %g: must be between 0 and 1",
                         end->value));
}

static bool read_stress_end(struct gb_path_reading *in, int component,
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

/* "50 MPa" is the pressure that the leg raises, the shear stress of a shear; "20 %" its
 * strain. */
static bool read_own_end(struct gb_path_reading *in, struct gb_leg_end *end)
{
    if (gb_path_words_quantity(&in->words, GB_DIM_PRESSURE, &end->value)) {
        const int leading = in->leg->leading;
        end->kind = leading >= 3 ? GB_LEG_END_STRESS : GB_LEG_END_PRESSURE;
        end->of = leading;
        return true;
    }
    end->kind = GB_LEG_END_STRAIN;
    return gb_path_words_quantity(&in->words, GB_DIM_FRACTION, &end->value) ||
           gb_path_reading_expected(
               in, "an end: a pressure (50 MPa, z = 50 MPa), a strain (20 %), "
                   "density 0.5, p, q or q/p");
}

static bool read_one_end(struct gb_path_reading *in, struct gb_leg_end *end)
{
    struct gb_path_words *words = &in->words;
    *end = (struct gb_leg_end){.of = in->leg->leading};
    if (gb_path_words_accept(words, "density")) {
        return read_density_end(in, end);
    }
    if (gb_path_words_accept(words, "q/p")) {
        end->kind = GB_LEG_END_RATIO;
        return gb_path_reading_number(in, &end->value);
    }
    if (gb_path_words_accept(words, "q")) {
        end->kind = GB_LEG_END_Q;
        return read_pressure(in, &end->value);
    }
    if (gb_path_words_accept(words, "p")) {
        end->kind = GB_LEG_END_MEAN;
        return read_pressure(in, &end->value);
    }
    const int component = gb_path_words_component(words);
    return component >= 0 ? read_stress_end(in, component, end) : read_own_end(in, end);
}

/* "to 50 MPa", "to q/p = 0.8 or 20 %" */
bool gb_path_reading_ends(struct gb_path_reading *in)
{
    struct gb_leg *leg = in->leg;
    if (!gb_path_words_accept(&in->words, "to")) {
        return gb_path_reading_expected(in,
                                        "'to' and an end, as in to 50 MPa or to 20 %");
    }
    do {
        if (leg->end_count == GB_PATH_ENDS_MAX) {
            return gb_error_set(in->err, GB_ERR_INPUT, "must have at most %d ends",
                                GB_PATH_ENDS_MAX);
        }
        if (!read_one_end(in, &leg->end[leg->end_count++])) {
            return false;
        }
    } while (gb_path_words_accept(&in->words, "or"));
    return true;
}

/* "between -1 % and 1 %" of a cycle */
bool gb_path_reading_reversals(struct gb_path_reading *in)
{
    struct gb_leg *leg = in->leg;
    leg->end_count = 2;
    if (!gb_path_words_accept(&in->words, "between")) {
        return gb_path_reading_expected(in,
                                        "'between', as in between 20 MPa and 100 MPa");
    }
    if (!read_one_end(in, &leg->end[0])) {
        return false;
    }
    if (!gb_path_words_accept(&in->words, "and")) {
        return gb_path_reading_expected(in, "'and' and the other end");
    }
    if (!read_one_end(in, &leg->end[1])) {
        return false;
    }
    return (leg->end[0].kind == leg->end[1].kind && leg->end[0].of == leg->end[1].of &&
            leg->end[0].value != leg->end[1].value) ||
           gb_error_set(in->err, GB_ERR_INPUT,
                        "between: must be two different values of one quantity");
}

/* "x = y =" or "x = y by": bits of the components; false: neither follows them. */
static bool read_members(struct gb_path_reading *in, unsigned *members)
{
    for (int next = gb_path_words_component(&in->words); next >= 0;
         next = gb_path_words_component(&in->words)) {
        if (!gb_path_reading_give(in, next)) {
            return false;
        }
        *members |= 1u << next;
        if (strcmp(gb_path_words_peek(&in->words), "by") == 0) {
            return true;
        }
        if (!gb_path_words_accept(&in->words, "=")) {
            return gb_path_reading_expected(in, "'=' or 'by'");
        }
    }
    return true;
}

/* "50 MPa", "0.5 z", "held", "by 0.5 z" */
static bool read_value(struct gb_path_reading *in, struct gb_leg_component *control)
{
    const bool by = gb_path_words_accept(&in->words, "by");
    if (!by && (gb_path_words_accept(&in->words, "held") ||
                gb_path_words_quantity(&in->words, GB_DIM_PRESSURE, &control->value))) {
        return true;
    }
    control->control = by ? GB_LEG_FOLLOW : GB_LEG_RATIO;
    if (!gb_path_words_quantity(&in->words, GB_DIM_NONE, &control->value)) {
        return gb_path_reading_expected(
            in, by ? "a fraction of the change of another component, as in by 0.5 z"
                   : "a pressure (50 MPa), a fraction of another component (0.5 z) or "
                     "'held'");
    }
    if (control->value == 0.0) {
        return gb_error_set(in->err, GB_ERR_INPUT,
                            "'0': a fraction must not be 0; write 0 MPa or held");
    }
    return gb_path_reading_component(in, &control->of);
}

static bool set_control(struct gb_path_reading *in, int k,
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

/* "x = y = z = 50 MPa", "x = y = 0.5 z", "z = held", "x = y by -0.5 z"; components may be
 * left out where the leg has its own (triaxial, hold): "50 MPa". */
static bool read_control(struct gb_path_reading *in, unsigned own)
{
    struct gb_leg_component control = {GB_LEG_STRESS, (double)NAN, -1};
    unsigned members = 0;
    if (!read_members(in, &members)) {
        return false;
    }
    members = members != 0 ? members : own;
    if (members == 0) {
        return gb_path_reading_expected(in, "a component to hold, as in z = 50 MPa");
    }
    bool good = read_value(in, &control);
    for (int k = 0; k < GB_PATH_COMPONENTS && good; k++) {
        good = (members >> k & 1u) == 0 || set_control(in, k, &control);
    }
    return good;
}

bool gb_path_reading_controls(struct gb_path_reading *in, unsigned own)
{
    do {
        if (!read_control(in, own)) {
            return false;
        }
    } while (gb_path_words_accept(&in->words, ",") ||
             gb_path_words_accept(&in->words, "and"));
    return true;
}

/* "at z = 50 MPa", or nothing */
bool gb_path_reading_at(struct gb_path_reading *in, unsigned own)
{
    return !gb_path_words_accept(&in->words, "at") || gb_path_reading_controls(in, own);
}
