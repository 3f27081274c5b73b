#include "render/film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "core/error.h"

namespace lightsieve {
namespace {

void add_color(std::array<double, 3>& sum, Color value, double factor) {
    sum[0] += double{value.r} * factor;
    sum[1] += double{value.g} * factor;
    sum[2] += double{value.b} * factor;
}

/// What the pixel took, by itself and not by filters.
bool is_cost(LayerSource source) {
    return source == LayerSource::RayCount || source == LayerSource::CpuTime ||
           source == LayerSource::InverseDensity;
}

/// Values of a bucket's pixels, most of which may be nothing: a bit for each, then those that have a bit set.
template <class T>
void put_sparse(const std::vector<T>& values, ByteWriter& out) {
    constexpr std::size_t kRun = 64;
    const T nothing{};
    const auto is_nothing = [&](const T& v) { return std::memcmp(&v, &nothing, sizeof(T)) == 0; };
    for (std::size_t begin = 0; begin < values.size(); begin += kRun) {
        const auto run = std::span(values).subspan(begin, std::min(kRun, values.size() - begin));
        std::uint64_t there = 0;
        for (std::size_t i = 0; i < run.size(); ++i)
            there |= std::uint64_t{!is_nothing(run[i])} << i;
        out.put(there);
        for (const T& value : run)
            if (!is_nothing(value)) out.put(value);
    }
}

/// Into values that are nothing. False if something is missing.
template <class T>
bool get_sparse(ByteReader& in, std::vector<T>& values) {
    std::uint64_t there = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % 64 == 0 && !in.get(there)) return false;
        if ((there >> (i % 64) & 1U) != 0 && !in.get(values[i])) return false;
    }
    return true;
}

bool is_matte(LayerSource source) {
    return source == LayerSource::Matte || source == LayerSource::MattePreview;
}

}  // namespace

