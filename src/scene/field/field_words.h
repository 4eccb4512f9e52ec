#ifndef GB_SCENE_FIELD_FIELD_WORDS_H
#define GB_SCENE_FIELD_FIELD_WORDS_H

#include "greenbody/params.h"

/* Search for parameters by key, symbol, synonym and words of their meaning. */

/* How well a parameter matches a text; 0: not at all.  From best to worst: the exact
 * key, a synonym, the beginning of the key, part of the key, or words that all begin
 * words of the synonyms or the meaning.  Case is ignored, a Greek letter equals its
 * name, and an underscore equals a blank. */
int gb_field_words_rank(const struct gb_field *field, const char *text);

/* The only parameter with this synonym; NULL: none or several. */
const struct gb_field *gb_field_words_find(const char *word);

#endif
