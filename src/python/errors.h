// Errors on their way from C++ to Python, the same for both modules.
//
// An `InputError` becomes a `lightsieve.errors.LightsieveError` whose `.errors` are `Diagnostic`s: plain Python objects,
// defined in Python, so that both modules raise the same class. Everything in them is computed here, line, column and
// rendered text included; Python never sees a SourceSpan.
#pragma once

#include <nanobind/nanobind.h>

#include <vector>

#include "core/diagnostics.h"
#include "core/error.h"

namespace lightsieve::python {

/// The error as a `lightsieve.errors.Diagnostic`.
[[nodiscard]] nanobind::object to_python(const Error& error);
/// All of them, in order, as a tuple.
[[nodiscard]] nanobind::tuple to_python(const std::vector<Error>& errors);

/// From now on InputError becomes LightsieveError in calls to this module.
void translate_errors();

/// Adds `version` and `exit_3_on_bug()` to a module.
void add_common(nanobind::module_& module);

}  // namespace lightsieve::python
