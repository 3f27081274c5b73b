// Equivalence classes of events: the letters that automata are made over.
//
// A scene has hundreds of events (every lobe with its labels, every light group), but expressions
// tell few of them apart. Two events that every test in every expression answers alike are one
// class, so tables stay small and a step costs the same however many lights and labels there are.
// Light and probes, scattering and terminal events are never in one class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/interner.h"

namespace lightsieve::lpe {

/// Number of a class: the camera, then scattering classes, then terminal classes.
using EventClass = std::uint32_t;

class Alphabet {
  public:
    static constexpr EventClass kCamera = 0;
    static constexpr EventClass kFirstScatter = 1;

    /// Classes of the camera event and of `events`, as the tests in `exprs` (nulls are skipped)
    /// tell them apart.
    Alphabet(std::span<const Expr> exprs, std::span<const Event> events);

    [[nodiscard]] std::size_t n_classes() const { return examples_.size(); }
    [[nodiscard]] std::size_t n_scatter() const { return n_scatter_; }
    [[nodiscard]] std::size_t n_terminals() const { return n_classes() - n_scatter_ - 1; }
    [[nodiscard]] EventClass first_terminal() const {
        return kFirstScatter + static_cast<EventClass>(n_scatter_);
    }
    /// The class of events[i].
    [[nodiscard]] EventClass class_of(std::size_t i) const { return class_of_event_[i]; }
    /// The first event of the class.
    [[nodiscard]] const Event& example(EventClass c) const { return examples_[c]; }
    /// Is the class a probe (A)?
    [[nodiscard]] bool is_probe(EventClass c) const {
        return examples_[c].kind == EventKind::Albedo;
    }
    /// Is the class a terminal that light arrives from (L, O, B)?
    [[nodiscard]] bool is_light(EventClass c) const {
        return c >= first_terminal() && !is_probe(c);
    }
    /// The classes that a test of one of the expressions takes, as a bit set of `n_words` words.
    [[nodiscard]] std::span<const std::uint32_t> taken_by(const Node& test) const;
    [[nodiscard]] std::size_t n_words() const { return (n_classes() + 31) / 32; }

  private:
    std::vector<EventClass> class_of_event_;
    std::vector<Event> examples_;
    std::size_t n_scatter_ = 0;
    Interner sets_;
    std::unordered_map<std::string, std::uint32_t> set_of_test_;  ///< by the test's text
};

}  // namespace lightsieve::lpe
