/* Compares the states of two run directories bit by bit, except times.  Prints the first
 * different array.
 * Usage: same_state DIR DIR */
#include <stdio.h>
#include <stdlib.h>

#include "run/checkpoint.h"
#include "run/record/run_recorder.h"

static struct gb_record records[2];

int main(int argc, char **argv)
{
    struct gb_params params;
    struct gb_error err = {0};
    int64_t row = 0;
    if (argc != 3) {
        fputs("usage: same_state DIR DIR\n", stderr);
        return 2;
    }
    for (int k = 0; k < 2; k++) {
        if (!gb_run_recorder_read(argv[k + 1], "state.h5", &params, &records[k], &err)) {
            fprintf(stderr, "%s\n", err.text);
            return 2;
        }
        gb_record_remove(&records[k], "journal/"); /* seconds, and bytes of files */
    }
    const char *name = gb_record_difference(&records[0], &records[1], &row);
    if (name != NULL) {
        fprintf(stderr, "%s differs in row %lld\n", name, (long long)row);
    }
    gb_record_finish(&records[0]);
    gb_record_finish(&records[1]);
    return name != NULL;
}
