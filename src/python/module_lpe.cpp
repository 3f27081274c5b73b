#include "python/errors.h"
#include "python/layers.h"

NB_MODULE(_lpe, module) {
    module.doc() = "Light path expressions: the engine alone. Private; use lightsieve.lpe.";
    lightsieve::python::translate_errors();
    lightsieve::python::add_common(module);
    lightsieve::python::add_lpe(module);
    lightsieve::python::add_dialects(module);
}
