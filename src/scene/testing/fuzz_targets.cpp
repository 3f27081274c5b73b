#include "scene/testing/fuzz_targets.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/ass_packed.h"
#include "scene/ass_read.h"
#include "scene/ass_write.h"
#include "scene/graph.h"
#include "scene/test_nodes.h"

namespace lightsieve::testing {
namespace {

void require(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

void check_places(const Diagnostics& diagnostics) {
    for (const Error& error : diagnostics.items()) {
        require(!error.message.empty(), "a report without a message");
        if (error.where.source)
            require(std::size_t{error.where.offset} + error.where.length <=
                        error.where.source->text.size(),
                    "a place outside the text: " + error.message);
    }
    (void)diagnostics.render();
}

/// Packed data and how to read it.
struct Packed {
    bool base85 = true;
    ParamType type = ParamType::Float;

    [[nodiscard]] PackedScan scan(std::string_view text, std::size_t n) const {
        return base85 ? scan_b85(text, 0, type, n) : scan_b64(text, 0, type, n);
    }
    [[nodiscard]] std::vector<std::uint32_t> decode(std::string_view text, std::size_t n) const {
        std::vector<std::uint32_t> out(n, 0xdeadbeefU);
        if (base85)
            decode_b85(text, type, out);
        else
            decode_b64(text, type, out);
        return out;
    }
};

constexpr std::array kTypes{ParamType::Float, ParamType::Byte, ParamType::Bool,
                            ParamType::Int,   ParamType::UInt, ParamType::Vector};

}  // namespace

void fuzz_ass(std::string_view text) {
    // A file that includes itself, for a while: the reader's own limits have tests, and take long to reach.
    constexpr int kMostSelfIncludes = 6;
    int n_opened = 0;
    const ReadFile read_file = [&](const std::string& path) -> std::optional<std::string> {
        if (path.find("some") == std::string::npos) return std::nullopt;
        const bool again = ++n_opened % kMostSelfIncludes != 0;
        return std::string("options { AA_samples 2 }\n") + (again ? "include \"some\"\n" : "");
    };
    Diagnostics diagnostics;
    const Document document = read_ass(std::string(text), "fuzz.ass", read_file, diagnostics);
    require(write_ass(document) == text, "a document is not written as it was read");
    (void)dump(document);
    const SceneGraph graph = build_graph(document, test::registry(), {}, diagnostics);
    check_places(diagnostics);
    const std::string written = write_ass(graph);
    if (diagnostics.n_errors() > 0) return;
    Diagnostics again;
    const Document reread = read_ass(written, "written.ass", read_file, again);
    require(again.n_errors() == 0, "what was written cannot be read: " + again.render());
    const SceneGraph second = build_graph(reread, test::registry(), {}, again);
    check_places(again);
}

void fuzz_packed(std::string_view text) {
    if (text.size() < 2) return;
    const auto choice = static_cast<unsigned char>(text[0]);
    const Packed packed{choice % 2 == 0, kTypes[choice / 2 % kTypes.size()]};
    const std::size_t n = static_cast<unsigned char>(text[1]);
    text.remove_prefix(2);
    const PackedScan scan = packed.scan(text, n);
    require(scan.end <= text.size(), "data ends behind its text");
    require(scan.n_found <= n, "more numbers than were asked for");
    if (scan.error != PackedError::None) return;
    require(scan.n_found == n, "complete, but not all numbers are there");
    const std::string_view data = text.substr(0, scan.end);
    require(packed.scan(data, n).error == PackedError::None, "its own text is not enough");
    require(packed.decode(data, n) == packed.decode(text, n), "it depends on what comes after");
    // One character less is not enough, unless it was a blank or padding.
    if (n == 0 || data.empty() || data.back() == '=' || data.back() <= ' ') return;
    require(packed.scan(data.substr(0, data.size() - 1), n).error != PackedError::None,
            "complete without its last character");
}

}  // namespace lightsieve::testing
