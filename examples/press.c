/* Presses a preset and prints its curve.  Usage: press PRESET [KEY=VALUE]... */
#include <greenbody/greenbody.h>
#include <inttypes.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    struct gb_error err = {GB_OK, ""};
    struct gb_parameters *parameters = NULL;
    struct gb_simulation *simulation = NULL;
    bool good = gb_parameters_create(&parameters, argc > 1 ? argv[1] : NULL, &err);
    for (int i = 2; good && i < argc; i++) {
        good = gb_parameters_set(parameters, argv[i], &err);
    }
    good = good && gb_simulation_create(&simulation, parameters, &err);
    if (good &&
        gb_simulation_advance(simulation, INT64_MAX, &err) == GB_RUN_OUTCOME_DONE) {
        puts("density,p_MPa,coordination");
        for (size_t i = 0; i < gb_simulation_points(simulation); i++) {
            const struct gb_point *point = gb_simulation_point(simulation, i);
            printf("%.6g,%.6g,%.4g\n", point->density, point->p_pa / 1e6,
                   point->coordination);
        }
    } else {
        fprintf(stderr, "press: %s\n", err.text);
    }
    gb_simulation_destroy(simulation);
    gb_parameters_destroy(parameters);
    return gb_status_exit_code(err.code);
}
