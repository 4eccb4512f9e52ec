#include "solve/event_queue.h"

#include <stdio.h>

static void drop_oldest(struct gb_event_queue *queue)
{
    queue->first = (queue->first + 1) % GB_EVENT_QUEUE_LENGTH;
    queue->count--;
}

void gb_event_queue_add(struct gb_event_queue *queue, const char *text)
{
    if (text[0] == '\0') {
        return;
    }
    if (queue->count == GB_EVENT_QUEUE_LENGTH) {
        drop_oldest(queue);
    }
    const int at = (queue->first + queue->count++) % GB_EVENT_QUEUE_LENGTH;
    snprintf(queue->text[at], GB_EVENT_TEXT, "%s", text);
    queue->step[at] = -1;
}

void gb_event_queue_set_step(struct gb_event_queue *queue, int64_t step)
{
    for (int k = 0; k < queue->count; k++) {
        int64_t *at = &queue->step[(queue->first + k) % GB_EVENT_QUEUE_LENGTH];
        *at = *at < 0 ? step : *at;
    }
}

bool gb_event_queue_take(struct gb_event_queue *queue, int64_t *step, char *text,
                         size_t size)
{
    if (queue->count == 0) {
        return false;
    }
    snprintf(text, size, "%s", queue->text[queue->first]);
    if (step != NULL) {
        *step = queue->step[queue->first];
    }
    drop_oldest(queue);
    return true;
}
