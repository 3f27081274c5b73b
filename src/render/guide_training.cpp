#include "render/guide_training.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "core/sobol.h"
#include "render/accel.h"
#include "render/camera_sample.h"
#include "render/integrator.h"

namespace lightsieve {
namespace {

/// Samples of the training over those of the picture.
constexpr double kTrainingShare = 1.0 / 8;
/// Samples of the first round at least, and rounds at most.
constexpr double kFirstRound = 1 << 14;
constexpr double kMostSamples = 1 << 24;
constexpr int kMostRounds = 10;
/// A cell that more records fell into is divided.
constexpr std::uint64_t kMostRecords = 2000;
/// The picture is walked through in squares of so many pixels; so many samples are traced, then learned from.
constexpr int kTileSize = 16;
constexpr double kSamplesAtOnce = 1 << 16;
/// Seeds of rounds are apart from the picture's: a picture must not be guided by its own noise.
constexpr std::uint32_t kTrainingSeed = 0x7a3d90c5U;

struct Tile {
    int x0, y0, x1, y1;
};

/// Shares of guided rays that a cell may have. At most half: light that the guide knows nothing of is found by the other rays,
/// and then counts no more than twice. Cells begin with kFirstShare.
constexpr std::array<float, 3> kShares{0, 0.25F, 0.5F};
constexpr float kFirstShare = 0.5F;
/// Guided rays take time: they must bring the variance down to this.
constexpr double kWorthIt = 0.9;

/// How much light would vary in a cell if other shares of its rays were guided.
struct CellStatistics {
    std::uint64_t n = 0;
    double light = 0;
    std::array<double, kShares.size()> squares{};  ///< of light, by share

    void add(const GuideRecord& r) {
        ++n;
        if (!(r.light > 0)) return;
        light += double{r.light};
        for (std::size_t i = 0; i < kShares.size(); ++i) {
            // Importance sampling: drawn with one density, asked about another.
            const double density = double{r.pdf.of_share(kShares[i])};
            if (density > 0)
                squares[i] += double{r.light} * double{r.light} * double{r.pdf.used} / density;
        }
    }
    [[nodiscard]] float best_share() const {
        const double mean = n > 0 ? light / static_cast<double>(n) : 0;
        const auto variance = [&](std::size_t i) {
            return squares[i] / static_cast<double>(n) - mean * mean;
        };
        std::size_t best = 0;
        for (std::size_t i = 1; i < kShares.size(); ++i)
            if (n > 0 && variance(i) < (best == 0 ? kWorthIt : 1) * variance(best)) best = i;
        return kShares[best];
    }
};

class Trainer {
  public:
    Trainer(const Scene& scene, const std::function<void(std::uint64_t)>& taken,
            const std::atomic<bool>* stop)
        : scene_(scene),
          taken_(taken),
          stop_(stop),
          guide_(std::make_unique<Guide>(scene.accel->bounds())) {}

    GuideTraining run();

  private:
    [[nodiscard]] bool stopped() const {
        return stop_ != nullptr && stop_->load(std::memory_order_relaxed);
    }
    void begin_round();
    void end_round();
    void train(const Pass& pass, std::uint32_t seed, double samples_a_pixel);
    void trace(const Pass& pass, std::uint32_t seed, double samples_a_pixel, const Tile& tile,
               std::vector<GuideRecord>& out, GuideTraining& took) const;
    void learn(std::span<const std::vector<GuideRecord>> records);

