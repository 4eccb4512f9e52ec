#ifndef GB_RUNNER_PUBLISH_H
#define GB_RUNNER_PUBLISH_H

#include <stdatomic.h>
#include <stdbool.h>

#include "greenbody/snapshot.h"

/* Lock-free exchange between engine and screen, with one writer and one reader.
 *
 * Triple buffer: the engine fills its private slot and swaps it with the shared one;
 * the reader takes the newest.  Neither waits. */
struct gb_publish_slots {
    _Atomic unsigned middle; /* index of the shared slot, bit 2: fresh */
    unsigned back, front;    /* writer's and reader's own */
};

struct gb_publish {
    struct gb_snapshot slot[3];
    struct gb_publish_slots slots;
};

void gb_publish_init(struct gb_publish *publish);
/* Engine: the slot to fill; gb_publish_swap then hands it over. */
struct gb_snapshot *gb_publish_back(struct gb_publish *publish);
void gb_publish_swap(struct gb_publish *publish);
/* Screen: takes the newest slot, if there is a new one; true if it did. */
bool gb_publish_take(struct gb_publish *publish);
const struct gb_snapshot *gb_publish_front(const struct gb_publish *publish);

/* The same for any three slots of the caller, by their indices. swap: the engine has
 * filled its slot. take: true if the reader has a new one. */
void gb_publish_slots_init(struct gb_publish_slots *slots);
void gb_publish_slots_swap(struct gb_publish_slots *slots);
bool gb_publish_slots_take(struct gb_publish_slots *slots);

/* Screen to engine: a ring of commands, read between slices.  One writer, one reader. */
enum gb_command_kind {
    GB_COMMAND_PAUSE,
    GB_COMMAND_RESUME,
    GB_COMMAND_STOP,
    GB_COMMAND_WATCH,    /* take view samples from now on */
    GB_COMMAND_FORK,     /* hand over the state at the next loading point */
    GB_COMMAND_YIELD,    /* sleep while another engine computes; no event, same state */
    GB_COMMAND_CONTINUE, /* ends YIELD */
    GB_COMMAND_STORE     /* write the state of the last point to state.h5 */
};

struct gb_command {
    enum gb_command_kind kind;
};

enum { GB_COMMAND_RING = 64 };

struct gb_command_ring {
    struct gb_command slot[GB_COMMAND_RING];
    _Atomic unsigned head, tail;
};

void gb_command_ring_init(struct gb_command_ring *ring);
bool gb_command_ring_push(struct gb_command_ring *ring, struct gb_command command);
bool gb_command_ring_pop(struct gb_command_ring *ring, struct gb_command *command);

#endif
