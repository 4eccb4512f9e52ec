#include "runner/publish.h"

#include <string.h>

/* Bit of the middle index, set until the reader has taken the slot. */
static const unsigned fresh = 4;
static const unsigned index_mask = 3;

void gb_publish_slots_init(struct gb_publish_slots *slots)
{
    slots->back = 0;
    atomic_init(&slots->middle, 1);
    slots->front = 2;
}

/* Release: publishes the contents of the slot with its index.  Acquire: the other side
 * no longer reads the slot that is returned. */
void gb_publish_slots_swap(struct gb_publish_slots *slots)
{
    const unsigned old = atomic_exchange_explicit(&slots->middle, slots->back | fresh,
                                                  memory_order_acq_rel);
    slots->back = old & index_mask;
}

bool gb_publish_slots_take(struct gb_publish_slots *slots)
{
    /* Only the reader clears the bit, so it stays set until the exchange. */
    if (!(atomic_load_explicit(&slots->middle, memory_order_relaxed) & fresh)) {
        return false;
    }
    const unsigned old =
        atomic_exchange_explicit(&slots->middle, slots->front, memory_order_acq_rel);
    slots->front = old & index_mask;
    return true;
}

void gb_publish_init(struct gb_publish *publish)
{
    memset(publish->slot, 0, sizeof publish->slot);
    gb_publish_slots_init(&publish->slots);
}

struct gb_snapshot *gb_publish_back(struct gb_publish *publish)
{
    return &publish->slot[publish->slots.back];
}

void gb_publish_swap(struct gb_publish *publish)
{
    gb_publish_slots_swap(&publish->slots);
}

bool gb_publish_take(struct gb_publish *publish)
{
    return gb_publish_slots_take(&publish->slots);
}

const struct gb_snapshot *gb_publish_front(const struct gb_publish *publish)
{
    return &publish->slot[publish->slots.front];
}

void gb_command_ring_init(struct gb_command_ring *ring)
{
    memset(ring->slot, 0, sizeof ring->slot);
    atomic_init(&ring->head, 0);
    atomic_init(&ring->tail, 0);
}

/* head and tail count all commands pushed and popped.  Unsigned wrap-around keeps their
 * difference correct because the size of the ring divides the range. */
bool gb_command_ring_push(struct gb_command_ring *ring, struct gb_command command)
{
    const unsigned head = atomic_load_explicit(&ring->head, memory_order_relaxed);
    const unsigned tail = atomic_load_explicit(&ring->tail, memory_order_acquire);
    if (head - tail >= GB_COMMAND_RING) {
        return false;
    }
    ring->slot[head % GB_COMMAND_RING] = command;
    atomic_store_explicit(&ring->head, head + 1, memory_order_release);
    return true;
}

bool gb_command_ring_pop(struct gb_command_ring *ring, struct gb_command *command)
{
    const unsigned tail = atomic_load_explicit(&ring->tail, memory_order_relaxed);
    const unsigned head = atomic_load_explicit(&ring->head, memory_order_acquire);
    if (head == tail) {
        return false;
    }
    *command = ring->slot[tail % GB_COMMAND_RING];
    atomic_store_explicit(&ring->tail, tail + 1, memory_order_release);
    return true;
}
