#include "io/lab/lab_private.h"

#include <math.h>
#include <string.h>

/* Rows by which a column is taken for numbers. */
enum { ROWS_SEEN = 200 };

/* Whether half of the cells of a column that are not empty are numbers. */
static bool has_numbers(const struct gb_lab_reading *reading, size_t column)
{
    size_t numbers = 0;
    size_t words = 0;
    const size_t end = MIN(gb_lab_grid_rows(&reading->grid), reading->first + ROWS_SEEN);
    for (size_t r = reading->first; r < end; r++) {
        struct gb_lab_number number;
        const char *text = gb_lab_grid_cell(&reading->grid, r, column).text;
        const bool is = gb_lab_number_scan(text, &number);
        numbers += is;
        words += !is && *text != '\0';
    }
    return numbers > 0 && numbers >= words;
}

/* How well a column suits a role, 0 if another role suits better. */
static int rank_of(const struct gb_lab_reading *reading, enum gb_lab_role role,
                   size_t column)
{
    const struct gb_lab_heading *heading = &reading->heading[column];
    const int rank = gb_lab_role_rank(role, heading);
    for (int other = 0; other < GB_LAB_ROLES && rank > 0; other++) {
        if (gb_lab_role_rank((enum gb_lab_role)other, heading) > rank) {
            return 0;
        }
    }
    return rank > 0 && (gb_lab_role_is_words(role) || has_numbers(reading, column)) ? rank
                                                                                    : 0;
}

/* The columns that suit a role best; their number. */
static int find_best(const struct gb_lab_reading *reading, enum gb_lab_role role,
                     int best[GB_LAB_READER_CHOICES])
{
    int most = 0;
    int count = 0;
    for (size_t k = 0; k < reading->columns; k++) {
        const int rank = rank_of(reading, role, k);
        if (rank > most) {
            most = rank;
            count = 0;
        }
        if (rank > 0 && rank == most && count < GB_LAB_READER_CHOICES) {
            best[count++] = (int)k;
        }
    }
    return count;
}

static bool same_head(const struct gb_lab_reading *reading, size_t column,
                      const char *name)
{
    const char *head = gb_lab_layout_head(reading, column);
    struct gb_lab_heading wanted;
    gb_lab_role_heading(name, &wanted);
    return *head != '\0' && (strcmp(head, name) == 0 ||
                             (wanted.name[0] != '\0' && wanted.unit == NULL &&
                              strcmp(reading->heading[column].name, wanted.name) == 0));
}

/* The column that an option names. */
static enum gb_lab_outcome find_given(struct gb_lab_reading *reading,
                                      const struct gb_lab_options_column *given,
                                      const char *what, int *index)
{
    *index = given->index - 1;
    size_t found = 0;
    for (size_t k = 0; given->index == 0 && k < reading->columns; k++) {
        if (same_head(reading, k, given->name)) {
            *index = found++ == 0 ? (int)k : *index;
        }
    }
    if ((given->index == 0 && found != 1) || *index >= (int)reading->columns) {
        char *list = gb_lab_layout_list(reading);
        char number[16];
        g_snprintf(number, sizeof number, "%d", given->index);
        gb_lab_question_fail(reading, "%.200s: %s=%.60s: expected one of the columns %s",
                             reading->path, what, given->index > 0 ? number : given->name,
                             list);
        g_free(list);
        return GB_LAB_FAILED;
    }
    return GB_LAB_READ;
}

static enum gb_lab_outcome take_given(struct gb_lab_reading *reading,
                                      enum gb_lab_role role)
{
    const struct gb_lab_options_column *given = &reading->options->column[role];
    struct gb_lab_column *column = &reading->column[role];
    const enum gb_lab_outcome outcome =
        find_given(reading, given, gb_lab_role_name(role), &column->index);
    if (outcome != GB_LAB_READ) {
        return outcome;
    }
    const struct gb_lab_unit *unit = reading->heading[column->index].unit;
    column->unit = given->unit;
    if (given->unit == NULL && unit != NULL && gb_lab_role_takes(role, unit)) {
        column->unit = unit;
        column->guessed = true; /* the unit was */
    }
    return GB_LAB_READ;
}

