#include "render/testing/checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

#include "lpe/testing/naive_matcher.h"

namespace lightsieve::testing {
namespace {

std::string number(double v) { return text_of(static_cast<float>(v)); }

Verdict bad(std::string why) { return {false, std::move(why)}; }

/// Keeps the worst of many offences.
class Worst {
  public:
    /// error over limit, and how to tell of it
    template <class Tell>
    void see(double error, double limit, const Tell& tell) {
        if (error <= limit) return;
        const double ratio = limit > 0 ? error / limit : HUGE_VAL;
        ++n_;
        if (ratio <= worst_ && n_ > 1) return;
        worst_ = ratio;
        why_ = tell();
    }
    [[nodiscard]] Verdict verdict() const {
        return n_ == 0 ? Verdict{} : bad(std::to_string(n_) + " offences, the worst: " + why_);
    }

  private:
    double worst_ = 0;
    std::size_t n_ = 0;
    std::string why_;
};

std::string place(const Picture& picture, std::size_t pixel, int channel) {
    const auto width = static_cast<std::size_t>(picture.width());
    return "pixel " + std::to_string(pixel % width) + ' ' + std::to_string(pixel / width) +
           " channel " + std::to_string(channel) + ": ";
}

Estimate estimate(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (double v : values)
        sum += v;
    const double mean = sum / n;
    for (double v : values)
        squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

std::vector<double> channel_of(const Picture& picture, const std::string& layer, int channel) {
    std::vector<double> out;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        out.push_back(static_cast<double>(picture.color(layer, i)[channel]));
    return out;
}

/// Rounding of means of many floats that should be equal: no estimate is better than this.
constexpr double kRounding = 2e-6;

}  // namespace

Estimate estimate(const Picture& picture, const std::string& layer, int channel) {
    return estimate(channel_of(picture, layer, channel));
}

Verdict check_sum(const Picture& picture, const std::string& whole,
                  const std::vector<std::string>& parts, double tolerance) {
    Worst worst;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0, magnitude = 0;
            for (const std::string& part : parts) {
                const double v = static_cast<double>(picture.color(part, i)[c]);
                sum += v;
                magnitude += std::abs(v);
            }
            const double is = static_cast<double>(picture.color(whole, i)[c]);
            worst.see(std::abs(sum - is), tolerance * (magnitude + std::abs(is)), [&] {
                return place(picture, i, c) + "the parts of " + whole + " give " + number(sum) +
                       ", the whole is " + number(is);
            });
        }
    return worst.verdict();
}

Verdict check_black(const Picture& picture, const std::string& layer) {
    const FrameLayer& l = picture.layer(layer);
    const std::size_t colors = std::min<std::size_t>(l.info.n_channels, 3);
    for (std::size_t i = 0; i < l.pixels.size(); ++i)
        if (i % l.info.n_channels < colors && l.pixels[i] != 0)
            return bad(layer + " has " + number(static_cast<double>(l.pixels[i])) + " in pixel " +
                       std::to_string(i / l.info.n_channels));
    return {};
}

Verdict check_lit(const Picture& picture, const std::string& layer) {
    return check_black(picture, layer) ? bad(layer + " has no light") : Verdict{};
}

Verdict check_equal(const Picture& a, const std::string& layer_a, const Picture& b,
                    const std::string& layer_b, double tolerance) {
    if (a.n_pixels() != b.n_pixels()) return bad("pictures of different sizes");
    Worst worst;
    for (std::size_t i = 0; i < a.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = static_cast<double>(a.color(layer_a, i)[c]),
                         y = static_cast<double>(b.color(layer_b, i)[c]);
            worst.see(std::abs(x - y), tolerance * (std::abs(x) + std::abs(y)), [&] {
                return place(a, i, c) + layer_a + " is " + number(x) + ", " + layer_b + " is " +
                       number(y);
            });
        }
    return worst.verdict();
}

Verdict check_identical(const Picture& a, const std::string& layer_a, const Picture& b,
                        const std::string& layer_b) {
    const std::vector<float>&x = a.layer(layer_a).pixels, &y = b.layer(layer_b).pixels;
    if (x.size() != y.size()) return bad("layers of different sizes");
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::bit_cast<std::uint32_t>(x[i]) != std::bit_cast<std::uint32_t>(y[i]))
            return bad("value " + std::to_string(i) + " of " + layer_a + " is " +
                       number(static_cast<double>(x[i])) + " and " +
                       number(static_cast<double>(y[i])));
    return {};
}

Verdict check_mean_of(const std::vector<double>& values, double truth, const std::string& what,
                      double relative_slack) {
    const Estimate e = estimate(values);
    if (std::abs(e.mean - truth) <= kZ * e.error + (relative_slack + kRounding) * std::abs(truth))
        return {};
    return bad(what + " has mean " + number(e.mean) + " +- " + number(e.error) + ", expected " +
               number(truth));
}

