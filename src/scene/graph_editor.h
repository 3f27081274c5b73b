// Fills and changes node instances: the private half of graph.h.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/graph.h"
#include "scene/param_read.h"

namespace lightsieve {

/// `color[4000000000] x` must not make an array of that size.
inline constexpr std::int64_t kMaxLinkedElement = 4096;

class GraphEditor {
  public:
    /// For the scene itself.
    GraphEditor(SceneGraph& graph, UnknownPolicy unknown, Diagnostics& diagnostics);
    /// For one of its scopes.
    GraphEditor(SceneGraph& graph, NodeScope& scope, UnknownPolicy unknown,
                Diagnostics& diagnostics);

    /// Adds all nodes of a document to an empty graph.
    void build(const Document& document);
    /// SceneGraph::set, ::add.
    bool set(NodeInstance& node, std::string_view param, std::string_view value);
    NodeInstance* add(const NodeType& type, Name name, bool named, SourceSpan where);
    /// Gives user data a value written as in a file. Where the node has none of that name it is declared as `fresh` says.
    bool set_user_data(NodeInstance& node, const UserData& fresh, std::string_view value);
    /// Takes nodes out of the scope: nothing refers to them any more, and nobody finds them.
    void disable(const std::vector<NodeInstance*>& nodes);

  private:
    /// A parameter with the texts that it lies in.
    struct Statement {
        const ParamText* param = nullptr;
        std::shared_ptr<const SourceText> name_source, value_source;
        [[nodiscard]] SourceSpan name_span() const {
            return {name_source, param->name_range.offset, param->name_range.length};
        }
        [[nodiscard]] SourceSpan value_span() const {
            return {value_source, param->value.range.offset, param->value.range.length};
        }
    };
    /// Reports of one kind are shown once with a count: scene files repeat the same unknown names in every node.
    struct Repeated {
        Error error;
        std::size_t count = 1;
    };
    /// What a link's text leads to.
    struct Found {
        const NodeInstance* node = nullptr;
        std::int32_t component = -1;
    };

    void add_nodes(const Document& document,
                   std::vector<std::pair<const NodeBlock*, NodeInstance*>>& read);
    void read_node(const Document& document, const NodeBlock& block, NodeInstance& node);
    void declare_user_data(const Document& document, const NodeBlock& block, NodeInstance& node);
    void check_user_data(const NodeInstance& node);

    void read_param(NodeInstance& node, const Statement& statement);
    void read_known(NodeInstance& node, const ParamInfo& info, const Statement& statement);
    bool read_user_data(NodeInstance& node, const Statement& statement);
    void unknown_param(const NodeInstance& node, const Statement& statement);
    bool check_suffixes(const NodeInstance& node, const ParamInfo& info,
                        const Statement& statement);
    void check_duplicate(const NodeInstance& node, const ParamInfo& info,
                         const Statement& statement);
    void check_pending(const NodeInstance& node, const ParamInfo& info,
                       const Statement& statement);

    bool reads_as_link(const ParamInfo& info, const ParamText& param,
                       const std::string& text) const;
    void add_link(NodeInstance& node, const ParamInfo& info, const Statement& statement,
                  const std::string& text);
    bool link_fits(const NodeInstance& node, const ParamInfo& info, const Found& source,
                   const SourceSpan& where);
    /// The node and component that `text` names. Reports and gives null if there is none.
    Found find_source(const std::string& text, const SourceSpan& where);
    const NodeInstance* find_node(const std::string& name, const SourceSpan& where);
    /// A warning if the node is there but of an unknown type, else a report of that severity.
    void missing_node(const std::string& name, const SourceSpan& where, Severity severity);

    void store(NodeInstance& node, const ParamInfo& info, const ParamText& param,
               TypedValues values);
    bool grow_array(NodeInstance& node, const ParamInfo& info, std::int64_t element,
                    const SourceSpan& where);
    void replace_array(NodeInstance& node, const ParamInfo& info, TypedValues values);
    ParamReader reader(Diagnostics& diagnostics, bool quiet_references);

    /// Reports circles of nodes of one kind that can be reached from `starts`; cuts them so that nobody walks in circles.
    void check_cycles(const std::vector<NodeInstance*>& starts, bool cut_them);
    void report_cycle(const std::vector<NodeInstance*>& circle);
    static void cut(NodeInstance& from, const NodeInstance& to);

    void repeated(const std::string& key, Error error);
    void report_repeated();

    /// The value of an edit; `source` becomes the text that it lies in.
    std::optional<ValueText> lex_edit(const ParamInfo& info, std::string_view param,
                                      std::string_view value,
                                      std::shared_ptr<const SourceText>& source);

    static std::vector<std::string> param_names(const NodeType& type);
    static std::size_t index_of(const NodeInstance& node, const ParamInfo& info);
    static std::byte* address(NodeInstance& node, const ParamInfo& info);

    SceneGraph& graph_;
    NodeScope& scope_;
    UnknownPolicy unknown_;
    Diagnostics* diagnostics_;  ///< a scratch one while a parameter without effect is read
    Diagnostics& all_diagnostics_;
    std::vector<Repeated> repeated_;
    std::map<std::string, std::size_t> repeated_index_;
    std::vector<bool> given_;  ///< of the node being read: parameters that have a whole value
    std::uint64_t run_bytes_ = 0;
    std::size_t n_compared_ = 0;                 ///< names looked at for "did you mean"
    std::vector<NodeInstance::Buffer> retired_;  ///< replaced arrays, kept for a roll-back
};

}  // namespace lightsieve
