#include "io/lab/lab_role.h"

#include <string.h>

#include <glib.h>

/* Words by which laboratories name a quantity, in lower case: English, German, French,
 * Spanish, Russian. */
struct role {
    const char *name;
    enum gb_dimension dimension;
    bool words;
    const char *synonyms;
};

static const struct role roles[GB_LAB_ROLES] = {
    [GB_LAB_ROLE_PRESSURE] =
        {"pressure", GB_DIM_PRESSURE, false,
         "pressure|p|compaction pressure|compaction stress|pressing pressure|"
         "axial pressure|axial stress|stress|sigma|\xcf\x83|druck|pressdruck|spannung|"
         "druckspannung|verdichtungsdruck|pression|contrainte|pression de compactage|"
         "presi\xc3\xb3n|pressione|\xd0\xb4\xd0\xb0\xd0\xb2\xd0\xbb\xd0\xb5\xd0\xbd\xd0\xb8"
         "\xd0\xb5"},
    [GB_LAB_ROLE_PRESSURE_ERROR] = {"pressure_error", GB_DIM_PRESSURE, false, ""},
    [GB_LAB_ROLE_DENSITY] =
        {"density", GB_DIM_FRACTION, false,
         "density|rho|\xcf\x81|d|green density|dichte|gr\xc3\xbcndichte|densit\xc3\xa9|"
         "masse volumique|densidad|densit\xc3\xa0|"
         "\xd0\xbf\xd0\xbb\xd0\xbe\xd1\x82\xd0\xbd\xd0\xbe\xd1\x81\xd1\x82\xd1\x8c"},
    [GB_LAB_ROLE_DENSITY_ERROR] = {"density_error", GB_DIM_FRACTION, false, ""},
    [GB_LAB_ROLE_POROSITY] = {"porosity", GB_DIM_FRACTION, false,
                              "porosity|porosit\xc3\xa4t|porosit\xc3\xa9|"
                              "\xd0\xbf\xd0\xbe\xd1\x80\xd0\xb8\xd1\x81\xd1\x82\xd0\xbe"
                              "\xd1\x81\xd1\x82\xd1\x8c"},
    [GB_LAB_ROLE_FORCE] = {"force", GB_DIM_FORCE, false,
                           "force|load|f|standard force|compressive load|kraft|last|"
                           "presskraft|pr\xc3\xbc"
                           "fkraft|standardkraft|stempelkraft|"
                           "charge|effort|fuerza|forza|\xd1\x81\xd0\xb8\xd0\xbb\xd0\xb0|"
                           "\xd0\xbd\xd0\xb0\xd0\xb3\xd1\x80\xd1\x83\xd0\xb7\xd0\xba"
                           "\xd0\xb0"},
    [GB_LAB_ROLE_TRAVEL] =
        {"travel", GB_DIM_LENGTH, false,
         "travel|punch travel|displacement|extension|compressive extension|stroke|"
         "crosshead|crosshead position|position|standard travel|weg|stempelweg|"
         "traversenweg|standardweg|verschiebung|d\xc3\xa9placement|course|"
         "\xd0\xbf\xd0\xb5\xd1\x80\xd0\xb5\xd0\xbc\xd0\xb5\xd1\x89\xd0\xb5\xd0\xbd\xd0\xb8"
         "\xd0\xb5"},
    [GB_LAB_ROLE_HEIGHT] = {"height", GB_DIM_LENGTH, false,
                            "height|h|thickness|compact height|specimen height|"
                            "h\xc3\xb6he|dicke|hauteur|\xc3\xa9paisseur|altura|"
                            "\xd0\xb2\xd1\x8b\xd1\x81\xd0\xbe\xd1\x82\xd0\xb0"},
    [GB_LAB_ROLE_BRANCH] = {"branch", GB_DIM_NONE, true, "branch"},
    [GB_LAB_ROLE_SERIES] = {"series", GB_DIM_NONE, true,
                            "series|sample|sample id|sample name|specimen|specimen id|"
                            "powder|batch|probe|proben nr|probennummer|serie|pulver|"
                            "charge nr|\xc3\xa9"
                            "chantillon|poudre|"
                            "\xd0\xbe\xd0\xb1\xd1\x80\xd0\xb0\xd0\xb7\xd0\xb5\xd1\x86"},
};

