#include "scene/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "scene/ass_read.h"
#include "scene/assignment.h"
#include "scene/graph_editor.h"
#include "scene/operator_context.h"
#include "scene/selection.h"

namespace lightsieve {
namespace {

/// Operators behind operators.
constexpr int kMaxOperatorDepth = 256;

std::string normal(const std::string& path) {
    return std::filesystem::path(path).lexically_normal().string();
}

template <class T>
T value_of(const NodeInstance& node, Name param, T fallback) {
    const T* value = node.find<T>(param);
    return value == nullptr ? fallback : *value;
}

bool is_procedural(const NodeInstance& node) { return node.type().name.view() == "procedural"; }

bool is_ass(const std::string& file) {
    return file.ends_with(".ass") || file.ends_with(".ass.gz");
}

}  // namespace

std::string scope_prefix(const NodeInstance& procedural) {
    const Name space = value_of<Name>(procedural, "namespace", {});
    return (space.empty() ? procedural.name() : space).str() + "^";
}

// ---- procedurals ----

class SceneAssembler {
  public:
    SceneAssembler(SceneGraph& graph, const AssembleOptions& options, Diagnostics& diagnostics)
        : graph_(graph), options_(options), diagnostics_(diagnostics) {}

    void run() {
        if (std::exchange(graph_.assembled_, true)) return;
        open_files_.push_back(normal(options_.scene_path));
        if (!options_.ignore_operators && graph_.options() != nullptr)
            scene_operator_ = value_of<NodeRef>(*graph_.options(), "operator", {});
        NodeScope& scene = *graph_.scopes_.front();
        cook(scene_operator_, scene, "");
        expand(scene, "", 0);
        report_unmet();
    }

  private:
    friend class Cook;

    /// What a part of an operator met so far.
    struct Use {
        SourceSpan where;
        std::string text;
        std::size_t n = 0;
        std::string hint;
    };

    void expand(NodeScope& scope, const std::string& prefix, int depth) {
        // Reading a file adds a scope and no nodes to this one.
        for (std::size_t i = 0; i < scope.nodes.size(); ++i)
            if (is_procedural(*scope.nodes[i]))
                open(*scope.nodes[i], scope, prefix + scope_prefix(*scope.nodes[i]), depth);
    }

    void open(const NodeInstance& node, NodeScope& outer, const std::string& prefix, int depth) {
        const std::optional<std::string> path = file_of(node, outer);
        if (!path) return;
        const auto operator_of_node =
            options_.ignore_operators ? NodeRef{} : value_of<NodeRef>(node, "operator", {});
        const bool share = options_.share_procedurals && !scene_operator_ && !operator_of_node &&
                           value_of(node, "auto_instancing", true);
        if (share)
            if (const auto known = shared_.find({&outer, *path}); known != shared_.end()) {
                graph_.contents_[&node] = known->second;
                return;
            }
        if (!may_open(node, *path, depth)) return;
        ++n_read_;
        NodeScope& inner = read(*path, outer);
        graph_.contents_[&node] = &inner;
        if (share) shared_[{&outer, *path}] = &inner;
        open_files_.push_back(normal(*path));
        // The procedural's own operator knows its contents by their own names.
        cook(operator_of_node, inner, "");
        cook(scene_operator_, inner, prefix);
        expand(inner, prefix, depth + 1);
        open_files_.pop_back();
    }

    NodeScope& read(const std::string& path, const NodeScope& outer) {
        const Document document = read_ass_file(path, diagnostics_);
        NodeScope& scope = *graph_.scopes_.emplace_back(std::make_unique<NodeScope>());
        scope.outer = &outer;
        scope.file = path;
        edit(scope).build(document);
        return scope;
    }
    GraphEditor edit(NodeScope& scope) { return {graph_, scope, graph_.unknown_, diagnostics_}; }

