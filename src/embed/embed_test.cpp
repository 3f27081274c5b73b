#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/version.h"
#include "embed/flat_tables.h"
#include "lightsieve/lpe.h"
#include "lpe/match.h"
#include "lpe/parse.h"
#include "lpe/path.h"

extern "C" int lightsieve_c_caller(const char* expression, char* code);

namespace lightsieve::embed {
namespace {

const std::vector<Event> kEvents = {{Kind::Reflection, Lobe::Diffuse, {}},
                                    {Kind::Reflection, Lobe::Specular, {"coat", "car"}},
                                    {Kind::Transmission, Lobe::Specular, {}},
                                    {Kind::Volume, Lobe::None, {}},
                                    {Kind::Light, Lobe::None, {"key"}},
                                    {Kind::Light, Lobe::None, {}},
                                    {Kind::Object, Lobe::None, {}},
                                    {Kind::Background, Lobe::None, {}},
                                    {Kind::Albedo, Lobe::None, {}}};
constexpr std::size_t kScattering = 4;
/// The same events as the engine's readers of paths write them.
const std::vector<std::string> kTexts = {"RD", "RS'coat''car'", "TS", "V", "L'key'", "L", "O", "B",
                                         "A"};

/// The AOVs that take the path of these events (numbers into kEvents), over all automata.
std::vector<std::uint32_t> aovs_of_path(const Program& program,
                                        const std::vector<std::size_t>& path) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < program.n_automata(); ++i) {
        State state = program.start(i);
        for (std::size_t k = 0; k + 1 < path.size(); ++k)
            state = program.step(state, program.column(static_cast<std::uint32_t>(path[k])));
        const Atom atom =
            program.atom(state, program.column(static_cast<std::uint32_t>(path.back())));
        if (atom == kNoAtom) continue;
        const bool is_probe = kEvents[path.back()].kind == Kind::Albedo;
        EXPECT_TRUE(is_probe ? program.live_probe(state) : program.live_light(state));
        for (const std::uint32_t aov : program.aovs_of(atom))
            out.push_back(aov);
    }
    return out;
}

/// Every path of at most three scattering events.
std::vector<std::vector<std::size_t>> short_paths() {
    std::vector<std::vector<std::size_t>> prefixes{{}}, out;
    for (std::size_t at = 0; at < prefixes.size(); ++at) {
        const std::vector<std::size_t> prefix = prefixes[at];
        for (std::size_t event = 0; event < kEvents.size(); ++event) {
            std::vector<std::size_t> longer = prefix;
            longer.push_back(event);
            if (event >= kScattering) {
                if (!prefix.empty() || kEvents[event].kind != Kind::Albedo) out.push_back(longer);
            } else if (longer.size() <= 3) {
                prefixes.push_back(longer);
            }
        }
    }
    return out;
}

TEST(Embed, TheTablesTakeWhatTheMatcherTakes) {
    const std::vector<std::string> expressions = {
        "C.*", "C<RD>[DSVOB].*", "C<RS'coat'>.*", "C.*<L.'key'>", "C<RD>A", "CT+.*", "$specular"};
    Compiler compiler;
    for (const std::string& text : expressions)
        EXPECT_LT(compiler.add_aov("aov", text), expressions.size());
    for (const Event& event : kEvents)
        EXPECT_NE(compiler.add_event(event), kNoEvent);
    const Program program = compiler.compile();
    for (const Diagnostic& found : compiler.diagnostics())
        EXPECT_NE(found.severity, Severity::Error) << found.text;
    ASSERT_EQ(program.n_aovs(), expressions.size());

    std::size_t n_taken = 0;
    for (const std::vector<std::size_t>& path : short_paths()) {
        std::string text = "C";
        for (const std::size_t event : path)
            text += " " + kTexts[event];
        Diagnostics diagnostics;
        const auto read = lpe::parse_path(text, diagnostics);
        ASSERT_TRUE(read) << diagnostics.render();
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < expressions.size(); ++i)
            if (lpe::match(lpe::parse(expressions[i], diagnostics), *read)) expected.push_back(i);
        EXPECT_EQ(aovs_of_path(program, path), expected) << text;
        n_taken += expected.size();
    }
    EXPECT_GT(n_taken, 500U);
}

