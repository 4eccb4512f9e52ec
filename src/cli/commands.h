#ifndef GB_CLI_COMMANDS_H
#define GB_CLI_COMMANDS_H

#include <stdio.h>

/* A command is a function in a file cmd_NAME.c (related commands share one), with its
 * prototype below and a row in commands.c.  Help, manual page, dispatch and messages
 * follow from the row. */
struct gb_commands_row {
    const char *group; /* heading in the help */
    const char *name;
    const char *doc;                        /* one line */
    int (*function)(int argc, char **argv); /* argv[0] is the name; the exit status */
};

/* The row of a command; NULL if the word is not a command. */
const struct gb_commands_row *gb_commands_find(const char *name);

/* Row `index`; NULL after the last. */
const struct gb_commands_row *gb_commands_at(size_t index);

/* Prints the commands by group, as in the help. */
void gb_commands_print(FILE *to);
/* Prints lines "NAME DOC" for the manual page. */
void gb_commands_print_plain(FILE *to);
/* "run, resume, ..."; g_free. */
char *gb_commands_names(void);

int gb_cmd_attach(int argc, char **argv);
int gb_cmd_calibrate(int argc, char **argv);
int gb_cmd_card(int argc, char **argv);
int gb_cmd_chart(int argc, char **argv);
int gb_cmd_cycle(int argc, char **argv);
int gb_cmd_fit(int argc, char **argv);
int gb_cmd_law(int argc, char **argv);
int gb_cmd_moduli(int argc, char **argv);
int gb_cmd_pack(int argc, char **argv);
int gb_cmd_papers(int argc, char **argv);
int gb_cmd_params(int argc, char **argv);
int gb_cmd_plot(int argc, char **argv);
int gb_cmd_report(int argc, char **argv);
int gb_cmd_resume(int argc, char **argv);
int gb_cmd_run(int argc, char **argv);
int gb_cmd_runs(int argc, char **argv);
int gb_cmd_sizes(int argc, char **argv);
int gb_cmd_snapshot(int argc, char **argv);
int gb_cmd_export(int argc, char **argv);
int gb_cmd_stability(int argc, char **argv);
int gb_cmd_strength(int argc, char **argv);
int gb_cmd_sweep(int argc, char **argv);
int gb_cmd_verify(int argc, char **argv);
int gb_cmd_yield(int argc, char **argv);

/* Without a command: opens the workbench; prints its keys; prints its views (key and
 * title in a quasi-static scene). */
int gb_cmd_workbench(int argc, char **argv);
void gb_cmd_workbench_keys(void);
void gb_cmd_workbench_views(void);

#endif