    /// The file that a procedural reads; nothing with a warning if there is none that we can read.
    std::optional<std::string> file_of(const NodeInstance& node, const NodeScope& outer) {
        Name filename = value_of<Name>(node, "filename", {});
        Name param = "filename";
        if (filename.empty() && !value_of<Name>(node, "dso", {}).empty())
            filename = value_of<Name>(node, param = "dso", {});
        const auto leave_out = [&](Code code, const std::string& problem, std::string hint) {
            diagnostics_.warning(code, problem + "; nothing of it is shown", node.where(param),
                                 std::move(hint));
            return std::nullopt;
        };
        const std::string label = fmt::format("the procedural \"{}\"", node.name().view());
        if (filename.empty())
            return leave_out(Code::FileNotFound, label + " names no file",
                             "give \"filename\" the name of an .ass file");
        if (!is_ass(filename.str()))
            return leave_out(
                Code::FileFormat,
                fmt::format("{} reads \"{}\", which is no .ass file", label, filename.view()),
                "files of other kinds are not supported: convert it to .ass");
        const std::string& from = outer.outer == nullptr ? options_.scene_path : outer.file;
        std::optional<std::string> path =
            options_.find_file ? options_.find_file(filename.view(), from) : std::nullopt;
        if (!path)
            return leave_out(
                Code::FileNotFound,
                fmt::format("{} reads \"{}\", which does not exist", label, filename.view()),
                "looked for beside the scene and in procedural_searchpath");
        return path;
    }

    bool may_open(const NodeInstance& node, const std::string& path, int depth) {
        const auto found = std::find(open_files_.begin(), open_files_.end(), normal(path));
        if (found != open_files_.end()) {
            std::string chain;
            for (auto file = found; file != open_files_.end(); ++file)
                chain += "\"" + *file + "\" contains ";
            diagnostics_.error(Code::IncludeCycle,
                               "a file contains itself: " + chain + "\"" + *found + "\"",
                               node.where("filename"), "take one of the procedurals out");
            return false;
        }
        if (depth < kMaxProceduralDepth && n_read_ < kMaxProceduralFiles) return true;
        diagnostics_.error(
            Code::LimitIncludes, "the procedural file \"" + path + "\" is not read",
            node.where("filename"),
            fmt::format("at most {} files (kMaxProceduralFiles), {} inside one another "
                        "(kMaxProceduralDepth)",
                        kMaxProceduralFiles, kMaxProceduralDepth));
        return false;
    }

    // Operators; below.
    void cook(NodeRef last, NodeScope& scope, const std::string& prefix);
    void report_unmet();

    SceneGraph& graph_;
    const AssembleOptions& options_;
    Diagnostics& diagnostics_;
    NodeRef scene_operator_;
    std::vector<std::string> open_files_;
    std::size_t n_read_ = 0;
    std::map<std::pair<const NodeScope*, std::string>, NodeScope*> shared_;
    std::map<std::pair<const NodeInstance*, std::string>, Use> uses_;
    std::vector<std::pair<const NodeInstance*, std::string>> use_order_;
    std::set<const NodeInstance*> bad_selections_, bad_inputs_;
    std::map<std::string, const NodeScope*> operator_files_;  ///< null: could not be read
};

// ---- operators ----

/// One run of a chain of operators over one scope.
class Cook {
  public:
    Cook(SceneAssembler& assembler, NodeScope& scope, std::string prefix)
        : all_(assembler), scope_(scope), prefix_(std::move(prefix)) {}

    void run(const NodeInstance& node);

  private:
    class Context;
    struct Collection {
        Name name;
        Selection selection;
    };

    [[nodiscard]] bool in_collection(Name name, const Selection::Candidate& candidate,
                                     std::size_t n_known) const;
    [[nodiscard]] const NodeScope* read_operators(const std::string& filename,
                                                  const SourceSpan& where);

    SceneAssembler& all_;
    NodeScope& scope_;
    std::string prefix_;
    std::vector<Collection> collections_;
    std::set<const NodeInstance*> done_;
    int depth_ = 0;
};

class Cook::Context final : public OperatorContext {
  public:
    Context(Cook& cook, const NodeInstance& node) : cook_(cook), node_(node) {}

