#include "scene/graph.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "scene/graph_editor.h"

namespace lightsieve {

NodeInstance::NodeInstance(const NodeType& type, Name name, SourceSpan where)
    : type_(type),
      name_(name),
      where_(std::move(where)),
      written_(type.params.size()),
      set_(type.params.size()),
      arrays_(type.params.size()) {
    block_ = static_cast<std::byte*>(::operator new(std::max<std::size_t>(type.block_size, 1),
                                                    std::align_val_t(type.block_align)));
    if (!type.default_block.empty())
        std::memcpy(block_, type.default_block.data(), type.default_block.size());
}

NodeInstance::~NodeInstance() { ::operator delete(block_, std::align_val_t(type_.block_align)); }

bool NodeInstance::is_set(Name param) const {
    const ParamInfo* info = type_.find(param);
    return info != nullptr && set_[static_cast<std::size_t>(info - type_.params.data())];
}

bool NodeInstance::has_default(Name param) const {
    const ParamInfo* info = type_.find(param);
    if (info == nullptr) return true;
    const std::byte* value = block_ + info->offset;
    const std::byte* standard = type_.default_block.data() + info->offset;
    if (!info->is_array) return std::memcmp(value, standard, type_size(info->type)) == 0;
    // Every Array<T> has the same layout.
    const auto& a = *reinterpret_cast<const Array<std::byte>*>(value);
    const auto& b = *reinterpret_cast<const Array<std::byte>*>(standard);
    const std::size_t bytes = std::size_t{a.n} * a.n_keys * type_size(info->type);
    return a.n == b.n && a.n_keys == b.n_keys &&
           (bytes == 0 || std::memcmp(a.data, b.data, bytes) == 0);
}

SourceSpan NodeInstance::where(Name param) const {
    const ParamInfo* info = type_.find(param);
    if (info == nullptr) return where_;
    const SourceSpan& span = written_[static_cast<std::size_t>(info - type_.params.data())];
    return span.known() ? span : where_;
}

bool NodeInstance::is_linked(Name param) const {
    return std::any_of(links_.begin(), links_.end(),
                       [&](const Link& link) { return link.param->name == param; });
}

const UserData* NodeInstance::find_user_data(Name name) const {
    const auto found = std::find_if(user_data_.begin(), user_data_.end(),
                                    [&](const UserData& data) { return data.name == name; });
    return found == user_data_.end() ? nullptr : &*found;
}

std::vector<const NodeInstance*> NodeInstance::references() const {
    std::vector<const NodeInstance*> out;
    for (const Link& link : links_)
        out.push_back(link.source);
    for (const ParamInfo& info : type_.params) {
        if (info.type != ParamType::Node && info.type != ParamType::Closure) continue;
        const std::byte* value = block_ + info.offset;
        std::size_t n = 1;
        if (info.is_array) {
            const auto& array = *reinterpret_cast<const Array<std::byte>*>(value);
            n = std::size_t{array.n} * array.n_keys;
            value = array.data;
        }
        // Both NodeRef and ShaderRef begin with the pointer to the node.
        for (std::size_t i = 0; i < n; ++i) {
            const NodeInstance* node = nullptr;
            std::memcpy(&node, value + i * type_size(info.type), sizeof(node));
            if (node != nullptr) out.push_back(node);
        }
    }
    return out;
}

NodeInstance* NodeScope::find(Name name) const {
    const NodeScope* scope = this;
    for (;; scope = scope->outer) {
        if (const auto found = scope->names.find(name); found != scope->names.end())
            return found->second;
        if (scope->outer == nullptr) break;
    }
    if (!name.view().starts_with('^')) return nullptr;
    const auto found = scope->names.find(Name(name.view().substr(1)));
    return found == scope->names.end() ? nullptr : found->second;
}

SceneGraph::SceneGraph(const Registry& registry) : registry_(&registry) {
    scopes_.push_back(std::make_unique<NodeScope>());
}

const NodeScope* SceneGraph::contents(const NodeInstance& procedural) const {
    const auto found = contents_.find(&procedural);
    return found == contents_.end() ? nullptr : found->second;
}

const NodeInstance* SceneGraph::find(Name name) const { return scopes_.front()->find(name); }
NodeInstance* SceneGraph::find(Name name) { return scopes_.front()->find(name); }

bool SceneGraph::set(Name node, std::string_view param, std::string_view value,
                     Diagnostics& diagnostics) {
    NodeInstance* instance = find(node);
    if (instance == nullptr && node.view() == "options") instance = add(node, node, diagnostics);
    if (instance == nullptr) {
        std::vector<std::string> names;
        for (const auto& [name, unused] : scopes_.front()->names)
            names.push_back(name.str());
        diagnostics.error(Code::UnknownReference, "the scene has no node \"" + node.str() + "\"",
                          {}, did_you_mean(node.view(), names));
        return false;
    }
    return GraphEditor(*this, UnknownPolicy::Error, diagnostics).set(*instance, param, value);
}

bool SceneGraph::assign(std::string_view assignment, Diagnostics& diagnostics) {
    fingerprint_.add(assignment);
    // Names may contain "." and "=": take the longest node name that exists.
    std::string_view first_node, first_param, first_value;
    for (std::size_t equals = assignment.find('='); equals != std::string_view::npos;
         equals = assignment.find('=', equals + 1)) {
        const std::string_view target = assignment.substr(0, equals);
        for (std::size_t dot = target.rfind('.'); dot != std::string_view::npos && dot > 0;
             dot = target.rfind('.', dot - 1)) {
            const std::string_view node = target.substr(0, dot), param = target.substr(dot + 1),
                                   value = assignment.substr(equals + 1);
            if (first_node.empty()) {
                first_node = node;
                first_param = param;
                first_value = value;
            }
            if (find(Name(node)) != nullptr) return set(Name(node), param, value, diagnostics);
        }
    }
    if (first_node.empty()) {
        diagnostics.error(Code::AssSyntax, "\"" + std::string(assignment) + "\" is no assignment",
                          {}, "write NODE.PARAM=VALUE");
        return false;
    }
    return set(Name(first_node), first_param, first_value, diagnostics);
}

NodeInstance* SceneGraph::add(Name type, Name name, Diagnostics& diagnostics) {
    const NodeType* found = registry_->find(type);
    if (found == nullptr) {
        diagnostics.error(Code::UnknownNode, "there is no node type \"" + type.str() + "\"", {},
                          did_you_mean(type.view(), registry_->names()));
        return nullptr;
    }
    if (!name.empty() && find(name) != nullptr) {
        diagnostics.error(Code::DuplicateName,
                          "the scene has a node \"" + name.str() + "\" already",
                          find(name)->where());
        return nullptr;
    }
    return GraphEditor(*this, UnknownPolicy::Error, diagnostics)
        .add(*found, name, !name.empty(), {});
}

SceneGraph build_graph(const Document& document, const Registry& registry,
                       const BuildOptions& options, Diagnostics& diagnostics) {
    SceneGraph graph(registry);
    GraphEditor(graph, options.unknown, diagnostics).build(document);
    return graph;
}

}  // namespace lightsieve
