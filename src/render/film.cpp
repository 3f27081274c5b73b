#include "render/film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"

namespace lightsieve {
namespace {

void add_color(std::array<double, 3>& sum, Color value, double factor) {
    sum[0] += double{value.r} * factor;
    sum[1] += double{value.g} * factor;
    sum[2] += double{value.b} * factor;
}

}  // namespace

void Film::begin(const Pass& pass, int width, int height) {
    width_ = width;
    height_ = height;
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    wants_data_ = std::any_of(plan_.layers.begin(), plan_.layers.end(),
                              [](const PlannedLayer& l) { return !is_light(l.source); });
    const lpe::Program& program = *plan_.program;
    const std::size_t n_keys = program.film_stores_atoms() ? program.n_atoms() : program.n_aovs();
    views_.resize(pass.views.size());
    for (std::size_t i = 0; i < views_.size(); ++i) {
        ViewSums& sums = views_[i];
        sums.view = pass.views[i];
        sums.closest = plan_.views[sums.view].filter->closest();
        sums.beauty.assign(n, {});
        sums.alpha.assign(n, 0);
        sums.weight.assign(n, 0);
        sums.half_weight.assign(n, 0);
        sums.count.assign(n, 0);
        sums.slot_of.assign(n_keys, -1);
        sums.n_slots = 0;
        sums.written.assign(plan_.written.size(), std::vector<std::array<double, 4>>(n));
        if (!wants_data_ && !sums.closest) continue;
        sums.data.assign(n, {});
        sums.opacity.assign(n, {});
        sums.shadow.assign(n, {});
        sums.shadow_difference.assign(n, {});
        sums.shadow_mask.assign(n, 0);
        sums.volume_opacity.assign(n, {});
        sums.nearest.assign(n, {});
        sums.nearest_rank.assign(n, kInfinity);
    }
}

std::vector<Film::LightSum>& Film::slot(ViewSums& sums, std::uint32_t key) {
    std::int32_t& at = sums.slot_of[key];
    if (at < 0) {
        at = static_cast<std::int32_t>(sums.n_slots++);
        if (sums.slots.size() < sums.n_slots) sums.slots.emplace_back();
        sums.slots[static_cast<std::size_t>(at)].assign(
            static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), {});
    }
    return sums.slots[static_cast<std::size_t>(at)];
}

void Film::add(int x, int y, const SampleBuffer& sample, float scale, Vec2f offset,
               std::span<const float> weights, bool in_half) {
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        ViewSums& sums = views_[i];
        const double weight = double{weights[i]};
        ++sums.count[pixel];
        if (sums.closest) {
            add_if_nearest(sums, pixel, sample, double{scale}, offset);
            continue;
        }
        sums.weight[pixel] += weight;
        if (in_half) sums.half_weight[pixel] += weight;
        sums.alpha[pixel] += double{sample.alpha} * weight;
        add_light(sums, pixel, sample, {double{scale}, weight, in_half});
        add_written(sums, pixel, sample, weight);
        if (wants_data_) add_data(sums, pixel, sample.first, weight);
    }
}

void Film::add_to(LightSum& sum, Color value, double factor, bool in_half) {
    add_color(sum.color, value, factor);
    if (in_half) sum.half += double{luminance(value)} * factor;
}

void Film::add_light(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                     const Share& share) {
    const double factor = share.clamp * share.weight;
    add_to(sums.beauty[pixel], sample.beauty, factor, share.in_half);
    add_to_atoms(sums, pixel, sample.contributions, factor, share.in_half);
    add_to_atoms(sums, pixel, sample.probes, share.weight, share.in_half);
}

void Film::add_to_atoms(ViewSums& sums, std::size_t pixel,
                        std::span<const SampleBuffer::Contribution> contributions, double factor,
                        bool in_half) {
    const lpe::Program& program = *plan_.program;
    const bool atoms = program.film_stores_atoms();
    for (const SampleBuffer::Contribution& c : contributions) {
        if (atoms) {
            add_to(slot(sums, c.atom)[pixel], c.value, factor, in_half);
            continue;
        }
        for (std::uint32_t aov : program.aovs_of(c.atom))
            add_to(slot(sums, aov)[pixel], c.value, factor, in_half);
    }
}