    Diagnostics& diagnostics() override { return cook_.all_.diagnostics_; }
    SourceSpan where(Name param) const override { return node_.where(param); }

    void cook(NodeRef input) override {
        if (!input) return;
        if (input.node->type().edit_scene != nullptr) return cook_.run(*input.node);
        if (cook_.all_.bad_inputs_.insert(input.node).second)
            diagnostics().warning(
                Code::LinkType,
                fmt::format("\"{}\" is a {}, not an operator: it is passed over",
                            input.node->name().view(), input.node->type().name.view()),
                where("inputs"));
    }

    void cook_file(std::string_view filename, Name target) override {
        const NodeScope* file = cook_.read_operators(std::string(filename), where("filename"));
        if (file == nullptr) return;
        if (!target.empty()) {
            const NodeInstance* last = file->find(target);
            if (last != nullptr) return cook({last});
            diagnostics().warning(
                Code::UnknownReference,
                fmt::format("\"{}\" has no operator \"{}\"", filename, target.view()),
                where("target"));
            return;
        }
        std::set<const NodeInstance*> inputs;
        for (const auto& node : file->nodes)
            for (const NodeInstance* input : node->references())
                inputs.insert(input);
        for (const auto& node : file->nodes)
            if (node->type().edit_scene != nullptr && !inputs.contains(node.get()))
                cook({node.get()});
    }

    std::vector<NodeInstance*> selected() override {
        const auto selection = parsed();
        std::vector<NodeInstance*> out;
        if (!selection) return out;
        const auto collections = [&](Name name, const Selection::Candidate& candidate) {
            return cook_.in_collection(name, candidate, cook_.collections_.size());
        };
        for (const auto& node : cook_.scope_.nodes)
            if (selection->matches({node.get(), cook_.prefix_}, collections))
                out.push_back(node.get());
        return out;
    }

    void define_collection(Name name) override {
        if (auto selection = parsed()) cook_.collections_.push_back({name, std::move(*selection)});
    }

    bool assign(NodeInstance& node, std::string_view text) override {
        Assignment assignment;
        try {
            assignment = parse_assignment(text, where("assignment"));
        } catch (const InputError& e) {
            for (Error error : e.errors()) {
                error.severity = Severity::Warning;
                diagnostics().add(std::move(error));
            }
            return true;  // told already
        }
        const std::string base = assignment.param.substr(0, assignment.param.find_first_of(".["));
        GraphEditor editor = cook_.all_.edit(cook_.scope_);
        if (node.type().find(base) != nullptr) {
            editor.set(node, assignment.param, assignment.value);
            return true;
        }
        const UserData* known = node.find_user_data(base);
        if (known == nullptr && !assignment.declared) return false;
        UserData fresh;
        fresh.name = base;
        fresh.user_class = assignment.user_class;
        fresh.is_array = assignment.is_array;
        fresh.type = known != nullptr ? known->type : *assignment.declared;
        fresh.where = where("assignment");
        editor.set_user_data(node, fresh, assignment.value);
        return true;
    }

    void set(NodeInstance& node, std::string_view param, std::string_view value) override {
        cook_.all_.edit(cook_.scope_).set(node, param, value);
    }

    void disable(const std::vector<NodeInstance*>& nodes) override {
        cook_.all_.edit(cook_.scope_).disable(nodes);
    }

    void met(std::string_view part, std::size_t n,
             const std::vector<std::string>& known) override {
        const std::pair key(&node_, std::string(part));
        const auto [use, added] = cook_.all_.uses_.try_emplace(key);
        if (added) cook_.all_.use_order_.push_back(key);
        use->second.n += n;
        if (use->second.n > 0) return;
        if (!part.empty()) {
            const std::string_view name = part.substr(0, part.find_first_of("=.[ "));
            use->second.text = fmt::format(
                "the assignment \"{}\" meets no node that has such a "
                "parameter",
                part);
            use->second.where = where("assignment");
            if (use->second.hint.empty()) use->second.hint = did_you_mean(name, known);
            return;
        }
        use->second.text =
            fmt::format("the selection of \"{}\" meets no node", node_.name().view());
        use->second.where = where("selection");
        if (!use->second.hint.empty()) return;
        std::vector<std::string> names;
        for (const auto& other : cook_.scope_.nodes)
            if (other->is_named()) names.push_back(other->name().str());
        if (const auto selection = parsed())
            for (const std::string& pattern : selection->patterns())
                if (use->second.hint.empty()) use->second.hint = did_you_mean(pattern, names);
    }

