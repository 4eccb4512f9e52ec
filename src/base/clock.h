#ifndef GB_BASE_CLOCK_H
#define GB_BASE_CLOCK_H

/* The clocks of the program, in seconds.  Only differences have a meaning. */

/* Elapsed time; no change of the date moves it. */
double gb_clock_s(void);

/* Processor time of the calling thread, and of all threads of the process. */
double gb_clock_thread_s(void);
double gb_clock_process_s(void);

#endif