/* With one of these a density is relative; a name of its own in the second list. */
static const char relative[] =
    "relative|rel|relativ|theoretical|\xd0\xbe\xd1\x82\xd0\xbd\xd0\xbe\xd1\x81\xd0\xb8"
    "\xd1\x82\xd0\xb5\xd0\xbb\xd1\x8c\xd0\xbd\xd0\xb0\xd1\x8f";
static const char relative_names[] =
    "td|%td|% td|solid fraction|packing fraction|relativdichte";

static const char errors[] =
    "error|err|std|stdev|sd|se|deviation|uncertainty|fehler|stabw|standardabweichung|"
    "unsicherheit|\xc3\xa9"
    "cart|incertitude";

/* With one of these a quantity is another one, or what was wanted instead of found. */
static const char others[] =
    "rate|speed|geschwindigkeit|vitesse|ejection|eject|aussto\xc3\x9f|ausstoss|radial|"
    "lateral|wall|oil|hydraulic|\xc3\xb6l|target|setpoint|soll|sollwert|nominal|initial|"
    "start|max|maximum|min|minimum|tap|bulk|apparent|true|skeletal|log|ln|log10|inverse|"
    "change|difference|ratio|pore";

const char *gb_lab_role_name(enum gb_lab_role role)
{
    return roles[role].name;
}

bool gb_lab_role_is_words(enum gb_lab_role role)
{
    return roles[role].words;
}

enum gb_dimension gb_lab_role_dimension(enum gb_lab_role role)
{
    return roles[role].dimension;
}

bool gb_lab_role_takes(enum gb_lab_role role, const struct gb_lab_unit *unit)
{
    const bool density = role == GB_LAB_ROLE_DENSITY || role == GB_LAB_ROLE_DENSITY_ERROR;
    return unit->dimension == roles[role].dimension ||
           (density && unit->dimension == GB_DIM_MASS_DENSITY);
}

/* Whether a list "a|b|c" has a word. */
static bool list_has(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = list; *at != '\0';) {
        const char *end = strchr(at, '|');
        const size_t size = end != NULL ? (size_t)(end - at) : strlen(at);
        if (size == length && memcmp(at, word, size) == 0) {
            return true;
        }
        at += size + (end != NULL);
    }
    return false;
}

/* Whether one of the words of a name is in the list.  Letters alone say nothing there:
 * the d of "powder d" is a diameter. */
static bool has_word_of(const char *name, const char *list)
{
    char **words = g_strsplit(name, " ", -1);
    bool found = false;
    for (size_t i = 0; words[i] != NULL && !found; i++) {
        found = strlen(words[i]) > 1 && list_has(list, words[i]);
    }
    g_strfreev(words);
    return found;
}

/* 3: a relative density; 2: the quantity and nothing else; 1: a word among others. */
static int rank_name(enum gb_lab_role role, const char *name)
{
    const char *synonyms = roles[role].synonyms;
    const bool word = has_word_of(name, synonyms);
    if (role == GB_LAB_ROLE_DENSITY &&
        (list_has(relative_names, name) || (word && has_word_of(name, relative)))) {
        return 3;
    }
    return list_has(synonyms, name) ? 2 : word ? 1 : 0;
}

static int rank_error(enum gb_lab_role of, const struct gb_lab_heading *heading)
{
    return has_word_of(heading->name, errors) && rank_name(of, heading->name) > 0 ? 2 : 0;
}

int gb_lab_role_rank(enum gb_lab_role role, const struct gb_lab_heading *heading)
{
    int rank = 0;
    if (role == GB_LAB_ROLE_PRESSURE_ERROR) {
        rank = rank_error(GB_LAB_ROLE_PRESSURE, heading);
    } else if (role == GB_LAB_ROLE_DENSITY_ERROR) {
        rank = rank_error(GB_LAB_ROLE_DENSITY, heading);
    } else if (!has_word_of(heading->name, errors) &&
               !has_word_of(heading->name, others)) {
        rank = rank_name(role, heading->name);
    }
    if (rank == 0 || gb_lab_role_is_words(role) || heading->unit == NULL) {
        return gb_lab_role_is_words(role) && heading->unit != NULL ? 0 : 2 * rank;
    }
    return gb_lab_role_takes(role, heading->unit) ? 2 * rank + 1 : 0;
}

