// Every node of Lightsieve, gathered by the build from one file a node.
#pragma once

#include "scene/registry.h"

namespace lightsieve {

/// Adds all built-in nodes. Called once by `Registry::builtin()`.
void add_all_nodes(Registry& registry);

}  // namespace lightsieve
