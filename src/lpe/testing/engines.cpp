#include "lpe/testing/engines.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "lpe/match.h"
#include "lpe/minimise.h"
#include "lpe/print.h"
#include "lpe/testing/naive_matcher.h"

namespace lightsieve::lpe::testing {

Engines::Engines(Expr expr, std::vector<Event> events)
    : expr_(std::move(expr)),
      events_(std::move(events)),
      alphabet_({&expr_, 1}, events_),
      made_(determinise({&expr_, 1}, alphabet_, {})),
      minimal_(minimise(made_.dfa)),
      program_(Program::compile(std::array{AovRequest{"x", expr_}}, events_, {}, diagnostics_)) {}

EventClass Engines::class_of(const Event& event) const {
    const auto found = std::ranges::find(events_, event);
    return alphabet_.class_of(static_cast<std::size_t>(found - events_.begin()));
}

bool Engines::run(const Dfa& dfa, const Path& path) const {
    std::uint32_t state = dfa.start;
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
        state = dfa.step(state, class_of(path[i]));
    const std::uint32_t column = class_of(path.back()) - alphabet_.first_terminal();
    const std::uint32_t set = made_.outputs[dfa.output[state]][column];
    return !made_.sets[set].empty();
}

bool Engines::run_program(const Path& path) const {
    const Automaton& automaton = program_.automaton(0);
    State state = automaton.start();
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
        state = automaton.step(state, program_.scatter_class(path[i]));
    return automaton.atom(state, program_.terminal(path.back())) != kNoAtom;
}

std::vector<Engines::Answer> Engines::ask(const Path& path) const {
    return {{"naive", naive_match(expr_, path)},
            {"match", match(expr_, path)},
            {"automaton", run(made_.dfa, path)},
            {"minimised", run(minimal_, path)},
            {"program", run_program(path)}};
}

std::string Engines::dissent(const Path& path, bool expected) const {
    std::string out;
    for (const Answer& answer : ask(path))
        if (answer.takes != expected) out += " " + answer.engine;
    return out;
}

bool Engines::agreed(const Path& path) const {
    const bool naive = naive_match(expr_, path);
    const std::string others = dissent(path, naive);
    if (!others.empty())
        throw std::logic_error(print(expr_) + " on " + print_path(path) + ": naive says " +
                               (naive ? "yes" : "no") + ", not so" + others);
    return naive;
}

std::vector<Event> events_of(std::span<const Path> paths) {
    std::vector<Event> events;
    for (const Path& path : paths)
        for (const Event& event : path)
            if (event.kind != EventKind::Camera) events.push_back(event);
    std::ranges::sort(events);
    events.erase(std::unique(events.begin(), events.end()), events.end());
    return events;
}

}  // namespace lightsieve::lpe::testing
