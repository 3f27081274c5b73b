#include "lpe/testing/fuzz_targets.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "lpe/algebra.h"
#include "lpe/dialects/dialect.h"
#include "lpe/dialects/translate.h"
#include "lpe/parse.h"
#include "lpe/print.h"
#include "lpe/program.h"
#include "lpe/rest.h"
#include "lpe/testing/generate.h"
#include "lpe/testing/naive_matcher.h"

namespace lightsieve::lpe::testing {
namespace {

/// Small enough for thousands of runs a second, large enough for what people write.
constexpr Limits kLimits{.max_states = 300,
                         .max_steps = 60'000,
                         .max_nodes = 20'000,
                         .max_table_bytes = 1U << 20U,
                         .max_automata = 8,
                         .max_labels = 5};
constexpr std::size_t kMaxExpressions = 4;
/// Ways that the naive matcher may have to try.
constexpr double kMaxNaiveWork = 20'000;
/// Events of the longest path that is tried, the camera included.
constexpr std::size_t kMaxPathEvents = 4;

void require(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

void check_places(const Diagnostics& diagnostics, std::size_t length) {
    for (const Error& error : diagnostics.items()) {
        require(!error.message.empty(), "a report without a message");
        if (error.where.source && error.where.source->text.size() == length)
            require(error.where.offset + error.where.length <= length,
                    "a place outside the text: " + error.message);
    }
    (void)diagnostics.render();
}

/// About how many ways to divide a short path the naive matcher tries.
double naive_work(const Node& node) {
    if (is_event_test(node)) return 1;
    double inner = 0;
    for (const Expr& child : children(node))
        inner += naive_work(*child);
    const auto* repeat = std::get_if<Repeat>(&node.form);
    if (repeat == nullptr) return 1 + kMaxPathEvents * inner;
    const std::size_t rounds = repeat->min + kMaxPathEvents + 2;
    return 1 + static_cast<double>(rounds * kMaxPathEvents) * inner;
}

/// Does the program say of this AOV what the naive matcher says?
void check_path(const Program& program, const std::vector<AovRequest>& aovs, const Path& path) {
    std::vector<bool> taken(aovs.size(), false);
    for (std::size_t a = 0; a < program.n_automata(); ++a) {
        const Automaton& automaton = program.automaton(a);
        State state = automaton.start();
        for (std::size_t i = 1; i + 1 < path.size(); ++i)
            state = automaton.step(state, program.scatter_class(path[i]));
        const AtomId atom = automaton.atom(state, program.terminal(path.back()));
        if (atom == kNoAtom) continue;
        for (const std::uint32_t aov : program.aovs_of(atom))
            taken[aov] = true;
    }
    for (std::size_t i = 0; i < aovs.size(); ++i)
        if (aovs[i].expr && naive_work(*aovs[i].expr) < kMaxNaiveWork)
            require(taken[i] == naive_match(aovs[i].expr, path),
                    print(aovs[i].expr) + " on " + print_path(path));
}

/// A witness must be what it is a witness for.
void check_witnesses(const Expr& a, const Expr& b) {
    if (naive_work(*a) + naive_work(*b) > kMaxNaiveWork) return;
    const Comparison found = compare(a, b, kLimits);
    const auto check = [&](const std::optional<Path>& path, bool in_a, bool in_b) {
        if (path && path->size() <= kMaxPathEvents)
            require(naive_match(a, *path) == in_a && naive_match(b, *path) == in_b,
                    "wrong witness " + print_path(*path));
    };
    check(found.only_a, true, false);
    check(found.only_b, false, true);
    check(found.both, true, true);
}

}  // namespace

void fuzz_parser(std::string_view text) {
    for (const auto binding : {AlternationBinding::Loose, AlternationBinding::Tight}) {
        Diagnostics diagnostics;
        const Expr expr = parse(text, SourceSpan{}, diagnostics, {.binding = binding});
        check_places(diagnostics, text.size());
        require((expr == nullptr) == diagnostics.has_errors(), "an error or a tree, not both");
        if (!expr) continue;
        const std::string printed = print(expr);
        Diagnostics again;
        require(equal(parse(printed, again), expr), "reads differently: " + printed);
    }
    Diagnostics standard;
    (void)parse(text, SourceSpan{}, standard, {.standard = true});
    check_places(standard, text.size());
    Diagnostics of_path;
    const std::optional<Path> path = parse_path(text, of_path);
    check_places(of_path, text.size());
    if (path) require(parse_path(print_path(*path), of_path) == path, "path reads differently");
}

void fuzz_compiler(std::string_view text) {
    std::vector<AovRequest> aovs;
    for (std::size_t begin = 0; begin < text.size() && aovs.size() < kMaxExpressions;) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        Diagnostics unused;
        if (Expr expr = parse(text.substr(begin, end - begin), unused))
            aovs.push_back({"line " + std::to_string(aovs.size()), std::move(expr)});
        begin = end + 1;
    }
    if (aovs.empty()) return;
    static const std::vector<Event> events =
        must_events("RD RS RS'coat' TS'a''b' V L L'key' O'a' B A");
    static const std::vector<Path> paths = all_paths(events, kMaxPathEvents - 1);
    static const std::vector<Path> long_paths = [] {
        std::mt19937 random(1);
        std::vector<Path> out;
        for (int i = 0; i < 40; ++i)
            out.push_back(random_path(random, events, kMaxPathEvents));
        return out;
    }();
    Diagnostics diagnostics;
    const Program program = Program::compile(aovs, events, kLimits, diagnostics);
    // One that is over its limit takes nothing.
    if (diagnostics.has_errors()) return;
    for (const Path& path : paths)
        check_path(program, aovs, path);
    for (const Path& path : long_paths)
        check_path(program, aovs, path);
    try {
        check_witnesses(aovs.front().expr, aovs.back().expr);
        (void)simplify(aovs.front().expr, kLimits);
    } catch (const InputError&) {
        // Too much work.
    }
}

void fuzz_dialects(std::string_view text) {
    if (text.size() < 2) return;
    const std::span<const dialects::Dialect* const> all = dialects::dialects();
    const auto pick = [&](char c) -> const dialects::Dialect& {
        return *all[static_cast<unsigned char>(c) % all.size()];
    };
    const dialects::Dialect &from = pick(text[0]), &to = pick(text[1]);
    const std::string_view expression = text.substr(2);
    Diagnostics diagnostics;
    try {
        const std::optional<dialects::Translation> made = dialects::translate(
            expression, SourceSpan{}, from, to, diagnostics, {.without = {}, .limits = kLimits});
        check_places(diagnostics, expression.size());
        require(made.has_value() || diagnostics.has_errors(), "nothing, and no error");
        if (!made || made->text.empty()) return;
        require(!made->exact || (!made->lost && !made->added), "exact, with a loss");
        Diagnostics again;
        (void)to.read(made->text, SourceSpan{}, again);
        require(!again.has_errors(), "cannot be read: " + made->text);
    } catch (const InputError&) {
        // Too much work.
    }
}

}  // namespace lightsieve::lpe::testing
