// Every way that we have to decide whether an expression takes a path, asked one after the other.
//
// They share the tree and little else, so that a mistake in one stage shows as a disagreement.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lpe/alphabet.h"
#include "lpe/determinise.h"
#include "lpe/path.h"
#include "lpe/program.h"

namespace lightsieve::lpe::testing {

/// One expression, ready to be asked.
class Engines {
  public:
    /// events  scattering and terminal events of all paths that will be asked
    Engines(Expr expr, std::vector<Event> events);

    struct Answer {
        std::string engine;
        bool takes;
    };
    /// The answers of: the naive matcher, `match`, the automaton as it was made, the minimised
    /// one, the program.
    [[nodiscard]] std::vector<Answer> ask(const Path& path) const;
    /// "" if all engines answer `expected`, else who does not.
    [[nodiscard]] std::string dissent(const Path& path, bool expected) const;
    /// What the naive matcher says, if all agree; else throws std::logic_error naming path and
    /// engines.
    bool agreed(const Path& path) const;

  private:
    [[nodiscard]] bool run(const Dfa& dfa, const Path& path) const;
    [[nodiscard]] bool run_program(const Path& path) const;
    [[nodiscard]] EventClass class_of(const Event& event) const;

    Expr expr_;
    std::vector<Event> events_;
    Alphabet alphabet_;
    Determinised made_;
    Dfa minimal_;
    Diagnostics diagnostics_;
    Program program_;
};

/// Every event but the camera of these paths.
[[nodiscard]] std::vector<Event> events_of(std::span<const Path> paths);

}  // namespace lightsieve::lpe::testing
