// What each file of this folder adds to its module; one file for each layer that Python sees.
#pragma once

#include <nanobind/nanobind.h>

namespace lightsieve::python {

/// Expressions, built-ins, paths (module _lpe).
void add_lpe(nanobind::module_& module);
/// Dialects of other renderers (module _lpe).
void add_dialects(nanobind::module_& module);
/// The node types (module _core).
void add_nodes(nanobind::module_& module);
/// Reading and checking EXR files (module _core).
void add_exr(nanobind::module_& module);
/// Checking and rendering scenes (module _core).
void add_render(nanobind::module_& module);

}  // namespace lightsieve::python