    const Scene& scene_;
    const std::function<void(std::uint64_t)>& taken_;
    const std::atomic<bool>* stop_;
    std::unique_ptr<Guide> guide_;
    std::vector<DirectionTree> trees_;        ///< of this round, by cell
    std::vector<CellStatistics> statistics_;  ///< of this round, by cell
    GuideTraining out_;
};

std::vector<Tile> tiles_of(const Region& r) {
    std::vector<Tile> out;
    for (int y = r.y0; y <= r.y1; y += kTileSize)
        for (int x = r.x0; x <= r.x1; x += kTileSize)
            out.push_back(
                {x, y, std::min(x + kTileSize, r.x1 + 1), std::min(y + kTileSize, r.y1 + 1)});
    return out;
}

/// One pass for each camera: others take the same samples.
std::vector<const Pass*> cameras_of(const Scene& scene) {
    std::vector<const Pass*> out;
    for (const Pass& pass : scene.plan.passes)
        if (std::none_of(out.begin(), out.end(),
                         [&](const Pass* p) { return p->camera_node == pass.camera_node; }))
            out.push_back(&pass);
    return out;
}

double n_pixels_of(const RenderSettings& s) {
    return static_cast<double>(s.region.x1 - s.region.x0 + 1) * (s.region.y1 - s.region.y0 + 1);
}

/// Of each camera.
double samples_of(const Scene& scene) {
    return std::min(kMostSamples,
                    kTrainingShare * n_pixels_of(scene.settings) * scene.settings.samples);
}

GuideTraining Trainer::run() {
    const double samples = samples_of(scene_);
    // What a round learned is tried out by the next one.
    const int n_rounds =
        std::clamp(static_cast<int>(std::log2(samples / kFirstRound + 1)), 2, kMostRounds);
    const std::vector<const Pass*> passes = cameras_of(scene_);
    for (int round = 0; round < n_rounds; ++round) {
        begin_round();
        const double of_round = samples * std::exp2(round) / (std::exp2(n_rounds) - 1);
        const std::uint32_t seed =
            hash_combine(scene_.settings.seed ^ kTrainingSeed, static_cast<std::uint32_t>(round));
        for (const Pass* pass : passes)
            train(*pass, seed, of_round / n_pixels_of(scene_.settings));
        if (stopped()) return std::move(out_);
        end_round();
    }
    out_.guide = std::move(guide_);
    return std::move(out_);
}

void Trainer::begin_round() {
    trees_.clear();
    for (const Guide::Cell& cell : guide_->cells())
        trees_.push_back(cell.tree.empty() ? DirectionTree::uniform() : cell.tree.refined());
    statistics_.assign(trees_.size(), {});
}

void Trainer::end_round() {
    for (std::size_t i = 0; i < trees_.size(); ++i) {
        Guide::Cell& cell = guide_->cells()[i];
        const CellStatistics& of_cell = statistics_[i];
        // Whether guiding helps is known only where paths were held against what the round before had learned.
        const float share = cell.tree.empty() ? kFirstShare : of_cell.best_share();
        trees_[i].take_roots();
        cell = {std::move(trees_[i]), share, of_cell.n};
    }
    guide_->split(kMostRecords);
}

/// Traces paths from a camera and learns from them.
void Trainer::train(const Pass& pass, std::uint32_t seed, double samples_a_pixel) {
    const std::vector<Tile> tiles = tiles_of(scene_.settings.region);
    const auto at_once = static_cast<std::size_t>(
        std::max(1.0, kSamplesAtOnce / (samples_a_pixel * kTileSize * kTileSize)));
    for (std::size_t first = 0; first < tiles.size() && !stopped(); first += at_once) {
        const std::size_t n = std::min(at_once, tiles.size() - first);
        std::vector<std::vector<GuideRecord>> records(n);
        std::vector<GuideTraining> took(n);
        parallel_for(n, scene_.settings.threads, [&](std::size_t i) {
            if (!stopped())
                trace(pass, seed, samples_a_pixel, tiles[first + i], records[i], took[i]);
        });
        std::uint64_t n_samples = 0;
        for (const GuideTraining& t : took) {
            n_samples += t.n_samples;
            for (std::size_t k = 0; k < t.rays.size(); ++k)
                out_.rays[k] += t.rays[k];
        }
        out_.n_samples += n_samples;
        taken_(n_samples);
        learn(records);
    }
}

void Trainer::trace(const Pass& pass, std::uint32_t seed, double samples_a_pixel, const Tile& tile,
                    std::vector<GuideRecord>& out, GuideTraining& took) const {
    const CameraSampler camera(scene_, pass, seed);
    Integrator<AovTracker> integrator(scene_);
    GuideRecorder recorder;
    integrator.train(*guide_, recorder);
    SampleBuffer sample_buffer;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            // Where there is less than one sample a pixel chance says which pixels have one.
            const float u =
                Sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, ~seed)
                    .random(0);
            const auto n = static_cast<std::uint32_t>(samples_a_pixel + double{u});
            for (std::uint32_t i = 0; i < n; ++i) {
                const CameraSample sample = camera.sample(x, y, i);
                integrator.state = sample.state;
                integrator.trace(sample.ray, sample.time, sample.camera_from_world, sample.sampler,
                                 sample_buffer);
                recorder.finish(out);
            }
            took.n_samples += n;
        }
    took.rays = integrator.counts.rays;
}

