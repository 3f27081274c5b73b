// The scene as typed, linked nodes: what a Document means, given a Registry.
//
// Each node instance holds a parameter block (the struct of its NodeType: defaults first, then what the file says),
// the arrays that the block points to, the links into its parameters, its user data, and where each parameter was
// written. References to nodes that do not exist, wrong types and cycles are found here, all at once; what
// a node then makes of its parameters is the business of `prepare` and the renderer. Nodes never move: pointers to
// instances stay valid as long as the graph lives, also when the graph is moved.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "core/diagnostics.h"
#include "core/fingerprint.h"
#include "core/source.h"
#include "scene/describe.h"
#include "scene/document.h"
#include "scene/node_type.h"
#include "scene/registry.h"
#include "scene/value.h"

namespace lightsieve {

/// `param[element].component` takes the value of shader `source`(.source_component).
///
/// In a node's list, links of whole parameters come before links of elements, and those before links of components:
/// applied in order, the more special one wins.
struct Link {
    const ParamInfo* param = nullptr;  ///< of the node that has the link
    std::int32_t element = -1;         ///< of an array parameter; -1: the parameter is no array
    std::int32_t component = -1;       ///< 0..3: only this channel of the parameter; -1: all
    const NodeInstance* source = nullptr;  ///< never null; its type has an output
    std::int32_t source_component = -1;    ///< 0..3: this channel of the source's value; -1: all
    SourceSpan where;                      ///< the value in the scene file
};

/// Values that a shape carries for shaders, beside its parameters.
struct UserData {
    Name name;
    UserDataClass user_class{};
    bool is_array = false;  ///< declared ARRAY: each value is an array (only Constant ones occur)
    ParamType
        type{};  ///< Bool, Byte, Int, UInt, Float, Rgb, Rgba, Vector, Vector2, String, Matrix or Node
    std::uint32_t n = 0;       ///< values a motion key; 0 if declared but never given
    std::uint32_t n_keys = 1;  ///< motion keys
    const void* data =
        nullptr;  ///< n * n_keys values as `value.h` lays them out; owned by the node
    Array<std::uint32_t> indices;  ///< for Indexed: one a face corner
    SourceSpan where;              ///< of the values, or of the declaration
    /// The values as T, which must be the C++ type of `type` (Color for Rgb, ...).
    template <class T>
    [[nodiscard]] std::span<const T> values() const {
        LIGHTSIEVE_ASSERT(describe_detail::param_type<T>() == type, std::string(name.view()));
        return {static_cast<const T*>(data), std::size_t{n} * n_keys};
    }
};

/// One node of a scene.
class NodeInstance {
  public:
    NodeInstance(const NodeType& type, Name name, SourceSpan where);
    ~NodeInstance();
    NodeInstance(const NodeInstance&) = delete;
    NodeInstance& operator=(const NodeInstance&) = delete;

    [[nodiscard]] const NodeType& type() const { return type_; }
    [[nodiscard]] NodeKind kind() const { return type_.kind; }
    /// Its name in the file; a node without one has a private name that no link can spell, e.g. "<sphere 3>".
    [[nodiscard]] Name name() const { return name_; }
    /// False for nodes without a name in the file.
    [[nodiscard]] bool is_named() const { return named_; }

    /// The parameter struct, aligned as the type asks.
    [[nodiscard]] const void* block() const { return block_; }
    [[nodiscard]] void* block() { return block_; }

    /// A parameter's value; T is the C++ type of the member, or std::int32_t for enumerations. A type without such a
    /// parameter or another T is a bug of ours.
    template <class T>
    [[nodiscard]] const T& get(Name param) const {
        const T* value = find<T>(param);
        LIGHTSIEVE_ASSERT(value != nullptr, type_.name.str() + "." + param.str());
        return *value;
    }
    /// A parameter's value, or null if the node has no parameter of that name and type.
    template <class T>
    [[nodiscard]] const T* find(Name param) const {
        const ParamInfo* info = type_.find(param);
        if (info == nullptr || !holds<T>(*info)) return nullptr;
        return reinterpret_cast<const T*>(
            static_cast<const std::byte*>(static_cast<const void*>(block_)) + info->offset);
    }

    /// Whether the file (or an edit) gives the parameter a value or a link.
    [[nodiscard]] bool is_set(Name param) const;
    /// Whether the parameter has its default value, also if the file writes it.
    [[nodiscard]] bool has_default(Name param) const;
    /// Where the value of `param` was written; where the node starts if it was not.
    [[nodiscard]] SourceSpan where(Name param) const;
    /// Where the node starts.
    [[nodiscard]] const SourceSpan& where() const { return where_; }

    /// Links into the node's parameters, of value parameters only: Node and Closure parameters hold theirs in the block.
    [[nodiscard]] std::span<const Link> links() const { return links_; }
    /// Whether a shader drives the parameter, an element or a component of it.
    [[nodiscard]] bool is_linked(Name param) const;
    /// User data, in the order of declaration.
    [[nodiscard]] std::span<const UserData> user_data() const { return user_data_; }
    /// User data of that name, or null.
    [[nodiscard]] const UserData* find_user_data(Name name) const;
    /// Every node that this one needs: sources of links, then Node and Closure parameters. With repetitions.
    [[nodiscard]] std::vector<const NodeInstance*> references() const;

  private:
    friend class GraphEditor;
    friend class SwitchBoard;

