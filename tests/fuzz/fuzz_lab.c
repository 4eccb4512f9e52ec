#include "fuzz/target.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "io/lab/lab_reader.h"

/* What is given about a file, one after the other. */
static const char *const given[] = {
    "",
    "pressure=1:MPa,density=2:%",
    "decimal=comma,die-area=1 cm2,powder-mass=2 g,true-density=4 g/cm3,initial-height=9 mm",
    ("separator=blank,force=2:kN,height=1:mm,die-area=1 cm2,powder-mass=2 g,"
     "true-density=4 g/cm3,particles.diameter_nm=3"),
};

static void check_line(const char *text)
{
    if (*text == '\0' || strpbrk(text, "\n\r") != NULL ||
        !g_utf8_validate(text, -1, NULL)) {
        abort();
    }
}

static void check_table(const struct gb_table *table)
{
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const double *density = gb_table_column(table, "density", NULL);
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        if (gb_table_line(table, i) < 1 || strlen(gb_table_word(table, i)) == SIZE_MAX) {
            abort();
        }
        if (!(pressure[i] > 0.0) || !(density[i] > 0.0 && density[i] <= 1.0)) {
            abort();
        }
    }
}

static void read_given(const char *path, const char *list)
{
    struct gb_lab_options options;
    struct gb_lab_report report;
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    gb_lab_options_init(&options);
    if (!gb_lab_options_parse(&options, list, NULL)) {
        abort();
    }
    switch (gb_lab_reader_read(&table, path, &options, NULL, &report, &err)) {
    case GB_LAB_READ:
        if (report.told[0] != '\0') {
            check_line(report.told);
            check_table(table);
        }
        break;
    case GB_LAB_QUESTION:
        check_line(report.question);
        for (int k = 0; k < report.choices; k++) {
            (void)gb_lab_options_parse(&options, report.choice[k], NULL);
        }
        break;
    case GB_LAB_FAILED:
        if (err.text[0] == '\0' || strchr(err.text, '\n') != NULL) {
            abort();
        }
        break;
    }
    gb_table_destroy(table);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[TARGET_PATH];
    const int fd = target_open(data, size, path);
    for (size_t i = 0; i < G_N_ELEMENTS(given); i++) {
        read_given(path, given[i]);
    }
    target_close(fd, path);
    return 0;
}
