/* Laboratory files of different habits: what is read, what is said, what is expected. */
#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "io/lab/lab_reader.h"

enum { POINTS = 4, SAID = 5 };

static char *path;

/* A file, what is given about it, and what comes out. */
struct habit {
    const char *name;
    const char *text;
    gssize length; /* 0: to the NUL */
    const char *given;
    size_t count;
    double pressure[POINTS], density[POINTS]; /* MPa; the first ones of the table */
    const char *said[SAID];                   /* parts of the line; NULL: no more */
};

static const struct habit habits[] = {
    {.name = "German spreadsheet: semicolons, decimal commas, BOM, CRLF, units in heads",
     .text = "\xef\xbb\xbf"
             "Zeit [s];Druck [MPa];Weg [mm];rel. Dichte [%]\r\n"
             "0,5;12,5;1,25;41,2\r\n1,0;1.050,75;2,5;55,25\r\n",
     .count = 2,
     .pressure = {12.5, 1050.75},
     .density = {0.412, 0.5525},
     .said = {"pressure from column 2 'Druck [MPa]' in MPa",
              "density from column 4 'rel. Dichte [%]' in percent", "between semicolons",
              "decimal comma", "'1.050,75' in line 3 is 1050.75"}},
    {.name = "quoted cells, a line end and quotes in a head, commas, a remark below",
     .text = "\"Sample \"\"A\"\"\",,\n\"No.\",\"Pressure\n(MPa)\",\"Relative density\"\n"
             "1,\"1,050.5\",0.412\n2,\"1,100.25\",0.55\n\"measured twice\"\n",
     .count = 2,
     .pressure = {1050.5, 1100.25},
     .density = {0.412, 0.55},
     .said = {"column 2 'Pressure (MPa)'", "decimal point", "headings in line 2",
              "1 row remark (line 6)", "thousands grouped"}},
    {.name = "tabs, slashes before units, French groups by no-break spaces",
     .text = "Temps / s\tPression / kPa\tDensit\xc3\xa9 relative\n"
             "1,0\t50\xc2\xa0"
             "000,5\t0,41\n2,0\t1\xe2\x80\xaf"
             "250\xe2\x80\xaf"
             "000\t0,55\n",
     .count = 2,
     .pressure = {50.0005, 1250.0},
     .density = {0.41, 0.55},
     .said = {"between tabs", "in kPa", "in fractions (it names no unit)",
              "not read: 'Temps / s'"}},
    {.name = "Windows-1252, mass density, superscript in the unit",
     .text = "Druck (bar);Gr\xfcndichte (g/cm\xb3)\n1000;1,95\n2000;2,34\n",
     .given = "true-density=3.9 g/cm3",
     .count = 2,
     .pressure = {100.0, 200.0},
     .density = {0.5, 0.6},
     .said = {"taken for WINDOWS-1252", "Gr\xc3\xbcndichte (g/cm\xc2\xb3)", "in g/cm3"}},
    {.name = "UTF-16 of a spreadsheet, tabs",
     .text = "\xff\xfep\0 \0[\0M\0P\0a\0]\0\t\0T\0D\0 \0[\0%\0]\0\r\0\n\0"
             "1\0\t\0"
             "4\0"
             "5\0,\0"
             "5\0\r\0\n\0"
             "2\0\t\0"
             "5\0"
             "0\0,\0"
             "5\0\r\0\n\0",
     .length = 2 + 2 * 32,
     .count = 2,
     .pressure = {1.0, 2.0},
     .density = {0.455, 0.505},
     .said = {"between tabs", "decimal comma"}},
    {.name = "testing machine: title lines, names and units in two rows, kN and mm, "
             "compression negative, unloading",
     .text = "\"Test\",\"die 10 mm\"\n\"Date\",\"2024-05-02\"\n\n"
             "\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(kN)\"\n"
             "\"0.00\",\"0.000\",\"0.000\"\n\"1.00\",\"-2.000\",\"-10.000\"\n"
             "\"2.00\",\"-4.000\",\"-20.000\"\n\"3.00\",\"-3.900\",\"-5.000\"\n",
     .given = "die-area=1 cm2,powder-mass=2 g,true-density=4 g/cm3,initial-height=12 mm,"
              "compliance=10 um/kN",
     .count = 2,
     .pressure = {100.0, 200.0},
     .density = {5.0 / 10.1, 5.0 / 8.2},
     .said = {"force from column 3 'Load' in kN",
              "travel from column 2 'Extension' in mm",
              "compression negative in column 3", "travel decreasing on compression",
              "1 row without pressure (line 6), 1 row of unloading (line 9)"}},
    {.name = "crosshead position, zero of the empty die, N and um",
     .text = "Standardweg in um;Standardkraft in N\n1000;1000\n3000;10000\n",
     .given = "die-area=100 mm2,powder-mass=2 g,true-density=4 g/cm3,zero-travel=13 mm",
     .count = 2,
     .pressure = {10.0, 100.0},
     .density = {5.0 / 12.0, 5.0 / 10.0},
     .said = {"travel from column 1 'Standardweg in um' in um"}},
    {.name = "comments, head in the last of them, blanks",
     .text = "# alumina, 2 mm\n# pressure_MPa  rho\n  10.5   0.40\n 100.0\t0.50\n"
             "# later\n 200.5   0.55\n",
     .count = 3,
     .pressure = {10.5, 100.0, 200.5},
     .density = {0.4, 0.5, 0.55},
     .said = {"between blanks", "headings in line 2 (a comment)",
              "1 row comment (line 5)"}},
    {.name = "samples in a column of merged cells, empty lines, separators at the end",
     .text = "Probe;p (MPa);Dichte (%);;\nA;100;45,0;;\n;200;50,5;;\n;;;;\n\n"
             "B;100;40,0;;\n;200;42,5;;\n",
     .count = 4,
     .pressure = {100.0, 200.0, 100.0, 200.0},
     .density = {0.45, 0.505, 0.4, 0.425},
     .said = {"series from column 1 'Probe'", "empty series continue the one above"}},
    {.name = "percent signs in the cells, sep= of Excel, a compact in each row",
     .text = "sep=;\nSpecimen;Pressure [MPa];Density\nK1;100;45,5 %\nK3;300;60,5 %\n"
             "K2;200;52,0%\n",
     .count = 3,
     .pressure = {100.0, 300.0, 200.0},
     .density = {0.455, 0.605, 0.52},
     .said = {"in percent", "rows not in the order of pressure taken as loading",
              "not read: 'Specimen'"}},
    {.name = "loading, unloading and loading again; a density that is missing",
     .text = "p/MPa|rel density/%\n10|40\n100|50\n50|49.9\n1|49\n60|49.9\n150|\n"
             "200|55.5\n",
     .count = 3,
     .pressure = {10.0, 100.0, 200.0},
     .density = {0.4, 0.5, 0.555},
     .said = {"between bars", "1 row with an empty cell (line 7)",
              "3 rows of unloading (from line 4)"}},
    {.name = "columns by number, no head",
     .text = "1;12,5;41,2\n2;25,5;45,2\n",
     .given = "pressure=2:MPa,density=3:%,decimal=comma,separator=semicolon",
     .count = 2,
     .pressure = {12.5, 25.5},
     .density = {0.412, 0.452}},
    {.name = "all is given, a row is left out",
     .text = "1;12,5;41,2\n2;25,5;45,2\nbroken\n",
     .given = "pressure=2:MPa,density=3:%,decimal=comma,separator=semicolon",
     .count = 2,
     .pressure = {12.5, 25.5},
     .density = {0.412, 0.452},
     .said = {"left out: 1 row remark (line 3)"}},
    {.name = "a leading zero tells the decimal mark",
     .text = "p (MPa);rho\n100;0,412\n200;0,452\n",
     .count = 2,
     .pressure = {100.0, 200.0},
     .density = {0.412, 0.452},
     .said = {"decimal comma"}},
    {.name = "columns by their heads",
     .text = "a,b: c,\"p, q\"\n1,12.5,41.2\n2,25.5,45.2\n",
     .given = "pressure=\"b: c\":MPa,density=\"p, q\":%",
     .count = 2,
     .pressure = {12.5, 25.5},
     .density = {0.412, 0.452},
     .said = {"decimal point"}},
    {.name = "porosity, old line ends, minus of typography, exponents",
     .text = "Druck in MPa;Porosit\xc3\xa4t in %\r\xe2\x88\x92"
             "1,5;60\r1,25E+02;50\r3E2;40\r",
     .count = 2,
     .pressure = {125.0, 300.0},
     .density = {0.5, 0.6},
     .said = {"porosity from column 2", "1 row without pressure (line 2)"}},
    {.name = "height of the compact, error of the density",
     .text = "H\xc3\xb6he [mm];Kraft [kN]\n10,5;10\n8,25;20\n",
     .given = "die-area=1cm2,powder-mass=2g,true-density=4 g/cm3",
     .count = 2,
     .pressure = {100.0, 200.0},
     .density = {5.0 / 10.5, 5.0 / 8.25},
     .said = {"height from column 1"}},
    {.name = "branches by words, errors, a key of a preset",
     .text = "p [MPa];density [%];density error [%];branch;particles.diameter_nm\n"
             "100;45,5;0,5;Belastung;10\n200;50,5;0,25;Belastung;10\n"
             "200;49,5;0,5;Entlastung;10\n",
     .count = 3,
     .pressure = {100.0, 200.0, 200.0},
     .density = {0.455, 0.505, 0.495},
     .said = {"density_error from column 3", "branch from column 4"}},
    {.name = "three decimals between commas", /* commas separate: points are decimal */
     .text = "Pressure (MPa),Density (%)\n100.125,45.125\n200.125,50.125\n",
     .count = 2,
     .pressure = {100.125, 200.125},
     .density = {0.45125, 0.50125},
     .said = {"decimal point"}},
    {.name = "other columns tell the decimal mark",
     .text = "t;p (MPa);d (%)\n0,1;1.125;45\n0,2;2.125;50\n",
     .count = 2,
     .pressure = {1125.0, 2125.0},
     .density = {0.45, 0.5},
     .said = {"decimal comma", "'1.125' in line 2 is 1125"}},
};

