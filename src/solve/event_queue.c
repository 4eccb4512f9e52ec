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
}

bool gb_event_queue_take(struct gb_event_queue *queue, char *text, size_t size)
{
    if (queue->count == 0) {
        return false;
    }
    snprintf(text, size, "%s", queue->text[queue->first]);
    drop_oldest(queue);
    return true;
}