/// Adds records to the trees of their cells: in their order, whichever thread does it.
void Trainer::learn(std::span<const std::vector<GuideRecord>> records) {
    std::vector<std::size_t> end(trees_.size() + 1);
    for (const std::vector<GuideRecord>& of_tile : records)
        for (const GuideRecord& r : of_tile)
            ++end[r.cell + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<GuideRecord> sorted(end.back());
    std::vector<std::size_t> next(end.begin(), end.end() - 1);
    for (const std::vector<GuideRecord>& of_tile : records)
        for (const GuideRecord& r : of_tile)
            sorted[next[r.cell]++] = r;
    parallel_for(trees_.size(), scene_.settings.threads, [&](std::size_t cell) {
        for (std::size_t i = end[cell]; i < end[cell + 1]; ++i) {
            const GuideRecord& r = sorted[i];
            statistics_[cell].add(r);
            // Mean squares: rays should go by the root of what a direction's light varies about zero.
            if (r.light > 0) trees_[cell].add(r.at, r.light * r.light * r.pdf.used);
        }
    });
}

}  // namespace

void GuideRecorder::finish(std::vector<GuideRecord>& out) {
    for (const Place& place : places_) {
        const float light = place.brought * place.scale;
        out.push_back(
            {place.cell, place.at, std::isfinite(light) ? std::max(light, 0.0F) : 0, place.pdf});
    }
    places_.clear();
}

std::uint64_t training_samples(const Scene& scene) {
    const bool some_light = std::ranges::any_of(
        scene.plan.layers, [](const PlannedLayer& layer) { return is_light(layer.source); });
    if (!scene.settings.guiding || !some_light) return 0;
    return static_cast<std::uint64_t>(samples_of(scene) *
                                      static_cast<double>(cameras_of(scene).size()));
}

std::size_t training_memory(const Scene& scene) {
    // Half of the samples are in the last round. Trees of that round and of the one before, and records in two orders.
    constexpr double kPlaces = 8, kBytesOfTree = 6000;
    const auto n = static_cast<double>(training_samples(scene));
    if (n == 0) return 0;
    const double cells = std::min(static_cast<double>(Guide::kMostCells),
                                  6 + 2 * kPlaces * 0.5 * n / static_cast<double>(kMostRecords));
    const double records = 2 * kPlaces * std::min(n, kSamplesAtOnce);
    return static_cast<std::size_t>(2 * cells * kBytesOfTree + records * sizeof(GuideRecord));
}

GuideTraining train_guide(const Scene& scene, const std::function<void(std::uint64_t)>& taken,
                          const std::atomic<bool>* stop) {
    if (training_samples(scene) == 0 || scene.accel->bounds().empty()) return {};
    return Trainer(scene, taken, stop).run();
}

}  // namespace lightsieve