static void write_text(const char *text, gssize length)
{
    g_assert_true(g_file_set_contents(path, text, length > 0 ? length : -1, NULL));
}

static enum gb_lab_outcome read_given(struct gb_table **table, const char *given,
                                      struct gb_lab_report *report, struct gb_error *err)
{
    struct gb_lab_options options;
    gb_lab_options_init(&options);
    if (given != NULL && !gb_lab_options_parse(&options, given, err)) {
        return GB_LAB_FAILED;
    }
    return gb_lab_reader_read(table, path, &options, NULL, report, err);
}

static void test_habit(const void *data)
{
    const struct habit *habit = data;
    struct gb_table *table = NULL;
    struct gb_lab_report report;
    struct gb_error err = {0};
    write_text(habit->text, habit->length);
    const enum gb_lab_outcome outcome = read_given(&table, habit->given, &report, &err);
    g_test_message("%s", report.told);
    if (outcome != GB_LAB_READ) {
        g_error("%s: %s%s", habit->name, err.text, report.question);
    }
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const double *density = gb_table_column(table, "density", NULL);
    g_assert_cmpuint(gb_table_rows(table), ==, habit->count);
    for (size_t i = 0; i < habit->count; i++) {
        g_assert_cmpfloat_with_epsilon(pressure[i], habit->pressure[i],
                                       1e-12 * habit->pressure[i]);
        g_assert_cmpfloat_with_epsilon(density[i], habit->density[i], 1e-12);
    }
    g_assert_null(strchr(report.told, '\n'));
    g_assert_true(g_utf8_validate(report.told, -1, NULL));
    g_assert_true((habit->said[0] == NULL) == (report.told[0] == '\0'));
    for (size_t k = 0; k < SAID && habit->said[k] != NULL; k++) {
        if (strstr(report.told, habit->said[k]) == NULL) {
            g_error("\"%s\" does not say \"%s\"", report.told, habit->said[k]);
        }
    }
    gb_table_destroy(table);
}

