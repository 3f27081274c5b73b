// Chooses one light among many, so that near, bright, facing lights get most of the shadow rays.
//
// Finite lights lie in a tree of up to 16 branches a node, which bound where their lights are, where these point and how
// strong they are; a walk from the root takes each branch with probability proportional to an estimate of what it can
// send to the shaded point. Sixteen at a time, because a choice between two crude bounds is a bad one: on a ceiling of
// 256 panels the relative variance of a pick is 0.04, of a binary tree 2, and one instruction takes four bounds.
// Infinite lights stand apart: their share is their irradiance compared with the estimate of the whole tree. The
// probability of every pick can be asked for again, which MIS with rays that happen to hit a light needs. No
// splitting: one call, one light.
// Sources: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting";
// bounds without trigonometry as in Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., section 12.6.3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/float4.h"
#include "core/vec.h"
#include "scene/light.h"

namespace lightsieve {

/// A light drawn by `LightSampler::pick`.
struct LightPick {
    std::uint32_t light = 0;  ///< index into the span that the sampler was made from
    float probability =
        0;        ///< of this light; 0: no light can reach the point, `light` means nothing
    float u = 0;  ///< the rest of the random number, uniform in [0,1) again
};

class LightSampler {
  public:
    /// No lights: every pick has probability 0.
    LightSampler() = default;
    /// Chooses among all `lights`. They must outlive the sampler; black ones are never picked.
    explicit LightSampler(std::span<const Light* const> lights);
    /// Chooses only among `lights[i]` for i in `subset` (a shape's light_group); picks keep the indices of `lights`.
    LightSampler(std::span<const Light* const> lights, std::span<const std::uint32_t> subset);

    /// Draws a light.
    ///
    /// position  world space
    /// normal    unit shading normal on the side that light must come from; the zero vector where light from both
    ///           sides counts: volumes, transmissive surfaces, lobes with normals of their own
    /// u         in [0,1)
    /// Never misses a light that can contribute: probability 0 only where a bound proves darkness. A light that is alone
    /// is always picked.
    [[nodiscard]] LightPick pick(Vec3f position, Vec3f normal, float u) const noexcept;
    /// The probability with which `pick` gives `light` there: the same arithmetic, so exactly the same number.
    [[nodiscard]] float probability(Vec3f position, Vec3f normal,
                                    std::uint32_t light) const noexcept;
    /// The lights that can be picked, by index.
    [[nodiscard]] std::span<const std::uint32_t> lights() const noexcept { return lights_; }
    /// Whether a light can be picked anywhere.
    [[nodiscard]] bool contains(std::uint32_t light) const noexcept {
        return light < places_.size() && places_[light].kind != Place::Kind::Absent;
    }
    /// Whether any light can be picked at all.
    [[nodiscard]] bool empty() const noexcept { return nodes_.empty() && infinite_.empty(); }

  private:
    static constexpr std::size_t kLanes = 4;      ///< bounds that one pass of the arithmetic takes
    static constexpr std::size_t kBranches = 16;  ///< at most, of a node
    static constexpr std::uint32_t kNone = 0xffffffffU;

    /// Bounds of four sets of lights, side by side. Empty lanes have intensity 0.
    struct alignas(16) Bounds4 {
        using Lane = std::array<float, kLanes>;
        Lane center_x{}, center_y{}, center_z{};  ///< of the bounding sphere
        Lane radius{};                            ///< of the bounding sphere
        Lane axis_x{}, axis_y{}, axis_z{};        ///< of the cone of normals
        Lane cos_spread{}, sin_spread{};          ///< half angle of the cone of normals
        Lane cos_emission{};                      ///< further angle to which light leaves
        Lane intensity{};                         ///< sum over the lights [W/sr]
    };
    /// A node of the tree.
    struct Node {
        std::uint32_t first_bounds = 0;   ///< in `bounds_`; as many as the branches need
        std::uint32_t n_branches = 0;     ///< 1 to 16
        std::uint32_t parent = kNone;     ///< kNone: the root
        std::uint32_t parent_branch = 0;  ///< which branch of the parent this node is
        /// A node below, or a light of the caller's span with kLeaf added.
        std::array<std::uint32_t, kBranches> branches{};
    };
    static constexpr std::uint32_t kLeaf = 0x80000000U;
    /// What the branches of a node can send to a point.
    struct Weights {
        std::array<float, kBranches> of{};  ///< each branch, 0 where a bound proves darkness
        float sum = 0;                      ///< of all
    };
    /// A light without place: a cone of directions in which its light travels.
    struct Infinite {
        Vec3f axis{0, 0, 1};      ///< of the cone
        float cos_spread = -1;    ///< half angle of the cone
        float sin_spread = 0;     ///< the same
        float irradiance = 0;     ///< of a facing plane [W/m^2]
        std::uint32_t light = 0;  ///< index into the caller's span
    };
    /// How to reach a light of the caller's span.
    struct Place {
        enum class Kind : std::uint8_t { Absent, Tree, Infinite };
        Kind kind = Kind::Absent;  ///< absent lights are never picked
        std::uint32_t index = 0;   ///< Tree: the node; Infinite: position in `infinite_`
        std::uint32_t branch = 0;  ///< Tree: of that node
    };
    struct Builder;

    static Float4 importance(const Bounds4& bounds, Vec3f position, Vec3f normal) noexcept;
    static float importance(const Infinite& light, Vec3f normal) noexcept;
    [[nodiscard]] Weights weigh(const Node& node, Vec3f position, Vec3f normal) const noexcept;
    [[nodiscard]] Weights weigh_root(Vec3f position, Vec3f normal) const noexcept;
    [[nodiscard]] float infinite_importance(Vec3f normal) const noexcept;
    /// Chance of walking down the tree rather than taking an infinite light.
    static float tree_probability(float tree, float infinite) noexcept;
    /// The two halves of `pick`; `so_far` has the probability and the random number that are left.
    [[nodiscard]] LightPick pick_finite(Vec3f position, Vec3f normal, Weights weights,
                                        LightPick so_far) const noexcept;
    [[nodiscard]] LightPick pick_infinite(Vec3f normal, float sum,
                                          LightPick so_far) const noexcept;

    std::vector<Node> nodes_;            ///< the root is number 0
    std::vector<Bounds4> bounds_;        ///< of the nodes' branches
    std::vector<Infinite> infinite_;     ///< in the caller's order
    std::vector<Place> places_;          ///< one for each light of the caller's span
    std::vector<std::uint32_t> lights_;  ///< those that can be picked
    std::uint32_t lone_ = kNone;         ///< the light that can be picked, if there is only one
};

}  // namespace lightsieve
