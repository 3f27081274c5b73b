#include "scene/registry.h"

#include <algorithm>

#include "core/error.h"

namespace lightsieve {

void Registry::add(NodeType type) {
    const Name name = type.name;
    const bool added =
        types_.emplace(name, std::make_unique<const NodeType>(std::move(type))).second;
    LIGHTSIEVE_ASSERT(added, "two node types are named " + name.str());
}

const NodeType* Registry::find(Name name) const {
    const auto found = types_.find(name);
    return found == types_.end() ? nullptr : found->second.get();
}

std::vector<const NodeType*> Registry::all() const {
    std::vector<const NodeType*> out;
    out.reserve(types_.size());
    for (const auto& [name, type] : types_)
        out.push_back(type.get());
    std::sort(out.begin(), out.end(),
              [](const NodeType* a, const NodeType* b) { return a->name < b->name; });
    return out;
}

std::vector<std::string> Registry::names() const {
    std::vector<std::string> out;
    for (const NodeType* type : all())
        out.push_back(type->name.str());
    return out;
}

}  // namespace lightsieve
