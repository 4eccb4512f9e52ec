#include "many/mpi_pool.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/clock.h"
#include "many/pool.h"

#if GB_WITH_MPI

#include <mpi.h>

enum { TAG_HELLO = 1, TAG_WORK, TAG_REPORT, TAG_ALIVE, TAG_STOP, TAG_QUIT };
enum { DIRECTORY_MAX = 4096 };

/* Signs of life are sent this often. */
static const double beat_s = 1.0;
/* A rank silent for longer is lost; a stalled file system must not look like that. */
static const double lost_after_s = 20.0;
/* At the end nobody has to wait that long: signs of life come every second. */
static const double missing_after_s = 8.0;
/* The first rank may be busy reading what is there. */
static const double orphan_after_s = 600.0;
/* A run on its way to a rank. */
struct parcel {
    uint64_t ticket;
    struct gb_params params;
    char directory[DIRECTORY_MAX];
};

struct letter {
    MPI_Request request;
    struct parcel parcel;
};

/* What the first rank knows of another. */
struct member {
    size_t capacity;
    GArray *tickets; /* size_t: runs it does */
    double heard;
    bool lost;
    MPI_Request beat; /* last sign of life sent to it */
};

struct gb_mpi_pool {
    int index, count;
    struct member *member; /* of the first rank: count, its own unused */
    GPtrArray *letters;    /* not yet gone */
    GQueue *hand;          /* of the others: struct parcel, for workers that are busy */
    double beaten;
    bool any_lost;
    int byte; /* content of letters that are but a tag */
};

/* Started by something that starts several? */
static bool is_launched(void)
{
    return getenv("OMPI_COMM_WORLD_SIZE") != NULL || getenv("PMIX_RANK") != NULL ||
           getenv("PMI_RANK") != NULL;
}

bool gb_mpi_pool_create(struct gb_mpi_pool **out, struct gb_error *err)
{
    *out = NULL;
    if (!is_launched()) {
        return true;
    }
    if (MPI_Init(NULL, NULL) != MPI_SUCCESS) {
        return gb_error_set(err, GB_ERR_MACHINE, "MPI does not start");
    }
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    struct gb_mpi_pool *ranks = g_new0(struct gb_mpi_pool, 1);
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks->index);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks->count);
    ranks->letters = g_ptr_array_new_with_free_func(g_free);
    ranks->hand = g_queue_new();
    ranks->member = g_new0(struct member, (gsize)ranks->count);
    for (int r = 0; r < ranks->count; r++) {
        ranks->member[r].tickets = g_array_new(FALSE, FALSE, sizeof(size_t));
        ranks->member[r].heard = gb_clock_s();
        ranks->member[r].beat = MPI_REQUEST_NULL;
    }
    *out = ranks;
    return true;
}

