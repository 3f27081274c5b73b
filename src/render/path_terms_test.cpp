// The shares of a path: reductions that keep sums and means, joining of groups, depth limits.
#include "render/path_terms.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "render/term_reduction.h"

namespace lightsieve {
namespace {

// Four colours to three ------------------------------------------------------------------------------------------------

using Four = std::array<Color, 4>;

Color sum(const Four& x) { return x[0] + x[1] + x[2] + x[3]; }

/// Sizes of the four, for tolerances.
double magnitude(const Four& x) {
    double out = 0;
    for (const Color& c : x)
        out += static_cast<double>(max_component(c));
    return out;
}

/// Reduces `x` with many evenly spread random numbers: checks each result and the mean of all.
void check_reduction(const Four& x, const std::string& what) {
    constexpr int kSteps = 4096;
    std::array<std::array<double, 3>, 4> mean{};
    for (int step = 0; step < kSteps; ++step) {
        Four y = x;
        const std::size_t dropped =
            drop_one_of_four(y, (static_cast<float>(step) + 0.5F) / kSteps);
        ASSERT_LT(dropped, 4U) << what;
        ASSERT_TRUE(is_black(y[dropped])) << what;
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(static_cast<double>(sum(y)[c]), static_cast<double>(sum(x)[c]),
                        5e-7 * magnitude(x))
                << what << ", step " << step;
            for (std::size_t i = 0; i < 4; ++i) {
                ASSERT_TRUE(std::isfinite(y[i][c]) && y[i][c] >= 0) << what;
                mean[i][static_cast<std::size_t>(c)] += static_cast<double>(y[i][c]) / kSteps;
            }
        }
    }
    // The odds are met to one step in kSteps, which moves a mean by at most twice the largest value over kSteps.
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[i][c], static_cast<double>(x[i][static_cast<int>(c)]),
                        2.5 * magnitude(x) / kSteps + 2e-5 * magnitude(x))
                << what << ", entry " << i;
}

TEST(DropOneOfFour, KeepsTheSumAndEveryMean) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto color = [&] { return Color(uniform(random), uniform(random), uniform(random)); };
    for (int i = 0; i < 200; ++i)
        check_reduction({color(), color(), color(), color()}, "random " + std::to_string(i));
}

TEST(DropOneOfFour, HandlesColoursThatSpanLess) {
    const Color red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), grey(0.5F, 0.5F, 0.5F);
    check_reduction({grey, grey, grey, grey}, "four equal");
    check_reduction({grey, grey * 2, grey * 3, grey * 1e-6F}, "parallel");
    check_reduction({red, red * 2, green, green * 0.1F}, "a plane of two axes");
    check_reduction({red, green, blue, red}, "three axes and a twin");
    check_reduction({red, green, red + green, grey}, "three in a plane, one not");
    check_reduction({red, green, blue, kWhite}, "white as the sum");
    check_reduction({red, kBlack, green, blue}, "a black one");
    check_reduction({red * 1e-12F, green * 1e6F, blue, kWhite * 1e-3F}, "very different sizes");
    // Degenerate up to every size of rounding.
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (const float size : {1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, 1e-7F})
        for (int i = 0; i < 5; ++i) {
            const auto near = [&](Color c) {
                return Color(c.r + size * (1 + uniform(random)),
                             c.g + size * (1 + uniform(random)),
                             c.b + size * (1 + uniform(random)));
            };
            check_reduction({near(grey), near(grey), near(grey), near(grey * 3)},
                            "nearly parallel");
            check_reduction({near(red), near(green), near(red + green), near(red * 0.3F + green)},
                            "nearly in a plane");
        }
}

// Depth limits ---------------------------------------------------------------------------------------------------------

LobeRecord record(EventKind kind, EventLobe lobe, std::uint32_t event) {
    LobeRecord out;
    out.kind = kind;
    out.lobe = lobe;
    out.event = event;
    return out;
}

const std::array<LobeRecord, 5> kRecords{record(EventKind::Reflection, EventLobe::Diffuse, 0),
                                         record(EventKind::Reflection, EventLobe::Specular, 1),
                                         record(EventKind::Transmission, EventLobe::Diffuse, 2),
                                         record(EventKind::Transmission, EventLobe::Specular, 3),
                                         record(EventKind::Volume, EventLobe::None, 4)};

constexpr std::array<bool, 8> kAllMatter{true, true, true, true, true, true, true, true};

/// Counters as the specification has them: RD and TD diffuse, RS specular, TS transmission, V volume.
struct PlainCounters {
    int diffuse = 0, specular = 0, transmission = 0, volume = 0;
    void count(const LobeRecord& r) {
        if (r.kind == EventKind::Volume)
            ++volume;
        else if (r.lobe == EventLobe::Diffuse)
            ++diffuse;
        else if (r.kind == EventKind::Reflection)
            ++specular;
        else
            ++transmission;
    }
    [[nodiscard]] int total() const { return diffuse + specular + transmission + volume; }
    [[nodiscard]] bool past(const DepthLimits& l) const {
        return diffuse > l.diffuse || specular > l.specular || transmission > l.transmission ||
               volume > l.volume || total() > l.total;
    }
};