void Film::begin(const Pass& pass, int width, int height) {
    width_ = width;
    height_ = height;
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    wants_data_ = std::any_of(plan_.layers.begin(), plan_.layers.end(), [](const PlannedLayer& l) {
        return !is_light(l.source) && !is_matte(l.source);
    });
    const lpe::Program& program = *plan_.program;
    const std::size_t n_keys = program.film_stores_atoms() ? program.n_atoms() : program.n_aovs();
    views_.resize(pass.views.size());
    for (std::size_t i = 0; i < views_.size(); ++i) {
        ViewSums& sums = views_[i];
        sums.view = pass.views[i];
        sums.reduction = plan_.views[sums.view].filter->reduction();
        sums.beauty.assign(n, {});
        sums.lost.assign(plan_.wants_clamps ? n : 0, {});
        sums.alpha.assign(n, 0);
        sums.rays.assign(plan_.wants_cost ? n : 0, 0);
        sums.microseconds.assign(plan_.wants_cost ? n : 0, 0);
        sums.weight.assign(n, 0);
        sums.half_weight.assign(n, 0);
        sums.count.assign(n, 0);
        sums.slot_of.assign(n_keys, -1);
        sums.n_slots = 0;
        sums.written.assign(plan_.written.size(), std::vector<std::array<double, 4>>(n));
        begin_mattes(sums, n);
        begin_spreads(sums, n);
        begin_deep(sums, n);
        if (!wants_data_ && !sums.keeps_one()) continue;
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

void Film::begin_mattes(ViewSums& sums, std::size_t n_pixels) const {
    std::set<std::uint32_t> shown;
    for (const PlannedLayer& layer : plan_.layers)
        if (is_matte(layer.source) && layer.view == sums.view) shown.insert(layer.aov);
    // Another pass may have left others.
    std::erase_if(sums.mattes, [&](const MatteSums& m) { return shown.erase(m.matte()) == 0; });
    for (const std::uint32_t matte : shown)
        sums.mattes.emplace_back(matte);
    std::sort(sums.mattes.begin(), sums.mattes.end(),
              [](const MatteSums& a, const MatteSums& b) { return a.matte() < b.matte(); });
    for (MatteSums& matte : sums.mattes)
        matte.begin(n_pixels);
}

void Film::begin_deep(ViewSums& sums, std::size_t n_pixels) const {
    sums.deep.clear();
    for (std::uint32_t d = 0; d < plan_.drivers.size(); ++d) {
        const PlannedDriver& driver = plan_.drivers[d];
        if (!driver.driver || !driver.driver->deep() || driver.layers.empty() ||
            plan_.layers[driver.layers[0]].view != sums.view)
            continue;
        std::size_t n_values = 0;
        for (const std::uint32_t layer : driver.layers)
            n_values += std::min<std::size_t>(plan_.layers[layer].info.n_channels, 3);
        sums.deep.emplace_back(d, n_values).begin(n_pixels);
    }
}

void Film::add_deep(DeepSums& deep, std::size_t pixel, const SampleBuffer& sample, double clamp,
                    double weight) {
    const std::size_t stride = deep.n_values();
    slot_values_.assign(sample.slots.size() * stride, 0);
    std::size_t first = 0;
    for (const std::uint32_t index : plan_.drivers[deep.driver()].layers) {
        const PlannedLayer& layer = plan_.layers[index];
        const std::size_t n = std::min<std::size_t>(layer.info.n_channels, 3);
        const auto put = [&](std::size_t slot, Color light, double factor) {
            double* at = &slot_values_[slot * stride + first];
            if (n == 1) at[0] += double{luminance(light)} * factor;
            for (std::size_t c = 0; n == 3 && c < 3; ++c)
                at[c] += double{light[static_cast<int>(c)]} * factor;
        };
        const auto put_all = [&](std::span<const SampleBuffer::Contribution> all, double factor) {
            for (const SampleBuffer::Contribution& c : all)
                if (is_in(c.atom, layer.aov)) put(c.slot, c.value, factor);
        };
        if (layer.source == LayerSource::Beauty)
            for (std::size_t s = 0; s < sample.slots.size(); ++s)
                put(s, sample.slots[s].beauty, clamp);
        if (layer.source == LayerSource::Expression) {
            put_all(sample.contributions, clamp);
            put_all(sample.probes, 1);
        }
        first += n;
    }
    for (std::size_t s = 0; s < sample.slots.size(); ++s)
        deep.add(pixel, sample.slots[s].depth, sample.slots[s].opacity,
                 std::span(slot_values_).subspan(s * stride, stride), weight);
}

DeepBucket Film::resolve_deep(std::uint32_t driver) const {
    for (const ViewSums& sums : views_)
        for (const DeepSums& deep : sums.deep) {
            if (deep.driver() != driver) continue;
            std::vector<double> norms(sums.weight.size());
            for (std::size_t i = 0; i < norms.size(); ++i)
                norms[i] = norm_of(sums, i);
            return deep.resolve(norms);
        }
    report_bug("driver belongs to the pass", __FILE__, __LINE__, std::to_string(driver));
}

bool Film::is_in(lpe::AtomId atom, std::uint32_t aov) const {
    const std::span<const std::uint32_t> aovs = plan_.program->aovs_of(atom);
    return std::find(aovs.begin(), aovs.end(), aov) != aovs.end();
}

void Film::begin_spreads(ViewSums& sums, std::size_t n_pixels) const {
    sums.spreads.clear();
    if (keeps_sums(sums.reduction)) return;
    for (std::uint32_t i = 0; i < plan_.layers.size(); ++i)
        if (plan_.layers[i].view == sums.view) sums.spreads.emplace_back(i, sums.reduction);
    for (SampleSpread& spread : sums.spreads)
        spread.begin(n_pixels);
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
        if (plan_.wants_cost) {
            sums.rays[pixel] += double{sample.rays};
            sums.microseconds[pixel] += double{sample.microseconds};
        }
        if (sums.keeps_one()) {
            add_if_nearest(sums, pixel, sample, double{scale}, offset);
            continue;
        }
        if (!sums.spreads.empty()) {
            add_spreads(sums, pixel, sample, double{scale}, weight);
            continue;
        }
        sums.weight[pixel] += weight;
        if (in_half) sums.half_weight[pixel] += weight;
        sums.alpha[pixel] += double{sample.alpha} * weight;
        add_light(sums, pixel, sample, {double{scale}, weight, in_half});
        add_written(sums, pixel, sample, weight);
        for (MatteSums& matte : sums.mattes)
            matte.add(pixel, sample.mattes, weight);
        for (DeepSums& deep : sums.deep)
            add_deep(deep, pixel, sample, double{scale}, weight);
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
    if (plan_.wants_clamps) {
        add_to(sums.lost[pixel], sample.lost, share.weight, share.in_half);
        add_to(sums.lost[pixel], sample.beauty, (1 - share.clamp) * share.weight, share.in_half);
    }
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

Color Film::light_of(const PlannedLayer& layer, const SampleBuffer& sample, double clamp) const {
    Color out;
    const auto factor = static_cast<float>(clamp);
    if (layer.source == LayerSource::Beauty) return sample.beauty * factor;
    if (layer.source == LayerSource::Unclamped) return sample.beauty + sample.lost;
    if (layer.source == LayerSource::ClampLoss) return sample.lost + sample.beauty * (1 - factor);
    if (layer.source != LayerSource::Expression) return out;
    const auto add = [&](std::span<const SampleBuffer::Contribution> contributions, float scale) {
        for (const SampleBuffer::Contribution& c : contributions) {
            if (is_in(c.atom, layer.aov)) out += c.value * scale;
        }
    };
    add(sample.contributions, factor);
    add(sample.probes, 1);
    return out;
}

SampleSpread::Values Film::value_of(const PlannedLayer& layer, const SampleBuffer& sample,
                                    double clamp) const {
    const FirstHit& f = sample.first;
    const auto color = [&](Color c) {
        return layer.info.n_channels == 1
                   ? SampleSpread::Values{double{average(c)}}
                   : SampleSpread::Values{double{c.r}, double{c.g}, double{c.b}};
    };
    const auto vector = [](Vec3f v) {
        return SampleSpread::Values{double{v.x}, double{v.y}, double{v.z}};
    };
    switch (layer.source) {
        case LayerSource::Beauty:
        case LayerSource::ClampLoss:
        case LayerSource::Unclamped:
        case LayerSource::Expression: {
            const Color c = light_of(layer, sample, clamp);
            if (layer.info.n_channels == 1) return {double{luminance(c)}};
            return {double{c.r}, double{c.g}, double{c.b}, double{sample.alpha}};
        }
        case LayerSource::Depth: return {double{f.depth}};
        case LayerSource::Normal: return vector(f.normal);
        case LayerSource::Position: return vector(f.position);
        case LayerSource::Pref: return vector(f.pref);
        case LayerSource::Uv: return {double{f.uv.x}, double{f.uv.y}};
        case LayerSource::Motion: return {double{f.motion.x}, double{f.motion.y}};
        case LayerSource::Alpha: return {double{sample.alpha}};
        case LayerSource::Opacity: return color(f.opacity);
        case LayerSource::VolumeOpacity: return color(f.volume_opacity);
        case LayerSource::Shadow: return color(f.shadow.by_channel);
        case LayerSource::ShadowDifference: return color(f.shadow.difference);
        case LayerSource::ShadowMask: return color(Color::grey(f.shadow.mask));
        case LayerSource::Written: {
            const Rgba& v = sample.written[layer.aov];
            return {double{v.rgb.r}, double{v.rgb.g}, double{v.rgb.b}, double{v.a}};
        }
        case LayerSource::RayCount: return {double{sample.rays}};
        case LayerSource::CpuTime: return {double{sample.microseconds}};
        case LayerSource::Id:
        case LayerSource::InverseDensity:
        case LayerSource::Matte:
        case LayerSource::MattePreview:
        case LayerSource::Black: break;
    }
    return {};
}

void Film::add_spreads(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample, double clamp,
                       double weight) const {
    sums.weight[pixel] += weight;
    for (SampleSpread& spread : sums.spreads) {
        const PlannedLayer& layer = plan_.layers[spread.layer()];
        SampleSpread::Values values = value_of(layer, sample, clamp);
        if (sums.reduction == Reduction::LumaVariance && layer.info.n_channels >= 3) {
            const double y =
                double{luminance({static_cast<float>(values[0]), static_cast<float>(values[1]),
                                  static_cast<float>(values[2])})};
            values[0] = values[1] = values[2] = y;
        }
        spread.add(pixel, values, weight);
    }
}

void Film::add_if_nearest(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                          double clamp, Vec2f offset) {
    // Samples inside the filter compete by depth; a sample outside of it only stands in for none at all.
    const float radius = plan_.views[sums.view].filter->radius();
    const bool inside = std::max(std::abs(offset.x), std::abs(offset.y)) <= radius;
    const float sign = sums.reduction == Reduction::Farthest ? -1.0F : 1.0F;
    const float distance = sample.first.hit ? sign * sample.first.depth : kLargestDepth;
    const float rank = inside ? distance : kLargestDepth + std::hypot(offset.x, offset.y);
    if (rank >= sums.nearest_rank[pixel]) return;
    sums.nearest_rank[pixel] = rank;
    sums.nearest[pixel] = sample.first;
    sums.alpha[pixel] = double{sample.alpha};
    sums.beauty[pixel] = {};
    if (plan_.wants_clamps) sums.lost[pixel] = {};
    for (std::size_t i = 0; i < sums.n_slots; ++i)
        sums.slots[i][pixel] = {};
    add_light(sums, pixel, sample, {clamp, 1, false});
    for (auto& written : sums.written)
        written[pixel] = {};
    add_written(sums, pixel, sample, 1);
    for (MatteSums& matte : sums.mattes) {
        matte.clear(pixel);
        matte.add(pixel, sample.mattes, 1);
    }
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
    const std::array<float, 14> values{
        f.depth, f.normal.x, f.normal.y, f.normal.z, f.position.x, f.position.y, f.position.z,
        f.uv.x,  f.uv.y,     f.pref.x,   f.pref.y,   f.pref.z,     f.motion.x,   f.motion.y};
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
    if (sums.keeps_one()) return 1;
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
    if (plan_.views[layer.view].filter->shows_heat()) return resolve_heat(sums, layer, out);
    resolve_values(sums, layer, out);
}

void Film::resolve_values(const ViewSums& sums, const PlannedLayer& layer,
                          std::vector<float>& out) const {
    if (!keeps_sums(sums.reduction)) return resolve_spread(sums, layer, out);
    if (is_light(layer.source)) return resolve_light(sums, layer, out);
    if (is_matte(layer.source)) return resolve_matte(sums, layer, out);
    if (is_cost(layer.source)) return resolve_cost(sums, layer, out);
    resolve_data(sums, layer, out);
}

std::size_t Film::memory() const {
    std::size_t sum = 0;
    const auto add = [&](const auto& values) { sum += values.capacity() * sizeof(values[0]); };
    for (const ViewSums& sums : views_) {
        ViewSums::for_each_sum(sums, add);
        ViewSums::for_each_kind(sums, [&](const auto& kind) { sum += kind.memory(); });
        add(sums.slot_of);
        for (const std::vector<LightSum>& slot : sums.slots)
            add(slot);
    }
    return sum;
}

std::size_t Film::most_memory(const AovPlan& plan, const Pass& pass, int width, int height) {
    constexpr int kSide = 8;
    Film sample(plan);
    sample.begin(pass, kSide, kSide);
    for (ViewSums& sums : sample.views_)
        for (std::uint32_t key = 0; key < sums.slot_of.size(); ++key)
            (void)sample.slot(sums, key);
    return sample.memory() / (kSide * kSide) * static_cast<std::size_t>(width) *
           static_cast<std::size_t>(height);
}

void Film::save(ByteWriter& out) const {
    for (const ViewSums& sums : views_) {
        ViewSums::for_each_sum(sums, [&](const auto& values) { out.put(values); });
        ViewSums::for_each_kind(sums, [&](const auto& kind) { kind.save(out); });
        out.put(sums.slot_of);
        for (std::size_t i = 0; i < sums.n_slots; ++i)
            put_sparse(sums.slots[i], out);
    }
}

bool Film::load(ByteReader& in) {
    for (ViewSums& sums : views_) {
        bool good = true;
        ViewSums::for_each_sum(
            sums, [&](auto& values) { good = good && in.get(values, values.size()); });
        ViewSums::for_each_kind(sums, [&](auto& kind) { good = good && kind.load(in); });
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
            if (sums.n_slots != i + 1 || !get_sparse(in, values)) return false;
        }
    }
    return true;
}

void Film::resolve_spread(const ViewSums& sums, const PlannedLayer& layer,
                          std::vector<float>& out) const {
    const std::size_t channels = layer.info.n_channels;
    for (const SampleSpread& spread : sums.spreads) {
        if (&plan_.layers[spread.layer()] != &layer) continue;
        for (std::size_t i = 0; i < sums.weight.size(); ++i) {
            const SampleSpread::Values values = spread.spread(i);
            for (std::size_t c = 0; c < channels; ++c)
                out[i * channels + c] = static_cast<float>(values[c]);
        }
    }
}

/// Numbers, or the luminance of colours, as colours.
void Film::resolve_heat(const ViewSums& sums, const PlannedLayer& layer,
                        std::vector<float>& out) const {
    PlannedLayer plain = layer;
    plain.info.n_channels = n_channels_of(layer.info.aov_type);
    const std::size_t n = sums.weight.size(), from = plain.info.n_channels,
                      to = layer.info.n_channels;
    std::vector<float> values(n * from);
    resolve_values(sums, plain, values);
    for (std::size_t i = 0; i < n; ++i) {
        const float* v = &values[i * from];
        const Color color =
            plan_.views[layer.view].filter->heat(from < 3 ? v[0] : luminance({v[0], v[1], v[2]}));
        for (std::size_t c = 0; c < 3; ++c)
            out[i * to + c] = color[static_cast<int>(c)];
        if (to == 4) out[i * to + 3] = v[3];
    }
}

std::vector<const std::vector<Film::LightSum>*> Film::parts_of(const ViewSums& sums,
                                                               const PlannedLayer& layer) const {
    const lpe::Program& program = *plan_.program;
    // In the order of their atoms: sums must not depend on which came first.
    std::vector<const std::vector<LightSum>*> parts;
    if (layer.source == LayerSource::Beauty || layer.source == LayerSource::Unclamped)
        parts.push_back(&sums.beauty);
    if (layer.source == LayerSource::ClampLoss || layer.source == LayerSource::Unclamped)
        parts.push_back(&sums.lost);
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
            return sums.keeps_one() ? nearest : static_cast<float>(sums.data[i][index] * norm);
        };
        float* at = &out[i * channels];
        /// A colour: the nearest sample's, or the filtered one; of one channel its mean.
        const auto put_color = [&](Color nearest, const std::vector<Sum>& filtered) {
            Color color = nearest;
            if (!sums.keeps_one())
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
            case LayerSource::Pref:
                for (std::size_t c = 0; c < 3; ++c)
                    at[c] = value(9 + c, f.pref[static_cast<int>(c)]);
                break;
            case LayerSource::Uv:
                at[0] = value(7, f.uv.x);
                at[1] = value(8, f.uv.y);
                break;
            case LayerSource::Motion:
                at[0] = value(12, f.motion.x);
                at[1] = value(13, f.motion.y);
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
                    at[c] = sums.keeps_one() ? f.shadow.mask
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
            case LayerSource::ClampLoss:
            case LayerSource::Unclamped:
            case LayerSource::RayCount:
            case LayerSource::CpuTime:
            case LayerSource::InverseDensity:
            case LayerSource::Matte:
            case LayerSource::MattePreview:
            case LayerSource::Black: break;
        }
    }
}