TEST(Embed, AllGroupsTogetherTakeEachLightPathOnce) {
    Compiler compiler;
    compiler.add_aov("key", "C.*", "key");
    compiler.add_aov("rest", "C.*", "default");
    for (const Event& event : kEvents)
        compiler.add_event(event);
    const Program program = compiler.compile();
    for (const std::vector<std::size_t>& path : short_paths()) {
        if (kEvents[path.back()].kind == Kind::Albedo) continue;
        const bool is_key = path.back() == kScattering;
        EXPECT_EQ(aovs_of_path(program, path), std::vector<std::uint32_t>{is_key ? 0U : 1U});
    }
}

TEST(Embed, ErrorsAreValuesWithTheirPlace) {
    Compiler compiler;
    compiler.add_aov("good", "C.*");
    compiler.add_aov("bad", "C<RD.*");
    for (const Event& event : kEvents)
        compiler.add_event(event);
    const Program program = compiler.compile();
    const std::vector<Diagnostic> found = compiler.diagnostics();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].severity, Severity::Error);
    EXPECT_EQ(found[0].code, "lpe-unclosed");
    EXPECT_EQ(found[0].expression, "C<RD.*");
    EXPECT_EQ(found[0].column, 2U);
    EXPECT_NE(found[0].message.find("bad"), std::string::npos) << found[0].message;
    EXPECT_NE(found[0].text.find("error[lpe-unclosed]"), std::string::npos) << found[0].text;
    // The other AOV is there.
    EXPECT_EQ(aovs_of_path(program, {0, 4}), std::vector<std::uint32_t>{0});
}

TEST(Embed, TheStandardLanguageRefusesExtensions) {
    Compiler compiler;
    compiler.add_aov("rest", "C.* - $diffuse");
    (void)compiler.compile();
    EXPECT_TRUE(compiler.diagnostics().empty());
    compiler.set_standard(true);
    (void)compiler.compile();
    ASSERT_FALSE(compiler.diagnostics().empty());
    EXPECT_EQ(compiler.diagnostics()[0].code, "lpe-standard");
}

TEST(Embed, EventsThatCannotBeAreRefused) {
    Compiler compiler;
    const std::vector<Event> impossible = {{Kind::Reflection, Lobe::None, {}},
                                           {Kind::Light, Lobe::Diffuse, {}},
                                           {Kind::Light, Lobe::None, {"a", "b"}},
                                           {Kind::Volume, Lobe::None, {""}},
                                           {static_cast<Kind>(7), Lobe::None, {}}};
    for (const Event& event : impossible)
        EXPECT_EQ(compiler.add_event(event), kNoEvent);
    EXPECT_EQ(compiler.add_event({Kind::Volume, Lobe::None, {"fire"}}), 0U);
}

TEST(Embed, ProgramsOutliveTheirCompilerAndTheirCopies) {
    const auto make = [] {
        Compiler compiler;
        compiler.add_aov("beauty", "C.*");
        for (const Event& event : kEvents)
            compiler.add_event(event);
        const Program first = compiler.compile();
        return Program(first);
    };
    const Program program = make();
    EXPECT_EQ(aovs_of_path(program, {1, 6}), std::vector<std::uint32_t>{0});
}

TEST(Embed, WithoutAovsNothingIsReached) {
    Compiler compiler;
    for (const Event& event : kEvents)
        compiler.add_event(event);
    const Program program = compiler.compile();
    EXPECT_EQ(program.n_atoms(), 0U);
    EXPECT_FALSE(program.live_light(program.start()));
    EXPECT_EQ(program.atom(program.step(program.start(), program.column(0)), program.column(4)),
              kNoAtom);
}

