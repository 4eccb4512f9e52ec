#ifndef GB_SCENE_NEAREST_KEY_H
#define GB_SCENE_NEAREST_KEY_H

#include <stddef.h>

/* Writes "did you mean contact.mu? " for a mistyped key: a few characters wrong,
 * missing, extra or exchanged, with or without its group, or a synonym ("friction").
 * Writes "" if no key is near, or several are.  Returns buffer. */
char *gb_nearest_key(const char *name, char *buffer, size_t size);

#endif
