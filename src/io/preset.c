/* Preset files.  The first part indexes the text of a key file: the place of every key
 * (gb_preset_lines_...).  Reading sets the parameters key by key and reports errors
 * with file and line.  Saving edits the original text, so that comments, order and
 * unknown keys survive: changed values are replaced in place, and missing keys are
 * inserted at the end of their group. */
#include "io/preset.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <linux/magic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "base/words.h"
#include "greenbody/status.h"
#include "io/preset_folders.h"
#include "io/text_file.h"
#include "scene/size/size_table.h"

/* One line of the text, trimmed of blanks and carriage return. */
struct piece {
    const char *start, *stop; /* trimmed */
    int line;
    size_t end;
};

struct scanner {
    struct gb_key_lines *lines;
    const char *path;
    const char *text;
    const char *group; /* current one, owned by its line */
    GHashTable *seen;  /* "group\nkey" -> line number */
};

static void add(struct gb_key_lines *lines, struct gb_key_line item)
{
    if (lines->count == lines->room) {
        lines->room = lines->room ? 2 * lines->room : 64;
        lines->item = g_renew(struct gb_key_line, lines->item, lines->room);
    }
    lines->item[lines->count++] = item;
}

static bool refuse(const struct scanner *scanner, const struct piece *piece,
                   const char *why, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s:%d: %.*s: %s", scanner->path, piece->line,
                        (int)MIN(piece->stop - piece->start, 80), piece->start, why);
}

static bool take_group(struct scanner *scanner, const struct piece *piece,
                       struct gb_error *err)
{
    const ptrdiff_t length = piece->stop - piece->start;
    if (length < 3 || piece->stop[-1] != ']') {
        return refuse(scanner, piece, "expected [group]", err);
    }
    struct gb_key_line item = {.line = piece->line, .end = piece->end};
    item.group = g_strndup(piece->start + 1, (size_t)length - 2);
    add(scanner->lines, item);
    scanner->group = item.group;
    return true;
}

/* Fails for a duplicate key, of which GKeyFile would silently take the last. */
static bool take_once(struct scanner *scanner, const struct piece *piece, const char *key,
                      struct gb_error *err)
{
    char *name = g_strconcat(scanner->group, "\n", key, NULL);
    const int first = GPOINTER_TO_INT(g_hash_table_lookup(scanner->seen, name));
    if (first == 0) {
        g_hash_table_insert(scanner->seen, name, GINT_TO_POINTER(piece->line));
        return true;
    }
    gb_error_set(err, GB_ERR_INPUT, "%s:%d: %.40s.%.40s is given twice, first in line %d",
                 scanner->path, piece->line, scanner->group, key, first);
    g_free(name);
    return false;
}

static bool take_key(struct scanner *scanner, const struct piece *piece,
                     struct gb_error *err)
{
    const char *equals = memchr(piece->start, '=', (size_t)(piece->stop - piece->start));
    if (!equals || equals == piece->start) {
        return refuse(scanner, piece, "expected [group], key = value or # comment", err);
    }
    if (!scanner->group) {
        return refuse(scanner, piece, "a [group] must come before the first key", err);
    }
    const char *value = equals + 1;
    while (value < piece->stop && g_ascii_isspace(*value)) {
        value++;
    }
    struct gb_key_line item = {.line = piece->line, .end = piece->end};
    item.value = (size_t)(value - scanner->text);
    item.value_end = (size_t)(piece->stop - scanner->text);
    item.group = g_strdup(scanner->group);
    item.key = g_strchomp(g_strndup(piece->start, (size_t)(equals - piece->start)));
    add(scanner->lines, item);
    return take_once(scanner, piece, item.key, err);
}

static bool take_line(struct scanner *scanner, const struct piece *piece,
                      struct gb_error *err)
{
    if (memchr(piece->start, '\0', (size_t)(piece->stop - piece->start))) {
        return refuse(scanner, piece, "NUL bytes are not text", err);
    }
    if (!g_utf8_validate(piece->start, piece->stop - piece->start, NULL)) {
        return refuse(scanner, piece, "not valid UTF-8", err);
    }
    if (piece->start == piece->stop || *piece->start == '#') {
        return true;
    }
    return *piece->start == '[' ? take_group(scanner, piece, err)
                                : take_key(scanner, piece, err);
}