/* What can be read in two ways: the question, its answers, and what an answer gives. */
struct question {
    const char *name, *text, *given;
    const char *expected;
    const char *choice[3];
    int taken; /* index of the answer that is tried; -1: has gaps */
    double pressure, density;
};

static const struct question questions[] = {
    {"thousands or decimals",
     "p (MPa);d (%)\n1,125;45\n2,250;50\n",
     NULL,
     "'1,125' in line 2: is it 1.125 (decimal comma) or 1125 (decimal point)?",
     {"pressure=1:MPa,density=2:%,decimal=comma",
      "pressure=1:MPa,density=2:%,decimal=point"},
     1,
     1125.0,
     0.45},
    {"points of German thousands",
     "p (MPa);d (%)\n1.125;45\n",
     NULL,
     "'1.125' in line 2",
     {"pressure=1:MPa,density=2:%,decimal=comma",
      "pressure=1:MPa,density=2:%,decimal=point"},
     1,
     1.125,
     0.45},
    {"quoted thousands between commas",
     "p (MPa),d (%)\n\"1,125\",45\n\"2,250\",50\n",
     NULL,
     "'1,125' in line 2",
     {"pressure=1:MPa,density=2:%,decimal=comma"},
     0,
     1.125,
     0.45},
    {"both marks",
     "p (MPa);d (%)\n1,5;45.5\n2,5;50.5\n",
     NULL,
     "'1,5' in line 2 and '45.5' in line 2",
     {"pressure=1:MPa,density=2:%,decimal=comma"},
     -1,
     0.0,
     0.0},
    {"a density above 1 without unit",
     "p (MPa);Dichte\n100;2,5\n200;3\n",
     NULL,
     "density from column 2 'Dichte', up to 3: in which unit?",
     {"pressure=1:MPa,density=2:%", "pressure=1:MPa,density=2:g/cm3"},
     0,
     100.0,
     0.025},
    {"a pressure without unit",
     "p;density\n100;0,5\n",
     NULL,
     "pressure from column 1 'p': in which unit?",
     {"pressure=1:MPa,density=2"},
     0,
     100.0,
     0.5},
    {"a milli that may be a mega",
     "Druck (mPa);density\n100;0,5\n",
     NULL,
     "pressure from column 1 'Druck (mPa)': in which unit?",
     {"pressure=1:MPa,density=2"},
     0,
     100.0,
     0.5},
    {"no head",
     "100;0,5\n200;0,6\n",
     NULL,
     "which column is the pressure, which the density? There are 1 '100', 2 '0,5'",
     {"pressure=?:MPa,density=?:%"},
     -1,
     0.0,
     0.0},
    {"heads of nothing known",
     "A;B;C\n1;100;0,5\n2;200;0,6\n",
     "pressure=2:MPa",
     "which column is the density? There are 1 'A', 2 'B', 3 'C'",
     {"pressure=2:MPa,density=?:%"},
     -1,
     0.0,
     0.0},
    {"a letter among words is no density",
     "p (MPa);powder d\n100;0,5\n200;0,6\n",
     NULL,
     "which column is the density?",
     {"pressure=1:MPa,density=?:%"},
     -1,
     0.0,
     0.0},
    {"two pressures",
     "p1 Druck (MPa);p2 Druck (MPa);d\n1;100;0,5\n2;200;0,6\n",
     NULL,
     "pressure: column 1 'p1 Druck (MPa)' or column 2 'p2 Druck (MPa)'?",
     {"pressure=1:MPa", "pressure=2:MPa"},
     1,
     100.0,
     0.5},
    {"a force without area",
     "Kraft (kN);d\n1;0,5\n2;0,6\n",
     NULL,
     "a force needs die-area",
     {"density=2:1,force=1:kN,die-area=? (1.33 cm2)"},
     -1,
     0.0,
     0.0},
    {"travel without numbers",
     "F (kN);s;Weg (mm)\n1;0,5;1\n2;0,6;2\n",
     "die-area=1 cm2",
     "punch travel needs powder-mass, true-density, initial-height (at travel 0",
     {"force=1:kN,travel=3:mm,die-area=100 mm2,powder-mass=? (2 g),"
      "true-density=? (3.99 g/cm3),initial-height=? (12 mm)"},
     -1,
     0.0,
     0.0},
    {"a mass density alone",
     "p (MPa);d (kg/m3)\n10;1500\n20;1600\n",
     NULL,
     "needs true-density",
     {"pressure=1:MPa,density=2:kg/m3,true-density=? (3.99 g/cm3)"},
     -1,
     0.0,
     0.0},
    {"a fraction or g/cm3 of a foam",
     "p (MPa);d\n10;0,5\n20;0,6\n",
     "true-density=2 g/cm3",
     "density from column 2 'd', up to 0.6: in which unit?",
     {"pressure=1:MPa,density=2:1,true-density=2000 kg/m3",
      "pressure=1:MPa,density=2:g/cm3,true-density=2000 kg/m3"},
     1,
     10.0,
     0.25},
};

