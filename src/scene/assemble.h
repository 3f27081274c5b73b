// From what a file says to what is rendered: operators act, procedurals are read.
//
// Between build_graph and compilation. Operators (options.operator) act on the scene's own nodes; then each procedural's file is
// read into a scope of its own, where the procedural's operator and the scene's act again, and so on inward. Procedurals
// of one file that lie side by side share a scope unless an operator could tell them apart: a forest of one tree is
// read once. Matrices and overrides of procedurals are applied when the scene is compiled.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "scene/graph.h"

namespace lightsieve {

/// Procedurals within procedurals.
inline constexpr int kMaxProceduralDepth = 32;
/// Files that procedurals read, each one counted as often as it is read.
inline constexpr std::size_t kMaxProceduralFiles = 16384;

struct AssembleOptions {
    std::string scene_path;  ///< the scene's own file, so that nothing reads it again
    bool ignore_operators = false;
    bool share_procedurals = true;  ///< options.procedural_auto_instancing
    /// Full path of a file that is named in `from`, after variables and search paths; nothing if there is none.
    std::function<std::optional<std::string>(std::string_view name, const std::string& from)>
        find_file;
};

/// Assembles the graph; does nothing the second time. A procedural that cannot be read is left out with a warning; one that
/// contains itself is an error.
void assemble(SceneGraph& graph, const AssembleOptions& options, Diagnostics& diagnostics);

/// The part of a path that names inside of a procedural begin with: "car^". Its namespace, or else its own name.
[[nodiscard]] std::string scope_prefix(const NodeInstance& procedural);

}  // namespace lightsieve
