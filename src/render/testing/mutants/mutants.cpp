// The test of the tests: with a fault injected into the renderer, some check must say so.
//
// Each fault still shows the right beauty, or nearly: what notices it are the laws, the path log and the comparison of
// each lobe with a truth found otherwise. Each test prints which checks noticed.
#include <gtest/gtest.h>

#include "render/faults.h"
#include "render/testing/lobe_checks.h"

namespace lightsieve::testing {
namespace {

/// Injects a fault as long as it lives.
class Injection {
  public:
    explicit Injection(Fault fault) { injected_fault = fault; }
    ~Injection() { injected_fault = Fault::None; }
    Injection(const Injection&) = delete;
    Injection& operator=(const Injection&) = delete;
};

struct Mutant {
    Fault fault;
    const char* name;
    const char* killer;  ///< a check that must notice; others may
};

class Mutants : public ::testing::TestWithParam<Mutant> {};

INSTANTIATE_TEST_SUITE_P(
    Faults, Mutants,
    ::testing::Values(
        Mutant{Fault::CoatAsSpecular, "coat_as_specular", "single lobes"},
        Mutant{Fault::DrawnLobeTakesAll, "drawn_lobe_takes_all", "lobes under a quad"},
        Mutant{Fault::TransmissionAsDiffuse, "transmission_as_diffuse", "single lobes"},
        Mutant{Fault::LightHitAsObject, "light_hit_as_object", "direct light is direct"},
        Mutant{Fault::DepthFromDrawnLobe, "depth_from_drawn_lobe", "depth limits by lobe"}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_P(Mutants, AreKilled) {
    std::string killers;
    const Injection injection(GetParam().fault);
    for (const NamedCheck& check : lobe_checks()) {
        const Verdict verdict = check.run();
        if (!verdict) killers += "\n  " + check.name + ": " + verdict.why;
        EXPECT_FALSE(verdict.good && check.name == GetParam().killer)
            << check.name << " does not notice";
    }
    EXPECT_FALSE(killers.empty()) << "no check notices";
    std::printf("%s is noticed by:%s\n", GetParam().name, killers.c_str());
}

TEST(NoMutant, LeavesAllChecksContent) {
    for (const NamedCheck& check : lobe_checks())
        EXPECT_TRUE(check.run()) << check.name;
}

}  // namespace
}  // namespace lightsieve::testing
