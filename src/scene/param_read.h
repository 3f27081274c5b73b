// From a value as written to typed values in memory: the second half of reading, where types are known.
//
// Files are generous with forms (a scalar for an array, an array of one for a scalar, INT for ENUM, POINT for
// VECTOR, RGB for RGBA, 65535 for a BYTE mask); what is accepted is written down in README.md, and everything else is a
// located error.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/diagnostics.h"
#include "core/source.h"
#include "scene/document.h"
#include "scene/node_type.h"

namespace lightsieve {

/// Bytes that runs of packed arrays may expand to beyond the size of their text, in one graph.
inline constexpr std::uint64_t kMaxRunBytes = std::uint64_t{1} << 30U;

/// Values of one parameter: `n * n_keys` of `type_size` bytes each.
struct TypedValues {
    std::uint32_t n = 0;
    std::uint32_t n_keys = 1;
    std::unique_ptr<std::byte[]> data;
};

/// Finds a node by the name in a file. Reports what is wrong and gives null then.
using FindNode =
    std::function<const NodeInstance*(const std::string& name, const SourceSpan& where)>;

/// What a value is read for.
struct ReadTarget {
    ParamType type{};                 ///< to convert to
    bool is_array = false;            ///< several values are welcome
    const ParamInfo* info = nullptr;  ///< range and enumerators; null for user data
    std::string label;                ///< how messages call it: `sphere.radius`
};

class ParamReader {
  public:
    /// run_bytes  how much of kMaxRunBytes is used up; counted on
    ParamReader(FindNode find_node, std::uint64_t& run_bytes, Diagnostics& diagnostics)
        : find_node_(std::move(find_node)), run_bytes_(run_bytes), diagnostics_(diagnostics) {}

    /// Reads a value. Nothing with errors reported if it does not fit.
    ///
    /// value, source  as in a Document; `source` is the text that the value lies in
    [[nodiscard]] std::optional<TypedValues> read(const ValueText& value,
                                                  const std::shared_ptr<const SourceText>& source,
                                                  const ReadTarget& target);

  private:
    FindNode find_node_;
    std::uint64_t& run_bytes_;
    Diagnostics& diagnostics_;
};

/// on, off, true, false in any case; nothing otherwise.
[[nodiscard]] std::optional<bool> parse_bool(std::string_view word);
/// Index of an enumerator by its name (then ignoring case), or -1.
[[nodiscard]] std::int32_t find_enumerator(const ParamInfo& info, std::string_view word);
/// The text of a value that is one word or one string; nothing for other forms.
[[nodiscard]] std::optional<std::string> single_text(const ValueText& value,
                                                     const SourceText& source);

}  // namespace lightsieve
