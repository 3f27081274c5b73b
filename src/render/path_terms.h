// What a path carries: throughput split by everything that later decisions depend on.
//
// A direction is drawn from the mixture of all lobes, so it belongs to all of them. The path therefore keeps, beside
// each other, the shares that came through different lobes (docs/architecture.md, "From lobe to AOV, exactly"):
//
//   groups   by depth counters and last ray type: what Arnold's depth limits, masks and light multipliers go by.
//            They exist for the beauty alone and never depend on which AOVs are asked for.
//   terms    by group and automaton state: what the AOVs need. The terms of a group add up to the group's throughput
//            (but for terms that no AOV can use any more, which are dropped).
//
// Equal keys merge. More than kMaxGroups groups: the faintest are joined by a weighted coin (unbiased). More than
// kMaxTerms terms: a null-vector step (render/term_reduction.h) drops one and keeps the group's sum exact.
//
// The machine is a template argument: the renderer steps the engine's automaton, the path log a tree of histories.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bsdf/closure.h"
#include "core/ray_type.h"
#include "core/vec.h"
#include "render/term_reduction.h"

namespace lightsieve {

/// How many bounces of each kind a path may make, as options.GI_*_depth.
struct DepthLimits {
    std::uint8_t diffuse = 0, specular = 0, transmission = 2, volume = 0, total = 10;
};

/// Depth counters and last ray type of a share of a path, packed into one word: keys are made, compared and copied for
/// every share at every vertex, and bytes that are read back as a word would wait for each other.
class GroupKey {
  public:
    /// What is counted: bounces by kind, and those of which only the number still matters, see DepthRules.
    enum class Count : std::uint8_t { Diffuse, Specular, Transmission, Volume, Forgotten };

    [[nodiscard]] constexpr int count(Count of) const { return byte(shift_of(of)); }
    [[nodiscard]] constexpr int total() const {
        int sum = 0;
        for (unsigned shift = 0; shift < kRayTypeShift; shift += 8)
            sum += byte(shift);
        return sum;
    }
    [[nodiscard]] constexpr RayType ray_type() const {
        return static_cast<RayType>(byte(kRayTypeShift));
    }
    /// Past a depth limit: the ray may still meet lights, everything else is black.
    [[nodiscard]] constexpr bool lights_only() const { return (word_ & kLightsOnly) != 0; }
    /// Past a depth limit, and the shader says exit_to_background.
    [[nodiscard]] constexpr bool exits() const { return (word_ & kExits) != 0; }
    /// No event yet: the camera sees what the ray meets.
    [[nodiscard]] constexpr bool seen() const { return (word_ & kUnseen) == 0; }
    /// Factor on what the ray meets but lights, see PathGroups.
    [[nodiscard]] constexpr std::size_t indirect() const { return byte(kIndirectShift); }

    constexpr void add(Count to, int n) { word_ += static_cast<std::uint64_t>(n) << shift_of(to); }
    constexpr void clear(Count of) { word_ &= ~(kByte << shift_of(of)); }
    constexpr void set_ray_type(RayType type) {
        word_ = (word_ & ~(kByte << kRayTypeShift)) | static_cast<std::uint64_t>(type)
                                                          << kRayTypeShift;
    }
    constexpr void set_lights_only(bool on) { set(kLightsOnly, on); }
    constexpr void set_exits(bool on) { set(kExits, on); }
    constexpr void set_seen(bool on) { set(kUnseen, !on); }
    constexpr void set_indirect(std::uint8_t index) {
        word_ = (word_ & ~(kByte << kIndirectShift)) | std::uint64_t{index} << kIndirectShift;
    }
    /// All of it, for tables.
    [[nodiscard]] constexpr std::uint64_t bits() const { return word_; }
    friend constexpr bool operator==(GroupKey, GroupKey) = default;

  private:
    static constexpr std::uint64_t kByte = 255, kLightsOnly = 1ULL << 48U, kExits = 1ULL << 49U,
                                   kUnseen = 1ULL << 50U;
    static constexpr unsigned kRayTypeShift = 40, kIndirectShift = 56;
    static constexpr unsigned shift_of(Count count) { return 8 * static_cast<unsigned>(count); }
    [[nodiscard]] constexpr std::uint8_t byte(unsigned shift) const {
        return static_cast<std::uint8_t>(word_ >> shift);
    }
    constexpr void set(std::uint64_t bit, bool on) { word_ = on ? word_ | bit : word_ & ~bit; }

