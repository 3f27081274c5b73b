#include "scene/ass_read.h"

#include <algorithm>
#include <filesystem>

#include "scene/ass_lexer.h"

namespace lightsieve {
namespace {

/// After so many errors the rest of a text is not worth reading: it is no scene file.
constexpr std::size_t kMaxReadErrors = 100;
/// A zero byte among so many first bytes tells binary data from text.
constexpr std::size_t kBinaryProbe = 65536;

}  // namespace

/// Turns texts into a document's blocks. Not recursive but for includes, whose depth is limited.
class AssReader {
  public:
    AssReader(Document& document, const ReadFile& read_file, Diagnostics& diagnostics)
        : document_(document), read_file_(read_file), diagnostics_(diagnostics) {}

    void read(std::string name, std::string text) {
        document_.sources_.clear();
        n_bytes_ = text.size();
        file(document_.add_source(std::move(name), std::move(text)));
    }

  private:
    /// What reading one text needs to know.
    struct Text {
        std::shared_ptr<const SourceText> source;
        std::uint32_t index;
        AssLexer lexer;
        [[nodiscard]] SourceSpan at(const Token& token) const {
            return {source, token.offset, token.length};
        }
        [[nodiscard]] TextRange range(const Token& token) const {
            return {index, token.offset, token.length};
        }
        [[nodiscard]] std::string_view text(const Token& token) const { return lexer.text(token); }
    };

    [[nodiscard]] bool gave_up() const {
        return diagnostics_.n_errors() >= first_error_ + kMaxReadErrors;
    }

    /// Reads all statements of one text.
    void file(std::uint32_t index) {
        Text text{document_.sources_[index], index, AssLexer(document_.sources_[index]->text)};
        if (!looks_like_text(text)) return;
        if (text.lexer.text().starts_with("\xEF\xBB\xBF")) text.lexer.seek(3);
        open_files_.push_back(normal(text.source->name));
        for (Token token = text.lexer.next(); token.kind != TokenKind::End && !gave_up();
             token = text.lexer.next())
            statement(text, token);
        open_files_.pop_back();
    }

    bool looks_like_text(const Text& text) {
        const std::string_view bytes = text.lexer.text();
        const bool binary = bytes.substr(0, kBinaryProbe).find('\0') != std::string_view::npos ||
                            bytes.starts_with("\x1f\x8b");
        if (binary)
            diagnostics_.error(Code::FileFormat,
                               "\"" + text.source->name + "\" is no text, so it is no .ass file");
        return !binary;
    }

    void statement(Text& text, const Token& token) {
        if (token.kind == TokenKind::Word) {
            const char next = text.lexer.peek();
            if (next == '{') return node(text, token);
            if (next == '"' && text.text(token) == "include") return include(text, token);
        }
        const std::string shown = token.kind == TokenKind::Word
                                      ? "\"" + std::string(text.text(token).substr(0, 40)) + "\""
                                  : token.kind == TokenKind::String
                                      ? "a string"
                                      : std::string("\"") + text.text(token)[0] + "\"";
        diagnostics_.error(
            Code::AssSyntax, "a node type and \"{\" are expected, not " + shown,
            {text.source, token.offset, token.kind == TokenKind::String ? 1 : token.length});
        find_node(text);
    }

    // Recovery looks at characters, not at tokens: after a mistake quotes may be out of step, and looking for the end of
    // each string from each place would take for ever on hostile files.

    /// The first word after the blanks at `at`; empty if a brace, a quote or the end comes first.
    static std::string_view word_after(std::string_view all, std::size_t at) {
        while (at < all.size() && is_ass_blank(all[at]))
            ++at;
        std::size_t end = at;
        while (end < all.size() && !is_ass_blank(all[end]) && all[end] != '{' && all[end] != '}' &&
               all[end] != '"')
            ++end;
        return all.substr(at, end - at);
    }

    /// Recovery at file level: goes to the next line that begins with a word and is followed by "{".
    static void find_node(Text& text) {
        const std::string_view all = text.lexer.text();
        for (std::size_t at = all.find('\n', text.lexer.position()); at != std::string_view::npos;
             at = all.find('\n', at)) {
            const std::string_view word = word_after(all, at);
            const auto end = static_cast<std::size_t>(word.data() + word.size() - all.data());
            AssLexer ahead(all, end);
            const char next = word.empty() || word[0] == '#' ? '\0' : ahead.peek();
            if (next == '{' || (next == '"' && word == "include")) return text.lexer.seek(at);
            at = std::max(at + 1, end);
        }
        text.lexer.seek(all.size());
    }