static bool take_all(struct scanner *scanner, size_t length, struct gb_error *err)
{
    const char *at = scanner->text;
    const char *last = at + length;
    for (int line = 1; at < last; line++) {
        const char *newline = memchr(at, '\n', (size_t)(last - at));
        struct piece piece = {
            .start = at, .stop = newline ? newline : last, .line = line};
        at = newline ? newline + 1 : last;
        piece.end = (size_t)(at - scanner->text);
        while (piece.start < piece.stop && g_ascii_isspace(*piece.start)) {
            piece.start++;
        }
        while (piece.stop > piece.start && g_ascii_isspace(piece.stop[-1])) {
            piece.stop--;
        }
        if (!take_line(scanner, &piece, err)) {
            return false;
        }
    }
    return true;
}

bool gb_preset_lines_init(struct gb_key_lines *lines, const char *path, const char *text,
                          size_t length, struct gb_error *err)
{
    *lines = (struct gb_key_lines){0};
    struct scanner scanner = {.lines = lines, .path = path, .text = text};
    scanner.seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    const bool good = take_all(&scanner, length, err);
    g_hash_table_destroy(scanner.seen);
    if (!good) {
        gb_preset_lines_finish(lines);
    }
    return good;
}

void gb_preset_lines_finish(struct gb_key_lines *lines)
{
    for (size_t i = 0; i < lines->count; i++) {
        g_free(lines->item[i].group);
        g_free(lines->item[i].key);
    }
    g_free(lines->item);
    *lines = (struct gb_key_lines){0};
}

const struct gb_key_line *gb_preset_lines_find(const struct gb_key_lines *lines,
                                               const char *group, const char *key)
{
    for (size_t i = 0; i < lines->count; i++) {
        const struct gb_key_line *item = &lines->item[i];
        if (strcmp(item->group, group) == 0 && g_strcmp0(item->key, key) == 0) {
            return item;
        }
    }
    return NULL;
}

/* Offset at which a new key of the group is inserted: after its last key or its header.
 * If the group does not exist, `length`. */
static size_t key_lines_group_end(const struct gb_key_lines *lines, const char *group,
                                  size_t length)
{
    for (size_t i = lines->count; i > 0; i--) {
        if (strcmp(lines->item[i - 1].group, group) == 0) {
            return lines->item[i - 1].end;
        }
    }
    return length;
}

/* Limit of the size of a file.  A preset is a page of text. */
enum { PRESET_BYTES_MAX = 1 << 20 };

/* Some editors write this before UTF-8 text. */
static const char byte_order_mark[] = "\xef\xbb\xbf";

struct gb_preset {
    struct gb_params params;
    char *path; /* "" without a file */
    GString *text;
    struct gb_key_lines lines;
};

/* GB_ERR_INPUT if the user can correct the error, else GB_ERR_MACHINE. */
static enum gb_status code_of(int number)
{
    const bool input = number == ENOENT || number == ENOTDIR || number == EISDIR ||
                       number == ENAMETOOLONG || number == ELOOP || number == EINVAL;
    return input ? GB_ERR_INPUT : GB_ERR_MACHINE;
}

static bool fail_errno(const char *path, int number, struct gb_error *err)
{
    return gb_error_set(err, code_of(number), "%s: %s", path, g_strerror(number));
}