TEST(Embed, NullPointersAreRefused) {
    EXPECT_EQ(lightsieve_add_aov(nullptr, "a", "C.*", nullptr), LIGHTSIEVE_NONE);
    EXPECT_EQ(lightsieve_add_event(nullptr, nullptr), LIGHTSIEVE_NONE);
    EXPECT_EQ(lightsieve_compile(nullptr), nullptr);
    EXPECT_EQ(lightsieve_n_diagnostics(nullptr), 0U);
    lightsieve_compiler_destroy(nullptr);
    lightsieve_program_destroy(nullptr);
}

TEST(Embed, TheVersionIsTheBuilds) {
    const std::string macros = std::to_string(LIGHTSIEVE_VERSION_MAJOR) + "." +
                               std::to_string(LIGHTSIEVE_VERSION_MINOR) + "." +
                               std::to_string(LIGHTSIEVE_VERSION_PATCH);
    EXPECT_EQ(macros, kVersion);
    EXPECT_EQ(lightsieve_version(), macros);
}

TEST(Embed, ACallerInC) {
    char code[64] = "";
    // All light, the expression that is asked for, and the lamp's group; not the other group.
    EXPECT_EQ(lightsieve_c_caller("C<RD>L", code), 3);
    EXPECT_EQ(lightsieve_c_caller("C<RS>L", code), 2);
    EXPECT_EQ(lightsieve_c_caller("C<RQ>L", code), -1);
    EXPECT_EQ(std::string(code), "lpe-event");
}

/// A set that is split over several automata is still one table.
TEST(FlatTables, SeveralAutomataShareOneTable) {
    using EngineEvent = lightsieve::Event;
    const std::vector<EngineEvent> events = {{EventKind::Reflection, EventLobe::Diffuse, {}},
                                             {EventKind::Reflection, EventLobe::Specular, {}},
                                             {EventKind::Light, EventLobe::None, {"default"}}};
    Diagnostics diagnostics;
    const std::vector<std::string> texts = {"CD*L", "CD.*S.{3}L", "CS.*D.{4}L"};
    std::vector<lpe::AovRequest> requests;
    for (const std::string& text : texts)
        requests.push_back({text, lpe::parse(text, diagnostics)});
    lpe::Limits limits;
    limits.max_states = 40;
    const lpe::Program program = lpe::Program::compile(requests, events, limits, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << diagnostics.render();
    ASSERT_GT(program.n_automata(), 1U);
    const std::optional<FlatTables> flat = flatten(program, events);
    ASSERT_TRUE(flat);
    ASSERT_EQ(flat->starts.size(), program.n_automata());

    // All paths of up to 6 bounces, bit by bit; many can reach nothing in one of the automata.
    for (unsigned path = 0; path < 127; ++path) {
        unsigned length = 0;
        while (path + 1 >= (2U << length))
            ++length;
        const unsigned bits = path + 1 - (1U << length);
        for (std::size_t i = 0; i < program.n_automata(); ++i) {
            lpe::State expected = program.automaton(i).start();
            std::uint32_t state = flat->starts[i];
            for (unsigned k = 0; k < length; ++k) {
                const std::size_t event = bits >> k & 1U;
                expected =
                    program.automaton(i).step(expected, program.scatter_class(events[event]));
                state = flat->table[state + flat->event_columns[event]];
            }
            EXPECT_EQ(flat->table[state + flat->event_columns[2]],
                      program.automaton(i).atom(expected, program.terminal(events[2])));
            EXPECT_EQ(flat->table[state], program.automaton(i).live_light(expected) ? 1U : 0U);
        }
    }
    EXPECT_FALSE(flatten(program, events, flat->table.size() - 1));
    EXPECT_TRUE(flatten(program, events, flat->table.size()));
}

}  // namespace
}  // namespace lightsieve::embed