void Film::resolve_cost(const ViewSums& sums, const PlannedLayer& layer, std::vector<float>& out) {
    for (std::size_t i = 0; i < sums.count.size(); ++i) {
        const double value = layer.source == LayerSource::RayCount  ? sums.rays[i]
                             : layer.source == LayerSource::CpuTime ? sums.microseconds[i]
                             : sums.count[i] > 0                    ? 1.0 / sums.count[i]
                                                                    : 0;
        out[i * layer.info.n_channels] = static_cast<float>(value);
    }
}

void Film::resolve_matte(const ViewSums& sums, const PlannedLayer& layer,
                         std::vector<float>& out) const {
    const auto matte = std::find_if(sums.mattes.begin(), sums.mattes.end(),
                                    [&](const MatteSums& m) { return m.matte() == layer.aov; });
    const std::size_t channels = layer.info.n_channels;
    for (std::size_t i = 0; i < sums.weight.size(); ++i) {
        const double norm = norm_of(sums, i);
        float* at = &out[i * channels];
        if (layer.source == LayerSource::Matte) {
            const auto ranks = matte->ranks(i, layer.rank, norm);
            at[0] = std::bit_cast<float>(ranks[0].id);
            at[1] = ranks[0].coverage;
            at[2] = std::bit_cast<float>(ranks[1].id);
            at[3] = ranks[1].coverage;
            continue;
        }
        const Color color = matte->preview(i, norm);
        if (channels == 1) {
            at[0] = luminance(color);
            continue;
        }
        for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c)
            at[c] = color[static_cast<int>(c)];
        if (channels == 4) at[3] = static_cast<float>(sums.alpha[i] * norm);
    }
}

}  // namespace lightsieve