static void send_tag(struct gb_mpi_pool *ranks, int to, int tag)
{
    MPI_Send(&ranks->byte, (int)sizeof ranks->byte, MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

static void tell_members(struct gb_mpi_pool *ranks, int tag)
{
    for (int r = 1; r < ranks->count; r++) {
        if (!ranks->member[r].lost) {
            send_tag(ranks, r, tag);
        }
    }
}

/* Is there a letter of any kind? */
static bool has_letter(MPI_Status *status)
{
    int there = 0;
    return MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, status) ==
               MPI_SUCCESS &&
           there != 0;
}

static void receive(void *to, size_t size, const MPI_Status *status)
{
    MPI_Recv(to, (int)size, MPI_BYTE, status->MPI_SOURCE, status->MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
}

/* Letters that have gone can be thrown away. */
static void sweep_letters(struct gb_mpi_pool *ranks)
{
    for (guint i = ranks->letters->len; i > 0; i--) {
        struct letter *letter = g_ptr_array_index(ranks->letters, i - 1);
        int gone = 0;
        if (MPI_Test(&letter->request, &gone, MPI_STATUS_IGNORE) == MPI_SUCCESS && gone) {
            g_ptr_array_remove_index_fast(ranks->letters, i - 1);
        }
    }
}

static bool forget_ticket(struct member *member, size_t ticket)
{
    for (guint i = 0; i < member->tickets->len; i++) {
        if (g_array_index(member->tickets, size_t, i) == ticket) {
            g_array_remove_index_fast(member->tickets, i);
            return true;
        }
    }
    return false;
}

/* One letter; true when it was a report that is still waited for. */
static bool open_letter(struct gb_mpi_pool *ranks, const MPI_Status *status,
                        struct gb_pool_report *report)
{
    struct member *member = &ranks->member[status->MPI_SOURCE];
    uint64_t capacity = 0;
    member->heard = gb_clock_s();
    switch (status->MPI_TAG) {
    case TAG_HELLO:
        receive(&capacity, sizeof capacity, status);
        member->capacity = capacity;
        return false;
    case TAG_REPORT:
        receive(report, sizeof *report, status);
        return !member->lost && forget_ticket(member, report->ticket);
    default:
        receive(&ranks->byte, sizeof ranks->byte, status);
        ranks->byte = 0;
        return false;
    }
}

/* Tells the others to end, and whether somebody is missing. */
static void dismiss(struct gb_mpi_pool *ranks)
{
    MPI_Status status;
    struct gb_pool_report report;
    while (has_letter(&status)) { /* late signs of life */
        (void)open_letter(ranks, &status, &report);
    }
    for (int r = 1; r < ranks->count; r++) {
        struct member *member = &ranks->member[r];
        ranks->any_lost |= member->lost || gb_clock_s() - member->heard > missing_after_s;
    }
    ranks->byte = ranks->any_lost;
    tell_members(ranks, TAG_QUIT);
}

/* Where somebody is missing, the collective end would wait for ever: the process then
 * leaves without it. */
void gb_mpi_pool_destroy(struct gb_mpi_pool *ranks)
{
    if (ranks == NULL) {
        return;
    }
    if (ranks->index == 0) {
        dismiss(ranks);
    }
    if (!ranks->any_lost) {
        sweep_letters(ranks);
        MPI_Finalize();
        g_ptr_array_unref(ranks->letters);
    } /* else letters may still be looked at by the library */
    for (int r = 0; r < ranks->count; r++) {
        g_array_unref(ranks->member[r].tickets);
    }
    g_queue_free_full(ranks->hand, g_free);
    g_free(ranks->member);
    g_free(ranks);
}

bool gb_mpi_pool_is_first(const struct gb_mpi_pool *ranks)
{
    return ranks == NULL || ranks->index == 0;
}

/* --- the others ------------------------------------------------------------------ */

static void send_report(const struct gb_pool_report *report)
{
    MPI_Send(report, (int)sizeof *report, MPI_BYTE, 0, TAG_REPORT, MPI_COMM_WORLD);
}

/* Why a rank does no more runs: the first one said so, which ends them for all, or it was
 * itself asked to end; then others may do them. */
enum stop { GOING, TOLD, LEAVING };

static void send_capacity(size_t workers)
{
    const uint64_t capacity = workers;
    MPI_Send(&capacity, (int)sizeof capacity, MPI_BYTE, 0, TAG_HELLO, MPI_COMM_WORLD);
}

/* What waits in the hand goes to workers that are free, or back. */
static void give_on(struct gb_mpi_pool *ranks, struct gb_pool *crew, enum stop stop)
{
    while (!g_queue_is_empty(ranks->hand) &&
           (stop != GOING || gb_pool_prefetch(crew, 0) > 0)) {
        struct gb_pool_report report = {0};
        struct parcel *parcel = g_queue_pop_head(ranks->hand);
        report.ticket = parcel->ticket;
        if (stop != GOING) {
            gb_error_set(&report.error, GB_ERR_CANCELLED, "stopped before it began");
            report.lost = stop == LEAVING;
            send_report(&report);
        } else if (!gb_pool_submit(crew, parcel->ticket, &parcel->params,
                                   parcel->directory, &report.error)) {
            send_report(&report);
        }
        g_free(parcel);
    }
}

/* Everything that has come; false when it is time to go. */
static bool open_letters(struct gb_mpi_pool *ranks, double *heard, enum stop *stop)
{
    MPI_Status status;
    while (has_letter(&status)) {
        *heard = gb_clock_s();
        if (status.MPI_TAG == TAG_WORK) {
            struct parcel *parcel = g_new0(struct parcel, 1);
            receive(parcel, sizeof *parcel, &status);
            g_queue_push_tail(ranks->hand, parcel);
            continue;
        }
        receive(&ranks->byte, sizeof ranks->byte, &status);
        if (status.MPI_TAG == TAG_STOP) {
            *stop = TOLD;
        }
        if (status.MPI_TAG == TAG_QUIT) {
            return false;
        }
    }
    return true;
}

static void beat(struct gb_mpi_pool *ranks)
{
    if (gb_clock_s() - ranks->beaten > beat_s) {
        ranks->beaten = gb_clock_s();
        send_tag(ranks, 0, TAG_ALIVE);
    }
}

bool gb_mpi_pool_serve(struct gb_mpi_pool *ranks, struct gb_pool *crew, size_t workers,
                       bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    double heard = gb_clock_s();
    enum stop stop = GOING;
    bool stopped = false, leaving = false;
    send_capacity(workers);
    while (open_letters(ranks, &heard, &stop)) {
        struct gb_pool_report report;
        if (!leaving && cancelled(data)) {
            leaving = true;
            stop = stop == GOING ? LEAVING : stop;
            send_capacity(0); /* before what is given back, or it would come again */
        }
        give_on(ranks, crew, stop);
        if (stop != GOING && !stopped) {
            stopped = true;
            gb_pool_stop(crew);
        }
        if (gb_pool_receive(crew, gb_pool_poll_interval(crew), &report)) {
            report.lost = stop == LEAVING && report.error.code == GB_ERR_CANCELLED;
            send_report(&report);
        }
        beat(ranks);
        if (gb_clock_s() - heard > orphan_after_s) {
            ranks->any_lost = true;
            return gb_error_set(err, GB_ERR_MACHINE,
                                "nothing was heard of the first rank for %g s",
                                orphan_after_s);
        }
    }
    /* what the first rank knows of missing ranks */
    ranks->any_lost = ranks->byte != 0;
    return !leaving || gb_error_set(err, GB_ERR_CANCELLED, "stopped");
}

/* --- the first one --------------------------------------------------------------- */

/* Runs that it may be given before it has `most` of them. */
static size_t room(const struct member *member, size_t most)
{
    return member->lost || member->tickets->len >= most ? 0 : most - member->tickets->len;
}

size_t gb_mpi_pool_workers(const struct gb_mpi_pool *ranks)
{
    size_t workers = 0;
    for (int r = 1; ranks != NULL && r < ranks->count; r++) {
        workers += ranks->member[r].lost ? 0 : ranks->member[r].capacity;
    }
    return workers;
}

size_t gb_mpi_pool_idle(const struct gb_mpi_pool *ranks)
{
    size_t idle = 0;
    for (int r = 1; ranks != NULL && r < ranks->count; r++) {
        idle += room(&ranks->member[r], ranks->member[r].capacity);
    }
    return idle;
}

size_t gb_mpi_pool_prefetch(const struct gb_mpi_pool *ranks)
{
    size_t ahead = 0;
    for (int r = 1; ranks != NULL && r < ranks->count; r++) {
        ahead += room(&ranks->member[r], 2 * ranks->member[r].capacity);
    }
    return ahead;
}

/* Who takes the next run: somebody idle, else somebody who has none in hand; 0: nobody.
 */
static int choose(const struct gb_mpi_pool *ranks)
{
    int ahead = 0;
    for (int r = 1; r < ranks->count; r++) {
        const struct member *member = &ranks->member[r];
        if (room(member, member->capacity) > 0) {
            return r;
        }
        ahead = ahead == 0 && room(member, 2 * member->capacity) > 0 ? r : ahead;
    }
    return ahead;
}

bool gb_mpi_pool_submit(struct gb_mpi_pool *ranks, size_t ticket,
                        const struct gb_params *params, const char *directory,
                        struct gb_error *err)
{
    const int to = choose(ranks);
    if (to == 0 || strlen(directory) >= DIRECTORY_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: no rank takes it", directory);
    }
    struct letter *letter = g_new0(struct letter, 1);
    letter->parcel.ticket = ticket;
    letter->parcel.params = *params;
    g_strlcpy(letter->parcel.directory, directory, DIRECTORY_MAX);
    /* without waiting: a dead rank never takes it */
    MPI_Isend(&letter->parcel, (int)sizeof letter->parcel, MPI_BYTE, to, TAG_WORK,
              MPI_COMM_WORLD, &letter->request);
    g_ptr_array_add(ranks->letters, letter);
    g_array_append_val(ranks->member[to].tickets, ticket);
    sweep_letters(ranks);
    return true;
}

/* Signs of life both ways; never waits for one that may be dead. */
static void look_after(struct gb_mpi_pool *ranks)
{
    const double now = gb_clock_s();
    if (now - ranks->beaten < beat_s) {
        return;
    }
    for (int r = 1; r < ranks->count; r++) {
        struct member *member = &ranks->member[r];
        int gone = 1;
        /* one that takes leave may still owe reports */
        const bool counts = member->capacity > 0 || member->tickets->len > 0;
        if (counts && now - member->heard > lost_after_s &&
            now - ranks->beaten < lost_after_s) { /* else it was we who slept */
            member->lost = true;
            ranks->any_lost = true;
        }
        if (member->beat != MPI_REQUEST_NULL) {
            MPI_Test(&member->beat, &gone, MPI_STATUS_IGNORE);
        }
        if (gone && !member->lost) {
            MPI_Isend(&ranks->byte, (int)sizeof ranks->byte, MPI_BYTE, r, TAG_ALIVE,
                      MPI_COMM_WORLD, &member->beat);
        }
    }
    ranks->beaten = now;
}

/* A run of a lost rank. */
static bool take_lost(struct gb_mpi_pool *ranks, struct gb_pool_report *report)
{
    for (int r = 1; r < ranks->count; r++) {
        struct member *member = &ranks->member[r];
        if (member->lost && member->tickets->len > 0) {
            *report = (struct gb_pool_report){
                .ticket = g_array_index(member->tickets, size_t, 0), .lost = true};
            g_array_remove_index_fast(member->tickets, 0);
            gb_error_set(&report->error, GB_ERR_MACHINE,
                         "rank %d, which did this run, was not heard of for %g s", r,
                         lost_after_s);
            return true;
        }
    }
    return false;
}

bool gb_mpi_pool_receive(struct gb_mpi_pool *ranks, struct gb_pool_report *report)
{
    MPI_Status status;
    if (ranks == NULL) {
        return false;
    }
    while (has_letter(&status)) {
        if (open_letter(ranks, &status, report)) {
            return true;
        }
    }
    look_after(ranks);
    return take_lost(ranks, report);
}

void gb_mpi_pool_stop(struct gb_mpi_pool *ranks)
{
    if (ranks != NULL) {
        tell_members(ranks, TAG_STOP);
    }
}

#else

bool gb_mpi_pool_create(struct gb_mpi_pool **out, struct gb_error *err)
{
    const char *size = getenv("OMPI_COMM_WORLD_SIZE");
    size = size != NULL ? size : getenv("PMI_SIZE");
    *out = NULL;
    return size == NULL || strcmp(size, "1") == 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "started %s times by mpirun or srun, but built without Open MPI; "
                        "accepted one process",
                        size);
}

void gb_mpi_pool_destroy(struct gb_mpi_pool *ranks)
{
    (void)ranks;
}

bool gb_mpi_pool_is_first(const struct gb_mpi_pool *ranks)
{
    (void)ranks;
    return true;
}

bool gb_mpi_pool_serve(struct gb_mpi_pool *ranks, struct gb_pool *crew, size_t workers,
                       bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    (void)ranks;
    (void)crew;
    (void)workers;
    (void)cancelled;
    (void)data;
    return gb_error_set(err, GB_ERR_INPUT, "built without Open MPI");
}

size_t gb_mpi_pool_workers(const struct gb_mpi_pool *ranks)
{
    (void)ranks;
    return 0;
}

size_t gb_mpi_pool_idle(const struct gb_mpi_pool *ranks)
{
    (void)ranks;
    return 0;
}

size_t gb_mpi_pool_prefetch(const struct gb_mpi_pool *ranks)
{
    (void)ranks;
    return 0;
}

bool gb_mpi_pool_submit(struct gb_mpi_pool *ranks, size_t ticket,
                        const struct gb_params *params, const char *directory,
                        struct gb_error *err)
{
    (void)ranks;
    (void)ticket;
    (void)params;
    (void)directory;
    return gb_error_set(err, GB_ERR_INPUT, "built without Open MPI");
}

bool gb_mpi_pool_receive(struct gb_mpi_pool *ranks, struct gb_pool_report *report)
{
    (void)ranks;
    (void)report;
    return false;
}

void gb_mpi_pool_stop(struct gb_mpi_pool *ranks)
{
    (void)ranks;
}

#endif