    std::uint64_t word_ = static_cast<std::uint64_t>(RayType::Camera) << kRayTypeShift;
};

/// The ray that leaves a vertex through a lobe.
[[nodiscard]] constexpr RayType ray_type_of(EventKind kind, EventLobe lobe, bool subsurface) {
    if (subsurface) return RayType::Subsurface;
    if (kind == EventKind::Volume) return RayType::Volume;
    if (kind == EventKind::Reflection)
        return lobe == EventLobe::Diffuse ? RayType::DiffuseReflect : RayType::SpecularReflect;
    return lobe == EventLobe::Diffuse ? RayType::DiffuseTransmit : RayType::SpecularTransmit;
}

/// Lobes of one hit that make the same event and obey the same rules, taken together.
struct Channel {
    const LobeRecord* record = nullptr;
    bool caustics = true;
    float indirect = 1;        ///< factor on indirect light
    bool direct_light = true;  ///< false: no light that comes from a light

    [[nodiscard]] bool matches(const Channel& other) const {
        const LobeRecord& a = *record;
        const LobeRecord& b = *other.record;
        return a.event == b.event && a.kind == b.kind && a.lobe == b.lobe &&
               a.subsurface == b.subsurface && a.exit_to_background == b.exit_to_background &&
               a.extra_depth == b.extra_depth && a.makes_no_event == b.makes_no_event &&
               caustics == other.caustics && indirect == other.indirect &&
               direct_light == other.direct_light;
    }
};

inline constexpr std::size_t kMaxChannels = ClosureSet::kMaxClosures + ClosureSet::kMaxSubsurfaces;

/// Turns depth counters into the next ones, and forgets differences that can no longer matter.
class DepthRules {
  public:
    /// type_matters  whether anything in the scene tells these ray types apart; others become one
    DepthRules(DepthLimits limits, std::array<bool, 8> type_matters)
        : limits_(limits), type_matters_(type_matters) {}

    [[nodiscard]] GroupKey next(GroupKey key, const LobeRecord& through) const {
        // Which counter an event uses: RD and TD diffuse, RS specular, TS transmission, V volume. The others are within
        // their limits, or within what a shader with extra_depth added to them.
        const RayType type = ray_type_of(through.kind, through.lobe, through.subsurface);
        const auto [counter, limit] = [&]() -> std::pair<GroupKey::Count, int> {
            switch (type) {
                case RayType::Volume: return {GroupKey::Count::Volume, limits_.volume};
                case RayType::SpecularTransmit:
                    return {GroupKey::Count::Transmission, limits_.transmission};
                case RayType::SpecularReflect:
                    return {GroupKey::Count::Specular, limits_.specular};
                default: return {GroupKey::Count::Diffuse, limits_.diffuse};
            }
        }();
        key.add(counter, 1);
        const int total = key.total();
        const bool lights_only =
            key.count(counter) > limit + through.extra_depth || total > limits_.total;
        key.set_lights_only(lights_only);
        key.set_exits(lights_only && through.exit_to_background);
        key.set_seen(key.seen() && through.makes_no_event);
        key.set_ray_type(type_matters_[static_cast<std::size_t>(type)] ? type
                                                                       : RayType::SpecularReflect);
        return canonical(key, total);
    }

  private:
    /// Forgets the counts of kinds whose limit can no longer bind before the total does, so that equal futures are equal keys.
    /// A kind that is free once stays so: each event takes at most one from its limit and exactly one from the total's rest.
    [[nodiscard]] GroupKey canonical(GroupKey key, int total) const {
        const int left = limits_.total - total;
        const auto forget = [&](GroupKey::Count kind, int limit) {
            const int used = key.count(kind);
            // Past the limits only the number of bounces still matters (indirect multipliers, max_bounces).
            if (!key.lights_only() && limit - used < left) return;
            key.add(GroupKey::Count::Forgotten, used);
            key.clear(kind);
        };
        forget(GroupKey::Count::Diffuse, limits_.diffuse);
        forget(GroupKey::Count::Specular, limits_.specular);
        forget(GroupKey::Count::Transmission, limits_.transmission);
        forget(GroupKey::Count::Volume, limits_.volume);
        return key;
    }