TEST(DepthRules, AgreeWithPlainCountersOnEverySequence) {
    // Keys may forget what no longer matters, but never so that a limit binds earlier or later than it should.
    std::mt19937 random(2);
    const std::array<DepthLimits, 8> limits{
        DepthLimits{},   {1, 1, 2, 0, 10}, {8, 8, 8, 0, 10}, {4, 10, 2, 0, 6},
        {4, 4, 4, 4, 4}, {2, 3, 1, 5, 6},  {0, 0, 0, 0, 3},  {250, 250, 250, 250, 20}};
    for (const DepthLimits& limit : limits) {
        const DepthRules rules(limit, kAllMatter);
        for (int i = 0; i < 3000; ++i) {
            GroupKey key;
            PlainCounters plain;
            std::string path;
            while (!key.lights_only()) {
                const LobeRecord& through = kRecords[random() % kRecords.size()];
                path += "DSdsV"[through.event];
                key = rules.next(key, through);
                plain.count(through);
                ASSERT_EQ(key.lights_only(), plain.past(limit))
                    << path << " with limits " << int{limit.diffuse} << ' ' << int{limit.specular}
                    << ' ' << int{limit.transmission} << ' ' << int{limit.volume} << ' '
                    << int{limit.total};
                ASSERT_EQ(key.ray_type(), ray_type_of(through.kind, through.lobe, false)) << path;
            }
        }
    }
}

TEST(DepthRules, ForgetOrderSoThatKeysMerge) {
    const DepthRules rules({8, 8, 8, 8, 4}, kAllMatter);
    const auto follow = [&](std::initializer_list<std::size_t> steps) {
        GroupKey key;
        for (std::size_t s : steps)
            key = rules.next(key, kRecords[s]);
        return key;
    };
    EXPECT_EQ(follow({0, 1, 0}), follow({1, 0, 0}));
    EXPECT_EQ(follow({1, 1, 0}), follow({0, 1, 0}))
        << "no limit but the total can bind, so kinds do not matter";
    EXPECT_FALSE(follow({0, 0}) == follow({0, 0, 0}));
}

TEST(DepthRules, ExtraDepthBelongsToTheShaderThatHasIt) {
    const DepthRules rules({1, 1, 1, 1, 6}, kAllMatter);
    LobeRecord hair = kRecords[1];
    hair.extra_depth = 3;
    GroupKey key;
    for (int i = 0; i < 4; ++i) {
        key = rules.next(key, hair);
        EXPECT_FALSE(key.lights_only()) << i;
    }
    // Another shader has the plain limit, but lobes of other kinds go on.
    EXPECT_TRUE(rules.next(key, kRecords[1]).lights_only());
    EXPECT_FALSE(rules.next(key, kRecords[0]).lights_only());
    EXPECT_TRUE(rules.next(key, hair).lights_only());
}

TEST(DepthRules, TypesThatNothingTellsApartAreOne) {
    std::array<bool, 8> matters{};
    matters[static_cast<std::size_t>(RayType::DiffuseReflect)] = true;
    const DepthRules rules({2, 2, 2, 2, 8}, matters);
    EXPECT_EQ(rules.next({}, kRecords[0]).ray_type(), RayType::DiffuseReflect);
    EXPECT_EQ(rules.next({}, kRecords[3]).ray_type(), rules.next({}, kRecords[1]).ray_type());
}

TEST(DepthSteps, AreThoseOfTheRules) {
    // Far more keys than there are places: answers must not be mixed up.
    const DepthRules rules({250, 250, 250, 250, 250}, kAllMatter);
    DepthSteps steps(rules);
    std::mt19937 random(5);
    for (int path = 0; path < 500; ++path) {
        GroupKey key;
        for (int vertex = 0; vertex < 20; ++vertex) {
            const LobeRecord& through = kRecords[random() % kRecords.size()];
            const GroupKey next = rules.next(key, through);
            ASSERT_EQ(steps.next(key, through), next);
            ASSERT_EQ(steps.next(key, through), next) << "the second time";
            key = next;
        }
    }
}

// Groups and terms -----------------------------------------------------------------------------------------------------

std::array<Channel, 4> four_channels() {
    return {Channel{&kRecords[0], true},
            {&kRecords[1], true},
            {&kRecords[2], true},
            {&kRecords[3], true}};
}

const std::array<Color, 4> kFactors{Color(0.5F, 0.2F, 0.1F), Color(0.1F, 0.4F, 0.3F),
                                    Color(0.2F, 0.05F, 0.6F), Color(0.3F, 0.3F, 0.02F)};

/// A machine whose state is the number of diffuse events seen, up to 7; all states are live.
struct CountingMachine {
    using State = std::uint32_t;
    static constexpr std::size_t kMaxTerms = 24;
    [[nodiscard]] static State start() { return 0; }
    [[nodiscard]] static State step(State state, const LobeRecord& r) {
        return std::min(7U, state + (r.lobe == EventLobe::Diffuse ? 1U : 0U));
    }
    [[nodiscard]] static bool live(State) { return true; }
};

