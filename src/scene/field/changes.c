#include "scene/field/changes.h"

#include <glib.h>
#include <inttypes.h>
#include <string.h>

#include "scene/loading_kind.h"

/* One entry: the recorded step after which it applies, and "group.key=value". */
struct entry {
    int64_t step;
    char *assignment;
};

/* The key of the assignment, with or without its group, if it may change; NULL
 * otherwise. */
static const struct gb_field *allowed_key(const char *assignment)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const size_t length = strcspn(assignment, "=");
    const char *dot = memchr(assignment, '.', length);
    const size_t group = dot == NULL ? 0 : (size_t)(dot - assignment);
    const char *key = dot == NULL ? assignment : dot + 1;
    const size_t key_length = length - (size_t)(key - assignment);
    for (size_t i = 0; assignment[length] == '=' && i < count; i++) {
        if (fields[i].may_change && strlen(fields[i].key) == key_length &&
            strncmp(fields[i].key, key, key_length) == 0 &&
            (dot == NULL || (strlen(fields[i].group) == group &&
                             strncmp(fields[i].group, assignment, group) == 0))) {
            return &fields[i];
        }
    }
    return NULL;
}

/* "contact.alpha, contact.mu, ...".  g_free. */
static char *allowed_names(void)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    GString *names = g_string_new("");
    for (size_t i = 0; i < count; i++) {
        if (fields[i].may_change) {
            g_string_append_printf(names, "%s%s.%s", names->len > 0 ? ", " : "",
                                   fields[i].group, fields[i].key);
        }
    }
    return g_string_free(names, FALSE);
}

/* The message suggests a likely key before it lists the keys that may change. */
static bool refuse_key(const char *assignment, struct gb_error *err)
{
    char *name = g_strndup(assignment, strcspn(assignment, "="));
    char *names = allowed_names();
    if (gb_params_find_name(g_strstrip(name), err) != NULL) {
        if (strchr(assignment, '=') == NULL) {
            gb_error_set(err, GB_ERR_INPUT, "%.60s: missing \"=value\"", assignment);
        } else {
            gb_error_set(err, GB_ERR_INPUT,
                         "%.60s: cannot change during a run; keys that can: %s",
                         assignment, names);
        }
    }
    g_free(names);
    g_free(name);
    return false;
}

/* Fails for the entry `text`.  The message quotes only the assignment if that is wrong.
 */
static bool refuse(const char *text, const struct entry *entry, struct gb_error *err)
{
    if (entry->assignment == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.changes = %.60s: must be STEP KEY=VALUE, separated "
                            "by ';', in the order of steps",
                            text);
    }
    return refuse_key(entry->assignment, err);
}

/* Reads "120 contact.mu=0.3", without blanks at its ends.  False: not an entry. */
static bool parse(const char *text, struct entry *entry)
{
    char *rest = NULL;
    entry->assignment = NULL;
    entry->step = g_ascii_strtoll(text, &rest, 10);
    if (rest == text || entry->step < 0 || !g_ascii_isspace(*rest)) {
        return false;
    }
    while (g_ascii_isspace(*rest)) {
        rest++;
    }
    entry->assignment = rest;
    return allowed_key(rest) != NULL;
}

/* Calls take with each entry up to step `last` until take returns false. */
static bool visit(const struct gb_params *params, int64_t last,
                  bool (*take)(const struct entry *entry, void *data), void *data,
                  struct gb_error *err)
{
    char **parts = g_strsplit(params->changes, ";", -1);
    int64_t before = 0;
    bool good = true;
    for (int i = 0; good && parts[i] != NULL; i++) {
        struct entry entry;
        const char *text = g_strstrip(parts[i]);
        if (*text == '\0') {
            continue;
        }
        if (!parse(text, &entry)) {
            good = refuse(text, &entry, err);
        } else if (entry.step < before) {
            entry.assignment = NULL;
            good = refuse(text, &entry, err);
        } else if (entry.step <= last) {
            good = take(&entry, data);
        }
        before = entry.step;
    }
    g_strfreev(parts);
    return good;
}

