#ifndef GB_CLI_CANDIDATES_H
#define GB_CLI_CANDIDATES_H

#include <glib.h>
#include <stdbool.h>

/* Continuations of a word, printed to stdout as they are found. */
struct gb_candidates {
    const char *prefix; /* what is typed of the part that is completed */
    const char *before; /* what stands before that part in the same word, as "--set=" */
};

/* Prints a candidate that begins with the prefix.  doc may be NULL. */
void gb_candidates_add(const struct gb_candidates *to, const char *candidate,
                       const char *doc);
/* The same for one that need not begin with it: a key typed without its group. */
void gb_candidates_add_any(const struct gb_candidates *to, const char *candidate,
                           const char *doc);

/* What a path may name. */
enum gb_candidates_path { GB_CANDIDATES_FILE, GB_CANDIDATES_FOLDER, GB_CANDIDATES_RUN };

/* Files with one of the endings ("" or NULL: any), folders, or directories of runs. */
void gb_candidates_paths(const struct gb_candidates *to, enum gb_candidates_path kind,
                         const char *const *endings);

/* Presets by name. */
void gb_candidates_presets(const struct gb_candidates *to);
/* "group." and "group.key=", also by the key alone; values behind the sign. */
void gb_candidates_keys(const struct gb_candidates *to);
/* Keys of a list "key,key": the last one. */
void gb_candidates_keys_list(const struct gb_candidates *to);
/* The value of an option by the name of the command and the option, and what the option's
 * description says: names of a table, keys, files or folders. */
void gb_candidates_value(const struct gb_candidates *to, const char *command,
                         const GOptionEntry *entry);
/* The contact laws. */
void gb_candidates_value_laws(const struct gb_candidates *to);

#endif
