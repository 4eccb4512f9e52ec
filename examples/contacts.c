/* Steps through a run and reads its contacts: the largest normal force at each point.
 * Usage: contacts PRESET [KEY=VALUE]... */
#include <greenbody/greenbody.h>
#include <stdio.h>

static void print_largest(void *data, struct gb_simulation *simulation,
                          const struct gb_point *point)
{
    struct gb_array force = {.size = sizeof force};
    double largest = 0.0;
    if (!gb_simulation_array(simulation, "contact_normal", &force, data)) {
        gb_simulation_cancel(simulation, "no contacts");
        return;
    }
    for (int64_t i = 0; i < force.shape[0]; i++) {
        const double value = ((const double *)force.data)[i];
        largest = value > largest ? value : largest;
    }
    printf("density %.4f: %lld contacts, largest force %.4g nN\n", point->density,
           (long long)force.shape[0], largest * force.si * 1e9);
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_parameters *parameters = NULL;
    struct gb_simulation *simulation = NULL;
    bool good = gb_parameters_create(&parameters, argc > 1 ? argv[1] : NULL, &err);
    for (int i = 2; good && i < argc; i++) {
        good = gb_parameters_set(parameters, argv[i], &err);
    }
    if (good && gb_simulation_create(&simulation, parameters, &err)) {
        gb_simulation_on_point(simulation, print_largest, &err);
        while (gb_simulation_advance(simulation, 10, &err) == GB_RUN_OUTCOME_NONE) {
            printf("%3.0f %%\n", 100.0 * gb_simulation_progress(simulation));
        }
    }
    fprintf(stderr, "%s%s", err.text, err.code ? "\n" : "");
    gb_simulation_destroy(simulation);
    gb_parameters_destroy(parameters);
    return gb_status_exit_code(err.code);
}