/* Two columns that suit equally. */
static enum gb_lab_outcome ask_which(struct gb_lab_reading *reading,
                                     enum gb_lab_role role, const int *best, int count)
{
    GString *list = g_string_new(NULL);
    for (int i = 0; i < count; i++) {
        char column[GB_LAB_LAYOUT_COLUMN];
        const struct gb_lab_unit *unit = reading->heading[best[i]].unit;
        char *item =
            g_strdup_printf("%s=%d%s%s", gb_lab_role_name(role), best[i] + 1,
                            unit != NULL ? ":" : "", unit != NULL ? unit->name : "");
        gb_lab_layout_column(reading, best[i], column);
        g_string_append_printf(list, "%s%s", i > 0 ? " or " : "", column);
        gb_lab_question_choice(reading, item);
        g_free(item);
    }
    gb_lab_question_ask(reading, "%s: %s?", gb_lab_role_name(role), list->str);
    g_string_free(list, TRUE);
    return GB_LAB_QUESTION;
}

static void take(struct gb_lab_reading *reading, enum gb_lab_role role, int column)
{
    reading->column[role] = (struct gb_lab_column){
        .index = column, .unit = reading->heading[column].unit, .guessed = true};
}

static bool has(const struct gb_lab_reading *reading, enum gb_lab_role role)
{
    return reading->column[role].index != GB_LAB_NONE;
}

/* The first role of a list that columns suit; a question where several suit equally. */
static enum gb_lab_outcome take_first(struct gb_lab_reading *reading,
                                      const enum gb_lab_role *role, size_t roles)
{
    for (size_t i = 0; i < roles; i++) {
        if (has(reading, role[i])) {
            return GB_LAB_READ;
        }
    }
    for (size_t i = 0; i < roles; i++) {
        int best[GB_LAB_READER_CHOICES];
        const int count = find_best(reading, role[i], best);
        if (count > 1) {
            return ask_which(reading, role[i], best, count);
        }
        if (count == 1) {
            take(reading, role[i], best[0]);
            return GB_LAB_READ;
        }
    }
    return GB_LAB_READ;
}

static const enum gb_lab_role pressures[] = {GB_LAB_ROLE_PRESSURE, GB_LAB_ROLE_FORCE};
static const enum gb_lab_role densities[] = {GB_LAB_ROLE_DENSITY, GB_LAB_ROLE_POROSITY,
                                             GB_LAB_ROLE_HEIGHT, GB_LAB_ROLE_TRAVEL};

static bool has_any(const struct gb_lab_reading *reading, const enum gb_lab_role *role,
                    size_t roles)
{
    bool any = false;
    for (size_t i = 0; i < roles; i++) {
        any = any || has(reading, role[i]);
    }
    return any;
}

static enum gb_lab_outcome ask_columns(struct gb_lab_reading *reading)
{
    const bool pressure = has_any(reading, pressures, G_N_ELEMENTS(pressures));
    const bool density = has_any(reading, densities, G_N_ELEMENTS(densities));
    if (pressure && density) {
        return GB_LAB_READ;
    }
    char *list = gb_lab_layout_list(reading);
    gb_lab_question_choice(reading, pressure  ? "density=?:%"
                                    : density ? "pressure=?:MPa"
                                              : "pressure=?:MPa,density=?:%");
    gb_lab_question_ask(reading, "which column is the %s? There are %s",
                        pressure  ? "density"
                        : density ? "pressure"
                                  : "pressure, which the density",
                        list);
    g_free(list);
    return GB_LAB_QUESTION;
}

/* Columns that a table can do without: only where one alone suits. */
static void take_others(struct gb_lab_reading *reading)
{
    static const enum gb_lab_role optional[] = {GB_LAB_ROLE_PRESSURE_ERROR,
                                                GB_LAB_ROLE_DENSITY_ERROR,
                                                GB_LAB_ROLE_BRANCH, GB_LAB_ROLE_SERIES};
    for (size_t i = 0; i < G_N_ELEMENTS(optional); i++) {
        int best[GB_LAB_READER_CHOICES];
        if (!has(reading, optional[i]) && find_best(reading, optional[i], best) == 1) {
            take(reading, optional[i], best[0]);
        }
    }
    if (has(reading, GB_LAB_ROLE_PRESSURE_ERROR) && !has(reading, GB_LAB_ROLE_PRESSURE)) {
        reading->column[GB_LAB_ROLE_PRESSURE_ERROR].index = GB_LAB_NONE;
    }
    if (has(reading, GB_LAB_ROLE_DENSITY_ERROR) && !has(reading, GB_LAB_ROLE_DENSITY)) {
        reading->column[GB_LAB_ROLE_DENSITY_ERROR].index = GB_LAB_NONE;
    }
}