struct checking {
    struct gb_params params;
    struct gb_error *err;
};

static bool check_entry(const struct entry *entry, void *data)
{
    struct checking *checking = data;
    return gb_params_assign(&checking->params, entry->assignment, checking->err) &&
           gb_params_check(&checking->params, checking->err);
}

static bool can_change(const struct gb_loading_kind *kind)
{
    return kind->changes;
}

bool gb_changes_check(const struct gb_params *params, struct gb_error *err)
{
    if (params->changes[0] == '\0') {
        return true;
    }
    if (!gb_loading_kind_of(params)->changes) {
        char names[80];
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.changes: must be empty unless scene.kind = %s",
                            gb_loading_kind_names(can_change, names, sizeof names));
    }
    struct checking checking = {*params, err};
    checking.params.changes[0] = '\0';
    return visit(params, INT64_MAX, check_entry, &checking, err);
}

static bool apply_entry(const struct entry *entry, void *data)
{
    gb_params_assign(data, entry->assignment, NULL);
    return true;
}

void gb_changes_effective(const struct gb_params *params, int64_t step,
                          struct gb_params *out)
{
    *out = *params;
    visit(params, step, apply_entry, out, NULL);
}

struct asking {
    int64_t step;
    bool due;
};

static bool compare_step(const struct entry *entry, void *data)
{
    struct asking *asking = data;
    asking->due = asking->due || entry->step == asking->step;
    return true;
}

bool gb_changes_due(const struct gb_params *params, int64_t step)
{
    struct asking asking = {step, false};
    if (params->changes[0] != '\0') {
        visit(params, step, compare_step, &asking, NULL);
    }
    return asking.due;
}

static bool compare_later(const struct entry *entry, void *data)
{
    int64_t *step = data;
    const bool later = entry->step > *step;
    *step = later ? entry->step : *step;
    return !later;
}

int64_t gb_changes_next(const struct gb_params *params, int64_t step)
{
    int64_t next = step;
    if (params->changes[0] != '\0') {
        visit(params, INT64_MAX, compare_later, &next, NULL);
    }
    return next > step ? next : -1;
}

/* "mu=0.3" becomes "contact.mu=0.3" if the key may change. */
static char *with_group(const char *assignment)
{
    const struct gb_field *field = allowed_key(assignment);
    return field == NULL || memchr(assignment, '.', strcspn(assignment, "=")) != NULL
               ? g_strdup(assignment)
               : g_strdup_printf("%s.%s", field->group, assignment);
}

/* Removes the blanks around '='. */
static char *tidy(const char *text)
{
    char **sides = g_strsplit(text, "=", 2);
    char *joined = NULL;
    if (sides[0] != NULL && sides[1] != NULL) {
        joined = g_strconcat(g_strstrip(sides[0]), "=", g_strstrip(sides[1]), NULL);
    } else {
        joined = g_strdup(text);
    }
    char *full = with_group(joined);
    g_free(joined);
    g_strfreev(sides);
    return full;
}

bool gb_changes_add(struct gb_params *params, int64_t step, const char *assignments,
                    struct gb_error *err)
{
    struct gb_params more = *params;
    GString *all = g_string_new(params->changes);
    char **parts = g_strsplit(assignments, ";", -1);
    for (int i = 0; parts[i] != NULL; i++) {
        if (*g_strstrip(parts[i]) != '\0') {
            char *entry = tidy(parts[i]);
            g_string_append_printf(all, "%s%" PRId64 " %s", all->len > 0 ? "; " : "",
                                   step, entry);
            g_free(entry);
        }
    }
    const bool fits = all->len < sizeof more.changes;
    if (fits) {
        g_strlcpy(more.changes, all->str, sizeof more.changes);
    } else {
        gb_error_set(err, GB_ERR_INPUT, "loading.changes: must be at most %zu bytes",
                     sizeof more.changes - 1);
    }
    g_strfreev(parts);
    g_string_free(all, TRUE);
    if (!fits || !gb_changes_check(&more, err)) {
        return false;
    }
    *params = more;
    return true;
}
