// Rays of broad lobes that go where a guide says (render/guide.h), and what paths note for its training.
#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "render/integrator.h"
#include "render/path_log.h"

namespace lightsieve {

template <class Tracker>
void Integrator<Tracker>::find_guide(const Surface& surface) {
    guided_ = 0;
    guided_share_ = 0;
    directions_ = nullptr;
    if (surface.in_medium || n_channels_ == 0) return;
    const std::span<const Closure> closures = closures_.closures();
    for (std::size_t i = 0; i < closures.size(); ++i)
        if (is_broad(closures[i].model)) guided_ |= 1U << i;
    if (guided_ == 0) return;
    cell_ = guide_->cell_at(surface.at.position, surface.outward);
    const Guide::Cell& cell = guide_->cells()[cell_];
    if (cell.tree.empty()) return;
    directions_ = &cell.tree;
    guided_share_ = cell.share;
}

template <class Tracker>
std::optional<LobeSample> Integrator<Tracker>::sample(std::size_t drawn) const {
    // One number says who chooses the direction, and the first coordinate of it: so the directions of both keep their
    // even spread, which they would lose if others than neighbours were left out.
    Vec2f u = points_.direction;
    if (is_guided(drawn) && guided_share_ > 0) {
        if (u.x < guided_share_) {
            u.x = std::min(u.x / guided_share_, kOneMinusEpsilon);
            const Vec3f wi = directions_->sample(u);
            const LobeEval eval = closures_.eval(drawn, wi);
            return LobeSample{wi, eval.f, eval.pdf};
        }
        u.x = std::min((u.x - guided_share_) / (1 - guided_share_), kOneMinusEpsilon);
    }
    const LobeSample sample = closures_.sample(drawn, u, points_.roulette.y);
    return sample.pdf > 0 ? std::optional(sample) : std::nullopt;
}

/// drawn    closure whose ray it is
/// factors  by channel, of the throughput
/// carried  throughput before [luminance]
template <class Tracker>
void Integrator<Tracker>::record(std::size_t drawn, Vec3f wi, std::span<const Color> factors,
                                 float carried) {
    if (guided_ == 0 || !(carried > 0)) return;
    const std::uint8_t mixture = mixture_[channel_of_[drawn]];
    const float of_guide = directions_ != nullptr ? directions_->pdf(wi) : 0;
    std::array<bool, kMaxChannels> is_guided_channel{};
    GuideDensities pdf;
    for (std::size_t i = 0; i < closures_.closures().size(); ++i) {
        if (mixture_[channel_of_[i]] != mixture) continue;
        const float own = closures_.eval(i, wi).pdf;
        pdf.used += probability_[i] * blended_pdf(i, own, of_guide);
        pdf.unguided += probability_[i] * own;
        pdf.guided += probability_[i] * (is_guided(i) ? of_guide : own);
        is_guided_channel[channel_of_[i]] |= is_guided(i);
    }
    // Light through lobes that are not guided does not count.
    float all = 0, guided = 0;
    for (std::size_t c = 0; c < n_channels_; ++c) {
        const float y = luminance(factors[c]);
        all += y;
        if (is_guided_channel[c]) guided += y;
    }
    if (all > 0)
        path_.place = recorder_->add(path_.place, cell_, wi, guided / (all * carried), pdf);
}

// Explicitly, member by member: the class as a whole is instantiated in integrator.cpp.
#define LIGHTSIEVE_GUIDE(Tracker)                                                      \
    template void Integrator<Tracker>::find_guide(const Surface&);                     \
    template std::optional<LobeSample> Integrator<Tracker>::sample(std::size_t) const; \
    template void Integrator<Tracker>::record(std::size_t, Vec3f, std::span<const Color>, float);
LIGHTSIEVE_GUIDE(AovTracker)
LIGHTSIEVE_GUIDE(LogTracker)
#undef LIGHTSIEVE_GUIDE

}  // namespace lightsieve
