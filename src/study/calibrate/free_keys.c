#include "study/calibrate/free_keys.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "many/key_difference.h"
#include "many/runset.h"

enum { DIGITS = 10 };

/* Without a range the fit begins between the value over this and the value times it. */
static const double first_factor = 2.0;

/* The number of a field in params. */
static double number_of(const struct gb_params *params, const struct gb_field *field,
                        bool *relative)
{
    const void *at = (const char *)params + field->offset;
    *relative = false;
    if (field->type == GB_FIELD_RELATIVE) {
        const struct gb_relative *both = at;
        *relative = both->relative;
        return both->value;
    }
    return *(const double *)at;
}

/* One end of a range; takes the unit behind the whole when it has none. */
static bool read_end(struct gb_free_key *key, const char *text, const char *unit,
                     double *value, struct gb_error *err)
{
    struct gb_params params;
    const char *end = text;
    double number = 0.0;
    gb_params_init(&params);
    const bool bare = gb_units_number(text, &end, &number) && *end == '\0';
    char *whole = g_strconcat(text, bare && *unit ? " " : "", bare ? unit : "", NULL);
    const bool good = gb_params_set(&params, key->field, whole, err);
    g_free(whole);
    *value = number_of(&params, key->field, &key->relative);
    return good;
}

static bool read_range(struct gb_free_key *key, const char *text, struct gb_error *err)
{
    char **ends = g_strsplit(text, ":", 3);
    bool good = g_strv_length(ends) == 2;
    if (good) {
        const char *unit = "";
        double number = 0.0;
        g_strstrip(ends[0]);
        if (gb_units_number(g_strstrip(ends[1]), &unit, &number)) {
            unit += strspn(unit, " \t");
        }
        bool relative = false;
        good = read_end(key, ends[0], unit, &key->low, err);
        relative = key->relative;
        good = good && read_end(key, ends[1], unit, &key->high, err);
        good = good && relative == key->relative && key->low < key->high;
    }
    g_strfreev(ends);
    key->from = key->low;
    key->to = key->high;
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--free %s.%s=%.80s: accepted two values that the key "
                                "takes, LOW:HIGH",
                                key->field->group, key->field->key, text);
}

static bool take_around(struct gb_free_key *key, const struct gb_params *params,
                        struct gb_error *err)
{
    const double value = number_of(params, key->field, &key->relative);
    if (!(value > 0.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--free %s.%s: the preset has no value above 0 to begin with; "
            "accepted %s.%s=LOW:HIGH",
            key->field->group, key->field->key, key->field->group, key->field->key);
    }
    key->low = fmax(key->field->min, value / 100.0);
    key->high = fmin(key->field->max, value * 100.0);
    key->from = fmax(key->low, value / first_factor);
    key->to = fmin(key->high, value * first_factor);
    return true;
}

static bool find_field(const struct gb_free_keys *keys, struct gb_free_key *key,
                       const char *name, struct gb_error *err)
{
    key->field = gb_params_find_name(name, err);
    if (key->field == NULL) {
        return false;
    }
    const bool fit =
        !gb_key_difference_bookkeeping(key->field) &&
        (key->field->type == GB_FIELD_NUMBER || key->field->type == GB_FIELD_RELATIVE);
    bool twice = false;
    for (size_t i = 0; i < keys->count; i++) {
        twice = twice || keys->key[i].field == key->field;
    }
    return (fit && !twice) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--free %.80s: accepted keys that are numbers, as contact.mu, each "
               "once; see greenbody params",
               name);
}

bool gb_free_keys_parse(struct gb_free_keys *keys, const char *text,
                        const struct gb_params *params, struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", GB_CALIBRATE_FREE + 2);
    bool good = parts[0] != NULL;
    keys->count = 0;
    if (!good || g_strv_length(parts) > GB_CALIBRATE_FREE) {
        good = gb_error_set(err, GB_ERR_INPUT, "--free %.80s: must be between 1 and %d keys",
                            text, GB_CALIBRATE_FREE);
    }
    for (size_t i = 0; good && parts[i] != NULL; i++) {
        struct gb_free_key *key = &keys->key[keys->count];
        char **sides = g_strsplit(g_strstrip(parts[i]), "=", 2);
        *key = (struct gb_free_key){0};
        good = sides[0] != NULL
                   ? find_field(keys, key, g_strstrip(sides[0]), err)
                   : gb_error_set(err, GB_ERR_INPUT, "--free: a key is empty");
        good = good && (sides[1] ? read_range(key, sides[1], err)
                                 : take_around(key, params, err));
        keys->count += good;
        g_strfreev(sides);
    }
    g_strfreev(parts);
    return good;
}

char *gb_free_keys_text(const struct gb_free_key *key, double value, char *buffer,
                        size_t size)
{
    if (key->relative) {
        g_snprintf(buffer, (gulong)size, "%.*g %s", DIGITS, value, key->field->relative);
        return buffer;
    }
    return gb_units_format_short(value, (enum gb_dimension)key->field->dimension, DIGITS,
                                 buffer, size);
}

bool gb_free_keys_apply(const struct gb_free_keys *keys, const double *value,
                        struct gb_params *params, struct gb_error *err)
{
    for (size_t k = 0; k < keys->count; k++) {
        char text[96];
        gb_free_keys_text(&keys->key[k], value[k], text, sizeof text);
        if (!gb_params_set(params, keys->key[k].field, text, err)) {
            return false;
        }
    }
    return true;
}
