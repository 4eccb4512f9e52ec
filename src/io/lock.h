#ifndef GB_IO_LOCK_H
#define GB_IO_LOCK_H

#include <stdbool.h>
#include <sys/types.h>

/* A lock that one process at a time holds, on one machine or on several that share a file
 * system: that of the whole regular file NAME in a folder.  Network file systems turn it
 * into a lock of their server; a folder they would lock for their own machine only.
 *
 * The kernel ends the lock with its process, however that ends, and nothing else ends it: a
 * process that stands still keeps it.  The file says who holds it.  A file without a
 * holder is left over from a killed process and means nothing.  File systems without locks
 * do not protect from a second process. */
struct gb_lock {
    int folder, file; /* open; -1: none */
    pid_t owner;      /* a child that inherits the lock does not end it */
    char *name;
};

/* Initial value: gb_lock_release has nothing to do. */
#define GB_LOCK_NONE ((struct gb_lock){.folder = -1, .file = -1})

/* Takes the lock; false with errno: EWOULDBLOCK where a process holds it.  A folder that
 * cannot be written has no lock: it is opened, without a file. */
bool gb_lock_take(struct gb_lock *lock, const char *folder, const char *name);

/* Removes the file and ends the lock. */
void gb_lock_release(struct gb_lock *lock);

/* Does a process, this one included, hold the lock? */
bool gb_lock_is_held(const char *folder, const char *name);

/* "process 4711 on node3", for people; "another process" where the file does not say.
 * g_free. */
char *gb_lock_holder(const char *folder, const char *name);

#endif