    /// Recovery in a node: goes to the closing brace or to the next line that may begin with a parameter's name.
    static void find_param(Text& text) {
        const std::string_view all = text.lexer.text();
        for (std::size_t at = text.lexer.position(); at < all.size(); ++at) {
            if (all[at] == '}') return text.lexer.seek(at);
            if (all[at] != '\n') continue;
            const std::string_view word = word_after(all, at);
            if (parse_param_name(word)) return text.lexer.seek(at);
            at = static_cast<std::size_t>(word.data() - all.data()) - 1;
        }
        text.lexer.seek(all.size());
    }

    void node(Text& text, const Token& type) {
        NodeBlock block;
        block.type = Name(text.text(type));
        block.type_range = text.range(type);
        (void)text.lexer.next();  // the brace
        const std::size_t end = body(text, type, block);
        block.whole = {text.index, type.offset, end - type.offset};
        document_.nodes_.push_back(std::move(block));
    }

    /// Reads to the closing brace. Returns the end of the node.
    std::size_t body(Text& text, const Token& type, NodeBlock& block) {
        while (!gave_up()) {
            AssLexer before = text.lexer;
            const Token token = text.lexer.next();
            if (token.kind == TokenKind::Close) return token.offset + token.length;
            if (token.kind == TokenKind::End) {
                unclosed_node(text, type, "the file ends here: it may be cut off");
                return token.offset;
            }
            if (token.kind == TokenKind::Word && text.lexer.peek() == '{') {
                // The start of another node.
                unclosed_node(text, type, "another node starts before it is closed with \"}\"");
                text.lexer = before;
                return before.position();
            }
            if (token.kind == TokenKind::Word && text.text(token) == "declare")
                declare(text, token, block);
            else if (token.kind == TokenKind::Word && parse_param_name(text.text(token)))
                param(text, token, block);
            else
                no_param(text, token);
        }
        return text.lexer.position();
    }

    void unclosed_node(const Text& text, const Token& type, std::string hint) {
        diagnostics_.error(Code::AssUnclosed,
                           "node \"" + std::string(text.text(type)) + "\" does not end",
                           text.at(type), std::move(hint));
    }

    void no_param(Text& text, const Token& token) {
        const std::string_view shown = text.text(token).substr(0, 40);
        const bool quote = token.kind == TokenKind::String;
        diagnostics_.error(
            Code::AssSyntax,
            quote ? "a parameter's name is expected, not a string"
                  : "a parameter's name is expected, not \"" + std::string(shown) + "\"",
            {text.source, token.offset, quote ? 1 : token.length});
        find_param(text);
    }

    void param(Text& text, const Token& token, NodeBlock& block) {
        const std::string_view written = text.text(token);
        const ParamName name = *parse_param_name(written);
        const std::optional<ValueText> value =
            lex_value(text.lexer, text.source, text.index, written, diagnostics_);
        if (!value) return;
        ParamText out;
        out.name = Name(name.base);
        out.element = name.element;
        out.component = name.component;
        out.name_range = text.range(token);
        out.statement = {text.index, token.offset, value->range.end() - token.offset};
        out.value = *value;
        if (written == "name") {
            const std::string_view raw = document_.text(value->range);
            block.name = Name(value->form == ValueForm::Strings ? unquote(raw) : std::string(raw));
        }
        block.params.push_back(std::move(out));
    }

    void declare(Text& text, const Token& keyword, NodeBlock& block) {
        const auto word = [&] {
            AssLexer ahead = text.lexer;
            const Token token = ahead.next();
            if (token.kind == TokenKind::Word) text.lexer = ahead;
            return token;
        };
        DeclareText out;
        const Token name = word(), user_class = word();
        Token type = word();
        if (type.kind == TokenKind::Word && text.text(type) == "ARRAY") {
            out.is_array = true;
            type = word();
        }
        const auto found =
            std::find_if(kClassNames.begin(), kClassNames.end(), [&](UserDataClass c) {
                return user_class.kind == TokenKind::Word &&
                       class_text(c) == text.text(user_class);
            });
        const std::optional<ParamType> parsed =
            type.kind == TokenKind::Word ? parse_type(text.text(type)) : std::nullopt;
        const SourceSpan where{
            text.source, keyword.offset,
            type.offset + (type.kind == TokenKind::Word ? type.length : 0) - keyword.offset};
        if (name.kind != TokenKind::Word || found == kClassNames.end() || !parsed) {
            diagnostics_.error(
                Code::AssSyntax, "a declaration that cannot be read", where,
                "write: declare NAME constant|uniform|varying|indexed [ARRAY] TYPE");
            return;
        }
        out.name = Name(text.text(name));
        out.user_class = *found;
        out.type = *parsed;
        out.statement = {text.index, where.offset, where.length};
        block.declares.push_back(std::move(out));
    }