/* --- heads ------------------------------------------------------------------------- */

/* Lower case; blanks for punctuation between words; one blank each. */
static void set_name(struct gb_lab_heading *heading, const char *text)
{
    char *lower = g_utf8_strdown(text, -1);
    size_t used = 0;
    for (const char *at = lower; *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar character = g_utf8_get_char(at);
        const bool part = g_unichar_isalnum(character) || g_unichar_ismark(character) ||
                          character == '%';
        char utf8[8] = " ";
        const int size = part ? g_unichar_to_utf8(character, utf8) : 1;
        const bool doubled = !part && (used == 0 || heading->name[used - 1] == ' ');
        if (!doubled && used + (size_t)size < GB_LAB_ROLE_NAME) {
            memcpy(heading->name + used, utf8, (size_t)size);
            used += (size_t)size;
        }
    }
    while (used > 0 && heading->name[used - 1] == ' ') {
        used--;
    }
    heading->name[used] = '\0';
    g_free(lower);
}

/* Takes `unit` as the unit and `name` as the name if there is such a unit. */
static bool take(struct gb_lab_heading *out, const char *name, size_t length,
                 const char *unit)
{
    char *text = g_strstrip(g_strdup(unit));
    const size_t size = strlen(text);
    if (size > 1 && strchr("([{", text[0]) && strchr(")]}", text[size - 1])) {
        text[size - 1] = ' ';
        text[0] = ' ';
    }
    out->unit = gb_lab_unit_find(text);
    g_free(text);
    if (out->unit == NULL) {
        return false;
    }
    char *head = g_strndup(name, length);
    set_name(out, head);
    g_free(head);
    return true;
}

/* "Druck [MPa]": in brackets at the end. */
static bool take_brackets(struct gb_lab_heading *out, const char *text)
{
    const size_t size = strlen(text);
    const char last = size > 0 ? text[size - 1] : '\0';
    const char open = last == ')' ? '(' : last == ']' ? '[' : last == '}' ? '{' : '\0';
    const char *at = open != '\0' ? strrchr(text, open) : NULL;
    return at != NULL && take(out, text, (size_t)(at - text), at);
}

/* The unit behind the last `before`. */
static bool take_last(struct gb_lab_heading *out, const char *text, char before)
{
    const char *at = strrchr(text, before);
    if (at == NULL || at == text || (strlen(at) < 3 && at[1] != '%')) {
        return false; /* "sample N" is no force */
    }
    return take(out, text, (size_t)(at - text), at + 1);
}

/* "Kraft kN", "p / MPa", "Kraft, kN", "Weg in mm", "density_percent". */
static bool take_behind(struct gb_lab_heading *out, const char *text)
{
    static const char *const before[] = {" in ", " en ", "/", ","};
    for (size_t i = 0; i < G_N_ELEMENTS(before); i++) {
        const char *at = strstr(text, before[i]);
        if (at != NULL && at > text &&
            take(out, text, (size_t)(at - text), at + strlen(before[i]))) {
            return true;
        }
        if (i == 1 && take_last(out, text, ' ')) {
            return true;
        }
    }
    return take_last(out, text, '_');
}

void gb_lab_role_heading(const char *text, struct gb_lab_heading *out)
{
    static const char error_end[] = "_error";
    char *line = g_strstrip(g_strdup(text));
    *out = (struct gb_lab_heading){.unit = NULL};
    for (char *c = line; *c != '\0'; c++) {
        *c = *c == '\n' || *c == '\r' || *c == '\t' ? ' ' : *c;
    }
    if (g_str_has_suffix(line, error_end)) { /* density_percent_error */
        line[strlen(line) - strlen(error_end)] = '\0';
        gb_lab_role_heading(line, out);
        g_strlcat(out->name, " error", sizeof out->name);
    } else if (!take_brackets(out, line) && !take_behind(out, line)) {
        const struct gb_lab_unit *unit = gb_lab_unit_find(line);
        set_name(out, line);
        if (unit != NULL && *line == '%') {
            out->unit = unit; /* "% TD" */
        }
    }
    g_free(line);
}
