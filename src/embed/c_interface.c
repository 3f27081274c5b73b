/* A caller in C: embed_test.cpp asks it for the light of one diffuse bounce. */
#include <string.h>

#include "lightsieve/lightsieve.h"

/* Compiles `expression` and follows the camera's ray over a diffuse bounce to a lamp of group
   "key". Returns how many AOVs take the path, -1 after an error (its code goes to `code`, of 64
   bytes), -2 if something is out of order. */
int lightsieve_c_caller(const char* expression, char* code) {
    const char* const key[] = {"key"};
    const lightsieve_event bounce = {LIGHTSIEVE_REFLECTION, LIGHTSIEVE_DIFFUSE, NULL, 0};
    const lightsieve_event lamp = {LIGHTSIEVE_LIGHT, LIGHTSIEVE_NO_LOBE, key, 1};
    lightsieve_compiler* const compiler = lightsieve_compiler_create();
    if (compiler == NULL) return -2;
    lightsieve_add_aov(compiler, "beauty", "C.*", NULL);
    lightsieve_add_aov(compiler, "asked", expression, NULL);
    lightsieve_add_aov(compiler, "key", "C.*", "key");
    lightsieve_add_aov(compiler, "fill", "C.*", "fill");
    const uint32_t bounce_index = lightsieve_add_event(compiler, &bounce);
    const uint32_t lamp_index = lightsieve_add_event(compiler, &lamp);
    lightsieve_program* const program = lightsieve_compile(compiler);

    int result = -2;
    lightsieve_diagnostic found;
    if (lightsieve_get_diagnostic(compiler, 0, &found) && found.severity == LIGHTSIEVE_ERROR) {
        strncpy(code, found.code, 63);
        code[63] = '\0';
        result = -1;
    } else if (program != NULL) {
        const lightsieve_tables t = lightsieve_program_tables(program);
        uint32_t state = t.starts[0];
        state = lightsieve_step(t.table, state, t.event_columns[bounce_index]);
        const uint32_t atom = lightsieve_atom(t.table, state, t.event_columns[lamp_index]);
        result = atom == LIGHTSIEVE_NONE ? 0 : (int)(t.atom_begin[atom + 1] - t.atom_begin[atom]);
    }
    lightsieve_program_destroy(program);
    lightsieve_compiler_destroy(compiler);
    return result;
}
