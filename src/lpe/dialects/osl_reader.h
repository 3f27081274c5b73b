// Reads light path expressions as stock Open Shading Language does, mistakes of its parser
// included.
//
// Read off the project's source (src/liboslexec/lpeparse.cpp). The parser works on single symbols:
// an event is its event letter, its scattering letter, its labels in order, and a stop. Inside
// <..> one item is one symbol, whatever it looks like; so `<D>` looks for an event named D and
// never finds one. It stops at the first error and says little; this reader goes on and says what
// will happen.
#pragma once

#include <string_view>

#include "lpe/dialects/dialect.h"

namespace lightsieve::lpe::dialects {

struct OslOptions {
    std::string_view renderer = "OSL";  ///< for messages
    std::string_view user_events{};     ///< letters of further events that end a path
    /// A label without a dot stands for every `material.lobe` with it (MoonRay).
    bool dotted_labels = false;
    bool trims_labels = false;             ///< blanks at a label's ends do not count
    bool every_event_is_labelled = false;  ///< by a placeholder if by nothing else
};

[[nodiscard]] Reading read_osl(std::string_view text, const SourceSpan& base,
                               Diagnostics& diagnostics, const OslOptions& options);

/// Does the label `carried` pass a test for `wanted`? Equal, or a part of a dotted one.
[[nodiscard]] bool is_dotted_label(std::string_view carried, std::string_view wanted);

}  // namespace lightsieve::lpe::dialects