using Sums = std::map<std::uint32_t, std::array<double, 3>>;

void add_to(Sums& sums, std::uint32_t key, Color value, double weight) {
    for (std::size_t c = 0; c < 3; ++c)
        sums[key][c] += static_cast<double>(value[static_cast<int>(c)]) * weight;
}

TEST(PathTerms, FollowTheGroupsAndStayUnbiasedWhenTheyAreJoined) {
    // Six vertices with four lobes: far more keys than kMaxGroups and, with the machine's states, than kMaxTerms.
    constexpr int kVertices = 6, kRuns = 20000;
    const DepthRules rules({250, 3, 250, 250, 250}, kAllMatter);
    const std::array<Channel, 4> channels = four_channels();
    Sums truth, mean, squares;
    // Brute force: every sequence of lobes, by the number of diffuse events; past the specular limit a sequence ends.
    const std::function<void(int, GroupKey, std::uint32_t, Color)> walk =
        [&](int left, GroupKey key, std::uint32_t state, Color throughput) {
            if (left == 0) return add_to(truth, state, throughput, 1);
            if (key.lights_only()) return;
            for (std::size_t c = 0; c < kFactors.size(); ++c)
                walk(left - 1, rules.next(key, kRecords[c]),
                     CountingMachine::step(state, kRecords[c]), throughput * kFactors[c]);
        };
    walk(kVertices, {}, 0, kWhite);

    std::mt19937 generator(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto random = [&](std::uint32_t) { return std::min(uniform(generator), 0.99999994F); };
    const CountingMachine machine;
    DepthSteps steps(rules);
    PathGroups groups;
    PathTerms<CountingMachine> terms;
    for (int run = 0; run < kRuns; ++run) {
        groups.start(kWhite);
        terms.start(machine, kWhite);
        for (int v = 0; v < kVertices; ++v) {
            PathGroups::Step step;
            groups.scatter(std::span<const Channel>(channels), kFactors, steps, random, step);
            terms.scatter(machine, channels, kFactors, step, random);
            ASSERT_LE(groups.all().size(), PathGroups::kMaxGroups);
            ASSERT_LE(terms.all().size(), CountingMachine::kMaxTerms);
            // The terms of a group add up to the group.
            std::array<Color, PathGroups::kMaxGroups> sums{};
            for (const auto& t : terms.all())
                sums[t.group] += t.throughput;
            for (std::size_t g = 0; g < groups.all().size(); ++g)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(sums[g][c], groups[g].throughput[c],
                                1e-4F * max_component(groups[g].throughput))
                        << "group " << g;
        }
        Sums here;
        for (const auto& t : terms.all())
            add_to(here, t.state, t.throughput, 1);
        for (const auto& [state, value] : here)
            for (std::size_t c = 0; c < 3; ++c) {
                mean[state][c] += value[c] / kRuns;
                squares[state][c] += value[c] * value[c] / kRuns;
            }
    }
    // 7 states times 3 channels at 4.5 standard errors: a false alarm once in 7000 seeds.
    for (const auto& [state, value] : truth)
        for (std::size_t c = 0; c < 3; ++c) {
            const double variance =
                std::max(0.0, squares[state][c] - mean[state][c] * mean[state][c]);
            EXPECT_NEAR(mean[state][c], value[c],
                        4.5 * std::sqrt(variance / kRuns) + 1e-5 * value[c])
                << "state " << state << " channel " << c;
        }
}

TEST(PathGroups, JoiningReallyHappens) {
    // Guards the test above: without more candidates than kMaxGroups it would show nothing.
    const DepthRules rules({250, 3, 250, 250, 250}, kAllMatter);
    const std::array<Channel, 4> channels = four_channels();
    DepthSteps steps(rules);
    PathGroups groups;
    groups.start(kWhite);
    bool drew = false;
    const auto random = [&](std::uint32_t) {
        drew = true;
        return 0.5F;
    };
    for (int v = 0; v < 6; ++v) {
        PathGroups::Step step;
        groups.scatter(std::span<const Channel>(channels), kFactors, steps, random, step);
    }
    EXPECT_TRUE(drew);
    EXPECT_EQ(groups.all().size(), PathGroups::kMaxGroups);
}

TEST(PathGroups, CausticsOffLeavesSpecularLobesDarkForDiffuseRays) {
    const Channel with{&kRecords[1], true}, without{&kRecords[1], false},
        diffuse{&kRecords[0], false};
    GroupKey key;
    key.set_ray_type(RayType::DiffuseReflect);
    EXPECT_TRUE(channel_allowed(key, with));
    EXPECT_FALSE(channel_allowed(key, without));
    EXPECT_TRUE(channel_allowed(key, diffuse));
    key.set_ray_type(RayType::SpecularReflect);
    EXPECT_TRUE(channel_allowed(key, without));
    key.set_ray_type(RayType::Camera);
    EXPECT_TRUE(channel_allowed(key, without));
}

}  // namespace
}  // namespace lightsieve
