#ifndef GB_RUN_RUNNER_PUBLISH_H
#define GB_RUN_RUNNER_PUBLISH_H

#include <stdatomic.h>
#include <stdbool.h>

#include "greenbody/snapshot.h"

/* The only atomics between engine and screen.
 *
 * Triple buffer: the engine writes its private slot and swaps it in; the reader takes the
 * newest.  Neither ever waits.  One writer, one reader. */
struct gb_publish_turn {
    _Atomic unsigned middle; /* index of the shared slot, bit 2: fresh */
    unsigned back, front;    /* writer's and reader's own */
};

struct gb_publish {
    struct gb_snapshot slot[3];
    struct gb_publish_turn turn;
};

void gb_publish_init(struct gb_publish *publish);
/* Engine: the slot to fill, then hand it over. */
struct gb_snapshot *gb_publish_back(struct gb_publish *publish);
void gb_publish_swap(struct gb_publish *publish);
/* Screen: takes the newest if there is one; true when it changed. */
bool gb_publish_take(struct gb_publish *publish);
const struct gb_snapshot *gb_publish_front(const struct gb_publish *publish);

/* The same for any other three slots: which one is whose.  swap: the engine's is filled;
 * take: true when the reader has got a new one. */
void gb_publish_turn_init(struct gb_publish_turn *turn);
void gb_publish_turn_swap(struct gb_publish_turn *turn);
bool gb_publish_turn_take(struct gb_publish_turn *turn);

/* Screen to engine: a ring of commands, drained between slices.  One writer, one reader.
 */
enum gb_command_kind {
    GB_COMMAND_PAUSE,
    GB_COMMAND_RESUME,
    GB_COMMAND_STOP,
    GB_COMMAND_WATCH,  /* take pictures of the packing from now on */
    GB_COMMAND_FORK,   /* hand over the state at the next point of the loading */
    GB_COMMAND_YIELD,  /* stand aside for another engine: no event, no change of state */
    GB_COMMAND_TAKE_UP /* ... and go on */
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
