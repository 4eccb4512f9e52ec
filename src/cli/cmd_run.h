#ifndef GB_CLI_CMD_RUN_H
#define GB_CLI_CMD_RUN_H

/* greenbody run PRESET [--set group.key=value]... [--out DIR] [--force] [--quiet]
 *
 * argv[0] is "run".  Returns the process exit status; stdout stays empty. */
int gb_cmd_run(int argc, char **argv);

#endif