/* Reads at most limit + 1 bytes, so that reading ends for endless files. */
static bool read_some(int file, GString *text, size_t limit)
{
    char chunk[16384];
    while (text->len <= limit) {
        const ssize_t got = read(file, chunk, MIN(sizeof chunk, limit + 1 - text->len));
        if (got == 0) {
            return true;
        }
        if (got > 0) {
            g_string_append_len(text, chunk, got);
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

/* Is the file a named pipe in a folder?  Reading one would wait for a writer; pipes of
 * the shell are allowed. */
static bool is_named_pipe(int file)
{
    struct stat info;
    struct statfs system;
    return fstat(file, &info) == 0 && S_ISFIFO(info.st_mode) &&
           fstatfs(file, &system) == 0 && system.f_type != PIPEFS_MAGIC;
}

static bool read_file(const char *path, GString *text, struct gb_error *err)
{
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        return fail_errno(path, errno, err);
    }
    if (is_named_pipe(file)) {
        close(file);
        return gb_error_set(err, GB_ERR_INPUT, "%s: is a named pipe; expected: a file",
                            path);
    }
    (void)fcntl(file, F_SETFL, 0); /* blocking again */
    const bool good = read_some(file, text, PRESET_BYTES_MAX);
    const int number = errno;
    close(file);
    if (!good) {
        return fail_errno(path, number, err);
    }
    if (text->len > PRESET_BYTES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: larger than %d bytes, the limit for a preset", path,
                            PRESET_BYTES_MAX);
    }
    if (g_str_has_prefix(text->str, byte_order_mark)) {
        g_string_erase(text, 0, (gssize)strlen(byte_order_mark));
    }
    return true;
}

static bool is_known_group(const char *group)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(fields[i].group, group) == 0) {
            return true;
        }
    }
    return false;
}

/* Is the value a file name?  These are relative to the folder of the preset. */
static bool names_file(const struct gb_field *field, const char *value)
{
    return (field->type == GB_FIELD_SIZES && gb_size_table_is_path(value)) ||
           (field->type == GB_FIELD_PACKING && *value != '\0');
}

/* Sets a field from a value in a preset at path. */
static bool set_value(struct gb_params *params, const struct gb_field *field,
                      const char *value, const char *path, struct gb_error *err)
{
    if (!names_file(field, value) || g_path_is_absolute(value)) {
        return gb_params_set(params, field, value, err);
    }
    char *folder = g_path_get_dirname(path);
    char *file = g_build_filename(folder, value, NULL);
    const bool good = gb_params_set(params, field, file, err);
    g_free(file);
    g_free(folder);
    return good;
}

/* Sets one key of the file. packing selects keys that name a packing, or all others. */
static bool apply_line(struct gb_preset *preset, GKeyFile *file, bool packing,
                       const struct gb_key_line *line, struct gb_error *err)
{
    if (!line->key || g_str_has_prefix(line->key, "x-") || !is_known_group(line->group)) {
        return true;
    }
    const struct gb_field *field = gb_params_find(line->group, line->key);
    if ((field && field->type == GB_FIELD_PACKING) != packing) {
        return true;
    }
    char *value = g_key_file_get_value(file, line->group, line->key, NULL);
    struct gb_error why = {0};
    bool good = false;
    if (!value) {
        gb_error_set(&why, GB_ERR_INPUT, "%.40s.%.40s: not a name for a key", line->group,
                     line->key);
    } else if (field) {
        good = set_value(&preset->params, field, value, preset->path, &why);
    } else { /* unknown key: the error lists the keys */
        char *text = g_strconcat(line->group, ".", line->key, "=", value, NULL);
        good = gb_params_assign(&preset->params, text, &why);
        g_free(text);
    }
    g_free(value);
    return good ||
           gb_error_set(err, why.code, "%s:%d: %s", preset->path, line->line, why.text);
}

static bool apply(struct gb_preset *preset, struct gb_error *err)
{
    GKeyFile *file = g_key_file_new();
    GError *trouble = NULL;
    bool good = preset->text->len == 0 ||
                g_key_file_load_from_data(file, preset->text->str, preset->text->len,
                                          G_KEY_FILE_KEEP_COMMENTS, &trouble);
    if (!good) {
        gb_error_set(err, GB_ERR_INPUT, "%s: %s", preset->path, trouble->message);
        g_error_free(trouble);
    }
    /* packings first: they set count and diameter, which other keys may change */
    for (size_t i = 0; i < 2 * preset->lines.count && good; i++) {
        const bool packing = i < preset->lines.count;
        good = apply_line(preset, file, packing,
                          &preset->lines.item[i % preset->lines.count], err);
    }
    g_key_file_free(file);
    return good;
}

