// Sums of one bucket: the beauty, one sum for each atom that light fell into, and data of the nearest hits.
//
// Everything is kept in double and rounded once. A sample's contributions wait in a SampleBuffer until the sample ends,
// because clamping scales all of them by one factor, so that layers still add up. Beside each sum is that of the brightness
// of about half of the samples: how far the two are apart tells how much noise is left.
// A film belongs to one thread and one bucket; it is resolved to layers and reused.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bytes.h"
#include "core/vec.h"
#include "lpe/program.h"
#include "render/aov_plan.h"
#include "render/deep_sums.h"
#include "render/mattes.h"
#include "render/sample_spread.h"

namespace lightsieve {

/// What the shadow on a shadow_matte does.
struct ShadowShown {
    float mask = 0;    ///< 0: no shadow, 1: no light
    Color by_channel;  ///< the same, a channel each
    Color difference;  ///< diffuse light without the shadow, less that with it
};

/// What the camera ray met first; for layers that are no light.
struct FirstHit {
    bool hit = false;
    float depth = 0;         ///< along the viewing axis
    Vec3f normal, position;  ///< world space
    Vec3f pref;              ///< user data Pref, or object space
    /// Where the point is as the shutter opens and as it closes, world space; set if some layer shows motion.
    std::array<Vec3f, 2> at_shutter;
    Vec2f motion;  ///< see screen_motion
    Vec2f uv;
    std::uint32_t id = 0;
    Color opacity;
    ShadowShown shadow;
    /// What media hide of everything behind them; also where nothing was hit.
    Color volume_opacity;
};

/// A place along the camera ray that light comes from, for deep files.
struct DeepSlot {
    float depth = 0;  ///< along the viewing axis
    Color opacity;    ///< what it hides of everything behind it
    Color beauty;     ///< light that comes from it
};

/// Depth of what has none: skies.
inline constexpr float kFarAway = 1e30F;

/// One camera sample's contributions.
struct SampleBuffer {
    struct Contribution {
        lpe::AtomId atom;
        Color value;
        std::uint32_t slot = 0;  ///< into `slots`, if there are any
    };
    Color beauty;
    Color lost;  ///< what indirect_sample_clamp took away
    float alpha = 0;
    float rays = 0, microseconds = 0;  ///< what the sample took
    bool deep = false;                 ///< slots are wanted
    std::vector<DeepSlot>
        slots;               ///< the first is for what has no place: it lies behind everything
    std::uint32_t slot = 0;  ///< what is added goes there
    FirstHit first;
    std::vector<Rgba> written;                ///< AOVs of shaders, by number
    std::vector<MatteHit> mattes;             ///< surfaces, the nearest first
    std::vector<Contribution> contributions;  ///< light
    std::vector<Contribution> probes;         ///< albedo: clamping leaves them alone

    /// What follows comes from that depth.
    void open_slot(float depth) {
        slot = static_cast<std::uint32_t>(slots.size());
        slots.push_back({depth, {}, {}});
    }
    /// full  before a clamp scaled it
    void add_light(Color light, Color full) {
        beauty += light;
        lost += full - light;
        if (deep) slots[slot].beauty += light;
    }
    /// by_channel  whose mean is `amount`
    void add_alpha(float amount, Color by_channel) {
        alpha += amount;
        if (deep) slots[slot].opacity += by_channel;
    }
    void clear() {
        beauty = lost = {};
        slots.clear();
        if (deep) open_slot(kFarAway);
        slot = 0;
        alpha = 0;
        first = {};
        std::fill(written.begin(), written.end(), Rgba{kBlack, 0});
        mattes.clear();
        contributions.clear();
        probes.clear();
    }
};

/// How bright a pixel of a layer is, and how far that is from the truth, by what halves of the samples say.
///
/// Source: Dammertz, Hanika, Keller and Lensch 2010, "A Hierarchical Automatic Stopping Condition for Monte Carlo Global
/// Illumination"; squared and scaled so that the mean of `variance` is that of `mean`, however unlike the halves are.
struct PixelNoise {
    double mean = 0;      ///< luminance
    double variance = 0;  ///< of `mean`; infinite if one half has no samples
};

class Film {
  public:
    explicit Film(const AovPlan& plan) : plan_(plan) {}

