// An expression of any dialect: a regular expression over tests of single events.
//
// A reader makes one with tests of what its dialect sees (`Hit`); `resolve` turns the tests into
// sets of common events. From then on no stage knows the dialect that it came from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lpe/dialects/symbol_set.h"

namespace lightsieve::lpe::dialects {

/// One event as a dialect's expressions see it.
struct Hit {
    char event = 'C';    ///< C R T V L O B A, or a dialect's own letter
    std::string lobe{};  ///< D, G, S, s, S4, ...; empty: none
    std::vector<std::string>
        labels{};  ///< in the dialect's order; an empty one: that place is free

    friend bool operator==(const Hit&, const Hit&) = default;
};

using HitTest = std::function<bool(const Hit&)>;

struct Pattern;
using PatternPtr = std::shared_ptr<Pattern>;

struct Pattern {
    static constexpr std::uint32_t kUnbounded = UINT32_MAX;
    enum class Form : std::uint8_t {
        Nothing,       ///< takes no path
        Empty,         ///< takes the path of no events
        Event,         ///< one event
        Sequence,      ///< parts, one after the other
        Alternation,   ///< one of the parts
        Repeat,        ///< parts[0], min to max times
        Intersection,  ///< what all parts take
        Difference,    ///< what parts[0] takes and no other
        Complement,    ///< the light paths that parts[0] does not take
    };
    Form form = Form::Nothing;
    HitTest test{};      ///< Event: as it was read
    SymbolSet events{};  ///< Event: once it is resolved
    std::string text{};  ///< Event: in the dialect that it is to be written in
    std::vector<PatternPtr> parts{};
    std::uint32_t min = 1, max = 1;  ///< Repeat
};

/// Makers. They simplify: nothing absorbs, the empty path vanishes, nested ones are flattened.
[[nodiscard]] PatternPtr make_nothing();
[[nodiscard]] PatternPtr make_empty();
[[nodiscard]] PatternPtr make_event(HitTest test);
[[nodiscard]] PatternPtr make_events(SymbolSet events, std::string text = {});
[[nodiscard]] PatternPtr make_sequence(std::vector<PatternPtr> parts);
[[nodiscard]] PatternPtr make_alternation(std::vector<PatternPtr> parts);
[[nodiscard]] PatternPtr make_repeat(PatternPtr body, std::uint32_t min, std::uint32_t max);
/// Intersection, difference or complement, kept as it is.
[[nodiscard]] PatternPtr make_boolean(Pattern::Form form, std::vector<PatternPtr> parts);

[[nodiscard]] inline bool is_boolean(Pattern::Form form) {
    return form >= Pattern::Form::Intersection;
}
/// May it take the path of no events?
[[nodiscard]] bool is_nullable(const Pattern& pattern);
/// A copy that shares no node with it, made again by the makers, with every event replaced by what
/// `replace(node)` returns.
[[nodiscard]] PatternPtr rebuild(const Pattern& pattern,
                                 const std::function<PatternPtr(const Pattern&)>& replace);
/// Nodes, repeats counted once.
[[nodiscard]] std::size_t count_nodes(const Pattern& pattern);

}  // namespace lightsieve::lpe::dialects
