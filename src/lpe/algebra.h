// Proofs about expressions, over all light paths that any scene could produce, with a shortest
// path as witness.
//
// The infinitely many possible events fall into few classes, since expressions name few labels:
// `abstract_events` lists one event of each. Proofs then walk the product of two automata, made
// state by state as the walk reaches them, so that no large automaton is ever built. Everything
// here may throw InputError (a limit-lpe-* code).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/limits.h"
#include "lpe/path.h"

namespace lightsieve::lpe {

/// One event of each class that these expressions can tell apart in any scene, unlabelled ones
/// first.
///
/// A light is in one group, a background in one or none; other events carry up to two of the
/// labels (a lobe label and an object label, which is never coat, sheen, hair or default). A label
/// may serve as all of these: a proof for more paths than a scene has also holds for the scene's.
[[nodiscard]] std::vector<Event> abstract_events(std::span<const Expr> exprs,
                                                 const Limits& limits = {});

/// Labels that these expressions treat alike stand for one another in `abstract_events`.
struct LabelClasses {
    /// Of lobes (and emitters), and of lights; the first of each class is the one that
    /// `abstract_events` uses.
    std::vector<std::vector<std::string>> lobes{}, groups{};
};
[[nodiscard]] LabelClasses label_classes(std::span<const Expr> exprs);

/// A shortest path that the expression takes; nothing if it takes none.
[[nodiscard]] std::optional<Path> shortest_path(const Expr& expr, const Limits& limits = {});
/// The same among the paths made of these events only.
[[nodiscard]] std::optional<Path> shortest_path(const Expr& expr, std::span<const Event> events,
                                                const Limits& limits = {});
/// A shortest path that both expressions take; nothing if they are disjoint.
[[nodiscard]] std::optional<Path> shortest_common_path(const Expr& a, const Expr& b,
                                                       const Limits& limits = {});
/// A shortest path that a takes and b does not; nothing if a is a part of b.
[[nodiscard]] std::optional<Path> shortest_path_outside(const Expr& a, const Expr& b,
                                                        const Limits& limits = {});
/// Do both take exactly the same paths?
[[nodiscard]] bool equivalent(const Expr& a, const Expr& b, const Limits& limits = {});

/// How the paths of two expressions lie to one another.
enum class Relation : std::uint8_t {
    Equal,        ///< the same paths (maybe none)
    Subset,       ///< a takes a part of what b takes
    Superset,     ///< b takes a part of what a takes
    Overlapping,  ///< some in common, and each some of its own
    Disjoint,     ///< none in common
};

struct Comparison {
    Relation relation = Relation::Equal;
    /// A shortest path of each region that is not empty.
    std::optional<Path> only_a{}, only_b{}, both{};
};

/// Compares over all paths. An expression that takes none is a subset of every other.
[[nodiscard]] Comparison compare(const Expr& a, const Expr& b, const Limits& limits = {});
/// The same among the paths made of these events only (a scene's).
[[nodiscard]] Comparison compare(const Expr& a, const Expr& b, std::span<const Event> events,
                                 const Limits& limits = {});

/// Does the expression take a path that ends with light (L, O, B)?
[[nodiscard]] bool takes_light(const Expr& expr, const Limits& limits = {});
/// Does the expression take a path that ends with a probe (A)?
[[nodiscard]] bool takes_probe(const Expr& expr, const Limits& limits = {});

/// Whether the parts take each path of the whole exactly once, and nothing else.
struct PartitionReport {
    enum class Fault : std::uint8_t {
        None,     ///< it is a partition
        Lost,     ///< no part takes the witness
        Twice,    ///< parts `first` and `second` take the witness
        Outside,  ///< a part takes the witness, the whole does not
    };
    Fault fault = Fault::None;
    Path witness{};                     ///< a shortest path that shows the fault
    std::size_t first = 0, second = 0;  ///< indices of parts, for Twice

    [[nodiscard]] bool holds() const { return fault == Fault::None; }
};

/// Proves that `parts` partition `whole`, or finds a shortest path that shows that they do not.
[[nodiscard]] PartitionReport check_partition(const Expr& whole, std::span<const Expr> parts,
                                              const Limits& limits = {});
/// The same among the paths made of these events only.
[[nodiscard]] PartitionReport check_partition(const Expr& whole, std::span<const Expr> parts,
                                              std::span<const Event> events,
                                              const Limits& limits = {});

}  // namespace lightsieve::lpe
