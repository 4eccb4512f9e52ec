#ifndef GB_STUDY_CARD_CARD_THREADS_H
#define GB_STUDY_CARD_CARD_THREADS_H

#include "study/card/card_study.h"

/* The cells of a card, shared by the threads that measure them; the engine of each is its
 * own, and nothing depends on the order. */
struct gb_card_threads {
    const struct gb_card_options *options;
    const struct gb_params *preset;
    const struct gb_card_callbacks *callbacks; /* called by one thread at a time */
    struct gb_card_cell *cell;                 /* of each replica */
    struct gb_error *error;                    /* of each replica */
    GMutex mutex;
    int next, done;
    bool stop;
};

/* Room for the replicas.  gb_card_threads_finish is due, also after an error. */
bool gb_card_threads_init(struct gb_card_threads *threads, struct gb_error *err);
void gb_card_threads_finish(struct gb_card_threads *threads);

/* Measures all cells, `jobs` at a time (0: one per processor).  The first failure stops
 * the others and is the error. */
bool gb_card_threads_work(struct gb_card_threads *threads, int jobs,
                          struct gb_error *err);

#endif
