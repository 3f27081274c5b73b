#include "scene/graph_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "scene/ass_lexer.h"
#include "scene/ass_packed.h"
#include "scene/ass_write.h"
#include "scene/missing_nodes.h"

namespace lightsieve {
namespace {

/// Parameters of older Arnold versions that exporters still write and that never had an effect on what we render: quiet. An
/// empty node type stands for all.
struct OldParam {
    std::string_view type, param;
};
constexpr std::array kOldParams{
    OldParam{"", "opaque"},
    OldParam{"", "sss_use_autobump"},
    OldParam{"options", "procedural_searchpath"},
    OldParam{"persp_camera", "aspect_ratio"},
    OldParam{"ortho_camera", "aspect_ratio"},
};

/// Names that are compared with misspelt ones before guessing ends.
constexpr std::size_t kMaxCompared = 1000000;

bool is_old_param(Name type, Name param) {
    return std::any_of(kOldParams.begin(), kOldParams.end(), [&](const OldParam& old) {
        return old.param == param.view() && (old.type.empty() || old.type == type.view());
    });
}

/// Whether nodes of a type have parameters and outputs that only their own source knows.
bool has_inputs_of_its_own(Name type) { return type.view() == "osl"; }

bool is_reference(ParamType type) { return type == ParamType::Node || type == ParamType::Closure; }

/// Every Array<T> has the same layout.
using AnyArray = Array<std::byte>;
AnyArray& array_at(std::byte* address) { return *reinterpret_cast<AnyArray*>(address); }

std::string label_of(const NodeType& type, const ParamText& param) {
    std::string out = fmt::format("{}.{}", type.name.view(), param.name.view());
    if (param.element >= 0) out += fmt::format("[{}]", param.element);
    if (param.component >= 0) out += fmt::format(".{}", "rgba"[param.component]);
    return out;
}

/// More special links come later.
int speciality(const Link& link) { return link.component >= 0 ? 2 : link.element >= 0 ? 1 : 0; }

}  // namespace

GraphEditor::GraphEditor(SceneGraph& graph, UnknownPolicy unknown, Diagnostics& diagnostics)
    : GraphEditor(graph, *graph.scopes_.front(), unknown, diagnostics) {}

GraphEditor::GraphEditor(SceneGraph& graph, NodeScope& scope, UnknownPolicy unknown,
                         Diagnostics& diagnostics)
    : graph_(graph),
      scope_(scope),
      unknown_(unknown),
      diagnostics_(&diagnostics),
      all_diagnostics_(diagnostics) {}

std::vector<std::string> GraphEditor::param_names(const NodeType& type) {
    std::vector<std::string> names;
    for (const ParamInfo& info : type.params)
        names.push_back(info.name.str());
    return names;
}

std::size_t GraphEditor::index_of(const NodeInstance& node, const ParamInfo& info) {
    return static_cast<std::size_t>(&info - node.type().params.data());
}
std::byte* GraphEditor::address(NodeInstance& node, const ParamInfo& info) {
    return node.block_ + info.offset;
}

// ---- nodes ----

void GraphEditor::build(const Document& document) {
    graph_.unknown_ = unknown_;
    for (const auto& source : document.sources())
        graph_.fingerprint_.add(source->text);
    std::vector<std::pair<const NodeBlock*, NodeInstance*>> read;
    add_nodes(document, read);
    // All nodes exist before the first link is read: links point forward and backward.
    for (const auto& [block, node] : read)
        read_node(document, *block, *node);
    report_repeated();
    std::vector<NodeInstance*> all;
    for (const auto& node : scope_.nodes)
        all.push_back(node.get());
    check_cycles(all, true);
}

void GraphEditor::add_nodes(const Document& document,
                            std::vector<std::pair<const NodeBlock*, NodeInstance*>>& read) {
    for (const NodeBlock& block : document.nodes()) {
        const SourceSpan where = document.span(block.type_range);
        const NodeType* type = graph_.registry_->find(block.type);
        if (type == nullptr) {
            graph_.skipped_.push_back({block.type, block.name, where});
            if (!block.name.empty()) scope_.skipped_types.emplace(block.name, block.type);
            if (unknown_ == UnknownPolicy::Ignore) continue;
            Error error{
                Code::UnknownNode,
                fmt::format("node type \"{}\" is not known: it is skipped", block.type.view()),
                where,
                {},
                {},
                unknown_ == UnknownPolicy::Error ? Severity::Error : Severity::Warning};
            if (!repeated_index_.contains("node " + block.type.str())) {
                error.hint = lost_without(block.type.view());
                if (error.hint.empty())
                    error.hint = did_you_mean(block.type.view(), graph_.registry_->names());
            }
            repeated("node " + block.type.str(), std::move(error));
            continue;
        }
        // What a procedural reads brings no options of its own.
        if (type->kind == NodeKind::Options && scope_.outer != nullptr) continue;
        // Arnold has one options node: further blocks add to it.
        if (type->kind == NodeKind::Options && graph_.options_ != nullptr) {
            read.emplace_back(&block, graph_.options_);
            continue;
        }
        const auto named = scope_.names.find(block.name);
        const bool taken = !block.name.empty() && named != scope_.names.end();
        if (const NodeInstance* twin = taken ? named->second : nullptr; twin != nullptr) {
            Error error{Code::DuplicateName,
                        fmt::format("two nodes are named \"{}\": links go to the first",
                                    block.name.view()),
                        where,
                        {},
                        {},
                        Severity::Warning};
            error.notes.push_back({"the first is", twin->where()});
            diagnostics_->add(std::move(error));
        }
        read.emplace_back(&block, add(*type, block.name, !block.name.empty(), where));
    }
}

NodeInstance* GraphEditor::add(const NodeType& type, Name name, bool named, SourceSpan where) {
    const bool is_options = type.kind == NodeKind::Options;
    if (!named)
        name = is_options ? Name("options")
                          : Name(fmt::format("<{} {}>", type.name.view(), scope_.nodes.size()));
    auto node = std::make_unique<NodeInstance>(type, name, std::move(where));
    node->named_ = named;
    if (named || is_options) scope_.names.emplace(name, node.get());
    if (is_options) {
        scope_.names.emplace(Name("options"), node.get());
        graph_.options_ = node.get();
    }
    scope_.nodes.push_back(std::move(node));
    return scope_.nodes.back().get();
}

void GraphEditor::read_node(const Document& document, const NodeBlock& block, NodeInstance& node) {
    declare_user_data(document, block, node);
    given_.assign(node.type().params.size(), false);
    for (const ParamText& param : block.params) {
        if (param.name.view() == "name" && param.element < 0 && param.component < 0) continue;
        read_param(node, {&param, document.sources()[param.name_range.source],
                          document.sources()[param.value.range.source]});
    }
    check_user_data(node);
}

// ---- user data ----

void GraphEditor::declare_user_data(const Document& document, const NodeBlock& block,
                                    NodeInstance& node) {
    for (const DeclareText& declare : block.declares) {
        const SourceSpan where = document.span(declare.statement);
        const ParamInfo* own = node.type().find(declare.name);
        // Exporters declare what older versions of a node did not have.
        const bool same = own != nullptr && own->type == declare.type &&
                          own->is_array == declare.is_array &&
                          declare.user_class == UserDataClass::Constant;
        if (same) continue;
        if (own != nullptr) {
            diagnostics_->warning(
                Code::UserData,
                fmt::format("{} has a parameter \"{}\" of its own: the declaration is ignored",
                            node.type().name.view(), declare.name.view()),
                where);
            continue;
        }
        if (node.find_user_data(declare.name) != nullptr) {
            diagnostics_->warning(
                Code::UserData,
                fmt::format("user data \"{}\" is declared twice: the first declaration counts",
                            declare.name.view()),
                where);
            continue;
        }
        UserData data;
        data.name = declare.name;
        data.user_class = declare.user_class;
        data.is_array = declare.is_array;
        data.type = declare.type == ParamType::Enum ? ParamType::Int : declare.type;
        data.where = where;
        node.user_data_.push_back(std::move(data));
    }
}

bool GraphEditor::read_user_data(NodeInstance& node, const Statement& statement) {
    const std::string_view name = statement.param->name.view();
    UserData* data = nullptr;
    bool indices = false;
    for (UserData& candidate : node.user_data_) {
        if (candidate.name.view() == name)
            data = &candidate;
        else if (data == nullptr && name.size() == candidate.name.view().size() + 4 &&
                 name.starts_with(candidate.name.view()) && name.ends_with("idxs")) {
            data = &candidate;
            indices = true;
        }
    }
    if (data == nullptr) return false;
    if (data->name.view() == name) indices = false;
    const SourceSpan where = statement.value_span();
    const std::optional<std::string> text =
        single_text(statement.param->value, *statement.value_source);
    if (text && !indices && data->type != ParamType::String && data->type != ParamType::Node &&
        !(data->type == ParamType::Bool && parse_bool(*text))) {
        diagnostics_->warning(
            Code::UserData,
            fmt::format("user data \"{}\" cannot be linked: \"{}\" is ignored", name, *text),
            where);
        return true;
    }
    const ReadTarget target{indices ? ParamType::UInt : data->type, true, nullptr,
                            fmt::format("user data \"{}\"", name)};
    std::optional<TypedValues> values =
        reader(*diagnostics_, true).read(statement.param->value, statement.value_source, target);
    if (!values) return true;
    node.user_arrays_.push_back(std::move(values->data));
    const std::byte* bytes = node.user_arrays_.back().get();
    if (indices) {
        data->indices = {reinterpret_cast<const std::uint32_t*>(bytes), values->n, values->n_keys};
        return true;
    }
    data->data = bytes;
    data->n = values->n;
    data->n_keys = values->n_keys;
    data->where = where;
    if (data->user_class == UserDataClass::Constant && !data->is_array && data->n > 1)
        diagnostics_->warning(
            Code::UserData,
            fmt::format("constant user data \"{}\" has {} values: the first is used", name,
                        data->n),
            where);
    return true;
}

void GraphEditor::check_user_data(const NodeInstance& node) {
    for (const UserData& data : node.user_data()) {
        if (data.user_class != UserDataClass::Indexed || data.n == 0) continue;
        const std::string idxs = data.name.str() + "idxs";
        if (data.indices.empty()) {
            diagnostics_->warning(
                Code::UserData,
                fmt::format("indexed user data \"{}\" has no \"{}\"", data.name.view(), idxs),
                data.where);
            continue;
        }
        const auto all = data.indices.first_key();
        const std::uint32_t highest = *std::max_element(all.begin(), all.end());
        if (highest >= data.n)
            diagnostics_->error(Code::UserData,
                                fmt::format("\"{}\" asks for value {} of \"{}\", which has {}",
                                            idxs, highest, data.name.view(), data.n),
                                data.where);
    }
}

// ---- parameters ----

void GraphEditor::read_param(NodeInstance& node, const Statement& statement) {
    const ParamInfo* info = node.type().find(statement.param->name);
    if (info == nullptr) {
        if (!read_user_data(node, statement)) unknown_param(node, statement);
        return;
    }
    if (!info->ignored) return read_known(node, *info, statement);
    // Without effect: whatever is wrong with it does not matter.
    Diagnostics scratch;
    diagnostics_ = &scratch;
    read_known(node, *info, statement);
    diagnostics_ = &all_diagnostics_;
}

void GraphEditor::unknown_param(const NodeInstance& node, const Statement& statement) {
    const NodeType& type = node.type();
    const Name name = statement.param->name;
    if (is_old_param(type.name, name) || has_inputs_of_its_own(type.name)) return;
    ++graph_.n_unknown_params_;
    if (unknown_ == UnknownPolicy::Ignore) return;
    const std::string key = fmt::format("param {}.{}", type.name.view(), name.view());
    Error error{Code::UnknownParam,
                fmt::format("{} has no parameter \"{}\"", type.name.view(), name.view()),
                statement.name_span(),
                {},
                {},
                unknown_ == UnknownPolicy::Error ? Severity::Error : Severity::Warning};
    if (!repeated_index_.contains(key)) {
        const std::string guess = did_you_mean(name.view(), param_names(type));
        error.hint = fmt::format("{}`lightsieve nodes {}` lists all of them",
                                 guess.empty() ? "" : guess + "   ", type.name.view());
        error.notes.push_back(
            {fmt::format("node \"{}\" starts", node.name().view()), node.where()});
    }
    repeated(key, std::move(error));
}

bool GraphEditor::check_suffixes(const NodeInstance& node, const ParamInfo& info,
                                 const Statement& statement) {
    const ParamText& param = *statement.param;
    if (param.element >= 0 && !info.is_array) {
        diagnostics_->error(Code::WrongType,
                            fmt::format("{}.{} is no array: it has no elements",
                                        node.type().name.view(), info.name.view()),
                            statement.name_span());
        return false;
    }
    if (param.component < 0) return true;
    const bool has_components = info.type == ParamType::Rgb || info.type == ParamType::Rgba ||
                                info.type == ParamType::Vector || info.type == ParamType::Vector2;
    if (!has_components ||
        static_cast<std::size_t>(param.component) >= component_count(info.type)) {
        diagnostics_->error(
            Code::WrongType,
            fmt::format("{}.{} is {}: it has no such component", node.type().name.view(),
                        info.name.view(), type_text(info.type)),
            statement.name_span());
        return false;
    }
    if (info.is_array && param.element < 0) {
        diagnostics_->error(Code::WrongType,
                            fmt::format("{}.{} is an array: a component needs an element",
                                        node.type().name.view(), info.name.view()),
                            statement.name_span(),
                            fmt::format("for example {}[0].r", info.name.view()));
        return false;
    }
    return true;
}

void GraphEditor::read_known(NodeInstance& node, const ParamInfo& info,
                             const Statement& statement) {
    const ParamText& param = *statement.param;
    if (!check_suffixes(node, info, statement)) return;
    const std::size_t index = index_of(node, info);
    const bool whole = param.element < 0 && param.component < 0;
    check_duplicate(node, info, statement);
    const std::optional<std::string> text = single_text(param.value, *statement.value_source);
    if (text && reads_as_link(info, param, *text)) {
        add_link(node, info, statement, *text);
    } else {
        ReadTarget target{info.type, info.is_array && param.element < 0, &info,
                          label_of(node.type(), param)};
        if (param.component >= 0) target.type = ParamType::Float;
        std::optional<TypedValues> values =
            reader(*diagnostics_, false).read(param.value, statement.value_source, target);
        if (!values) return;
        if (param.element >= 0 && !grow_array(node, info, param.element, statement.name_span()))
            return;
        store(node, info, param, std::move(*values));
        if (whole) given_[index] = true;
    }
    if (whole || !node.set_[index]) node.written_[index] = statement.value_span();
    node.set_[index] = true;
    check_pending(node, info, statement);
}

void GraphEditor::check_duplicate(const NodeInstance& node, const ParamInfo& info,
                                  const Statement& statement) {
    const ParamText& param = *statement.param;
    const bool whole = param.element < 0 && param.component < 0;
    if (!whole || !given_[index_of(node, info)]) return;
    const std::optional<std::string> text = single_text(param.value, *statement.value_source);
    if (text && reads_as_link(info, param, *text))
        return;  // a value and a link may stand side by side
    diagnostics_->lint(
        Code::DuplicateParam,
        fmt::format("{}.{} is given twice", node.type().name.view(), info.name.view()),
        statement.name_span(), "the later value counts");
}

void GraphEditor::check_pending(const NodeInstance& node, const ParamInfo& info,
                                const Statement& statement) {
    if (!info.pending) return;
    if (node.has_default(info.name) && !node.is_linked(info.name)) return;
    const std::string name = fmt::format("{}.{}", node.type().name.view(), info.name.view());
    repeated("pending " + name, {Code::ParamPending,
                                 fmt::format("{} is not supported yet: it has no effect", name),
                                 statement.value_span(),
                                 {},
                                 {},
                                 Severity::Warning});
}

void GraphEditor::store(NodeInstance& node, const ParamInfo& info, const ParamText& param,
                        TypedValues values) {
    if (info.is_array && param.element < 0) {
        replace_array(node, info, std::move(values));
        return;
    }
    if (values.n == 0) return;  // an array of nothing for one value: the default stays
    std::byte* at = address(node, info);
    // grow_array has made the array the instance's own.
    if (param.element >= 0)
        at = node.arrays_[index_of(node, info)].get() +
             static_cast<std::size_t>(param.element) * type_size(info.type);
    std::size_t size = type_size(info.type);
    if (param.component >= 0) {
        at += static_cast<std::size_t>(param.component) * sizeof(float);
        size = sizeof(float);
    }
    std::memcpy(at, values.data.get(), size);
}

void GraphEditor::replace_array(NodeInstance& node, const ParamInfo& info, TypedValues values) {
    NodeInstance::Buffer& buffer = node.arrays_[index_of(node, info)];
    if (buffer) retired_.push_back(std::move(buffer));
    buffer = std::move(values.data);
    array_at(address(node, info)) = {buffer.get(), values.n, values.n_keys};
}

bool GraphEditor::grow_array(NodeInstance& node, const ParamInfo& info, std::int64_t element,
                             const SourceSpan& where) {
    const AnyArray old = array_at(address(node, info));
    const bool inside = element < std::int64_t{old.n};
    if (inside && node.arrays_[index_of(node, info)]) return true;
    if (!inside && (element >= kMaxLinkedElement || old.n_keys > 1)) {
        diagnostics_->error(Code::BadValue,
                            fmt::format("{}.{} has {} elements: there is none with number {}",
                                        node.type().name.view(), info.name.view(), old.n, element),
                            where);
        return false;
    }
    const std::size_t size = type_size(info.type);
    TypedValues grown;
    grown.n = inside ? old.n : static_cast<std::uint32_t>(element + 1);
    grown.n_keys = old.n_keys;
    grown.data = std::make_unique<std::byte[]>(std::size_t{grown.n} * grown.n_keys * size);
    if (old.n > 0) std::memcpy(grown.data.get(), old.data, std::size_t{old.n} * old.n_keys * size);
    replace_array(node, info, std::move(grown));
    return true;
}

ParamReader GraphEditor::reader(Diagnostics& diagnostics, bool quiet_references) {
    return ParamReader(
        [this, quiet_references](const std::string& name,
                                 const SourceSpan& where) -> const NodeInstance* {
            return quiet_references ? scope_.find(Name(name)) : find_node(name, where);
        },
        run_bytes_, diagnostics);
}

// ---- links ----

bool GraphEditor::reads_as_link(const ParamInfo& info, const ParamText& param,
                                const std::string& text) const {
    if (is_reference(info.type)) return false;
    if (info.type == ParamType::String) {
        // A text, unless it is the name of a node that gives texts.
        const NodeInstance* node = scope_.find(Name(text));
        return node != nullptr && node->type().output == OutputType::String;
    }
    if (param.component >= 0) return true;
    if (info.type == ParamType::Bool && parse_bool(text)) return false;
    if (info.type == ParamType::Enum && find_enumerator(info, text) >= 0) return false;
    // A word that is neither a choice nor a node is more likely a misspelt choice.
    const bool few_words = info.type == ParamType::Bool || info.type == ParamType::Enum;
    return !few_words || text.empty() || text == "NULL" || scope_.find(Name(text)) != nullptr;
}

void GraphEditor::add_link(NodeInstance& node, const ParamInfo& info, const Statement& statement,
                           const std::string& text) {
    const ParamText& param = *statement.param;
    if (text.empty() || text == "NULL") return;  // no node: the value stays
    const SourceSpan where = statement.value_span();
    const Found found = find_source(text, where);
    if (found.node == nullptr || !link_fits(node, info, found, where)) return;
    Link link{
        &info,           static_cast<std::int32_t>(std::min(param.element, kMaxLinkedElement)),
        param.component, found.node,
        found.component, where};
    // A name in the place of an array is a link of its only element.
    if (info.is_array && link.element < 0) link.element = 0;
    if (info.is_array &&
        !grow_array(node, info, info.is_array && param.element < 0 ? 0 : param.element,
                    statement.name_span()))
        return;
    std::erase_if(node.links_, [&](const Link& old) {
        return old.param == link.param && old.element == link.element &&
               old.component == link.component;
    });
    const auto place =
        std::find_if(node.links_.begin(), node.links_.end(),
                     [&](const Link& other) { return speciality(other) > speciality(link); });
    node.links_.insert(place, std::move(link));
}

bool GraphEditor::link_fits(const NodeInstance& node, const ParamInfo& info, const Found& source,
                            const SourceSpan& where) {
    const NodeType& type = source.node->type();
    const std::string target = fmt::format("{}.{}", node.type().name.view(), info.name.view());
    if (type.output == OutputType::None) {
        diagnostics_->error(Code::LinkType,
                            fmt::format("{} is linked to \"{}\", a {}, which gives no value",
                                        target, source.node->name().view(), type.name.view()),
                            where);
        return false;
    }
    const auto wants = [&](ParamType param, OutputType output) {
        return (info.type == param) != (type.output == output);
    };
    if (wants(ParamType::Matrix, OutputType::Matrix) ||
        wants(ParamType::String, OutputType::String)) {
        diagnostics_->warning(
            Code::LinkType,
            fmt::format("{} is a {}, which \"{}\", a {}, does not give: the link is ignored",
                        target, type_text(info.type), source.node->name().view(),
                        type.name.view()),
            where);
        return false;
    }
    if (type.output == OutputType::Closure) {
        diagnostics_->warning(
            Code::LinkType,
            fmt::format("{} wants a {}, but \"{}\", a {}, gives a closure: the link is ignored",
                        target, type_text(info.type), source.node->name().view(),
                        type.name.view()),
            where);
        return false;
    }
    return true;
}

GraphEditor::Found GraphEditor::find_source(const std::string& text, const SourceSpan& where) {
    if (const NodeInstance* node = scope_.find(Name(text))) return {node, -1};
    // Names may contain dots, so only now is the last one looked at.
    const std::size_t dot = text.rfind('.');
    if (dot == std::string::npos || dot == 0 || scope_.skipped_types.contains(Name(text))) {
        missing_node(text, where, Severity::Error);
        return {};
    }
    const std::string name = text.substr(0, dot), suffix = text.substr(dot + 1);
    const NodeInstance* node = scope_.find(Name(name));
    if (node == nullptr) {
        missing_node(scope_.skipped_types.contains(Name(name)) ? name : text, where,
                     Severity::Error);
        return {};
    }
    const std::int8_t component = parse_component(suffix);
    if (component >= 0) return {node, component};
    if (has_inputs_of_its_own(node->type().name)) return {node, -1};
    diagnostics_->error(
        Code::UnknownReference,
        fmt::format("\"{}\", a {}, has no output \"{}\"", name, node->type().name.view(), suffix),
        where, "components are .r .g .b .a or .x .y .z");
    return {};
}

const NodeInstance* GraphEditor::find_node(const std::string& name, const SourceSpan& where) {
    if (const NodeInstance* node = scope_.find(Name(name))) return node;
    // Arnold renders shapes whose shader is missing, and exported scenes have such: a value that is missing is worse.
    missing_node(name, where,
                 unknown_ == UnknownPolicy::Error ? Severity::Error : Severity::Warning);
    return nullptr;
}

void GraphEditor::missing_node(const std::string& name, const SourceSpan& where,
                               Severity severity) {
    const NodeScope* scope = &scope_;
    while (scope->outer != nullptr && !scope->skipped_types.contains(Name(name)))
        scope = scope->outer;
    const auto skipped = scope->skipped_types.find(Name(name));
    if (skipped != scope->skipped_types.end()) {
        if (unknown_ != UnknownPolicy::Ignore)
            diagnostics_->warning(
                Code::UnknownReference,
                fmt::format(
                    "\"{}\" is of the unknown node type \"{}\": the reference to it is ignored",
                    name, skipped->second.view()),
                where);
        return;
    }
    std::string hint;
    // Comparing with every name of a large scene again and again would take longer than reading it.
    if (n_compared_ < kMaxCompared) {
        std::vector<std::string> names;
        for (const NodeScope* from = &scope_; from != nullptr; from = from->outer)
            for (const auto& [known, node] : from->names)
                names.push_back(known.str());
        n_compared_ += names.size();
        hint = did_you_mean(name, names);
    }
    diagnostics_->add({Code::UnknownReference,
                       fmt::format("the scene has no node \"{}\"", name),
                       where,
                       hint,
                       {},
                       severity});
}

// ---- circles ----

void GraphEditor::check_cycles(const std::vector<NodeInstance*>& starts, bool cut_them) {
    enum class Mark : std::uint8_t { New, Open, Done };
    struct Step {
        NodeInstance* node;
        std::vector<NodeInstance*> next;
        std::size_t at = 0;
    };
    std::unordered_map<const NodeInstance*, Mark> marks;
    // Only nodes of one kind can need each other in a circle; a shape and its mesh light name each other rightfully.
    const auto step_of = [&](NodeInstance* node) {
        Step step{node, {}, 0};
        for (const NodeInstance* other : node->references())
            if (other->kind() == node->kind())
                step.next.push_back(const_cast<NodeInstance*>(other));  // the graph owns them all
        return step;
    };
    for (NodeInstance* start : starts) {
        if (marks[start] != Mark::New) continue;
        std::vector<Step> path;
        path.push_back(step_of(start));
        marks[start] = Mark::Open;
        while (!path.empty()) {
            Step& top = path.back();
            if (top.at == top.next.size()) {
                marks[top.node] = Mark::Done;
                path.pop_back();
                continue;
            }
            NodeInstance* next = top.next[top.at++];
            Mark& mark = marks[next];
            if (mark == Mark::Open) {
                std::vector<NodeInstance*> circle;
                auto first = std::find_if(path.begin(), path.end(),
                                          [&](const Step& step) { return step.node == next; });
                for (; first != path.end(); ++first)
                    circle.push_back(first->node);
                report_cycle(circle);
                if (cut_them) cut(*top.node, *next);
            } else if (mark == Mark::New) {
                mark = Mark::Open;
                path.push_back(step_of(next));
            }
        }
    }
}

void GraphEditor::report_cycle(const std::vector<NodeInstance*>& circle) {
    constexpr std::size_t kShown = 8;
    std::string names;
    for (std::size_t i = 0; i < std::min(circle.size(), kShown); ++i)
        names += fmt::format("\"{}\" -> ", circle[i]->name().view());
    if (circle.size() > kShown) names += fmt::format("{} more -> ", circle.size() - kShown);
    names += fmt::format("\"{}\"", circle.front()->name().view());
    // Where one node of the circle names the next.
    const auto place = [&](const NodeInstance& from, const NodeInstance& to) {
        for (const Link& link : from.links())
            if (link.source == &to) return link.where;
        for (const ParamInfo& info : from.type().params) {
            const std::string_view written = from.written_[index_of(from, info)].text();
            if (is_reference(info.type) &&
                written.find(to.name().view()) != std::string_view::npos)
                return from.written_[index_of(from, info)];
        }
        return from.where();
    };
    Error error{Code::CyclicLink,
                fmt::format("nodes link to each other in a circle: {}", names),
                place(*circle.back(), *circle.front()),
                "take one of the links out",
                {},
                Severity::Error};
    for (std::size_t i = 0; i + 1 < std::min(circle.size(), kShown); ++i)
        error.notes.push_back({fmt::format("\"{}\" needs \"{}\"", circle[i]->name().view(),
                                           circle[i + 1]->name().view()),
                               place(*circle[i], *circle[i + 1])});
    diagnostics_->add(std::move(error));
}

/// Takes out every reference from one node to another, so that nobody walks in the circle.
void GraphEditor::cut(NodeInstance& from, const NodeInstance& to) {
    std::erase_if(from.links_, [&](const Link& link) { return link.source == &to; });
    for (const ParamInfo& info : from.type().params) {
        if (!is_reference(info.type)) continue;
        std::byte* value = address(from, info);
        std::size_t n = 1;
        if (info.is_array) {
            n = std::size_t{array_at(value).n} * array_at(value).n_keys;
            value = from.arrays_[index_of(from, info)].get();
        }
        for (std::size_t i = 0; i < n && value != nullptr; ++i) {
            std::byte* at = value + i * type_size(info.type);
            const NodeInstance* node = nullptr;
            std::memcpy(&node, at, sizeof(node));
            if (node == &to) std::memset(at, 0, sizeof(node));
        }
    }
}

// ---- reports ----

void GraphEditor::repeated(const std::string& key, Error error) {
    const auto [place, added] = repeated_index_.emplace(key, repeated_.size());
    if (added)
        repeated_.push_back({std::move(error), 1});
    else
        ++repeated_[place->second].count;
}

void GraphEditor::report_repeated() {
    for (Repeated& report : repeated_) {
        if (report.count > 1) report.error.message += fmt::format(" ({} times)", report.count);
        all_diagnostics_.add(std::move(report.error));
    }
    repeated_.clear();
    repeated_index_.clear();
}

}  // namespace lightsieve