static void test_question(const void *data)
{
    const struct question *question = data;
    struct gb_table *table = NULL;
    struct gb_lab_report report;
    struct gb_error err = {0};
    write_text(question->text, 0);
    const enum gb_lab_outcome outcome =
        read_given(&table, question->given, &report, &err);
    g_test_message("%s%s%s", err.text, report.told, report.question);
    g_assert_cmpint(outcome, ==, GB_LAB_QUESTION);
    g_assert_null(table);
    if (strstr(report.question, question->expected) == NULL) {
        g_error("\"%s\" does not ask \"%s\"", report.question, question->expected);
    }
    for (int k = 0; k < 3 && question->choice[k] != NULL; k++) {
        g_assert_cmpint(k, <, report.choices);
        g_assert_cmpstr(report.choice[k], ==, question->choice[k]);
    }
    if (question->taken >= 0) {
        char *answer = g_strdup(report.choice[question->taken]);
        g_assert_cmpint(read_given(&table, answer, &report, &err), ==, GB_LAB_READ);
        g_assert_cmpfloat(gb_table_column(table, "p_MPa", NULL)[0], ==,
                          question->pressure);
        g_assert_cmpfloat_with_epsilon(gb_table_column(table, "density", NULL)[0],
                                       question->density, 1e-15);
        gb_table_destroy(table);
        g_free(answer);
    }
}

