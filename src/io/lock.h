#ifndef GB_IO_LOCK_H
#define GB_IO_LOCK_H

#include <stdbool.h>
#include <sys/types.h>

/* A lock that one process at a time can hold, on one machine or on several that share a
 * file system.  It locks the regular file NAME in a folder; network file systems
 * forward locks of files to their server, but lock folders only for the local machine.
 *
 * The kernel releases the lock when the process ends in any way.  A process that is
 * stopped keeps it.  The file names the holder.  A file without a holder was left by a
 * killed process and has no meaning.  On file systems without locks a second process is
 * not detected. */
struct gb_lock {
    int folder, file; /* open; -1: none */
    pid_t owner;      /* a child that inherits the lock does not release it */
    char *name;
};

/* Initial value: gb_lock_release has nothing to do. */
#define GB_LOCK_NONE ((struct gb_lock){.folder = -1, .file = -1})

/* Takes the lock.  False with errno: EWOULDBLOCK if another process holds it.  In a
 * folder that cannot be written it succeeds without a lock file. */
bool gb_lock_take(struct gb_lock *lock, const char *folder, const char *name);

/* Removes the file and releases the lock. */
void gb_lock_release(struct gb_lock *lock);

/* Does a process, this one included, hold the lock? */
bool gb_lock_is_held(const char *folder, const char *name);

/* Text for the user: "process 4711 on node3", or "another process" if the file does not
 * name it. g_free. */
char *gb_lock_holder(const char *folder, const char *name);

#endif
