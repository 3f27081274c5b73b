// How fast light path expressions are: compiling all built-ins for 0, 8 and 64 light groups,
// stepping random paths, what explodes, and what is left over of the beauty.
//
// Prints one line per case: best of many runs, since the machine has other work. Aims: built-ins
// below 1 ms, with 64 groups below 10 ms, a step below 2.5 ns; whatever explodes ends within 2 s
// and 1 GiB; a rest within 50 ms.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "lpe/builtins.h"
#include "lpe/light_groups.h"
#include "lpe/print.h"
#include "lpe/program.h"
#include "lpe/rest.h"
#include "lpe/testing/generate.h"

namespace {

using namespace lightsieve;
using namespace lightsieve::lpe;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A scene with every lobe that our shaders have, and lights in `n_groups` groups.
std::vector<Event> scene_events(const std::vector<std::string>& groups) {
    std::vector<Event> events;
    for (const char* label : {"", "coat", "sheen", "hair"})
        events.push_back(
            {EventKind::Reflection, EventLobe::Specular,
             *label == '\0' ? std::vector<std::string>{} : std::vector<std::string>{label}});
    events.push_back({EventKind::Reflection, EventLobe::Diffuse, {}});
    events.push_back({EventKind::Transmission, EventLobe::Diffuse, {}});
    events.push_back({EventKind::Transmission, EventLobe::Specular, {}});
    events.push_back({EventKind::Volume, EventLobe::None, {}});
    events.push_back({EventKind::Light, EventLobe::None, {"default"}});
    events.push_back({EventKind::Object, EventLobe::None, {}});
    events.push_back({EventKind::Background, EventLobe::None, {}});
    events.push_back({EventKind::Albedo, EventLobe::None, {}});
    for (const std::string& group : groups) {
        events.push_back({EventKind::Light, EventLobe::None, {group}});
        events.push_back({EventKind::Background, EventLobe::None, {group}});
    }
    return events;
}

/// Every built-in, and its layer for each group where it ends at light.
std::vector<AovRequest> all_aovs(const ExpressionTable& table,
                                 const std::vector<std::string>& groups) {
    Diagnostics diagnostics;
    std::vector<AovRequest> aovs;
    const AovNames names{table, groups, {}};
    const auto add = [&](const std::string& name) {
        for (const LpeLayer& layer :
             resolve_output({name, "", "exr", {}}, names, diagnostics).layers)
            aovs.push_back(layer.request());
    };
    for (const Builtin& row : builtins()) {
        add(std::string(row.name));
        const bool is_albedo = row.expression.find('A') != std::string_view::npos;
        if (!groups.empty() && !is_albedo) add(std::string(row.name) + "_*");
    }
    return aovs;
}

/// Nanoseconds per event over random paths of one to eight scattering events and a terminal.
double step_ns(const Program& program, std::size_t n_paths, unsigned& checksum) {
    std::mt19937 random(1);
    std::vector<ClassId> columns;
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < n_paths; ++i) {
        for (std::size_t n = 1 + random() % 8; n > 0; --n)
            columns.push_back(Program::kFirstClass +
                              static_cast<ClassId>(random() % program.n_classes()));
        columns.push_back(program.first_terminal() +
                          static_cast<TerminalId>(random() % program.n_terminals()));
        ends.push_back(columns.size());
    }
    const Automaton& automaton = program.automaton(0);
    double best = 1e9;
    for (int run = 0; run < 50; ++run) {
        const Clock::time_point start = Clock::now();
        std::size_t at = 0;
        for (const std::size_t end : ends) {
            State state = automaton.start();
            while (at + 1 < end)
                state = automaton.step(state, columns[at++]);
            checksum += automaton.atom(state, columns[at++]);
        }
        best = std::min(best, seconds_since(start) / static_cast<double>(columns.size()));
    }
    return best * 1e9;
}

/// The same along one path of a million events, where each step waits for the one before.
double chain_ns(const Program& program, unsigned& checksum) {
    constexpr std::size_t kEvents = 1'000'000;
    std::mt19937 random(2);
    std::vector<ClassId> columns;
    for (std::size_t i = 0; i < kEvents; ++i)
        columns.push_back(Program::kFirstClass +
                          static_cast<ClassId>(random() % program.n_classes()));
    const Automaton& automaton = program.automaton(0);
    double best = 1e9;
    for (int run = 0; run < 20; ++run) {
        const Clock::time_point start = Clock::now();
        State state = automaton.start();
        for (const ClassId column : columns)
            state = automaton.step(state, column);
        checksum += state;
        best = std::min(best, seconds_since(start) / kEvents);
    }
    return best * 1e9;
}

