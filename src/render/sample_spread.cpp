#include "render/sample_spread.h"

#include <algorithm>

namespace lightsieve {

void SampleSpread::add(std::size_t pixel, const Values& values, double weight) {
    if (!(weight > 0)) return;
    Pixel& p = pixels_[pixel];
    const bool is_first = !(p.weight > 0);
    p.weight += weight;
    p.squares += weight * weight;
    for (std::size_t c = 0; c < values.size(); ++c) {
        if (reduction_ == Reduction::Range) {
            p.least[c] = is_first ? values[c] : std::min(p.least[c], values[c]);
            p.greatest[c] = is_first ? values[c] : std::max(p.greatest[c], values[c]);
            continue;
        }
        // Source: West 1979, "Updating mean and variance estimates: an improved method".
        const double off = values[c] - p.mean[c];
        p.mean[c] += off * weight / p.weight;
        p.deviation[c] += weight * off * (values[c] - p.mean[c]);
    }
}

auto SampleSpread::spread(std::size_t pixel) const -> Values {
    const Pixel& p = pixels_[pixel];
    Values out{};
    if (!(p.weight > 0)) return out;
    // What the weights are worth beyond one sample; W - W^2/n of n equal ones is W (n - 1) / n.
    const double rest = p.weight - p.squares / p.weight;
    for (std::size_t c = 0; c < out.size(); ++c) {
        if (reduction_ == Reduction::Range)
            out[c] = p.greatest[c] - p.least[c];
        else if (rest > 1e-9 * p.weight)
            out[c] = p.deviation[c] / rest;
    }
    return out;
}

}  // namespace lightsieve