Verdict check_mean(const Picture& picture, const std::string& layer, Color truth,
                   double relative_slack) {
    for (int c = 0; c < 3; ++c)
        if (Verdict v = check_mean_of(channel_of(picture, layer, c), static_cast<double>(truth[c]),
                                      layer + " channel " + std::to_string(c), relative_slack);
            !v)
            return v;
    return {};
}

Verdict check_same_mean(const Picture& a, const std::string& layer_a, const Picture& b,
                        const std::string& layer_b) {
    if (a.n_pixels() != b.n_pixels()) return bad("pictures of different sizes");
    Worst worst;
    for (int c = 0; c < 3; ++c) {
        const std::vector<double> x = channel_of(a, layer_a, c), y = channel_of(b, layer_b, c);
        std::vector<double> difference;
        for (std::size_t i = 0; i < x.size(); ++i)
            difference.push_back(x[i] - y[i]);
        const Estimate e = estimate(difference), mx = estimate(x), my = estimate(y);
        worst.see(std::abs(e.mean),
                  kZ * e.error + kRounding * (std::abs(mx.mean) + std::abs(my.mean)), [&] {
                      return layer_a + " has mean " + number(mx.mean) + ", " + layer_b +
                             " of the other " + number(my.mean) + "; the difference is " +
                             number(e.mean) + " +- " + number(e.error) + " in channel " +
                             std::to_string(c);
                  });
    }
    return worst.verdict();
}

Verdict check_constant(const Picture& picture, const std::string& layer, Color truth,
                       double relative) {
    Worst worst;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double is = static_cast<double>(picture.color(layer, i)[c]),
                         expected = static_cast<double>(truth[c]);
            worst.see(std::abs(is - expected), relative * std::abs(expected), [&] {
                return place(picture, i, c) + layer + " is " + number(is) + ", expected " +
                       number(expected);
            });
        }
    return worst.verdict();
}

namespace {

/// The group that a layer is restricted to, decided here without the engine.
bool in_group(const PlannedLayer& layer, const Event& terminal) {
    const bool has_group =
        (terminal.kind == EventKind::Light || terminal.kind == EventKind::Background) &&
        !terminal.labels.empty();
    const std::string group = has_group ? terminal.labels.front() : "default";
    switch (layer.select) {
        case lpe::GroupSelect::All: return true;
        case lpe::GroupSelect::Named: return has_group && group == layer.info.light_group;
        case lpe::GroupSelect::Default:
            return terminal.kind != EventKind::Albedo && group == "default";
    }
    return false;
}

}  // namespace

Verdict check_oracle(const Scene& scene, const Picture& picture, std::span<const LoggedPath> paths,
                     double tolerance) {
    const Region& region = scene.settings.region;
    const int width = region.x1 - region.x0 + 1;
    const double per_sample = 1.0 / scene.settings.samples;
    // Kinds of paths, each matched once.
    std::map<std::vector<std::uint32_t>, std::size_t> kinds;
    for (const LoggedPath& path : paths)
        kinds.try_emplace(path.events, kinds.size());
    std::vector<std::vector<Event>> events(kinds.size());
    for (const auto& [indices, kind] : kinds) {
        events[kind].push_back({EventKind::Camera, EventLobe::None, {}});
        for (std::uint32_t e : indices)
            events[kind].push_back(scene.events[e]);
    }
    Worst worst;
    for (const PlannedLayer& layer : scene.plan.layers) {
        if (layer.source != LayerSource::Expression && layer.source != LayerSource::Beauty)
            continue;
        std::vector<bool> takes(kinds.size());
        for (std::size_t k = 0; k < takes.size(); ++k)
            takes[k] = in_group(layer, events[k].back()) &&
                       lpe::testing::naive_match(layer.expr, events[k]);
        std::vector<std::array<double, 3>> sums(picture.n_pixels());
        for (const LoggedPath& path : paths) {
            if (!takes[kinds.at(path.events)]) continue;
            auto& sum =
                sums[static_cast<std::size_t>((path.y - region.y0) * width + path.x - region.x0)];
            for (int c = 0; c < 3; ++c)
                sum[static_cast<std::size_t>(c)] +=
                    static_cast<double>(path.value[c]) * per_sample;
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const Color color = picture.color(layer.info.name, i);
                const double is = layer.info.n_channels == 1 ? static_cast<double>(color.r)
                                                             : static_cast<double>(color[c]);
                const auto& s = sums[i];
                const double expected =
                    layer.info.n_channels == 1
                        ? static_cast<double>(
                              luminance(Color(static_cast<float>(s[0]), static_cast<float>(s[1]),
                                              static_cast<float>(s[2]))))
                        : s[static_cast<std::size_t>(c)];
                worst.see(std::abs(is - expected), tolerance * (std::abs(is) + std::abs(expected)),
                          [&] {
                              return place(picture, i, c) + layer.info.name + " is " + number(is) +
                                     ", the log says " + number(expected);
                          });
            }
    }
    return worst.verdict();
}

}  // namespace lightsieve::testing
