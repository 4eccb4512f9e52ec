#ifndef GB_SOLVE_EVENT_QUEUE_H
#define GB_SOLVE_EVENT_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Events of a run (guards, stages, branches), one line each, oldest first.  A full queue
 * drops its oldest event. */
enum { GB_EVENT_QUEUE_LENGTH = 32 };

struct gb_event_queue {
    char text[GB_EVENT_QUEUE_LENGTH][GB_EVENT_TEXT];
    int64_t step[GB_EVENT_QUEUE_LENGTH]; /* -1: not set yet */
    int first, count;
};

/* An empty text is no event. */
void gb_event_queue_add(struct gb_event_queue *queue, const char *text);

/* Sets the step of the events added since the last call. */
void gb_event_queue_set_step(struct gb_event_queue *queue, int64_t step);

/* Moves the oldest event into text (size bytes) and its step into *step (NULL is fine);
 * false when there is none. */
bool gb_event_queue_take(struct gb_event_queue *queue, int64_t *step, char *text,
                         size_t size);

#endif
