#ifndef GB_BASE_WORDS_H
#define GB_BASE_WORDS_H

#include <stddef.h>

/* Helpers for messages: suggestions for mistyped words, and lists that fit a width. */

/* Edit distance from a to b: characters to replace, insert or delete, and neighbours to
 * exchange.  A large number for words beyond 40 bytes.  Source: Damerau, Commun.  ACM
 * 7, 171 (1964). */
int gb_words_edits(const char *a, const char *b);

/* Largest edit distance at which a name still counts as mistyped: a third of its
 * characters, at most two. */
int gb_words_allowed(const char *name);

/* Writes "did you mean densification? " for the one of the words (NULL at the end) that
 * is that near to the name; "" if none is, or several are.  Returns buffer. */
char *gb_words_nearest(const char *name, char *const *words, char *buffer, size_t size);

/* The same with the words in one text, separated by ", ". */
char *gb_words_nearest_in(const char *name, const char *words, char *buffer, size_t size);

/* Joins whole words with commas (g_free), as many as fit into `bytes` bytes without the
 * final '\0'; the others are counted: "a, b and 3 more". "" if none fits. */
char *gb_words_join(char *const *words, size_t bytes);

#endif
