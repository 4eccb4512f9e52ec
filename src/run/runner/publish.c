#include "run/runner/publish.h"

#include <string.h>

/* The middle index carries this bit while the reader has not yet taken its slot. */
static const unsigned fresh = 4;
static const unsigned index_mask = 3;

void gb_publish_turn_init(struct gb_publish_turn *turn)
{
    turn->back = 0;
    atomic_init(&turn->middle, 1);
    turn->front = 2;
}

/* Release: the slot's content goes out with its index.  Acquire: the slot that comes back
 * is no longer read by the other side. */
void gb_publish_turn_swap(struct gb_publish_turn *turn)
{
    const unsigned old =
        atomic_exchange_explicit(&turn->middle, turn->back | fresh, memory_order_acq_rel);
    turn->back = old & index_mask;
}

bool gb_publish_turn_take(struct gb_publish_turn *turn)
{
    /* Only the reader clears the bit, so it cannot vanish between the two steps. */
    if (!(atomic_load_explicit(&turn->middle, memory_order_relaxed) & fresh)) {
        return false;
    }
    const unsigned old =
        atomic_exchange_explicit(&turn->middle, turn->front, memory_order_acq_rel);
    turn->front = old & index_mask;
    return true;
}

void gb_publish_init(struct gb_publish *publish)
{
    memset(publish->slot, 0, sizeof publish->slot);
    gb_publish_turn_init(&publish->turn);
}

struct gb_snapshot *gb_publish_back(struct gb_publish *publish)
{
    return &publish->slot[publish->turn.back];
}

void gb_publish_swap(struct gb_publish *publish)
{
    gb_publish_turn_swap(&publish->turn);
}

bool gb_publish_take(struct gb_publish *publish)
{
    return gb_publish_turn_take(&publish->turn);
}

const struct gb_snapshot *gb_publish_front(const struct gb_publish *publish)
{
    return &publish->slot[publish->turn.front];
}

void gb_command_ring_init(struct gb_command_ring *ring)
{
    memset(ring->slot, 0, sizeof ring->slot);
    atomic_init(&ring->head, 0);
    atomic_init(&ring->tail, 0);
}

/* head and tail count all commands ever pushed and popped; unsigned wrap-around keeps
 * their difference right because the ring's size divides the range. */
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
