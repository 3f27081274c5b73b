#include "scene/ass_write.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "scene/value_text.h"

namespace lightsieve {
namespace {

/// Replaces `length` bytes at `offset` of a text.
struct Patch {
    std::size_t offset = 0, length = 0;
    std::string text;
};

/// Whether a name can stand bare.
bool is_plain_word(std::string_view text) {
    return !text.empty() && text[0] != '#' && std::none_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) <= 0x20 || c == '"' || c == '{' || c == '}';
    });
}

std::string param_name(const ParamText& param) {
    std::string out = param.name.str();
    if (param.element >= 0) out += "[" + std::to_string(param.element) + "]";
    if (param.component >= 0) (out += '.') += "rgba"[param.component];
    return out;
}

}  // namespace

std::string quote_ass(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

/// Writes a document text by text: what lies between edits is copied.
class DocumentWriter {
  public:
    explicit DocumentWriter(const Document& document) : document_(document) {}

    [[nodiscard]] std::string write() const {
        std::string out = file(0);
        for (const NodeBlock& node : document_.nodes_)
            if (node.added) added_node(node, out);
        return out;
    }

  private:
    [[nodiscard]] bool is_edited(const NodeBlock& node) const {
        return !node.removed.empty() ||
               std::any_of(node.params.begin(), node.params.end(), [&](const ParamText& p) {
                   return p.value.range.source != node.whole.source;
               });
    }
    /// Whether a file, or one that it includes, must be written into its includer.
    [[nodiscard]] bool is_edited(std::uint32_t source) const {
        for (const NodeBlock& node : document_.nodes_)
            if (!node.added && node.whole.source == source && is_edited(node)) return true;
        for (const TextRange& removed : document_.removed_nodes_)
            if (removed.source == source) return true;
        return std::any_of(document_.includes_.begin(), document_.includes_.end(),
                           [&](const IncludeText& i) {
                               return i.statement.source == source && is_edited(i.source);
                           });
    }

    [[nodiscard]] std::string file(std::uint32_t source) const {
        std::vector<Patch> patches;
        for (const NodeBlock& node : document_.nodes_)
            if (!node.added && node.whole.source == source) node_patches(node, patches);
        for (const TextRange& removed : document_.removed_nodes_)
            if (removed.source == source) patches.push_back({removed.offset, removed.length, ""});
        for (const IncludeText& include : document_.includes_)
            if (include.statement.source == source && is_edited(include.source))
                patches.push_back(
                    {include.statement.offset, include.statement.length, file(include.source)});
        std::stable_sort(patches.begin(), patches.end(),
                         [](const Patch& a, const Patch& b) { return a.offset < b.offset; });

        const std::string_view text = document_.sources_[source]->text;
        std::string out;
        out.reserve(text.size());
        std::size_t done = 0;
        for (const Patch& patch : patches) {
            if (patch.offset < done) continue;  // inside a node that was removed
            out += text.substr(done, patch.offset - done);
            out += patch.text;
            done = patch.offset + patch.length;
        }
        return out += text.substr(done);
    }

    void node_patches(const NodeBlock& node, std::vector<Patch>& patches) const {
        for (const TextRange& removed : node.removed)
            patches.push_back({removed.offset, removed.length, ""});
        std::string added;
        for (const ParamText& param : node.params) {
            if (param.value.range.source == node.whole.source) continue;
            const std::string_view value = document_.text(param.value.range);
            if (param.statement.length == 0) {
                added += " " + param_name(param) + " " + std::string(value) + "\n";
            } else {
                patches.push_back(
                    {param.statement.offset, param.statement.length,
                     std::string(document_.text(param.name_range)) + " " + std::string(value)});
            }
        }
        if (added.empty()) return;
        // Before the closing brace, on lines of their own. A node that was cut off has none.
        const std::string_view text = document_.sources_[node.whole.source]->text;
        std::size_t at = node.whole.end();
        if (at > 0 && text[at - 1] == '}') --at;
        const bool own_line = at > 0 && text[at - 1] == '\n';
        patches.push_back({at, 0, own_line ? added : "\n" + added});
    }

    void added_node(const NodeBlock& node, std::string& out) const {
        if (!out.empty() && out.back() != '\n') out += '\n';
        if (!out.empty()) out += '\n';
        out += node.type.str() + "\n{\n";
        for (const ParamText& param : node.params)
            out += " " + param_name(param) + " " + std::string(document_.text(param.value.range)) +
                   "\n";
        out += "}\n";
    }

    const Document& document_;
};

std::string write_ass(const Document& document) { return DocumentWriter(document).write(); }

namespace {

const std::byte* block_bytes(const NodeInstance& node) {
    return static_cast<const std::byte*>(node.block());
}

void write_param(const NodeInstance& node, const ParamInfo& info, std::string& out) {
    const std::byte* data = block_bytes(node) + info.offset;
    out += " " + info.name.str() + " ";
    if (info.is_array) {
        Array<std::byte> array;
        std::memcpy(&array, data, sizeof(array));
        out += array_text(info.type, array.data, array.n, array.n_keys, &info, "  ");
    } else {
        if (info.type == ParamType::Matrix) out += "\n  ";
        out += value_text(info.type, data, &info);
    }
    out += "\n";
}

void write_link(const Link& link, std::string& out) {
    out += " " + link.param->name.str();
    if (link.element >= 0) out += "[" + std::to_string(link.element) + "]";
    const bool vector =
        link.param->type == ParamType::Vector || link.param->type == ParamType::Vector2;
    if (link.component >= 0) (out += '.') += (vector ? "xyzw" : "rgba")[link.component];
    std::string source = link.source->name().str();
    if (link.source_component >= 0) (source += '.') += "rgba"[link.source_component];
    out += " " + quote_ass(source) + "\n";
}

void write_user_data(const UserData& data, std::string& out) {
    out += " declare " + data.name.str() + " " + std::string(class_text(data.user_class)) +
           (data.is_array ? " ARRAY " : " ") + std::string(type_text(data.type)) + "\n";
    const auto* bytes = static_cast<const std::byte*>(data.data);
    const bool single = data.user_class == UserDataClass::Constant && !data.is_array &&
                        data.n == 1 && data.n_keys == 1;
    if (single)
        out += " " + data.name.str() + " " + value_text(data.type, bytes, nullptr) + "\n";
    else if (data.n > 0)
        out += " " + data.name.str() + " " +
               array_text(data.type, bytes, data.n, data.n_keys, nullptr, "  ") + "\n";
    if (!data.indices.empty())
        out += " " + data.name.str() + "idxs " +
               array_text(ParamType::UInt, reinterpret_cast<const std::byte*>(data.indices.data),
                          data.indices.n, data.indices.n_keys, nullptr, "  ") +
               "\n";
}

/// A parameter that only links were written for keeps its default.
bool has_value(const NodeInstance& node, const ParamInfo& info) {
    if (!node.is_set(info.name)) return false;
    if (!node.is_linked(info.name) || info.is_array) return true;
    return std::memcmp(block_bytes(node) + info.offset,
                       node.type().default_block.data() + info.offset, type_size(info.type)) != 0;
}

void write_node(const NodeInstance& node, std::string& out) {
    out += node.type().name.str() + "\n{\n";
    if (node.is_named())
        out += " name " +
               (is_plain_word(node.name().view()) ? node.name().str()
                                                  : quote_ass(node.name().view())) +
               "\n";
    for (const ParamInfo& info : node.type().params)
        if (has_value(node, info)) write_param(node, info, out);
    for (const Link& link : node.links())
        write_link(link, out);
    for (const UserData& data : node.user_data())
        write_user_data(data, out);
    out += "}\n\n";
}

}  // namespace

std::string write_ass(const SceneGraph& graph) {
    std::string out;
    for (const auto& node : graph.nodes())
        write_node(*node, out);
    return out;
}

std::string dump(const SceneGraph& graph) {
    std::string out;
    for (const auto& node : graph.nodes()) {
        out += std::string(kind_text(node->kind())) + " " + node->type().name.str() + " \"" +
               node->name().str() + "\"";
        const LineColumn at = node->where().line_column();
        if (node->where().known())
            out += " " + node->where().source->name + ":" + std::to_string(at.line);
        out += "\n";
        for (const ParamInfo& info : node->type().params)
            if (has_value(*node, info)) write_param(*node, info, out);
        for (const Link& link : node->links())
            write_link(link, out);
        for (const UserData& data : node->user_data())
            write_user_data(data, out);
    }
    for (const SkippedNode& skipped : graph.skipped())
        out += "skipped " + skipped.type.str() + " \"" + skipped.name.str() + "\"\n";
    return out;
}

}  // namespace lightsieve