    /// The same file under any spelling of its path.
    static std::string normal(const std::string& path) {
        return std::filesystem::path(path).lexically_normal().string();
    }

    void include(Text& text, const Token& keyword) {
        const Token token = text.lexer.next();
        const SourceSpan where{text.source, keyword.offset,
                               token.offset + token.length - keyword.offset};
        if (!token.closed) {
            diagnostics_.error(Code::AssUnclosed, "the name of an included file does not end",
                               {text.source, token.offset, 1}, "add the closing quote");
            return;
        }
        const std::string path = unquote(text.text(token));
        if (document_.includes_.size() >= kMaxIncludes || open_files_.size() > kMaxIncludeDepth) {
            diagnostics_.error(Code::LimitIncludes, "file \"" + path + "\" is not included", where,
                               "at most " + std::to_string(kMaxIncludes) +
                                   " include statements (kMaxIncludes), " +
                                   std::to_string(kMaxIncludeDepth) +
                                   " inside one another (kMaxIncludeDepth)");
            return;
        }
        // Beside the including file first, then as the path says.
        const std::string beside =
            normal((std::filesystem::path(text.source->name).parent_path() / path).string());
        std::string found_path = beside;
        for (const std::string& candidate : {beside, normal(path)})
            if (std::find(open_files_.begin(), open_files_.end(), candidate) !=
                open_files_.end()) {
                std::string chain;
                for (const std::string& open : open_files_)
                    chain += "\"" + open + "\" includes ";
                diagnostics_.error(Code::IncludeCycle,
                                   "a file includes itself: " + chain + "\"" + candidate + "\"",
                                   where);
                return;
            }
        std::optional<std::string> content = read_file_ ? read_file_(beside) : std::nullopt;
        if (!content && read_file_ && beside != normal(path)) {
            found_path = normal(path);
            content = read_file_(found_path);
        }
        if (!content) {
            diagnostics_.error(Code::FileNotFound, "included file \"" + path + "\" cannot be read",
                               where, "looked for \"" + beside + "\"");
            return;
        }
        n_bytes_ += content->size();
        if (n_bytes_ > kMaxSceneBytes) {
            diagnostics_.error(
                Code::LimitFileSize, "the scene with its included files is too large", where,
                "at most " + std::to_string(kMaxSceneBytes) + " bytes (kMaxSceneBytes)");
            return;
        }
        const std::uint32_t index = document_.add_source(found_path, std::move(*content));
        document_.includes_.push_back({{text.index, where.offset, where.length}, index});
        file(index);
    }

    static constexpr std::array<UserDataClass, 4> kClassNames{
        UserDataClass::Constant, UserDataClass::Uniform, UserDataClass::Varying,
        UserDataClass::Indexed};

    Document& document_;
    const ReadFile& read_file_;
    Diagnostics& diagnostics_;
    std::size_t first_error_ = diagnostics_.n_errors();
    std::vector<std::string> open_files_;
    std::size_t n_bytes_ = 0;
};

Document read_ass(std::string text, std::string name, const ReadFile& read_file,
                  Diagnostics& diagnostics) {
    Document document;
    AssReader(document, read_file, diagnostics).read(std::move(name), std::move(text));
    return document;
}

Document read_ass_file(const std::string& path, Diagnostics& diagnostics) {
    std::optional<std::string> text = read_text_file(path, diagnostics);
    if (!text) return {};
    const ReadFile read_file = [](const std::string& included) -> std::optional<std::string> {
        Diagnostics reported_by_the_reader;
        // A scene may come through a pipe; what it includes may not keep us waiting for ever.
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(included, ignored)) return std::nullopt;
        return read_text_file(included, reported_by_the_reader);
    };
    return read_ass(std::move(*text), path, read_file, diagnostics);
}

}  // namespace lightsieve
