#ifndef GB_BASE_WORDS_H
#define GB_BASE_WORDS_H

#include <stddef.h>

/* Words in messages: what was meant instead of a wrong one, and lists that fit. */

/* Characters to replace, to insert, to leave out, or neighbours to exchange, from a to b; many
 * for words beyond 40 bytes.  Source: Damerau, Commun. ACM 7, 171 (1964). */
int gb_words_edits(const char *a, const char *b);

/* Edits that a name may be away from what was meant: a third of its characters, at most
 * two. */
int gb_words_allowed(const char *name);

/* "did you mean densification? " for the one of the words (NULL at the end) that is so near
 * to the name; "" where none is, or several are.  Returns buffer. */
char *gb_words_nearest(const char *name, char *const *words, char *buffer, size_t size);

/* The same with the words in one text, between ", ". */
char *gb_words_nearest_in(const char *name, const char *words, char *buffer, size_t size);

/* Whole words with commas between in newly allocated memory (g_free), as far as they fit into
 * so many bytes without the 0; the other ones are counted at the end: "a, b and 3 more".  ""
 * when none fits. */
char *gb_words_join(char *const *words, size_t bytes);

#endif