  private:
    /// The operator's selection; nothing with a warning, once, if it cannot be read.
    std::optional<Selection> parsed() {
        const Name text = value_of<Name>(node_, "selection", {});
        try {
            return Selection::parse(text.view(), where("selection"));
        } catch (const InputError& e) {
            if (!cook_.all_.bad_selections_.insert(&node_).second) return std::nullopt;
            for (Error error : e.errors()) {
                error.severity = Severity::Warning;
                error.message += fmt::format("; \"{}\" does nothing", node_.name().view());
                diagnostics().add(std::move(error));
            }
            return std::nullopt;
        }
    }

    Cook& cook_;
    const NodeInstance& node_;
};

void Cook::run(const NodeInstance& node) {
    // Two operators may name one input, which acts once.
    if (!done_.insert(&node).second) return;
    if (++depth_ > kMaxOperatorDepth) {
        all_.diagnostics_.error(
            Code::CyclicLink,
            fmt::format("operators are linked more than {} deep", kMaxOperatorDepth),
            node.where("inputs"), "shorten the chain of inputs");
    } else {
        Context context(*this, node);
        node.type().edit_scene(node.block(), context);
    }
    --depth_;
}

/// Collections may name those that were defined before them.
bool Cook::in_collection(Name name, const Selection::Candidate& candidate,
                         std::size_t n_known) const {
    for (std::size_t i = n_known; i-- > 0;) {
        if (collections_[i].name != name) continue;
        const auto earlier = [this, i](Name other, const Selection::Candidate& c) {
            return in_collection(other, c, i);
        };
        if (collections_[i].selection.matches(candidate, earlier)) return true;
    }
    return false;
}

const NodeScope* Cook::read_operators(const std::string& filename, const SourceSpan& where) {
    const auto [known, added] = all_.operator_files_.try_emplace(filename, nullptr);
    if (!added) return known->second;
    const std::optional<std::string> path =
        all_.options_.find_file ? all_.options_.find_file(filename, all_.options_.scene_path)
                                : std::nullopt;
    if (!path) {
        all_.diagnostics_.warning(
            Code::FileNotFound,
            fmt::format("the file of operators \"{}\" does not exist", filename), where,
            "its operators do nothing");
        return nullptr;
    }
    return known->second = &all_.read(*path, *all_.graph_.scopes().front());
}

void SceneAssembler::cook(NodeRef last, NodeScope& scope, const std::string& prefix) {
    if (!last) return;
    if (last.node->type().edit_scene == nullptr) {
        if (bad_inputs_.insert(last.node).second)
            diagnostics_.warning(
                Code::LinkType,
                fmt::format("\"{}\" is a {}, not an operator: it does nothing",
                            last.node->name().view(), last.node->type().name.view()),
                graph_.options() == nullptr ? SourceSpan{} : graph_.options()->where("operator"));
        return;
    }
    Cook(*this, scope, prefix).run(*last.node);
}

void SceneAssembler::report_unmet() {
    for (const auto& key : use_order_) {
        const Use& use = uses_[key];
        if (use.n > 0 || bad_selections_.contains(key.first)) continue;
        // Where an operator meets nothing at all its assignments need not be told.
        const auto whole = uses_.find({key.first, ""});
        if (!key.second.empty() && whole != uses_.end() && whole->second.n == 0) continue;
        diagnostics_.warning(Code::OperatorUnused, use.text, use.where, use.hint);
    }
}

void assemble(SceneGraph& graph, const AssembleOptions& options, Diagnostics& diagnostics) {
    SceneAssembler(graph, options, diagnostics).run();
}

}  // namespace lightsieve