void bench(std::size_t n_groups, unsigned& checksum) {
    std::vector<std::string> groups;
    for (std::size_t i = 0; i < n_groups; ++i)
        groups.push_back("group" + std::to_string(i));
    const ExpressionTable table;
    const std::vector<AovRequest> aovs = all_aovs(table, groups);
    const std::vector<Event> events = scene_events(groups);
    double best = 1e9;
    Diagnostics diagnostics;
    for (int run = 0; run < 50; ++run) {
        const Clock::time_point start = Clock::now();
        checksum +=
            static_cast<unsigned>(Program::compile(aovs, events, {}, diagnostics).n_atoms());
        best = std::min(best, seconds_since(start));
    }
    const Program program = Program::compile(aovs, events, {}, diagnostics);
    std::printf("%6zu %6zu %9.3f %7zu %7zu %9zu %7zu %9.2f %9.2f\n", n_groups, program.n_aovs(),
                best * 1e3, program.automaton(0).n_inner_states(), program.n_classes(),
                program.n_atoms(), program.table_bytes(), step_ns(program, 20'000, checksum),
                chain_ns(program, checksum));
}

/// Compiles in a process of its own, so that its peak memory is its own.
void explode(const char* name, const std::vector<AovRequest>& aovs) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child != 0) {
        waitpid(child, nullptr, 0);
        return;
    }
    Diagnostics diagnostics;
    const Clock::time_point start = Clock::now();
    const Program program = Program::compile(aovs, scene_events({}), {}, diagnostics);
    const double seconds = seconds_since(start);
    std::size_t n_states = 0;
    for (std::size_t i = 0; i < program.n_automata(); ++i)
        n_states += program.automaton(i).n_inner_states();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%-28s %8.3f s %6ld MiB %9zu %9zu %7zu\n", name, seconds, usage.ru_maxrss / 1024,
                program.n_automata(), n_states, diagnostics.n_errors());
    std::fflush(stdout);
    _exit(0);
}

void bench_explosions() {
    std::printf("\n%-28s %10s %10s %9s %9s %7s\n", "explosion", "time", "peak", "automata",
                "states", "refused");
    for (const char* text : {"C.*D.{11}L", "C.*D.{20}L", "C(((D?){16}){16}){16}L"})
        explode(text, {{"x", testing::must_parse(text)}});
    std::mt19937 random(7);
    std::vector<AovRequest> many;
    for (int i = 0; i < 1000; ++i)
        many.push_back({"aov" + std::to_string(i),
                        testing::random_light_expression(random, 4 + random() % 12)});
    explode("1000 random expressions", many);
}

/// What every subset of the additive sets leaves over.
void bench_rest(unsigned& checksum) {
    const ExpressionTable table;
    const Expr beauty = table.find("RGBA")->expr;
    double total = 0, worst = 0;
    std::size_t n = 0, longest = 0;
    for (const auto& set : additive_sets(BuiltinTable::Reference))
        for (std::size_t chosen = 0; chosen < (std::size_t{1} << set.size()); ++chosen) {
            std::vector<Expr> parts;
            for (std::size_t i = 0; i < set.size(); ++i)
                if ((chosen >> i & 1U) != 0) parts.push_back(table.find(set[i])->expr);
            const Clock::time_point start = Clock::now();
            const std::string text = print(rest(beauty, parts));
            const double seconds = seconds_since(start);
            total += seconds;
            worst = std::max(worst, seconds);
            longest = std::max(longest, text.size());
            checksum += static_cast<unsigned>(text.size());
            ++n;
        }
    std::printf("\nrest of %zu subsets: mean %.3f ms, worst %.3f ms, longest %zu characters\n", n,
                total / static_cast<double>(n) * 1e3, worst * 1e3, longest);
}

}  // namespace

int main() {
    unsigned checksum = 0;
    std::printf("groups   AOVs compile_ms states classes    atoms   bytes  ns/event  chain_ns\n");
    for (const std::size_t n_groups : {0U, 8U, 64U})
        bench(n_groups, checksum);
    bench_explosions();
    bench_rest(checksum);
    // Printed so that nothing above can be left out.
    std::printf("checksum %u\n", checksum);
    return 0;
}