    DepthLimits limits_;
    std::array<bool, 8> type_matters_;
};

static_assert(sizeof(GroupKey) == 8);

/// Remembers answers of DepthRules: paths ask for few different steps, over and over. One for each thread.
class DepthSteps {
  public:
    /// rules  and the records that it is asked for must outlive it
    explicit DepthSteps(const DepthRules& rules) : rules_(rules) {}

    [[nodiscard]] GroupKey next(GroupKey key, const LobeRecord& through) {
        Known& known = known_[place(key, through)];
        if (known.through != &through || !(known.from == key))
            known = {&through, key, rules_.next(key, through)};
        return known.to;
    }

  private:
    struct Known {
        const LobeRecord* through = nullptr;
        GroupKey from, to;
    };
    static constexpr unsigned kPlaceBits = 7;
    static std::size_t place(GroupKey key, const LobeRecord& through) {
        const auto mixed =
            key.bits() ^ (reinterpret_cast<std::uintptr_t>(&through) / alignof(LobeRecord));
        return (mixed * 0x9e3779b97f4a7c15U) >> (64U - kPlaceBits);
    }

    const DepthRules& rules_;
    std::array<Known, std::size_t{1} << kPlaceBits> known_;
};

struct PathGroup {
    GroupKey key;
    Color throughput;
};

/// True if light through this channel exists for a share that arrived with this key: Arnold's `caustics` switch.
[[nodiscard]] inline bool channel_allowed(const GroupKey& key, const Channel& channel) {
    const bool diffuse_ray = key.ray_type() == RayType::DiffuseReflect ||
                             key.ray_type() == RayType::DiffuseTransmit ||
                             key.ray_type() == RayType::Subsurface;
    return channel.caustics || channel.record->lobe != EventLobe::Specular || !diffuse_ray;
}

/// True if a share that arrived with this key goes on through this channel at all.
[[nodiscard]] inline bool may_scatter(const GroupKey& key, const Channel& channel) {
    return !key.lights_only() && channel_allowed(key, channel);
}

/// The groups of a path.
///
/// A shader may scale indirect light alone. Whether light is indirect is known only when the next ray has met something:
/// lights are direct. So the factor waits in the group until the next scattering, and whoever adds light that is no
/// light's asks for `indirect`.
class PathGroups {
  public:
    static constexpr std::size_t kMaxGroups = 8;
    static constexpr std::uint8_t kNone = 255;

    void start(Color throughput) {
        n_ = 1;
        n_factors_ = 1;
        groups_[0] = {GroupKey{}, throughput};
    }
    [[nodiscard]] std::span<const PathGroup> all() const { return {groups_.data(), n_}; }
    [[nodiscard]] const PathGroup& operator[](std::size_t i) const { return groups_[i]; }
    /// Factor on what group `i` brings from anything but lights, and on all that it scatters.
    [[nodiscard]] float indirect(std::size_t i) const {
        return factors_[current_][groups_[i].key.indirect()].indirect;
    }
    /// Whether lights that the ray of group `i` meets count.
    [[nodiscard]] bool direct_light(std::size_t i) const {
        return factors_[current_][groups_[i].key.indirect()].direct_light;
    }
    [[nodiscard]] Color total() const {
        Color sum;
        for (std::size_t i = 0; i < n_; ++i)
            sum += groups_[i].throughput;
        return sum;
    }
    void scale(Color factor) {
        for (std::size_t i = 0; i < n_; ++i)
            groups_[i].throughput *= factor;
    }
    /// Keeps only group `i`, scaled. For masks that see some shares of a ray and not others.
    void keep_only(std::size_t i, float factor) {
        groups_[0] = {groups_[i].key, groups_[i].throughput * factor};
        n_ = 1;
    }

    /// Where each (group, channel) went: the terms follow the groups through a vertex by this map.
    struct Step {
        std::array<std::array<std::uint8_t, kMaxChannels>, kMaxGroups>
            to;  ///< new group, or kNone
        std::array<std::array<float, kMaxChannels>, kMaxGroups>
            scale;  ///< factor that waited, times that of a coin that joined groups
        std::array<PathGroup, kMaxGroups * kMaxChannels>
            candidates;  ///< of `scatter`; kept, because clearing it costs more than using it
    };

