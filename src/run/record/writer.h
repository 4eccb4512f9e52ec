#ifndef GB_RUN_RECORD_WRITER_H
#define GB_RUN_RECORD_WRITER_H

#include <stdbool.h>

#include "base/record.h"
#include "io/store.h"
#include "scene/model.h"

/* Writes states and status in a thread of its own: the engine fills a record, the thread
 * writes the file and waits for the disk.  There is one record, the largest thing that a
 * run holds beside its packing.  The thread blocks all signals. */
struct gb_writer;

/* store, params and model must outlive the writer. */
bool gb_writer_create(struct gb_writer **out, const struct gb_store *store,
                      const struct gb_params *params, const struct gb_model *model,
                      struct gb_error *err);
/* Waits for files under way.  NULL is fine. */
void gb_writer_destroy(struct gb_writer *writer);

/* The record.  It belongs to the engine but for the time from gb_writer_send until it is
 * written, and stays as it was sent. */
struct gb_record *gb_writer_record(struct gb_writer *writer);
bool gb_writer_busy(struct gb_writer *writer); /* it is being written */

enum gb_writer_outcome {
    GB_WRITER_SENT,
    GB_WRITER_BUSY,  /* the record is still being written */
    GB_WRITER_FAILED /* writing has failed before: err */
};

/* Hands the record over. */
enum gb_writer_outcome gb_writer_send(struct gb_writer *writer, struct gb_error *err);

/* Replaces status.json by text, which belongs to the writer from now on; it supersedes a
 * text that still waits.  False with err when writing has failed before. */
bool gb_writer_status(struct gb_writer *writer, char *text, struct gb_error *err);

/* Waits until nothing is being written; false and err when writing has failed. */
bool gb_writer_wait(struct gb_writer *writer, struct gb_error *err);

/* Seconds that the last state took to be written; 0 before the first. */
double gb_writer_seconds(struct gb_writer *writer);

#endif