bool gb_preset_create(struct gb_preset **out, struct gb_error *err)
{
    struct gb_preset *preset = g_try_new0(struct gb_preset, 1);
    if (!preset) {
        return gb_error_set(err, GB_ERR_MEMORY, "out of memory for a preset");
    }
    gb_params_init(&preset->params);
    preset->path = g_strdup("");
    preset->text = g_string_new(NULL);
    *out = preset;
    return true;
}

void gb_preset_destroy(struct gb_preset *preset)
{
    if (!preset) {
        return;
    }
    gb_preset_lines_finish(&preset->lines);
    g_string_free(preset->text, TRUE);
    g_free(preset->path);
    g_free(preset);
}

/* Rejects complete presets of version 0.1, whose random numbers would now give another
 * packing. */
static bool check_version(const char *path, const char *text, struct gb_error *err)
{
    return !g_str_has_prefix(text, "# greenbody 0.1.") ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s:1: this preset is from greenbody 0.1: expected 0.2 or later; "
                        "delete this line to get another packing of the same kind",
                        path);
}

static bool load_path(struct gb_preset *preset, const char *path, struct gb_error *err)
{
    g_free(preset->path);
    preset->path = g_strdup(path);
    if (!read_file(path, preset->text, err) ||
        !check_version(path, preset->text->str, err)) {
        return false;
    }
    gb_params_init(&preset->params);
    return gb_preset_lines_init(&preset->lines, path, preset->text->str,
                                preset->text->len, err) &&
           apply(preset, err);
}

/* Lists only a part of the folders and presets, which can be longer than a message. */
static void refuse_name(const char *name, struct gb_error *err)
{
    enum { NAME_BYTES = 80, TEXT_BYTES = 60, PRESETS_BYTES = 80 };
    char meant[64];
    char **known = gb_preset_folders_list(), **folders = gb_preset_folders();
    gb_words_nearest(name, known, meant, sizeof meant);
    const size_t bytes = sizeof err->text - MIN(strlen(name), NAME_BYTES) -
                         strlen(meant) - TEXT_BYTES - PRESETS_BYTES;
    char *searched = gb_words_join(folders, bytes);
    char *list = gb_words_join(known, bytes + PRESETS_BYTES - strlen(searched));
    gb_error_set(err, GB_ERR_INPUT,
                 "%.*s: no such file or preset; %slooked in %s; presets: %s", NAME_BYTES,
                 name, meant, *searched != '\0' ? searched : "folders of long names",
                 *list != '\0' ? list : "none");
    g_free(searched);
    g_free(list);
    g_strfreev(folders);
    g_strfreev(known);
}

/* Finds the path for a name or path given by the user (g_free).  NULL and err: not
 * found. */
static char *resolve(const char *name, struct gb_error *err)
{
    if (g_file_test(name, G_FILE_TEST_EXISTS) && !g_file_test(name, G_FILE_TEST_IS_DIR)) {
        return g_strdup(name);
    }
    char *path = gb_preset_folders_find(name);
    if (!path && (strchr(name, '/') || g_file_test(name, G_FILE_TEST_EXISTS))) {
        path = g_strdup(name); /* opening it reports the error */
    }
    if (!path) {
        refuse_name(name, err);
    }
    return path;
}

bool gb_preset_load(struct gb_preset **out, const char *name_or_path,
                    struct gb_error *err)
{
    char *path = resolve(name_or_path, err);
    if (!path) {
        return false;
    }
    struct gb_preset *preset = NULL;
    bool good = gb_preset_create(&preset, err);
    if (good) {
        good = load_path(preset, path, err);
    }
    g_free(path);
    if (!good) {
        gb_preset_destroy(preset);
        return false;
    }
    *out = preset;
    return true;
}

struct gb_params *gb_preset_params(struct gb_preset *preset)
{
    return &preset->params;
}

const char *gb_preset_path(const struct gb_preset *preset)
{
    return preset->path;
}

bool gb_preset_has(const struct gb_preset *preset, const char *group, const char *key)
{
    return gb_preset_lines_find(&preset->lines, group, key) != NULL;
}

const char *gb_preset_other_group(const struct gb_preset *preset, const char *group)
{
    for (size_t i = 0; i < preset->lines.count; i++) {
        if (strcmp(preset->lines.item[i].group, group) != 0) {
            return preset->lines.item[i].group;
        }
    }
    return NULL;
}