void Film::add_if_nearest(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                          double clamp, Vec2f offset) {
    // Samples inside the filter compete by depth; a sample outside of it only stands in for none at all.
    const float radius = plan_.views[sums.view].filter->radius();
    const bool inside = std::max(std::abs(offset.x), std::abs(offset.y)) <= radius;
    const float distance = sample.first.hit ? sample.first.depth : kLargestDepth;
    const float rank = inside ? distance : kLargestDepth + std::hypot(offset.x, offset.y);
    if (rank >= sums.nearest_rank[pixel]) return;
    sums.nearest_rank[pixel] = rank;
    sums.nearest[pixel] = sample.first;
    sums.alpha[pixel] = double{sample.alpha};
    sums.beauty[pixel] = {};
    for (std::size_t i = 0; i < sums.n_slots; ++i)
        sums.slots[i][pixel] = {};
    add_light(sums, pixel, sample, {clamp, 1, false});
    for (auto& written : sums.written)
        written[pixel] = {};
    add_written(sums, pixel, sample, 1);
}

void Film::add_written(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                       double weight) {
    for (std::size_t i = 0; i < sums.written.size() && i < sample.written.size(); ++i) {
        std::array<double, 4>& sum = sums.written[i][pixel];
        const Rgba& v = sample.written[i];
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += double{v.rgb[static_cast<int>(c)]} * weight;
        sum[3] += double{v.a} * weight;
    }
}

void Film::add_data(ViewSums& sums, std::size_t pixel, const FirstHit& f, double weight) {
    add_color(sums.volume_opacity[pixel], f.volume_opacity, weight);
    if (!f.hit) return;
    const std::array<float, 9> values{f.depth,      f.normal.x,   f.normal.y,
                                      f.normal.z,   f.position.x, f.position.y,
                                      f.position.z, f.uv.x,       f.uv.y};
    for (std::size_t i = 0; i < values.size(); ++i)
        sums.data[pixel][i] += double{values[i]} * weight;
    add_color(sums.opacity[pixel], f.opacity, weight);
    add_color(sums.shadow[pixel], f.shadow.by_channel, weight);
    add_color(sums.shadow_difference[pixel], f.shadow.difference, weight);
    sums.shadow_mask[pixel] += double{f.shadow.mask} * weight;
    // Ids cannot be averaged: the nearest sample's stands for the pixel.
    if (f.depth < sums.nearest_rank[pixel]) {
        sums.nearest_rank[pixel] = f.depth;
        sums.nearest[pixel].id = f.id;
    }
}

double Film::norm_of(const ViewSums& sums, std::size_t pixel) const {
    if (sums.closest) return 1;
    // Dividing by the sum of weights keeps even surfaces even. Those of a filter with negative lobes may nearly cancel when
    // samples are few; their mean is 1, so the count serves then.
    constexpr double kLeastMeanWeight = 0.25;
    if (plan_.views[sums.view].is_signed &&
        sums.weight[pixel] < kLeastMeanWeight * sums.count[pixel])
        return 1.0 / sums.count[pixel];
    return sums.weight[pixel] > 0 ? 1 / sums.weight[pixel] : 0;
}

const Film::ViewSums& Film::sums_of(std::uint32_t view) const {
    for (const ViewSums& sums : views_)
        if (sums.view == view) return sums;
    report_bug("view belongs to the pass", __FILE__, __LINE__, std::to_string(view));
}

void Film::resolve(const PlannedLayer& layer, std::vector<float>& out) const {
    const std::size_t n = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    out.assign(n * layer.info.n_channels, 0.0F);
    const ViewSums& sums = sums_of(layer.view);
    if (is_light(layer.source)) return resolve_light(sums, layer, out);
    resolve_data(sums, layer, out);
}

