// The node types that a scene may use, by name.
//
// A plain container: the built-in nodes are in `builtin_registry()` (nodes/all_nodes.h), tests make their own.
// Graphs keep pointers to the types, so a registry must outlive every graph that was built with it.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/node_type.h"

namespace lightsieve {

class Registry {
  public:
    /// Adds a node type. Two types of one name are a bug of ours.
    void add(NodeType type);
    /// The type of that name, or null.
    [[nodiscard]] const NodeType* find(Name name) const;
    /// All types, ordered by name.
    [[nodiscard]] std::vector<const NodeType*> all() const;
    /// Names of all types, in order, for "did you mean".
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::unordered_map<Name, std::unique_ptr<const NodeType>> types_;
};

}  // namespace lightsieve