/* Refusals: one line, the line of the file, what is expected. */
static void test_refusals(void)
{
    static const struct {
        const char *text, *given, *part;
    } cases[] = {
        {"p (MPa);d (%)\n1,5;45\nabc;46\n", NULL, ":3: column 1 'p (MPa)' = 'abc': must"},
        {"p (MPa);d (%)\n1,5;45\n#DIV/0!;46\n", NULL, ":3: column 1"},
        {"p (MPa);d (%)\n1,5;45\n1.5;46\n", "decimal=comma", ":3: column 1"},
        {"p (MPa);d (%)\n1,5;45\n2,5;145\n", NULL, ":3: a relative density of 1.45"},
        {"p (MPa);d\n1,5;45 %\n2,5;46\n", NULL, ":3: column 2 'd': expected a percent"},
        {"p (MPa);d\n1,5;0,45\n2,5;46 %\n", NULL, ":3: column 2 'd': expected a percent"},
        {"p (MPa);d (g/cm3)\n1,5;45 %\n", NULL, ":2: column 2 'd (g/cm3)': expected"},
        {"p,rho\n1,5,0,35\n2,5,0,36\n", NULL, ":2: 4 cells below 2 headings"},
        {"p (MPa);d (%)\n1,5;\"45\n2,5;46\n", "separator=;", ":2: a quote is not closed"},
        {"PK\x03\x04xlsx", NULL,
         "is a workbook (.xlsx, .ods); expected its table as CSV"},
        {"just text\n", NULL, "no rows of two numbers"},
        {"", NULL, "no rows of two numbers"},
        {"p (MPa);d (%)\n1,5;45\n", "pressure=7:MPa", "pressure=7: expected one of"},
        {"p (MPa);d (%)\n1,5;45\n", "pressure=\"q\":MPa", "pressure=q: expected one of"},
        {"p (MPa);d (%)\n1,5;45\n", "pressure=1:mm", "the unit must be one of MPa"},
        {"p (MPa);d (%)\n1,5;45\n", "presure=1:MPa", "presure: expected pressure, den"},
        {"p (MPa);d (%)\n1,5;45\n", "pressure=?:MPa", "expected the number of a column"},
        {"p (MPa);d (%)\n1,5;45\n", "die-area=1 cm2", "die-area has no use"},
        {"p (MPa);d (%)\n1,5;45\n", "die-area=-1 cm2",
         "expected a number above 0 in mm2"},
        {"p (MPa);d (%)\n1,5;45\n", "decimal=x", "decimal=x: expected comma, point"},
        {"p (MPa);d (%)\n0;45\n", NULL, "no row with a pressure above 0"},
        {"s;F (kN);Weg (mm)\n0;1,5;3\n1;2;9\n",
         "die-area=1 cm2,powder-mass=2 g,true-density=4 g/cm3,initial-height=6 mm",
         ":2: a relative density of 1.667"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        struct gb_table *table = NULL;
        struct gb_lab_report report = {.choices = 0};
        struct gb_error err = {0};
        write_text(cases[i].text, 0);
        const enum gb_lab_outcome outcome =
            read_given(&table, cases[i].given, &report, &err);
        g_test_message("%zu: %s%s", i, err.text, report.question);
        g_assert_cmpint(outcome, ==, GB_LAB_FAILED);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (strstr(err.text, cases[i].part) == NULL) {
            g_error("\"%s\" does not say \"%s\"", err.text, cases[i].part);
        }
    }
}

/* A file of this program is read without a word, as by gb_table_read. */
static void test_own(void)
{
    struct gb_table *table = NULL;
    struct gb_lab_report report;
    struct gb_error err = {0};
    write_text("\xef\xbb\xbf# a comment\np_MPa,density\r\n1.125,0.4\r\n1.0,0.5\r\n", 0);
    g_assert_cmpint(read_given(&table, NULL, &report, &err), ==, GB_LAB_READ);
    g_assert_cmpstr(report.told, ==, "");
    g_assert_cmpuint(gb_table_rows(table), ==, 2);
    g_assert_cmpfloat(gb_table_column(table, "p_MPa", NULL)[0], ==, 1.125);
    gb_table_destroy(table);
    write_text("p_MPa,density\n1,125,0.4\n", 0);
    g_assert_cmpint(read_given(&table, NULL, &report, &err), ==, GB_LAB_FAILED);
    g_assert_nonnull(strstr(err.text, ":2: 3 cells: must be 2"));
    static const char *const also[] = {"time_ns", "coordination", NULL};
    write_text("time_ns,coordination\n1,4\n", 0);
    g_assert_cmpint(gb_lab_reader_read(&table, path, NULL, also, &report, &err), ==,
                    GB_LAB_READ);
    gb_table_destroy(table);
}

/* The list of what was given says the same when it is read again. */
static void test_options(void)
{
    static const char text[] = "pressure=2:MPa,density=\"rel. Dichte, %\":%,branch=5,"
                               "particles.diameter_nm=6,decimal=comma,separator=tab,"
                               "die-area=100 mm2,compliance=3 um/kN,zero-travel=14.2 mm";
    struct gb_lab_options options;
    struct gb_error err = {0};
    gb_lab_options_init(&options);
    g_assert_false(gb_lab_options_given(&options));
    g_assert_true(gb_lab_options_parse(&options, text, &err));
    g_assert_true(gb_lab_options_given(&options));
    char *again = gb_lab_options_text(&options);
    g_assert_cmpstr(again, ==, text);
    g_free(again);
    g_assert_cmpfloat(options.die_area_m2, ==, 1e-4);
    g_assert_cmpfloat(options.compliance_m_n, ==, 3e-9);
    g_assert_true(gb_lab_options_set(&options, "decimal", ".", &err));
    g_assert_cmpint(options.decimal, ==, '.');
    g_assert_false(gb_lab_options_parse(&options, "pressure=3:MPa,density", &err));
    g_assert_cmpint(options.column[GB_LAB_ROLE_PRESSURE].index, ==, 2); /* unchanged */
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    char *folder = g_dir_make_tmp("greenbody-lab-XXXXXX", NULL);
    path = g_build_filename(folder, "lab.csv", NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(habits); i++) {
        char *name = g_strdup_printf("/lab/habit/%s", habits[i].name);
        g_test_add_data_func(name, &habits[i], test_habit);
        g_free(name);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(questions); i++) {
        char *name = g_strdup_printf("/lab/question/%s", questions[i].name);
        g_test_add_data_func(name, &questions[i], test_question);
        g_free(name);
    }
    g_test_add_func("/lab/refusals", test_refusals);
    g_test_add_func("/lab/own", test_own);
    g_test_add_func("/lab/options", test_options);
    const int status = g_test_run();
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return status;
}