void Film::save(ByteWriter& out) const {
    for (const ViewSums& sums : views_) {
        ViewSums::for_each_sum(sums, [&](const auto& values) { out.put(values); });
        out.put(sums.slot_of);
        for (std::size_t i = 0; i < sums.n_slots; ++i)
            out.put(sums.slots[i]);
    }
}

bool Film::load(ByteReader& in) {
    for (ViewSums& sums : views_) {
        bool good = true;
        ViewSums::for_each_sum(
            sums, [&](auto& values) { good = good && in.get(values, values.size()); });
        std::vector<std::int32_t> slot_of;
        if (!good || !in.get(slot_of, sums.slot_of.size())) return false;
        // Slots are numbered as they were made.
        std::vector<std::uint32_t> keys(slot_of.size());
        for (std::uint32_t key = 0; key < slot_of.size(); ++key) {
            if (slot_of[key] < 0) continue;
            if (static_cast<std::size_t>(slot_of[key]) >= slot_of.size()) return false;
            keys[static_cast<std::size_t>(slot_of[key])] = key;
            ++sums.n_slots;
        }
        const std::size_t n_slots = std::exchange(sums.n_slots, 0);
        for (std::size_t i = 0; i < n_slots; ++i) {
            std::vector<LightSum>& values = slot(sums, keys[i]);
            if (sums.n_slots != i + 1 || !in.get(values, values.size())) return false;
        }
    }
    return true;
}

std::vector<const std::vector<Film::LightSum>*> Film::parts_of(const ViewSums& sums,
                                                               const PlannedLayer& layer) const {
    const lpe::Program& program = *plan_.program;
    // In the order of their atoms: sums must not depend on which came first.
    std::vector<const std::vector<LightSum>*> parts;
    if (layer.source == LayerSource::Beauty) parts.push_back(&sums.beauty);
    if (layer.source == LayerSource::Expression)
        for (std::uint32_t key = 0; key < sums.slot_of.size(); ++key) {
            if (sums.slot_of[key] < 0) continue;
            const std::span<const std::uint32_t> aovs =
                program.film_stores_atoms() ? program.aovs_of(key)
                                            : std::span<const std::uint32_t>(&key, 1);
            if (std::find(aovs.begin(), aovs.end(), layer.aov) != aovs.end())
                parts.push_back(&sums.slots[static_cast<std::size_t>(sums.slot_of[key])]);
        }
    return parts;
}

void Film::estimate_noise(const PlannedLayer* layer, int step,
                          std::vector<PixelNoise>& out) const {
    const ViewSums& sums = layer == nullptr ? views_.front() : sums_of(layer->view);
    const std::vector<const std::vector<LightSum>*> parts =
        layer == nullptr ? std::vector{&sums.beauty} : parts_of(sums, *layer);
    out.clear();
    for (int y = 0; y < height_; y += step)
        for (int x = 0; x < width_; x += step)
            out.push_back(noise_of(sums, parts, static_cast<std::size_t>(y * width_ + x)));
}

PixelNoise Film::noise_of(const ViewSums& sums,
                          std::span<const std::vector<LightSum>* const> parts, std::size_t pixel) {
    double all = 0, half = 0;
    for (const std::vector<LightSum>* part : parts) {
        const Sum& c = (*part)[pixel].color;
        all += double{luminance(
            Color(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])))};
        half += (*part)[pixel].half;
    }
    const double weight = sums.weight[pixel], in_half = sums.half_weight[pixel],
                 in_other = weight - in_half;
    if (!(in_half > 0) || !(in_other > 0))
        return {weight > 0 ? all / weight : 0, std::numeric_limits<double>::infinity()};
    const double apart = half / in_half - all / weight;
    return {all / weight, apart * apart * in_half / in_other};
}

