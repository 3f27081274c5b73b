// Writes a Document or a SceneGraph as .ass text.
//
// A document is written as it was read, except for what was edited. A graph has forgotten its text and is written in one
// canonical form: a parameter a line, numbers with the fewest digits that read back to the same bits.
#pragma once

#include <string>

#include "scene/document.h"
#include "scene/graph.h"

namespace lightsieve {

/// The document's text. An include stays a statement unless a node that came from it was edited: then its text takes
/// the statement's place.
[[nodiscard]] std::string write_ass(const Document& document);

/// The graph's text: the parameters that were set, links, user data.
[[nodiscard]] std::string write_ass(const SceneGraph& graph);

/// A string with quotes, and with \" and \\ where they are needed.
[[nodiscard]] std::string quote_ass(std::string_view text);

}  // namespace lightsieve
