#ifndef GB_CLI_EXIT_STATUS_H
#define GB_CLI_EXIT_STATUS_H

#include <stdio.h>

/* Exit statuses of all commands, "STATUS MEANING", a line each: the manual pages are made
 * from it, and tests/pages.py compares docs/manual.md with it. */
void gb_exit_status_print(FILE *to);

#endif
