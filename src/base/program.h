#ifndef GB_BASE_PROGRAM_H
#define GB_BASE_PROGRAM_H

/* The program's own file, and what stands beside it.
 *
 * Under the launcher of a bundle the running file is the bundle's
 * loader, a copy named like the program in libexec/, with a link `launcher` beside it. */

/* Folder of the running file, links resolved, in newly allocated memory (g_free); NULL
 * where /proc is missing. */
char *gb_program_folder(void);

/* Folder of the file that this code was loaded from: libgreenbody in another
 * program, the running file otherwise (g_free); NULL where the loader does not say. */
char *gb_program_library_folder(void);

/* File to execute for another process of this program (g_free): the launcher of a bundle,
 * else /proc/self/exe, which also names a file that was replaced since the start. */
char *gb_program_executable(void);

/* Names the process like the program, which /proc/self/exe would call "exe": for ps, pgrep
 * and killall. */
void gb_program_name_process(void);

#endif
