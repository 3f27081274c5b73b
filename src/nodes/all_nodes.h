// Every node of Lightsieve, gathered by the build from one file a node.
#pragma once

#include "scene/registry.h"

namespace lightsieve {

/// Adds all built-in nodes.
void add_all_nodes(Registry& registry);

/// The built-in nodes; lives until the program ends. Thread safe.
[[nodiscard]] const Registry& builtin_registry();

}  // namespace lightsieve