/* A force needs the pressure of its unit: without one it is a question. */
static enum gb_lab_outcome check_units(struct gb_lab_reading *reading)
{
    static const struct {
        enum gb_lab_role role;
        const char *usual;
    } needed[] = {{GB_LAB_ROLE_PRESSURE, "MPa"},
                  {GB_LAB_ROLE_FORCE, "kN"},
                  {GB_LAB_ROLE_TRAVEL, "mm"},
                  {GB_LAB_ROLE_HEIGHT, "mm"}};
    for (size_t i = 0; i < G_N_ELEMENTS(needed); i++) {
        const enum gb_lab_role role = needed[i].role;
        struct gb_lab_column *column = &reading->column[role];
        if (column->index != GB_LAB_NONE && column->unit == NULL) {
            char shown[GB_LAB_LAYOUT_COLUMN];
            char *item = g_strdup_printf("%s=%d:%s", gb_lab_role_name(role),
                                         column->index + 1, needed[i].usual);
            gb_lab_question_choice(reading, item);
            g_free(item);
            return gb_lab_question_ask(
                reading, "%s from %s: in which unit? (%s)", gb_lab_role_name(role),
                gb_lab_layout_column(reading, column->index, shown),
                gb_lab_unit_accepted(gb_lab_role_dimension(role)));
        }
    }
    return GB_LAB_READ;
}

/* Heads that are keys, as particles.diameter_nm: lower case, one point. */
static bool is_key(const char *head)
{
    static const char lower[] = "abcdefghijklmnopqrstuvwxyz_";
    const size_t group = strspn(head, lower);
    return group > 1 && head[group] == '.' && strspn(head + group + 1, lower) > 1 &&
           strcspn(head + group + 1, ". ") == strlen(head + group + 1);
}

static enum gb_lab_outcome take_keys(struct gb_lab_reading *reading)
{
    struct gb_lab_options *options = reading->options;
    for (int k = 0; k < options->keys; k++) {
        const enum gb_lab_outcome outcome =
            find_given(reading, &options->key[k].column, options->key[k].key,
                       &reading->key[k].index);
        if (outcome != GB_LAB_READ) {
            return outcome;
        }
    }
    for (size_t k = 0; k < reading->columns && options->keys < GB_LAB_OPTIONS_KEYS; k++) {
        const char *head = gb_lab_layout_head(reading, k);
        if (is_key(head) && strlen(head) < GB_LAB_OPTIONS_NAME &&
            has_numbers(reading, k)) {
            struct gb_lab_options_key *key = &options->key[options->keys];
            *key = (struct gb_lab_options_key){
                .column = {.given = true, .index = (int)k + 1}};
            g_strlcpy(key->key, head, sizeof key->key);
            reading->key[options->keys++].index = (int)k;
        }
    }
    return GB_LAB_READ;
}

enum gb_lab_outcome gb_lab_columns_assign(struct gb_lab_reading *reading)
{
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        reading->column[role].index = GB_LAB_NONE;
    }
    enum gb_lab_outcome outcome = take_keys(reading);
    for (int role = 0; role < GB_LAB_ROLES && outcome == GB_LAB_READ; role++) {
        if (reading->options->column[role].given) {
            outcome = take_given(reading, (enum gb_lab_role)role);
        }
    }
    outcome = outcome != GB_LAB_READ
                  ? outcome
                  : take_first(reading, pressures, G_N_ELEMENTS(pressures));
    outcome = outcome != GB_LAB_READ
                  ? outcome
                  : take_first(reading, densities, G_N_ELEMENTS(densities));
    outcome = outcome != GB_LAB_READ ? outcome : ask_columns(reading);
    if (outcome == GB_LAB_READ) {
        take_others(reading);
        outcome = check_units(reading);
    }
    return outcome;
}