/* Does a line of the file, read at path, still mean the value in params?  Values are
 * compared as formatted text, so that "0.1nm" and "0.10 nm" stay as typed.  The name of
 * a table of sizes stays only if the table is next to the preset. */
static bool has_value(const struct gb_preset *preset, const struct gb_key_line *line,
                      const struct gb_field *field, const char *path, const char *now)
{
    char *typed =
        g_strndup(preset->text->str + line->value, line->value_end - line->value);
    struct gb_params then = preset->params;
    char written[GB_PARAMS_VALUE_MAX] = "";
    const bool good = set_value(&then, field, typed, path, NULL);
    g_free(typed);
    return good &&
           strcmp(gb_params_format(&then, field, written, sizeof written), now) == 0;
}

static bool is_fallback(const struct gb_field *field, const char *now)
{
    struct gb_params initial;
    char written[GB_PARAMS_VALUE_MAX];
    gb_params_init(&initial);
    return strcmp(gb_params_format(&initial, field, written, sizeof written), now) == 0;
}

/* Indexes the text after an edit.  It was valid before and still is. */
static bool index_again(struct gb_preset *preset, struct gb_error *err)
{
    gb_preset_lines_finish(&preset->lines);
    return gb_preset_lines_init(&preset->lines, preset->path, preset->text->str,
                                preset->text->len, err);
}

static void insert_key(struct gb_preset *preset, const struct gb_field *field,
                       const char *now)
{
    GString *text = preset->text;
    size_t at = key_lines_group_end(&preset->lines, field->group, text->len);
    GString *added = g_string_new(NULL);
    if (at > 0 && text->str[at - 1] != '\n') {
        g_string_append_c(added, '\n');
    }
    if (!gb_preset_lines_find(&preset->lines, field->group, NULL)) {
        g_string_append_printf(added, "%s[%s]\n", at > 0 ? "\n" : "", field->group);
    }
    g_string_append_printf(added, "%s =%s%s\n", field->key, *now ? " " : "", now);
    g_string_insert_len(text, (gssize)at, added->str, (gssize)added->len);
    g_string_free(added, TRUE);
}

static bool update_field(struct gb_preset *preset, const struct gb_field *field,
                         const char *path, enum gb_preset_extent extent,
                         struct gb_error *err)
{
    char now[GB_PARAMS_VALUE_MAX];
    gb_params_format(&preset->params, field, now, sizeof now);
    const struct gb_key_line *line =
        gb_preset_lines_find(&preset->lines, field->group, field->key);
    if (line ? has_value(preset, line, field, path, now)
             : extent == GB_PRESET_CHANGED_KEYS && is_fallback(field, now)) {
        return true;
    }
    if (line) {
        const gssize at = (gssize)line->value;
        g_string_erase(preset->text, at, (gssize)(line->value_end - line->value));
        g_string_insert(preset->text, at, now);
    } else {
        insert_key(preset, field, now);
    }
    return index_again(preset, err);
}

static bool update_text(struct gb_preset *preset, const char *path,
                        enum gb_preset_extent extent, struct gb_error *err)
{
    if (preset->text->len == 0 && *preset->path == '\0') {
        g_string_append(preset->text, "# greenbody " GB_VERSION "\n");
    }
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!update_field(preset, &fields[i], path, extent, err)) {
            return false;
        }
    }
    return true;
}

bool gb_preset_save(struct gb_preset *preset, const char *path,
                    enum gb_preset_extent extent, struct gb_error *err)
{
    /* the text in memory changes only after it was written */
    GString *before = g_string_new_len(preset->text->str, (gssize)preset->text->len);
    if (!update_text(preset, path, extent, err) ||
        !gb_text_file_replace(path, preset->text->str, preset->text->len,
                              GB_TEXT_FILE_TYPED, err)) {
        g_string_free(preset->text, TRUE);
        preset->text = before;
        index_again(preset, NULL);
        return false;
    }
    g_string_free(before, TRUE);
    char *saved = g_strdup(path);
    g_free(preset->path);
    preset->path = saved;
    return true;
}