    /// Moves every group through every channel. factors[c] = f_c / p_mix; black ones are left out.
    /// random  gives uniform numbers, used only when there are too many groups
    template <class Random>
    void scatter(std::span<const Channel> channels, std::span<const Color> factors,
                 DepthSteps& steps, const Random& random, Step& step) {
        std::array<PathGroup, kMaxCandidates>& candidates = step.candidates;
        // The factors that waited, and those that wait from now on: two lists in turn.
        const std::array<Waiting, kMaxFactors>& waiting = factors_[current_];
        current_ = 1 - current_;
        factors_[current_][0] = {};
        std::array<std::uint8_t, kMaxChannels> factor_of;
        n_factors_ = 1;
        for (std::size_t c = 0; c < channels.size(); ++c)
            factor_of[c] = factor_index({channels[c].indirect, channels[c].direct_light});
        std::size_t n = 0;
        for (std::size_t g = 0; g < n_; ++g)
            for (std::size_t c = 0; c < channels.size(); ++c) {
                step.to[g][c] = kNone;
                const float scale = waiting[groups_[g].key.indirect()].indirect;
                step.scale[g][c] = scale;
                if (is_black(factors[c]) || scale == 0 ||
                    !may_scatter(groups_[g].key, channels[c]))
                    continue;
                GroupKey key = steps.next(groups_[g].key, *channels[c].record);
                key.set_indirect(factor_of[c]);
                std::size_t i = 0;
                while (i < n && !(candidates[i].key == key))
                    ++i;
                if (i == n) candidates[n++] = {key, Color{}};
                candidates[i].throughput += groups_[g].throughput * factors[c] * scale;
                step.to[g][c] = static_cast<std::uint8_t>(i);
            }
        const std::size_t before = n_;
        if (n <= kMaxGroups) {
            for (std::size_t i = 0; i < n; ++i)
                groups_[i] = candidates[i];
            n_ = n;
            return;
        }
        join(candidates, n, random, before, channels.size(), step);
    }

  private:
    static constexpr std::size_t kMaxCandidates = kMaxGroups * kMaxChannels;
    static_assert(kMaxCandidates < kNone);
    /// Different factors at one vertex.
    static constexpr std::size_t kMaxFactors = 32;
    static_assert(kMaxChannels < kMaxFactors);

    /// What waits until the next ray has met something.
    struct Waiting {
        float indirect = 1;
        bool direct_light = true;
        friend bool operator==(const Waiting&, const Waiting&) = default;
    };

    std::uint8_t factor_index(Waiting factor) {
        std::array<Waiting, kMaxFactors>& factors = factors_[current_];
        std::size_t i = 0;
        while (i < n_factors_ && !(factors[i] == factor))
            ++i;
        if (i == n_factors_) factors[n_factors_++] = factor;
        return static_cast<std::uint8_t>(i);
    }

    /// Joins the two faintest candidates by a coin weighted with their luminance until they fit.
    template <class Random>
    void join(std::array<PathGroup, kMaxCandidates>& candidates, std::size_t n,
              const Random& random, std::size_t n_old, std::size_t n_channels, Step& step) {
        std::array<float, kMaxCandidates> factor;
        factor.fill(1);
        for (std::size_t alive = n, round = 0; alive > kMaxGroups; --alive, ++round) {
            std::size_t a = n, b = n;  // faintest and second faintest
            for (std::size_t i = 0; i < n; ++i) {
                if (factor[i] == 0) continue;
                const float y = luminance(candidates[i].throughput) * factor[i];
                if (a == n || y < luminance(candidates[a].throughput) * factor[a]) {
                    b = a;
                    a = i;
                } else if (b == n || y < luminance(candidates[b].throughput) * factor[b]) {
                    b = i;
                }
            }
            const float ya = luminance(candidates[a].throughput) * factor[a],
                        yb = luminance(candidates[b].throughput) * factor[b];
            const float p = ya + yb > 0 ? ya / (ya + yb) : 0.5F;
            const bool keep_a = random(static_cast<std::uint32_t>(round)) < p;
            factor[keep_a ? a : b] /= keep_a ? p : 1 - p;
            factor[keep_a ? b : a] = 0;
        }
        std::array<std::uint8_t, kMaxCandidates> slot;
        n_ = 0;
        for (std::size_t i = 0; i < n; ++i) {
            slot[i] = kNone;
            if (factor[i] == 0) continue;
            slot[i] = static_cast<std::uint8_t>(n_);
            groups_[n_++] = {candidates[i].key, candidates[i].throughput * factor[i]};
        }
        for (std::size_t g = 0; g < n_old; ++g)
            for (std::size_t c = 0; c < n_channels; ++c) {
                if (step.to[g][c] == kNone) continue;
                const std::size_t i = step.to[g][c];
                step.to[g][c] = slot[i];
                step.scale[g][c] *= factor[i];
            }
    }

