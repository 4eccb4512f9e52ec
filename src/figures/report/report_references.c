#include "figures/report/report_references.h"

#include <string.h>

/* In the order of the list. */
static const struct {
    const char *tag;  /* in a source, or the name of a law or equation */
    const char *name; /* shown in front: the tag of the other pages, or NULL */
    const char *text;
} papers[] = {
    {"P1", "P1",
     "G. Sh. Boltachev, K. E. Lukyashin, V. A. Shitov, N. B. Volkov, Three-dimensional "
     "simulations of nanopowder compaction processes by granular dynamics method, Phys. "
     "Rev. E 88, 012209 (2013), doi 10.1103/PhysRevE.88.012209"},
    {"P2", "P2",
     "G. Sh. Boltachev, N. B. Volkov, A. V. Spirin, E. A. Chingina, Simulation of "
     "nanopowder high-speed compaction by 2D granular dynamics method, Institute of "
     "Electrophysics, Ural Branch of RAS, Ekaterinburg"},
    {"P3", "P3",
     "J. Rojek, S. Nosewicz, K. Jurczak, M. Chmielewski, K. Bochenek, K. Pietrzak, "
     "Discrete element simulation of powder compaction in cold uniaxial pressing with low "
     "pressure, Comput. Part. Mech. 3, 513 (2016), doi 10.1007/s40571-015-0093-0"},
    {"hertz", NULL,
     "H. Hertz, \u00dcber die Ber\u00fchrung fester elastischer K\u00f6rper, J. Reine "
     "Angew. Math. 92, 156 (1881)"},
    {"storakers", NULL,
     "B. Stor\u00e5kers, S. Biwa, P.-L. Larsson, Similarity analysis of inelastic contact, "
     "Int. J. Solids Struct. 34, 3061 (1997)"},
    {"Potyondy", NULL,
     "D. O. Potyondy, P. A. Cundall, A bonded-particle model for rock, Int. J. Rock Mech. "
     "Min. Sci. 41, 1329 (2004)"},
    {"Salmon", NULL,
     "J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy "
     "as 1, 2, 3, Proc. Int. Conf. High Performance Computing (SC11), 16 (2011)"},
    {"heckel", NULL,
     "R. W. Heckel, Density-pressure relationships in powder compaction, Trans. Metall. "
     "Soc. AIME 221, 671 (1961)"},
    {"kawakita", NULL,
     "K. Kawakita, K.-H. L\u00fc"
     "dde, Some considerations on powder compression equations, Powder Technol. 4, 61 "
     "(1971)"},
    {"cooper-eaton", NULL,
     "A. R. Cooper, L. E. Eaton, Compaction behavior of several ceramic powders, J. Am. "
     "Ceram. Soc. 45, 97 (1962)"},
    {"walker", NULL,
     "E. E. Walker, The properties of powders. Part VI. The compressibility of powders, "
     "Trans. Faraday Soc. 19, 73 (1923)"},
    {"adams", NULL,
     "M. J. Adams, M. A. Mullier, J. P. K. Seville, Agglomerate strength measurement using "
     "a uniaxial confined compression test, Powder Technol. 78, 5 (1994)"},
    {"panelli-ambrozio", NULL,
     "R. Panelli, F. Ambrozio Filho, A study of a new phenomenological compacting equation, "
     "Powder Technol. 114, 255 (2001)"},
    {"secondi", NULL,
     "J. Secondi, Modelling powder compaction: from a pressure-density law to continuum "
     "mechanics, Powder Metall. 45, 213 (2002)"},
};

static void cite(struct gb_report *report, const char *text)
{
    if (!g_ptr_array_find_with_equal_func(report->cited, text, g_str_equal, NULL)) {
        g_ptr_array_add(report->cited, g_strdup(text));
    }
}

void gb_report_references_cite(struct gb_report *report, const char *source)
{
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        /* tags of sources begin with a capital letter, names of laws do not */
        if (g_ascii_isupper(papers[k].tag[0]) && strstr(source, papers[k].tag) != NULL) {
            cite(report, papers[k].text);
        }
    }
}

void gb_report_references_cite_name(struct gb_report *report, const char *name,
                                    const char *fallback)
{
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        if (strcmp(papers[k].tag, name) == 0) {
            cite(report, papers[k].text);
            return;
        }
    }
    if (fallback != NULL) {
        cite(report, fallback);
    }
}

static bool is_cited(const struct gb_report *report, const char *text)
{
    return g_ptr_array_find_with_equal_func(report->cited, text, g_str_equal, NULL);
}

/* Whether a cited text is one of the table. */
static bool is_known(const char *text)
{
    bool found = false;
    for (size_t k = 0; k < G_N_ELEMENTS(papers) && !found; k++) {
        found = strcmp(papers[k].text, text) == 0;
    }
    return found;
}

/* The papers of the table in its order, then the other ones in the order of citation. */
bool gb_report_references(struct gb_report *report, struct gb_error *err)
{
    GPtrArray *items = g_ptr_array_new_with_free_func(g_free);
    (void)err;
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        if (is_cited(report, papers[k].text)) {
            g_ptr_array_add(
                items, papers[k].name != NULL
                           ? g_strdup_printf("%s: %s.", papers[k].name, papers[k].text)
                           : g_strdup_printf("%s.", papers[k].text));
        }
    }
    for (guint k = 0; k < report->cited->len; k++) {
        const char *text = g_ptr_array_index(report->cited, k);
        if (!is_known(text)) {
            g_ptr_array_add(items, g_strdup_printf("%s.", text));
        }
    }
    gb_page_list(&report->page, items);
    g_ptr_array_unref(items);
    return true;
}
