/* Loading paths: any text in 2 or 3 dimensions is refused with one line or read, and what was
 * read is read again, from its own legs, to the same path. */
#include "fuzz/target.h"

#include <string.h>

#include <glib.h>

#include "scene/path/path.h"

static void refuse_quietly(const struct gb_error *err)
{
    if (err->text[0] == '\0' || strchr(err->text, '\n') != NULL) {
        abort();
    }
}

static bool same(const struct gb_path *a, const struct gb_path *b)
{
    if (a->count != b->count) {
        return false;
    }
    for (int i = 0; i < a->count; i++) {
        const struct gb_leg *p = &a->leg[i], *q = &b->leg[i];
        if (p->leading != q->leading || p->extension != q->extension ||
            p->end_count != q->end_count || p->cycles != q->cycles ||
            strcmp(p->text, q->text) != 0) {
            return false;
        }
        for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
            if (p->component[k].control != q->component[k].control ||
                memcmp(&p->component[k].value, &q->component[k].value, sizeof(double)) !=
                    0) {
                return false;
            }
        }
    }
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct gb_path path, again;
    char text[2048];
    struct gb_error err = {0};
    if (size < 1) {
        return 0;
    }
    const size_t length = size - 1 < sizeof text - 1 ? size - 1 : sizeof text - 1;
    const int dimension = 2 + data[0] % 2;
    memcpy(text, data + 1, length);
    text[length] = '\0';
    if (!gb_path_parse(&path, text, dimension, &err)) {
        refuse_quietly(&err);
        return 0;
    }
    GString *legs = g_string_new(NULL);
    for (int i = 0; i < path.count; i++) {
        g_string_append_printf(legs, "%s%s", i > 0 ? "; " : "", path.leg[i].text);
    }
    if (!gb_path_parse(&again, legs->str, dimension, &err) || !same(&path, &again)) {
        fprintf(stderr, "%s is read again as another path: %s\n", legs->str, err.text);
        abort();
    }
    g_string_free(legs, TRUE);
    (void)gb_path_strained(&path);
    (void)gb_path_sheared(&path);
    (void)gb_path_geometry(&path, dimension);
    return 0;
}
