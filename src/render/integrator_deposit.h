// Where light that arrives goes: the beauty and the trackers, with one clamp for both. For the integrator's own files.
#pragma once

#include "render/integrator.h"

namespace lightsieve {

template <class Tracker>
template <class Value>
void Integrator<Tracker>::deposit(Terminal terminal, const Value& value) {
    Color total;
    const std::span<const PathGroup> groups = path_.groups.all();
    for (std::size_t g = 0; g < groups.size(); ++g)
        total += groups[g].throughput * value(g);
    if (is_black(total)) return;
    if (!is_finite(total)) return drop(terminal.event);
    const float scale = clamp_factor(total, path_.n_scatter);
    out_->add_light(total * scale, total);
    if (recorder_ != nullptr) recorder_->bring(path_.place, luminance(total) * scale);
    tracker_.add(terminal, value, scale);
}

template <class Tracker>
template <class Value>
void Integrator<Tracker>::deposit_scattered(Terminal terminal, const Value& value) {
    // Worked out once: the beauty adds all of them up, and each term of the AOVs takes one.
    Color total;
    const std::span<const PathGroup> groups = path_.groups.all();
    const auto share = [&](std::size_t g, std::size_t c) -> Color& {
        return shares_[g * n_channels_ + c];
    };
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t c = 0; c < n_channels_; ++c) {
            share(g, c) = value(g, c) * path_.groups.indirect(g);
            total += groups[g].throughput * share(g, c);
        }
    if (is_black(total)) return;
    if (!is_finite(total)) return drop(terminal.event);
    const float scale = clamp_factor(total, path_.n_scatter + 1);
    out_->add_light(total * scale, total);
    if (recorder_ != nullptr) recorder_->bring(path_.place, luminance(total) * scale);
    tracker_.add_scattered(std::span(channels_.data(), n_channels_), terminal, share, scale);
}

template <class Tracker>
template <class Value>
void Integrator<Tracker>::deposit_scattered_light(const SceneLight& light, const Value& value) {
    const Terminal as_light{light.as_light, light.light_event},
        as_background{light.as_background, light.background_event};
    if (!light.is_skydome) return deposit_scattered(as_light, value);
    if (light.common.aov_indirect) return deposit_scattered(as_background, value);
    const auto is_seen = [&](std::size_t g, std::size_t c) {
        return path_.groups[g].key.seen() && channels_[c].record->makes_no_event;
    };
    deposit_scattered(as_light, [&](std::size_t g, std::size_t c) {
        return is_seen(g, c) ? kBlack : value(g, c);
    });
    if (some_group_is_seen())
        deposit_scattered(as_background, [&](std::size_t g, std::size_t c) {
            return is_seen(g, c) ? value(g, c) : kBlack;
        });
}

}  // namespace lightsieve
