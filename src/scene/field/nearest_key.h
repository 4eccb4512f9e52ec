#ifndef GB_SCENE_NEAREST_KEY_H
#define GB_SCENE_NEAREST_KEY_H

#include <stddef.h>

/* "did you mean contact.mu? " for a name with few characters wrong, missing, too many or
 * exchanged, with or without its group, or for a synonym ("friction"); "" where no key is near, or several are.  Returns
 * buffer. */
char *gb_nearest_key(const char *name, char *buffer, size_t size);

#endif
