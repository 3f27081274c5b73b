#include "python/errors.h"
#include "python/layers.h"

NB_MODULE(_core, module) {
    module.doc() = "Scenes, nodes, rendering and picture files. Private; use lightsieve.";
    lightsieve::python::translate_errors();
    lightsieve::python::add_common(module);
    lightsieve::python::add_nodes(module);
    lightsieve::python::add_exr(module);
    lightsieve::python::add_render(module);
}
