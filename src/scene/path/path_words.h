#ifndef GB_SCENE_PATH_PATH_WORDS_H
#define GB_SCENE_PATH_PATH_WORDS_H

#include <stdbool.h>

#include "greenbody/dimension.h"
#include "greenbody/status.h"

/* The words of one leg: "shear", "xz", "to", "20", "%", "at", "z", "=", "50", "MPa". */
enum { GB_PATH_WORDS_MAX = 48 };

struct gb_path_words {
    int count, next;
    char *word[GB_PATH_WORDS_MAX]; /* into the text of `storage` */
    char *storage;
};

/* Errors: GB_ERR_INPUT where a leg has too many words. */
bool gb_path_words_init(struct gb_path_words *words, const char *text,
                        struct gb_error *err);
void gb_path_words_finish(struct gb_path_words *words);

/* The next word, "" behind the last one. */
const char *gb_path_words_peek(const struct gb_path_words *words);
const char *gb_path_words_take(struct gb_path_words *words);
/* Takes the next word if it is this one. */
bool gb_path_words_accept(struct gb_path_words *words, const char *word);
/* Takes a number with its unit, "50 MPa", "20 %", "0.2".  False: the next words are none;
 * nothing is taken then. */
bool gb_path_words_quantity(struct gb_path_words *words, enum gb_dimension dimension,
                            double *value);
/* Takes the name of a component; -1: the next word is none. */
int gb_path_words_component(struct gb_path_words *words);

#endif
