#ifndef GB_BASE_PROGRAM_H
#define GB_BASE_PROGRAM_H

/* Paths of the program's own file and of the files next to it.
 *
 * In a bundle the running file is the loader of the bundle: a copy in libexec/ with the
 * name of the program, next to a link `launcher`. */

/* Folder of the running file, with links resolved (g_free); NULL without /proc. */
char *gb_program_folder(void);

/* Folder of the file from which this code was loaded: libgreenbody in another program,
 * otherwise the running file (g_free).  NULL if the loader does not report it. */
char *gb_program_library_folder(void);

/* File to execute to start another process of this program (g_free): the launcher of a
 * bundle, else /proc/self/exe, which remains valid if the file was replaced since the
 * start. */
char *gb_program_executable(void);

/* Sets the process name to the name of the program for ps, pgrep and killall; started
 * by /proc/self/exe it would be "exe". */
void gb_program_name_process(void);

#endif
