#ifndef GB_BASE_TEXT_NEAREST_WORD_H
#define GB_BASE_TEXT_NEAREST_WORD_H

#include <stddef.h>

/* Characters to replace, to insert, to leave out, or neighbours to exchange, from a to b; many
 * for words beyond 40 bytes.  Source: Damerau, Commun. ACM 7, 171 (1964). */
int gb_nearest_word_edits(const char *a, const char *b);

/* Edits that a name may be away from what was meant: a third of its characters, at most
 * two. */
int gb_nearest_word_allowed(const char *name);

/* "did you mean densification? " for the one of the words (NULL at the end) that is so near
 * to the name; "" where none is, or several are.  Returns buffer. */
char *gb_nearest_word(const char *name, char *const *words, char *buffer, size_t size);

/* The same with the words in one text, between ", ". */
char *gb_nearest_word_in(const char *name, const char *words, char *buffer, size_t size);

#endif
