#ifndef GB_RUN_WRITER_H
#define GB_RUN_WRITER_H

#include <stdbool.h>

#include "base/record.h"
#include "scene/model.h"
#include "io/store.h"

/* Writes states and status beside the engine: the engine fills a record, a thread of its
 * own makes the file of it and waits for the disk.  The thread blocks all signals. */
struct gb_writer;

/* store, params and model must outlive the writer. */
bool gb_writer_create(struct gb_writer **out, const struct gb_store *store,
                      const struct gb_params *params, const struct gb_model *model,
                      struct gb_error *err);
/* Waits for what is being written.  NULL is fine. */
void gb_writer_destroy(struct gb_writer *writer);

/* The record to be filled next; the engine's own until gb_writer_send. */
struct gb_record *gb_writer_record(struct gb_writer *writer);

/* Hands the record over; gb_writer_record gives another one from now on.  False without
 * err when the last one is still being written; with err when writing it has failed. */
bool gb_writer_send(struct gb_writer *writer, struct gb_error *err);

/* Has status.json replaced by text, which belongs to the writer from now on; a text that
 * still waits gives way.  False with err when writing has failed before. */
bool gb_writer_status(struct gb_writer *writer, char *text, struct gb_error *err);

/* Waits until nothing is being written; false and err when writing has failed. */
bool gb_writer_wait(struct gb_writer *writer, struct gb_error *err);

/* Seconds that writing a state took the last time; 0 before the first. */
double gb_writer_seconds(struct gb_writer *writer);

#endif