    std::array<PathGroup, kMaxGroups> groups_;
    std::size_t n_ = 0;
    /// By GroupKey::indirect; the first changes nothing.
    std::array<std::array<Waiting, kMaxFactors>, 2> factors_;
    std::size_t current_ = 0;
    std::size_t n_factors_ = 1;
};

/// The terms of a path in one automaton (or in the path log's tree of histories).
///
/// Machine: using State; State start(); State step(State, const LobeRecord&); bool live(State); static constexpr std::size_t kMaxTerms.
template <class Machine>
class PathTerms {
  public:
    using State = typename Machine::State;
    struct Term {
        std::uint32_t group;
        State state;
        Color throughput;
    };

    void start(const Machine& machine, Color throughput) {
        terms_.clear();
        n_reduced_ = 0;
        if (machine.live(machine.start())) terms_.push_back({0, machine.start(), throughput});
    }
    [[nodiscard]] std::span<const Term> all() const { return terms_; }
    [[nodiscard]] bool empty() const { return terms_.empty(); }
    /// Takes over the terms of another path. Capacity is kept.
    void copy_from(const PathTerms& other) {
        terms_ = other.terms_;
        n_reduced_ = other.n_reduced_;
    }
    void scale(Color factor) {
        for (Term& t : terms_)
            t.throughput *= factor;
    }
    /// Follows PathGroups::keep_only.
    void keep_only(std::size_t group, float factor) {
        std::size_t kept = 0;
        for (const Term& t : terms_)
            if (t.group == group) terms_[kept++] = {0, t.state, t.throughput * factor};
        terms_.resize(kept);
    }

    /// Follows PathGroups::scatter through the same vertex.
    template <class Random>
    void scatter(const Machine& machine, std::span<const Channel> channels,
                 std::span<const Color> factors, const PathGroups::Step& step,
                 const Random& random) {
        next_.clear();
        for (const Term& t : terms_)
            for (std::size_t c = 0; c < channels.size(); ++c) {
                if (step.to[t.group][c] == PathGroups::kNone) continue;
                const State state = machine.step(t.state, *channels[c].record);
                if (!machine.live(state)) continue;
                add({step.to[t.group][c], state,
                     t.throughput * factors[c] * step.scale[t.group][c]},
                    random);
            }
        std::swap(terms_, next_);
    }

  private:
    template <class Random>
    void add(const Term& term, const Random& random) {
        for (Term& t : next_)
            if (t.group == term.group && t.state == term.state) {
                t.throughput += term.throughput;
                return;
            }
        next_.push_back(term);
        if (next_.size() > Machine::kMaxTerms) reduce(random);
    }

    /// Drops one term of a group that has at least four, keeping that group's sum.
    template <class Random>
    void reduce(const Random& random) {
        // Pigeonhole: kMaxTerms >= 3 * kMaxGroups, so some group has four.
        static_assert(Machine::kMaxTerms >= 3 * PathGroups::kMaxGroups);
        std::array<std::uint32_t, PathGroups::kMaxGroups> count{};
        std::uint32_t fullest = 0;
        for (const Term& t : next_)
            if (++count[t.group] > count[fullest]) fullest = t.group;
        std::array<std::size_t, 4> index;
        std::array<Color, 4> value;
        std::size_t n = 0;
        for (std::size_t i = next_.size(); i-- > 0 && n < 4;)
            if (next_[i].group == fullest) {
                index[n] = i;
                value[n++] = next_[i].throughput;
            }
        const std::size_t dropped =
            index[drop_one_of_four(value, random(kReduceStream + n_reduced_++))];
        for (std::size_t i = 0; i < 4; ++i)
            next_[index[i]].throughput = value[i];
        next_[dropped] = next_.back();
        next_.pop_back();
    }

    /// Streams of random numbers for reductions, apart from those that join groups.
    static constexpr std::uint32_t kReduceStream = 1U << 16U;

    std::vector<Term> terms_,
        next_;  ///< capacity is kept between paths: no allocation after the first few
    std::uint32_t n_reduced_ =
        0;  ///< reductions of this path: each takes a random number of its own
};

}  // namespace lightsieve