    /// Starts a bucket of one pass.
    void begin(const Pass& pass, int width, int height);
    /// Adds a finished sample to a pixel of the bucket.
    ///
    /// scale    factor of clamping on all light
    /// offset   of the sample from the pixel's centre [pixels]
    /// weights  one a view of the pass: the filter's value over the sampling density
    /// in_half  whether the sample is one of the half that tells noise; halves must be well spread, each for itself
    void add(int x, int y, const SampleBuffer& sample, float scale, Vec2f offset,
             std::span<const float> weights, bool in_half);
    /// Deep pixels of a driver that asks for them; its place is not set.
    [[nodiscard]] DeepBucket resolve_deep(std::uint32_t driver) const;
    /// Values of a layer for the whole bucket: height * width * n_channels floats, row by row.
    void resolve(const PlannedLayer& layer, std::vector<float>& out) const;

    /// Samples that a pixel of the bucket has.
    [[nodiscard]] int count(int x, int y) const {
        return static_cast<int>(views_.front().count[static_cast<std::size_t>(y * width_ + x)]);
    }
    /// Memory of all sums, with what earlier buckets left for reuse [bytes].
    [[nodiscard]] std::size_t memory() const;
    /// The same for a bucket into all of whose atoms light falls. Mattes and deep samples, which grow with what is seen, count as
    /// they begin.
    [[nodiscard]] static std::size_t most_memory(const AovPlan& plan, const Pass& pass, int width,
                                                 int height);
    /// All sums, to go on later.
    void save(ByteWriter& out) const;
    /// Sums that `save` wrote, after `begin` of the same pass and size. False if they do not fit: then begin anew.
    [[nodiscard]] bool load(ByteReader& in);

    /// Noise of the bucket's pixels, row by row: of a layer of light, or of the beauty through the pass's first filter.
    ///
    /// layer  null: the beauty
    /// step   of every so many rows and columns one is looked at
    void estimate_noise(const PlannedLayer* layer, int step, std::vector<PixelNoise>& out) const;

  private:
    using Sum = std::array<double, 3>;
    /// Light: a colour, and the luminance of the half of the samples that tells noise.
    struct LightSum {
        Sum color{};
        double half = 0;
    };
    /// Beyond every depth of a hit: rank of samples that met nothing.
    static constexpr float kLargestDepth = 1e30F;
    /// Sums of one filter view.
    struct ViewSums {
        std::uint32_t view = 0;
        std::vector<LightSum> beauty, lost;
        std::vector<double> alpha;
        std::vector<double> weight;        ///< sum of filter weights a pixel
        std::vector<double> half_weight;   ///< the same of one half of the samples
        std::vector<std::uint32_t> count;  ///< samples a pixel
        std::vector<double> rays, microseconds;
        std::vector<std::int32_t> slot_of;  ///< by atom (or AOV): -1 until light falls into it
        std::vector<std::vector<LightSum>> slots;
        std::size_t n_slots = 0;
        /// Data layers: means under a filter, or the nearest sample.
        std::vector<std::array<double, 14>> data;  ///< depth, normal, position, uv, pref, motion
        std::vector<Sum> opacity, volume_opacity, shadow, shadow_difference;
        std::vector<double> shadow_mask;
        std::vector<std::vector<std::array<double, 4>>> written;  ///< by number, then pixel
        std::vector<MatteSums> mattes;      ///< those that layers of the view show
        std::vector<DeepSums> deep;         ///< a driver each
        std::vector<SampleSpread> spreads;  ///< a layer each, if the filter asks for them
        std::vector<FirstHit> nearest;
        std::vector<float> nearest_rank;  ///< the smaller the nearer
        Reduction reduction = Reduction::Mean;
        [[nodiscard]] bool keeps_one() const { return keeps_one_sample(reduction); }

