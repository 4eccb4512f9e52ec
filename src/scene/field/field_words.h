#ifndef GB_SCENE_FIELD_FIELD_WORDS_H
#define GB_SCENE_FIELD_FIELD_WORDS_H

#include "greenbody/params.h"

/* Parameters by what they mean: by key, symbol, synonym and words of the meaning. */

/* How near a parameter is to a text: 0: not at all; an exact key is nearest, then a
 * synonym, part of the key, and words that begin in synonyms or meaning, all of them.  Case
 * counts nowhere, a Greek letter is its name, an underscore a blank. */
int gb_field_words_rank(const struct gb_field *field, const char *text);

/* The only parameter with this synonym; NULL: none or several. */
const struct gb_field *gb_field_words_find(const char *word);

#endif
