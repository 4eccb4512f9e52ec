#ifndef GB_STUDY_BENCH_BENCH_COMPARE_H
#define GB_STUDY_BENCH_BENCH_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* A row of the table of `bench`. */
struct gb_bench_row {
    const char *name; /* without commas */
    double value;     /* NaN: not measured */
    double spread;    /* half of the range of the rounds; 0 where nothing is timed */
    const char *unit;
    enum gb_bench_goal {
        GB_BENCH_FACT, /* of the scene or the machine */
        GB_BENCH_LESS, /* the less the better */
        GB_BENCH_MORE
    } goal;
};

/* What became of a row since a stored run. */
struct gb_bench_change {
    double before; /* NaN: not in the stored run */
    double ratio;  /* value over that before */
    enum gb_bench_verdict {
        GB_BENCH_UNKNOWN, /* NaN before or now, or a fact */
        GB_BENCH_WITHIN,  /* within the noise */
        GB_BENCH_BETTER,
        GB_BENCH_WORSE
    } verdict;
};

/* Smallest change, as a share, that counts: runs one after the other differ by as much. */
#define GB_BENCH_CHANGE_LEAST 0.03

/* Compares rows with those of a file that `bench --csv` printed.  A change counts where it
 * is larger than the spreads of both runs together and than GB_BENCH_CHANGE_LEAST.
 *
 * change   as many as rows
 *
 * Errors: GB_ERR_INPUT for a file that is no such table or whose first row, the number of
 * particles, is another one; as of gb_table_read. */
bool gb_bench_compare(const char *path, const struct gb_bench_row *row, size_t rows,
                      struct gb_bench_change *change, struct gb_error *err);

#endif
