// What an expression takes, told to a person: in a sentence, by examples, by what it just misses,
// and by the AOVs that people know.
//
// Examples alone hide the edges; a near miss, a path that differs from a taken one in one event,
// shows them, and the reason comes from the automaton: what would have to stand in that place.
// Everything is decided over all paths, or over those that a scene can make.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/event.h"
#include "lpe/algebra.h"
#include "lpe/ast.h"
#include "lpe/limits.h"
#include "lpe/path.h"

namespace lightsieve::lpe {

/// A path that the expression takes.
struct TakenPath {
    Path path;
    std::string words;  ///< "a path that leaves the camera, ..."
};

/// A path that it does not take, one event away from one that it does.
struct NearMiss {
    Path path;
    std::string words;
    std::string reason;  ///< "after C RD it must end at a light"
};

/// Another AOV that takes some of its paths.
struct RelatedAov {
    std::string name;
    Relation relation = Relation::Overlapping;  ///< of the expression to the AOV; never Disjoint
};

struct Explanation {
    std::string words;  ///< "paths that leave the camera, are reflected diffusely, and ..."
    std::vector<std::string> notes;     ///< whole sentences: what is easily misread in it
    std::vector<TakenPath> taken;       ///< the shortest ones, none if it takes none
    std::vector<NearMiss> near_misses;  ///< differing in what was changed
    std::vector<RelatedAov> related;    ///< in the order of the others, equal ones first

    /// All of it but the paths as one paragraph. `name` is what it is called: `diffuse` or "It".
    [[nodiscard]] std::string paragraph(const std::string& name) const;
};

struct ExplainOptions {
    std::span<const NamedExpr> others{};  ///< AOVs to compare with; null expressions are skipped
    std::span<const Event> events{};      ///< what paths are made of; empty: all paths
    std::size_t n_paths = 3;              ///< of each kind at most
    Limits limits{};
};

/// Explains the expression. Null takes nothing.
///
/// throws  InputError (limit)
[[nodiscard]] Explanation explain(const Expr& expr, const ExplainOptions& options = {});

}  // namespace lightsieve::lpe
