#ifndef GB_CLI_COMMANDS_H
#define GB_CLI_COMMANDS_H

/* One command each: argv[0] is the command's name; returns the exit status. */
int gb_cmd_attach(int argc, char **argv);
int gb_cmd_bench(int argc, char **argv);
int gb_cmd_calibrate(int argc, char **argv);
int gb_cmd_chart(int argc, char **argv);
int gb_cmd_law(int argc, char **argv);
int gb_cmd_pack(int argc, char **argv);
int gb_cmd_params(int argc, char **argv);
int gb_cmd_plot(int argc, char **argv);
int gb_cmd_report(int argc, char **argv);
int gb_cmd_resume(int argc, char **argv);
int gb_cmd_run(int argc, char **argv);
int gb_cmd_sizes(int argc, char **argv);
int gb_cmd_snapshot(int argc, char **argv);
int gb_cmd_stability(int argc, char **argv);
int gb_cmd_sweep(int argc, char **argv);
int gb_cmd_verify(int argc, char **argv);
int gb_cmd_workbench(int argc, char **argv);
void gb_cmd_workbench_keys(void); /* prints the keys of the workbench */

#endif
