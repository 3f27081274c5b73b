#include "render/deep_sums.h"

#include <algorithm>

namespace lightsieve {

void DeepSums::begin(std::size_t n_pixels) {
    pixels_.resize(n_pixels);
    for (Pixel& p : pixels_) {
        p.depths.clear();
        p.opacities.clear();
        p.values.clear();
    }
}

void DeepSums::add(std::size_t pixel, float depth, Color opacity, std::span<const double> values,
                   double weight) {
    const bool dark = std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
    if (dark && is_black(opacity)) return;
    Pixel& p = pixels_[pixel];
    p.depths.push_back(depth);
    p.opacities.push_back(opacity * static_cast<float>(weight));
    for (const double v : values)
        p.values.push_back(static_cast<float>(v * weight));
}

std::size_t DeepSums::memory() const {
    std::size_t sum = pixels_.capacity() * sizeof(Pixel);
    for (const Pixel& pixel : pixels_)
        sum += pixel.depths.capacity() * sizeof(float) +
               pixel.opacities.capacity() * sizeof(Color) +
               pixel.values.capacity() * sizeof(float);
    return sum;
}

void DeepSums::save(ByteWriter& out) const {
    std::vector<std::uint32_t> counts;
    for (const Pixel& p : pixels_)
        counts.push_back(static_cast<std::uint32_t>(p.depths.size()));
    out.put(counts);
    for (const Pixel& p : pixels_) {
        out.put(p.depths);
        out.put(p.opacities);
        out.put(p.values);
    }
}

bool DeepSums::load(ByteReader& in) {
    std::vector<std::uint32_t> counts;
    if (!in.get(counts, pixels_.size())) return false;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        Pixel& p = pixels_[i];
        const std::size_t n = counts[i];
        if (!in.get(p.depths, n) || !in.get(p.opacities, n) || !in.get(p.values, n * n_values_))
            return false;
    }
    return true;
}

DeepBucket DeepSums::resolve(std::span<const double> norms) const {
    DeepBucket out;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& p = pixels_[i];
        const auto norm = static_cast<float>(norms[i]);
        out.depths.insert(out.depths.end(), p.depths.begin(), p.depths.end());
        for (const Color& opacity : p.opacities)
            out.opacities.push_back(opacity * norm);
        for (const float v : p.values)
            out.values.push_back(v * norm);
        out.ends.push_back(out.depths.size());
    }
    return out;
}

}  // namespace lightsieve
