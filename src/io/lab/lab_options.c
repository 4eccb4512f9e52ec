#include "io/lab/lab_options.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/table.h"
#include "base/units.h"
#include "io/lab/lab_quantity.h"

/* Keys with a number and a unit. */
struct quantity {
    const char *key;
    enum gb_dimension dimension;
    size_t offset;
    const char *example;
};

static const struct quantity quantities[] = {
    {"die-area", GB_DIM_AREA, offsetof(struct gb_lab_options, die_area_m2), "1.33 cm2"},
    {"powder-mass", GB_DIM_MASS, offsetof(struct gb_lab_options, powder_mass_kg), "2 g"},
    {"true-density", GB_DIM_MASS_DENSITY,
     offsetof(struct gb_lab_options, true_density_kg_m3), "3.99 g/cm3"},
    {"compliance", GB_DIM_COMPLIANCE, offsetof(struct gb_lab_options, compliance_m_n),
     "3 um/kN"},
    {"initial-height", GB_DIM_LENGTH, offsetof(struct gb_lab_options, initial_height_m),
     "12 mm"},
    {"zero-travel", GB_DIM_LENGTH, offsetof(struct gb_lab_options, zero_travel_m),
     "14.2 mm"},
};

/* Words for characters that a list cannot hold. */
static const struct {
    const char *key, *word;
    char character;
} marks[] = {
    {"decimal", "comma", ','},   {"decimal", "point", '.'},
    {"separator", "comma", ','}, {"separator", "semicolon", ';'},
    {"separator", "tab", '\t'},  {"separator", "blank", ' '},
    {"separator", "bar", '|'},
};

static double *number_at(struct gb_lab_options *options, const struct quantity *quantity)
{
    return (double *)(void *)((char *)options + quantity->offset);
}

void gb_lab_options_init(struct gb_lab_options *options)
{
    *options = (struct gb_lab_options){.keys = 0};
    for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
        *number_at(options, &quantities[i]) = NAN;
    }
}

bool gb_lab_options_given(const struct gb_lab_options *options)
{
    struct gb_lab_options copy = *options;
    bool given = options->decimal != 0 || options->separator != 0 || options->keys > 0;
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        given = given || options->column[role].given;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
        given = given || !isnan(*number_at(&copy, &quantities[i]));
    }
    return given;
}

static bool set_mark(struct gb_lab_options *options, const char *key, const char *value,
                     struct gb_error *err)
{
    char *to = *key == 'd' ? &options->decimal : &options->separator;
    for (size_t i = 0; i < G_N_ELEMENTS(marks); i++) {
        const bool character = value[0] == marks[i].character && value[1] == '\0';
        if (strcmp(key, marks[i].key) == 0 &&
            (character || strcmp(value, marks[i].word) == 0)) {
            *to = marks[i].character;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s=%.40s: expected %s", key, value,
                        *key == 'd' ? "comma, point"
                                    : "comma, semicolon, tab, blank, bar");
}

bool gb_lab_options_set(struct gb_lab_options *options, const char *key,
                        const char *value, struct gb_error *err)
{
    if (strcmp(key, "decimal") == 0 || strcmp(key, "separator") == 0) {
        return set_mark(options, key, value, err);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
        const struct quantity *quantity = &quantities[i];
        if (strcmp(key, quantity->key) == 0) {
            double si = 0.0;
            if (!gb_units_parse(value, quantity->dimension, &si, NULL) ||
                (!(si > 0.0) && quantity->dimension != GB_DIM_LENGTH)) {
                return gb_error_set(err, GB_ERR_INPUT,
                                    "%s=%.40s: expected a number above 0 in %s, as in %s",
                                    key, value, gb_units_accepted(quantity->dimension),
                                    quantity->example);
            }
            *number_at(options, quantity) = si;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.40s: expected pressure, density, porosity, force, travel, "
                        "height, density_error, pressure_error, branch, series, decimal, "
                        "separator, die-area, powder-mass, true-density, compliance, "
                        "initial-height, zero-travel",
                        key);
}

/* The text up to one of the ends outside quotes, without its quotes; *at stops there. */
static bool take_part(const char **at, const char *ends, char *out, size_t size,
                      bool *quoted)
{
    bool inside = false;
    size_t used = 0;
    *quoted = false;
    for (; **at != '\0' && (inside || strchr(ends, **at) == NULL); (*at)++) {
        if (**at == '"') {
            inside = !inside;
            *quoted = true;
        } else if (used + 1 < size) {
            out[used++] = **at;
        } else {
            return false;
        }
    }
    out[used] = '\0';
    g_strstrip(out);
    return !inside;
}

static bool parse_unit(enum gb_lab_role role, const char *text,
                       struct gb_lab_options_column *column, struct gb_error *err)
{
    column->unit = gb_lab_unit_find(text);
    if (column->unit != NULL && gb_lab_role_takes(role, column->unit)) {
        return true;
    }
    const bool density = role == GB_LAB_ROLE_DENSITY || role == GB_LAB_ROLE_DENSITY_ERROR;
    return gb_error_set(err, GB_ERR_INPUT, "%s=...:%.40s: the unit must be one of %s",
                        gb_lab_role_name(role), text,
                        gb_lab_unit_accepted(density ? GB_DIM_MASS_DENSITY
                                                     : gb_lab_role_dimension(role)));
}

/* "2:MPa", "\"Druck p\":MPa", at the cursor, which stops behind it. */
static bool parse_column(const char **at, enum gb_lab_role role,
                         struct gb_lab_options_column *column, struct gb_error *err)
{
    char unit[GB_LAB_OPTIONS_NAME];
    bool quoted = false;
    bool plain = false;
    guint64 index = 0;
    *column = (struct gb_lab_options_column){.given = true};
    if (!take_part(at, ":,", column->name, sizeof column->name, &quoted) ||
        column->name[0] == '\0' || (!quoted && strcmp(column->name, "?") == 0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%.60s: expected the number of a column or its head in quotes", column->name);
    }
    if (!quoted && strspn(column->name, "0123456789") == strlen(column->name)) {
        if (!g_ascii_string_to_unsigned(column->name, 10, 1, GB_TABLE_COLUMNS_MAX, &index,
                                        NULL)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "column %.20s: must be between 1 and %d", column->name,
                                GB_TABLE_COLUMNS_MAX);
        }
        column->index = (int)index;
        column->name[0] = '\0';
    }
    if (**at != ':') {
        return true;
    }
    (*at)++;
    if (!take_part(at, ",", unit, sizeof unit, &plain)) {
        return gb_error_set(err, GB_ERR_INPUT, ":%.40s: is no unit", unit);
    }
    return role == GB_LAB_ROLES || parse_unit(role, unit, column, err);
}

static enum gb_lab_role find_role(const char *key)
{
    int role = 0;
    while (role < GB_LAB_ROLES && strcmp(gb_lab_role_name((enum gb_lab_role)role), key)) {
        role++;
    }
    return (enum gb_lab_role)role;
}

static bool add_key(struct gb_lab_options *options, const char *key, const char **at,
                    struct gb_error *err)
{
    if (options->keys == GB_LAB_OPTIONS_KEYS) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.60s: more than %d columns besides the standard ones", key,
                            GB_LAB_OPTIONS_KEYS);
    }
    struct gb_lab_options_key *to = &options->key[options->keys];
    if (!parse_column(at, GB_LAB_ROLES, &to->column, err)) {
        return false;
    }
    g_strlcpy(to->key, key, sizeof to->key);
    options->keys++;
    return true;
}

