// A scene file as written: blocks of node type, declarations and parameters, each with its place in the text.
//
// The document keeps the texts it was read from and only points into them, so an unedited document is written back
// byte for byte (ass_write.h), comments and white space included, and an edited one differs only where it was edited.
// It knows nothing about node types: whether a word is a link, an enumeration or a file name is decided by
// `build_graph` (graph.h), which also decodes the arrays. Read one with `read_ass` (ass_read.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/name.h"
#include "core/source.h"
#include "scene/value.h"

namespace lightsieve {

/// A run of bytes in one of a document's texts.
struct TextRange {
    std::uint32_t source = 0;  ///< index of the text; `Document::span` turns it into a SourceSpan
    std::size_t offset = 0;    ///< first byte
    std::size_t length = 0;    ///< bytes
    [[nodiscard]] std::size_t end() const { return offset + length; }
};

/// How a value is written; what it means depends on the parameter's type.
enum class ValueForm : std::uint8_t {
    Numbers,  ///< one or more numbers: `0.8 0.2 0.1`
    Strings,  ///< one or more quoted strings: `"a" "b"`
    Word,     ///< one bare word: `on`, `checker1`, `left`
    Array,    ///< `COUNT KEYS TYPE data`
};

/// How the elements of an array are written.
enum class ArrayEncoding : std::uint8_t { Text, B85, B64 };

/// The head of an array value. Checked: the data holds `n * n_keys` elements.
struct ArrayHeader {
    std::uint32_t n = 0;          ///< elements a motion key
    std::uint32_t n_keys = 1;     ///< motion keys, at least 1
    ParamType type{};             ///< POINT is Vector, POINT2 is Vector2, POINTER is Node
    ArrayEncoding encoding{};     ///< text or packed
    std::size_t data_offset = 0;  ///< first byte after the head, in the value's text
};

/// A value as written.
struct ValueText {
    ValueForm form{};
    TextRange range;    ///< from the value's first byte to its last
    ArrayHeader array;  ///< for ValueForm::Array only
};

/// `NAME VALUE`, `NAME.r VALUE`, `NAME[2] VALUE`, `NAME[2].r VALUE`.
struct ParamText {
    Name name;                   ///< without the suffixes
    std::int64_t element = -1;   ///< the number in brackets, or -1
    std::int8_t component = -1;  ///< 0..3 for .r .g .b .a or .x .y .z, or -1
    TextRange statement;   ///< name and value in the node's file; length 0 if added by an edit
    TextRange name_range;  ///< the name with its suffixes
    ValueText value;       ///< lies in another text than `statement` after an edit
};

/// What one value of user data belongs to.
enum class UserDataClass : std::uint8_t {
    Constant,  ///< the whole object
    Uniform,   ///< one face, curve or point
    Varying,   ///< one vertex
    Indexed,   ///< face corners, by the indices in `<name>idxs`
};
/// The class as written, e.g. "uniform".
[[nodiscard]] std::string_view class_text(UserDataClass user_class);

/// `declare NAME CLASS [ARRAY] TYPE`.
struct DeclareText {
    Name name;
    UserDataClass user_class{};
    bool is_array = false;  ///< each value is an array
    ParamType type{};
    TextRange statement;
};

/// One node as written.
struct NodeBlock {
    Name type;             ///< e.g. "polymesh"
    Name name;             ///< value of its parameter `name`; empty if it has none
    TextRange whole;       ///< from the type to the closing brace; of a node that was added: empty
    TextRange type_range;  ///< the type's name
    std::vector<DeclareText> declares;
    std::vector<ParamText>
        params;  ///< in file order, `name` among them; a later one overrides an earlier one
    std::vector<TextRange> removed;  ///< statements that an edit took out
    bool added = false;              ///< made by `Document::add_node`
};

/// `include "FILE"` at file level.
struct IncludeText {
    TextRange statement;
    std::uint32_t source = 0;  ///< text of the file that was read
};

class Document {
  public:
    /// An empty document.
    Document();

    /// All nodes, those of included files in place of the statement.
    [[nodiscard]] const std::vector<NodeBlock>& nodes() const { return nodes_; }
    /// Index of the first node of that name; `options` without a name is found as "options". -1 if there is none.
    [[nodiscard]] std::int64_t find(Name name) const;
    /// The bytes of a range.
    [[nodiscard]] std::string_view text(const TextRange& range) const;
    /// A range as a place for diagnostics.
    [[nodiscard]] SourceSpan span(const TextRange& range) const;
    /// The texts: 0 is the file itself, then included files and the texts of edits.
    [[nodiscard]] const std::vector<std::shared_ptr<const SourceText>>& sources() const {
        return sources_;
    }
    /// The include statements of all files, in reading order.
    [[nodiscard]] const std::vector<IncludeText>& includes() const { return includes_; }

    /// Appends a node (to the end of the file itself). Returns its index. `name` may be empty.
    std::size_t add_node(Name type, Name name);
    /// Takes a node out; the indices of later nodes move down by one.
    void remove_node(std::size_t node);
    /// Sets a parameter to a value written as in a file; `param` may have suffixes ("color[1].r").
    ///
    /// returns  false with an error reported if either cannot be read; the document is then unchanged
    bool set_param(std::size_t node, std::string_view param, std::string_view value,
                   Diagnostics& diagnostics);
    /// Takes a parameter out. False if the node does not have it as written there.
    bool remove_param(std::size_t node, std::string_view param);

  private:
    friend class AssReader;
    friend class DocumentWriter;

    std::uint32_t add_source(std::string name, std::string text);

    std::vector<std::shared_ptr<const SourceText>> sources_;
    std::vector<NodeBlock> nodes_;
    std::vector<IncludeText> includes_;
    std::vector<TextRange> removed_nodes_;
};

/// All nodes and parameters with their forms and lengths, one a line; for tests and curious people.
[[nodiscard]] std::string dump(const Document& document);

}  // namespace lightsieve