        /// All sums a pixel but the slots', for whoever saves them: a new one must be added here.
        template <class Sums, class Each>
        static void for_each_sum(Sums& sums, const Each& each) {
            each(sums.beauty);
            each(sums.lost);
            each(sums.alpha);
            each(sums.weight);
            each(sums.half_weight);
            each(sums.count);
            each(sums.rays);
            each(sums.microseconds);
            each(sums.data);
            each(sums.opacity);
            each(sums.volume_opacity);
            each(sums.shadow);
            each(sums.shadow_difference);
            each(sums.shadow_mask);
            each(sums.nearest);
            each(sums.nearest_rank);
            for (auto& written : sums.written)
                each(written);
        }
        /// The sums that save and load themselves: a new kind must be added here.
        template <class Sums, class Each>
        static void for_each_kind(Sums& sums, const Each& each) {
            for (auto& matte : sums.mattes)
                each(matte);
            for (auto& deep : sums.deep)
                each(deep);
            for (auto& spread : sums.spreads)
                each(spread);
        }
    };
    std::vector<LightSum>& slot(ViewSums& sums, std::uint32_t key);
    /// What becomes of a sample's light: factors of clamping and of the filter, and whether it is in the half.
    struct Share {
        double clamp, weight;
        bool in_half;
    };
    static void add_to(LightSum& sum, Color value, double factor, bool in_half);
    void add_light(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                   const Share& share);
    void add_to_atoms(ViewSums& sums, std::size_t pixel,
                      std::span<const SampleBuffer::Contribution> contributions, double factor,
                      bool in_half);
    /// The sums that a layer is the sum of, in the order of their atoms.
    [[nodiscard]] std::vector<const std::vector<LightSum>*> parts_of(
        const ViewSums& sums, const PlannedLayer& layer) const;
    /// Noise of a pixel of the layer that is the sum of the parts.
    [[nodiscard]] static PixelNoise noise_of(const ViewSums& sums,
                                             std::span<const std::vector<LightSum>* const> parts,
                                             std::size_t pixel);
    void add_data(ViewSums& sums, std::size_t pixel, const FirstHit& hit, double weight);
    /// Makes room for the mattes that layers of the view show.
    void begin_mattes(ViewSums& sums, std::size_t n_pixels) const;
    static void add_written(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                            double weight);
    /// What a layer is in one sample.
    [[nodiscard]] SampleSpread::Values value_of(const PlannedLayer& layer,
                                                const SampleBuffer& sample, double clamp) const;
    [[nodiscard]] Color light_of(const PlannedLayer& layer, const SampleBuffer& sample,
                                 double clamp) const;
    /// Whether light of an atom is in an AOV.
    [[nodiscard]] bool is_in(lpe::AtomId atom, std::uint32_t aov) const;
    void begin_deep(ViewSums& sums, std::size_t n_pixels) const;
    void add_deep(DeepSums& deep, std::size_t pixel, const SampleBuffer& sample, double clamp,
                  double weight);
    void begin_spreads(ViewSums& sums, std::size_t n_pixels) const;
    void add_spreads(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample, double clamp,
                     double weight) const;
    /// For a filter that keeps one sample, the nearest or farthest: lets it take the pixel if it is that.
    void add_if_nearest(ViewSums& sums, std::size_t pixel, const SampleBuffer& sample,
                        double clamp, Vec2f offset);
    /// What a pixel's sums are multiplied by to become means.
    [[nodiscard]] double norm_of(const ViewSums& sums, std::size_t pixel) const;
    [[nodiscard]] const ViewSums& sums_of(std::uint32_t view) const;
    void resolve_values(const ViewSums& sums, const PlannedLayer& layer,
                        std::vector<float>& out) const;
    void resolve_spread(const ViewSums& sums, const PlannedLayer& layer,
                        std::vector<float>& out) const;
    void resolve_heat(const ViewSums& sums, const PlannedLayer& layer,
                      std::vector<float>& out) const;
    void resolve_light(const ViewSums& sums, const PlannedLayer& layer,
                       std::vector<float>& out) const;
    void resolve_data(const ViewSums& sums, const PlannedLayer& layer,
                      std::vector<float>& out) const;
    static void resolve_cost(const ViewSums& sums, const PlannedLayer& layer,
                             std::vector<float>& out);
    void resolve_matte(const ViewSums& sums, const PlannedLayer& layer,
                       std::vector<float>& out) const;

    const AovPlan& plan_;
    std::vector<ViewSums> views_;
    bool wants_data_ = false;
    std::vector<double> slot_values_;  ///< of one sample for one driver, slot after slot
    int width_ = 0, height_ = 0;
};

}  // namespace lightsieve