void Film::resolve_light(const ViewSums& sums, const PlannedLayer& layer,
                         std::vector<float>& out) const {
    const std::vector<const std::vector<LightSum>*> parts = parts_of(sums, layer);
    const std::size_t n = sums.beauty.size(), channels = layer.info.n_channels;
    for (std::size_t i = 0; i < n; ++i) {
        const double norm = norm_of(sums, i);
        Sum total{};
        for (const std::vector<LightSum>* part : parts)
            for (std::size_t c = 0; c < 3; ++c)
                total[c] += (*part)[i].color[c];
        float* at = &out[i * channels];
        if (channels == 1) {
            at[0] = luminance(Color(static_cast<float>(total[0] * norm),
                                    static_cast<float>(total[1] * norm),
                                    static_cast<float>(total[2] * norm)));
            continue;
        }
        for (std::size_t c = 0; c < 3; ++c)
            at[c] = static_cast<float>(total[c] * norm);
        if (channels == 4) at[3] = static_cast<float>(sums.alpha[i] * norm);
    }
}

void Film::resolve_data(const ViewSums& sums, const PlannedLayer& layer,
                        std::vector<float>& out) const {
    const std::size_t channels = layer.info.n_channels;
    for (std::size_t i = 0; i < sums.weight.size(); ++i) {
        const FirstHit& f = sums.nearest[i];
        const double norm = norm_of(sums, i);
        const auto value = [&](std::size_t index, float nearest) {
            return sums.closest ? nearest : static_cast<float>(sums.data[i][index] * norm);
        };
        float* at = &out[i * channels];
        /// A colour: the nearest sample's, or the filtered one; of one channel its mean.
        const auto put_color = [&](Color nearest, const std::vector<Sum>& filtered) {
            Color color = nearest;
            if (!sums.closest)
                for (int c = 0; c < 3; ++c)
                    color[c] = static_cast<float>(filtered[i][static_cast<std::size_t>(c)] * norm);
            if (channels == 1) {
                at[0] = average(color);
            } else {
                for (std::size_t c = 0; c < 3; ++c)
                    at[c] = color[static_cast<int>(c)];
            }
        };
        switch (layer.source) {
            case LayerSource::Depth: at[0] = value(0, f.depth); break;
            case LayerSource::Normal:
                for (std::size_t c = 0; c < 3; ++c)
                    at[c] = value(1 + c, f.normal[static_cast<int>(c)]);
                break;
            case LayerSource::Position:
                for (std::size_t c = 0; c < 3; ++c)
                    at[c] = value(4 + c, f.position[static_cast<int>(c)]);
                break;
            case LayerSource::Uv:
                at[0] = value(7, f.uv.x);
                at[1] = value(8, f.uv.y);
                break;
            case LayerSource::Alpha: at[0] = static_cast<float>(sums.alpha[i] * norm); break;
            case LayerSource::Opacity: put_color(f.opacity, sums.opacity); break;
            case LayerSource::VolumeOpacity:
                put_color(f.volume_opacity, sums.volume_opacity);
                break;
            case LayerSource::Shadow: put_color(f.shadow.by_channel, sums.shadow); break;
            case LayerSource::ShadowDifference:
                put_color(f.shadow.difference, sums.shadow_difference);
                break;
            case LayerSource::ShadowMask:
                for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c)
                    at[c] = sums.closest ? f.shadow.mask
                                         : static_cast<float>(sums.shadow_mask[i] * norm);
                break;
            case LayerSource::Id: at[0] = std::bit_cast<float>(f.id); break;
            case LayerSource::Written:
                for (std::size_t c = 0; c < channels; ++c)
                    at[c] = static_cast<float>(sums.written[layer.aov][i][c] * norm);
                if (layer.info.aov_type == "INT" || layer.info.aov_type == "UINT")
                    at[0] = std::bit_cast<float>(static_cast<std::int32_t>(std::lround(at[0])));
                break;
            case LayerSource::Beauty:
            case LayerSource::Expression:
            case LayerSource::Black: break;
        }
    }
}

}  // namespace lightsieve
