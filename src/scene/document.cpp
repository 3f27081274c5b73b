#include "scene/document.h"

#include <algorithm>
#include <array>

#include "scene/ass_lexer.h"

namespace lightsieve {
namespace {

constexpr std::array<std::string_view, 4> kClasses{"constant", "uniform", "varying", "indexed"};
constexpr std::array<std::string_view, 4> kForms{"numbers", "strings", "word", "array"};

bool same_target(const ParamText& param, const ParamName& name) {
    return param.name.view() == name.base && param.element == name.element &&
           param.component == name.component;
}

}  // namespace

std::string_view class_text(UserDataClass user_class) {
    return kClasses.at(static_cast<std::size_t>(user_class));
}

Document::Document() { add_source("<document>", ""); }

std::uint32_t Document::add_source(std::string name, std::string text) {
    sources_.push_back(
        std::make_shared<const SourceText>(SourceText{std::move(name), std::move(text)}));
    return static_cast<std::uint32_t>(sources_.size() - 1);
}

std::int64_t Document::find(Name name) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].name == name) return static_cast<std::int64_t>(i);
    if (name.view() != "options") return -1;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].type == name) return static_cast<std::int64_t>(i);
    return -1;
}

std::string_view Document::text(const TextRange& range) const {
    return std::string_view(sources_[range.source]->text).substr(range.offset, range.length);
}

SourceSpan Document::span(const TextRange& range) const {
    return {sources_[range.source], range.offset, range.length};
}

std::size_t Document::add_node(Name type, Name name) {
    NodeBlock node;
    node.type = type;
    node.added = true;
    const std::string type_text = type.str();
    const std::uint32_t source = add_source("<added node>", type_text);
    node.type_range = {source, 0, type_text.size()};
    node.whole = node.type_range;
    nodes_.push_back(std::move(node));
    Diagnostics unused;  // a word or a quoted string is always a value
    if (!name.empty()) {
        std::string quoted = "\"";
        for (const char c : name.view())
            quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
        set_param(nodes_.size() - 1, "name", quoted + '"', unused);
    }
    return nodes_.size() - 1;
}

void Document::remove_node(std::size_t node) {
    if (!nodes_[node].added) removed_nodes_.push_back(nodes_[node].whole);
    nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(node));
}

bool Document::set_param(std::size_t node, std::string_view param, std::string_view value,
                         Diagnostics& diagnostics) {
    const std::optional<ParamName> name = parse_param_name(param);
    const std::uint32_t source =
        add_source("<edit of " + std::string(param) + ">", std::string(value));
    AssLexer lexer(sources_[source]->text);
    std::optional<ValueText> read;
    if (!name) {
        diagnostics.error(Code::AssSyntax, "\"" + std::string(param) + "\" is no parameter name",
                          {}, "names look like Kd, Kd_color.r or color[1]");
    } else {
        read = lex_value(lexer, sources_[source], source, param, diagnostics);
    }
    if (read && lexer.peek() != '\0') {
        diagnostics.error(Code::AssSyntax, "one value is expected",
                          {sources_[source], lexer.position(), 1},
                          "a text with blanks needs quotes");
        read.reset();
    }
    if (!read) {
        sources_.pop_back();  // nothing points to it but the report
        return false;
    }
    NodeBlock& block = nodes_[node];
    // The last statement is the one that counts.
    const auto found = std::find_if(block.params.rbegin(), block.params.rend(),
                                    [&](const ParamText& p) { return same_target(p, *name); });
    if (found != block.params.rend()) {
        found->value = *read;
    } else {
        ParamText added;
        added.name = Name(name->base);
        added.element = name->element;
        added.component = name->component;
        added.statement = {block.whole.source, block.whole.end(), 0};
        added.name_range = {source, 0, 0};
        added.value = *read;
        block.params.push_back(std::move(added));
    }
    if (param == "name")
        block.name = Name(read->form == ValueForm::Strings ? unquote(text(read->range))
                                                           : std::string(text(read->range)));
    return true;
}

bool Document::remove_param(std::size_t node, std::string_view param) {
    const std::optional<ParamName> name = parse_param_name(param);
    if (!name) return false;
    NodeBlock& block = nodes_[node];
    const std::size_t before = block.params.size();
    for (const ParamText& p : block.params)
        if (same_target(p, *name) && p.statement.length > 0) block.removed.push_back(p.statement);
    std::erase_if(block.params, [&](const ParamText& p) { return same_target(p, *name); });
    if (param == "name") block.name = Name();
    return block.params.size() < before;
}

std::string dump(const Document& document) {
    std::string out;
    for (const NodeBlock& node : document.nodes()) {
        out += node.type.str() + " \"" + node.name.str() + "\"\n";
        for (const DeclareText& declare : node.declares)
            out += "  declare " + declare.name.str() + " " +
                   std::string(class_text(declare.user_class)) +
                   (declare.is_array ? " ARRAY " : " ") + std::string(type_text(declare.type)) +
                   "\n";
        for (const ParamText& param : node.params) {
            out += "  " + param.name.str();
            if (param.element >= 0) out += "[" + std::to_string(param.element) + "]";
            if (param.component >= 0) out += std::string(".") + "rgba"[param.component];
            out += ": " + std::string(kForms.at(static_cast<std::size_t>(param.value.form)));
            const ArrayHeader& array = param.value.array;
            if (param.value.form == ValueForm::Array) {
                constexpr std::array<std::string_view, 3> kEncodings{"", " b85", " b64"};
                out += " " + std::to_string(array.n) + " x " + std::to_string(array.n_keys) + " " +
                       std::string(type_text(array.type)) +
                       std::string(kEncodings.at(static_cast<std::size_t>(array.encoding)));
            } else {
                out += " " + std::string(document.text(param.value.range));
            }
            out += "\n";
        }
    }
    return out;
}

}  // namespace lightsieve
