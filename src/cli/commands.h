#ifndef GB_CLI_COMMANDS_H
#define GB_CLI_COMMANDS_H

/* One command each: argv[0] is the command's name; returns the exit status. */
int gb_cmd_bench(int argc, char **argv);
int gb_cmd_law(int argc, char **argv);
int gb_cmd_pack(int argc, char **argv);
int gb_cmd_params(int argc, char **argv);
int gb_cmd_plot(int argc, char **argv);
int gb_cmd_run(int argc, char **argv);
int gb_cmd_snapshot(int argc, char **argv);
int gb_cmd_workbench(int argc, char **argv);

#endif