static bool parse_item(struct gb_lab_options *options, const char **at,
                       struct gb_error *err)
{
    char key[GB_LAB_OPTIONS_NAME];
    char value[GB_LAB_OPTIONS_NAME];
    bool quoted = false;
    if (!take_part(at, "=,", key, sizeof key, &quoted) || **at != '=') {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.60s: expected a list as in pressure=2:MPa,density=4:%%",
                            key);
    }
    (*at)++;
    const enum gb_lab_role role = find_role(key);
    if (role < GB_LAB_ROLES) {
        return parse_column(at, role, &options->column[role], err);
    }
    if (strchr(key, '.') != NULL || gb_lab_quantity_is_further(key)) {
        return add_key(options, key, at, err);
    }
    return (take_part(at, ",", value, sizeof value, &quoted) ||
            gb_error_set(err, GB_ERR_INPUT, "%.40s=%.40s: is too long", key, value)) &&
           gb_lab_options_set(options, key, value, err);
}

bool gb_lab_options_parse(struct gb_lab_options *options, const char *list,
                          struct gb_error *err)
{
    struct gb_lab_options next = *options;
    const char *at = list;
    while (*at != '\0') {
        if (!parse_item(&next, &at, err)) {
            return false;
        }
        at += *at == ',';
    }
    *options = next;
    return true;
}

static void append_column(GString *text, const char *key,
                          const struct gb_lab_options_column *column)
{
    g_string_append_printf(text, "%s%s=", text->len > 0 ? "," : "", key);
    if (column->index > 0) {
        g_string_append_printf(text, "%d", column->index);
    } else {
        g_string_append_printf(text, "\"%s\"", column->name);
    }
    if (column->unit != NULL) {
        g_string_append_printf(text, ":%s", column->unit->name);
    }
}

char *gb_lab_options_text(const struct gb_lab_options *options)
{
    GString *text = g_string_new(NULL);
    struct gb_lab_options copy = *options;
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        if (options->column[role].given) {
            append_column(text, gb_lab_role_name((enum gb_lab_role)role),
                          &options->column[role]);
        }
    }
    for (int k = 0; k < options->keys; k++) {
        append_column(text, options->key[k].key, &options->key[k].column);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(marks); i++) {
        const char given = *marks[i].key == 'd' ? options->decimal : options->separator;
        if (given == marks[i].character) {
            g_string_append_printf(text, "%s%s=%s", text->len > 0 ? "," : "",
                                   marks[i].key, marks[i].word);
        }
    }
    for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
        const double si = *number_at(&copy, &quantities[i]);
        char number[64];
        if (!isnan(si)) {
            gb_units_format(si, quantities[i].dimension, number, sizeof number);
            g_string_append_printf(text, "%s%s=%s", text->len > 0 ? "," : "",
                                   quantities[i].key, number);
        }
    }
    return g_string_free(text, FALSE);
}