    template <class T>
    static bool holds(const ParamInfo& info) {
        using namespace describe_detail;
        if constexpr (IsArray<T>::value) {
            using Element = typename IsArray<T>::Element;
            return info.is_array &&
                   (param_type<Element>() == info.type ||
                    (std::is_same_v<Element, std::int32_t> && info.type == ParamType::Enum));
        } else {
            return !info.is_array &&
                   (param_type<T>() == info.type ||
                    (std::is_same_v<T, std::int32_t> && info.type == ParamType::Enum));
        }
    }

    /// Memory of one array.
    using Buffer = std::unique_ptr<std::byte[]>;

    const NodeType& type_;
    Name name_;
    SourceSpan where_;
    bool named_ = true;
    std::byte* block_ = nullptr;
    std::vector<SourceSpan>
        written_;                 ///< a parameter: where its value was written; unknown: never
    std::vector<bool> set_;       ///< a parameter: whether it was given
    std::vector<Buffer> arrays_;  ///< a parameter: what its Array points to, if the file gave it
    std::vector<Link> links_;
    std::vector<UserData> user_data_;
    std::vector<Buffer> user_arrays_;
};

/// What to do about node types and parameters that the registry does not know.
enum class UnknownPolicy : std::uint8_t {
    Error,   ///< `--strict`
    Warn,    ///< skipped with a warning: scene files contain much that no reader knows
    Ignore,  ///< skipped
};

struct BuildOptions {
    UnknownPolicy unknown = UnknownPolicy::Warn;  ///< node types and parameters
};

/// A node whose type is unknown.
struct SkippedNode {
    Name type;
    Name name;         ///< empty if it has none
    SourceSpan where;  ///< where it starts
};

/// The nodes of one file with their names: the scene itself, or what a procedural reads.
struct NodeScope {
    const NodeScope* outer =
        nullptr;       ///< where names are looked for next; null: this is the scene itself
    std::string file;  ///< that was read; empty for the scene itself
    std::vector<std::unique_ptr<NodeInstance>> nodes;     ///< in file order
    std::vector<std::unique_ptr<NodeInstance>> disabled;  ///< taken out by operators
    std::unordered_map<Name, NodeInstance*> names;
    std::unordered_map<Name, Name> skipped_types;  ///< type of a skipped node by its name

    /// The node of that name here or further out, or null. `^name` is a name of the scene itself.
    [[nodiscard]] NodeInstance* find(Name name) const;
};

class SceneGraph {
  public:
    explicit SceneGraph(const Registry& registry);

    /// All nodes of the scene itself in file order.
    [[nodiscard]] const std::vector<std::unique_ptr<NodeInstance>>& nodes() const {
        return scopes_.front()->nodes;
    }
    /// The scene itself first, then what procedurals hold. Procedurals of one file that cannot differ share theirs.
    [[nodiscard]] const std::vector<std::unique_ptr<NodeScope>>& scopes() const { return scopes_; }
    /// What a procedural holds; null for other nodes, or if its file could not be read.
    [[nodiscard]] const NodeScope* contents(const NodeInstance& procedural) const;
    /// The node of that name in the scene itself, or null. `options` is found as "options".
    [[nodiscard]] const NodeInstance* find(Name name) const;
    [[nodiscard]] NodeInstance* find(Name name);
    /// The options node, or null if the scene has none.
    [[nodiscard]] const NodeInstance* options() const { return options_; }
    [[nodiscard]] NodeInstance* options() { return options_; }
    /// Nodes of unknown types.
    [[nodiscard]] const std::vector<SkippedNode>& skipped() const { return skipped_; }
    /// Unknown parameters that were skipped, those of skipped nodes not counted.
    [[nodiscard]] std::size_t n_unknown_params() const { return n_unknown_params_; }
    [[nodiscard]] const Registry& registry() const { return *registry_; }
    /// Of all texts that the graph was made from, assignments and the files of procedurals included.
    [[nodiscard]] const Fingerprint& fingerprint() const { return fingerprint_; }

    /// Sets a parameter to a value written as in a file; replaces a link. `param` may have suffixes ("color[1].r").
    /// For STRING parameters the text may also stand without quotes, blanks included.
    ///
    /// node     name of the node, or "options"; options are added if the scene has none
    /// returns  false with errors reported (unknown node or parameter, wrong type, a cycle); the value is then unchanged
    bool set(Name node, std::string_view param, std::string_view value, Diagnostics& diagnostics);
    /// Does `NODE.PARAM=VALUE` as `--set` takes it; node names may contain dots.
    bool assign(std::string_view assignment, Diagnostics& diagnostics);
    /// Adds a node with default parameters. Null with an error reported if the type is unknown or the name is taken.
    NodeInstance* add(Name type, Name name, Diagnostics& diagnostics);

  private:
    friend class GraphEditor;
    friend class SceneAssembler;
    friend class SwitchBoard;

    const Registry* registry_;
    std::vector<std::unique_ptr<NodeScope>> scopes_;
    std::unordered_map<const NodeInstance*, NodeScope*> contents_;  ///< by procedural
    NodeInstance* options_ = nullptr;
    std::vector<SkippedNode> skipped_;
    std::size_t n_unknown_params_ = 0;
    Fingerprint fingerprint_;
    UnknownPolicy unknown_ = UnknownPolicy::Warn;  ///< as the scene was built
    bool assembled_ = false;
};

/// Makes the graph of a document. Never fails as a whole: what is wrong is reported and left at its default.
[[nodiscard]] SceneGraph build_graph(const Document& document, const Registry& registry,
                                     const BuildOptions& options, Diagnostics& diagnostics);

/// All nodes with the parameters that were set, links and user data, one a line; for tests and curious people.
[[nodiscard]] std::string dump(const SceneGraph& graph);

}  // namespace lightsieve
