#ifndef GB_BASE_CLOCK_H
#define GB_BASE_CLOCK_H

/* Clocks, in seconds.  Only differences are meaningful. */

/* Monotonic elapsed time; setting the date does not affect it. */
double gb_clock_s(void);

/* Processor time of the calling thread, and of all threads of the process. */
double gb_clock_thread_s(void);
double gb_clock_process_s(void);

#endif
