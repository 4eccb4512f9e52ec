#include "io/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>

enum { HOLDER_BYTES = 400 };

/* Does a process hold the lock?  Queries take a shared lock for a moment, so that they
 * do not mistake each other for a holder. */
static bool has_holder(int file)
{
    if (flock(file, LOCK_SH | LOCK_NB) != 0) {
        return errno == EWOULDBLOCK;
    }
    (void)flock(file, LOCK_UN);
    return false;
}

static int open_to_ask(const char *folder, const char *name)
{
    char *path = g_build_filename(folder, name, NULL);
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    g_free(path);
    return file;
}

/* Is the open file still the one in the folder?  A holder removes the file before it
 * unlocks, so a file that was opened before may be a removed one. */
static bool is_current(int folder, const char *name, int file)
{
    struct stat ours, named;
    return fstat(file, &ours) == 0 &&
           fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
}

/* Opens and locks the file; -1 with errno. */
static int lock_file(int folder, const char *name)
{
    while (true) {
        const int file =
            openat(folder, name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0) {
            return -1;
        }
        bool locked = true;
        while (locked && flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            locked = !has_holder(file);
            (void)sched_yield(); /* lets queries finish */
        }
        if (locked && is_current(folder, name, file)) {
            return file;
        }
        close(file);
        if (!locked) {
            errno = EWOULDBLOCK;
            return -1;
        }
    }
}

bool gb_lock_take(struct gb_lock *lock, const char *folder, const char *name)
{
    *lock = (struct gb_lock){.file = -1, .owner = getpid()};
    lock->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock->folder < 0) {
        return false;
    }
    lock->file = lock_file(lock->folder, name);
    if (lock->file < 0) {
        int why = errno;
        if (why == EACCES || why == EROFS) {
            if (!gb_lock_is_held(folder, name)) {
                return true;
            }
            why = EWOULDBLOCK;
        }
        close(lock->folder);
        lock->folder = -1;
        errno = why;
        return false;
    }
    lock->name = g_strdup(name);
    if (ftruncate(lock->file, 0) == 0) {
        dprintf(lock->file, "process %ld on %s\n", (long)lock->owner, g_get_host_name());
    }
    return true;
}

void gb_lock_release(struct gb_lock *lock)
{
    if (lock->file >= 0) {
        if (lock->owner == getpid()) {
            (void)unlinkat(lock->folder, lock->name, 0);
            (void)flock(lock->file, LOCK_UN); /* also for children that inherited it */
        }
        close(lock->file);
    }
    if (lock->folder >= 0) {
        close(lock->folder);
    }
    g_free(lock->name);
    *lock = GB_LOCK_NONE;
}

bool gb_lock_is_held(const char *folder, const char *name)
{
    const int file = open_to_ask(folder, name);
    const bool held = file >= 0 && has_holder(file);
    if (file >= 0) {
        close(file);
    }
    return held;
}

char *gb_lock_holder(const char *folder, const char *name)
{
    char text[HOLDER_BYTES] = "";
    const int file = open_to_ask(folder, name);
    const ssize_t size = file >= 0 ? read(file, text, sizeof text - 1) : 0;
    if (file >= 0) {
        close(file);
    }
    text[size > 0 ? size : 0] = '\0';
    text[strcspn(text, "\n")] = '\0';
    return g_strdup(text[0] != '\0' ? text : "another process");
}
