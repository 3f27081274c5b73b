// Changes to nodes that are there: the second half of graph_editor.h.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "scene/ass_lexer.h"
#include "scene/ass_write.h"
#include "scene/graph_editor.h"

namespace lightsieve {

std::optional<ValueText> GraphEditor::lex_edit(const ParamInfo& info, std::string_view param,
                                               std::string_view value,
                                               std::shared_ptr<const SourceText>& source) {
    const std::string name = fmt::format("<{}>", param);
    const auto lex = [&](std::string text, Diagnostics& report) -> std::optional<ValueText> {
        source = std::make_shared<const SourceText>(SourceText{name, std::move(text)});
        AssLexer lexer(source->text);
        std::optional<ValueText> read = lex_value(lexer, source, 0, param, report);
        if (!read || lexer.peek() == '\0') return read;
        report.error(Code::AssSyntax, "one value is expected", {source, lexer.position(), 1},
                     "a text with blanks needs quotes");
        return std::nullopt;
    };
    if (info.type == ParamType::String && !value.starts_with('"')) {
        // On a command line texts have no quotes of their own.
        Diagnostics unused;
        std::optional<ValueText> read = lex(std::string(value), unused);
        return read && read->form == ValueForm::Array ? read
                                                      : lex(quote_ass(value), *diagnostics_);
    }
    return lex(std::string(value), *diagnostics_);
}

bool GraphEditor::set(NodeInstance& node, std::string_view param, std::string_view value) {
    const std::optional<ParamName> name = parse_param_name(param);
    const ParamInfo* info = name ? node.type().find(Name(name->base)) : nullptr;
    const std::string target = fmt::format("{}.{}", node.name().view(), param);
    if (info == nullptr) {
        const std::string guess =
            did_you_mean(name ? name->base : param, param_names(node.type()));
        diagnostics_->error(
            Code::UnknownParam,
            fmt::format("{} has no parameter \"{}\"", node.type().name.view(), param), {},
            fmt::format("{}`lightsieve nodes {}` lists all of them",
                        guess.empty() ? "" : guess + "   ", node.type().name.view()));
        return false;
    }
    std::shared_ptr<const SourceText> source;
    const std::optional<ValueText> read = lex_edit(*info, target, value, source);
    if (!read) return false;
    const ParamText statement{Name(name->base), name->element, name->component, {},
                              {0, 0, 0},        *read};

    // Keep what an error must bring back.
    const std::size_t n_errors = diagnostics_->n_errors(), index = index_of(node, *info);
    const std::vector<std::byte> block(node.block_, node.block_ + node.type().block_size);
    const std::vector<Link> links = node.links_;
    const SourceSpan written = node.written_[index];
    const bool was_set = node.set_[index];
    std::erase_if(node.links_, [&](const Link& link) {
        return link.param == info && (name->element < 0 || link.element == name->element) &&
               (name->component < 0 || link.component == name->component);
    });
    given_.assign(node.type().params.size(), false);
    read_param(node, {&statement, source, source});
    if (diagnostics_->n_errors() == n_errors) check_cycles({&node}, false);
    report_repeated();
    if (diagnostics_->n_errors() == n_errors) return true;

    std::copy(block.begin(), block.end(), node.block_);
    node.links_ = links;
    node.written_[index] = written;
    node.set_[index] = was_set;
    if (!retired_.empty()) node.arrays_[index] = std::move(retired_.front());
    return false;
}

bool GraphEditor::set_user_data(NodeInstance& node, const UserData& fresh,
                                std::string_view value) {
    const auto known = std::find_if(node.user_data_.begin(), node.user_data_.end(),
                                    [&](const UserData& data) { return data.name == fresh.name; });
    const bool declared = known != node.user_data_.end();
    const UserData before = declared ? *known : fresh;
    ParamInfo info;
    info.type = before.type;
    std::shared_ptr<const SourceText> source;
    const std::string target = fmt::format("{}.{}", node.name().view(), fresh.name.view());
    const std::optional<ValueText> read = lex_edit(info, target, value, source);
    if (!read) return false;
    if (!declared) node.user_data_.push_back(fresh);
    const std::size_t n_errors = diagnostics_->n_errors();
    const ParamText statement{fresh.name, -1, -1, {}, {0, 0, 0}, *read};
    read_user_data(node, {&statement, source, source});
    if (diagnostics_->n_errors() == n_errors) return true;
    if (!declared) node.user_data_.pop_back();
    return false;
}

void GraphEditor::disable(const std::vector<NodeInstance*>& nodes) {
    const std::unordered_set<const NodeInstance*> out(nodes.begin(), nodes.end());
    for (const auto& scope : graph_.scopes_)
        for (const auto& other : scope->nodes) {
            const std::vector<const NodeInstance*> needed = other->references();
            for (const NodeInstance* node : needed)
                if (out.contains(node)) cut(*other, *node);
        }
    const auto leaves = [&](const std::unique_ptr<NodeInstance>& node) {
        return out.contains(node.get());
    };
    for (std::unique_ptr<NodeInstance>& node : scope_.nodes) {
        if (!leaves(node)) continue;
        if (const auto named = scope_.names.find(node->name());
            named != scope_.names.end() && named->second == node.get())
            scope_.names.erase(named);
        scope_.disabled.push_back(std::move(node));
    }
    std::erase(scope_.nodes, nullptr);
}

}  // namespace lightsieve
