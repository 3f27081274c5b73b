// Buckets over threads, samples over pixels, buckets to drivers.
#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <utility>

#include "core/memory.h"
#include "core/parallel.h"
#include "core/version.h"
#include "io/file_claim.h"
#include "lpe/path.h"
#include "render/adaptive.h"
#include "render/camera_sample.h"
#include "render/guide_training.h"
#include "render/integrator.h"
#include "render/live_view.h"
#include "render/mattes.h"
#include "render/memory_use.h"
#include "render/screen_motion.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct BucketRect {
    int x, y, width, height;
};

std::vector<BucketRect> buckets_of(const RenderSettings& s) {
    std::vector<BucketRect> out;
    for (int y = s.region.y0; y <= s.region.y1; y += s.bucket_size)
        for (int x = s.region.x0; x <= s.region.x1; x += s.bucket_size)
            out.push_back({x, y, std::min(s.bucket_size, s.region.x1 + 1 - x),
                           std::min(s.bucket_size, s.region.y1 + 1 - y)});
    return out;
}

/// A camera sample that brought something infinite or not a number.
struct DroppedSample {
    int y, x, index;
    int depth;
    std::uint32_t event;
    friend auto operator<=>(const DroppedSample&, const DroppedSample&) = default;
};
/// As many are described, for somebody who wants to trace them again.
constexpr std::size_t kDescribedDrops = 10;

/// Of so many rows and columns one tells how noisy layers are: hundreds of layers of all pixels would take their time.
constexpr int kNoiseStep = 4;
/// Samples of a thread between two reports of progress: some hundred reports a second.
constexpr std::uint64_t kSamplesAReport = 1024;

/// What one thread needs; made once, used for many buckets.
struct Worker {
    explicit Worker(const Scene& scene) : integrator(scene), film(scene.plan) {}
    Integrator<AovTracker> integrator;
    Film film;
    SampleBuffer sample;
    std::vector<float> weights;
    std::vector<std::vector<float>> layers;  ///< by layer of the plan
    std::vector<PixelNoise> noise;           ///< of the bucket
    std::vector<DeepBucket> deep;            ///< by driver of the plan; empty for others
    std::vector<DroppedSample> dropped;      ///< the first few
    std::uint64_t n_unreported = 0;          ///< samples since the last report of progress
    Checkpoint::Clock::time_point saved;     ///< when the bucket's state was last saved, or begun

    /// Of what grows with the outputs [bytes].
    [[nodiscard]] std::size_t memory() const {
        std::size_t sum = film.memory() + noise.capacity() * sizeof(PixelNoise);
        for (const std::vector<float>& layer : layers)
            sum += layer.capacity() * sizeof(float);
        return sum;
    }
};

class Renderer {
  public:
    Renderer(const Scene& scene, const RenderControl& control, Diagnostics& diagnostics,
             bool capture, bool write_files)
        : scene_(scene),
          control_(control),
          diagnostics_(diagnostics),
          capture_(capture),
          write_files_(write_files),
          checkpoint_(scene.settings.checkpoint, scene.identity, scene.settings.samples_max) {}

    RenderResult run();

  private:
    [[nodiscard]] ImageHeader header_of(const PlannedDriver& driver, std::size_t index) const;
    void claim_files();
    void open_drivers();
    void open_viewer();
    void restore_folders();
    void make_room();
    void learn_guide();
    void render_bucket(Worker& worker, std::size_t index, const BucketRect& rect);
    void render_pass(Worker& worker, std::size_t bucket, std::size_t pass, const BucketRect& rect);
    [[nodiscard]] int most_samples(const Pass& pass) const;
    /// The bucket's state of an earlier render, if there is one.
    void resume(Worker& worker, std::size_t bucket, std::size_t pass, const BucketRect& rect,
                SampleSchedule& schedule);
    void save(Worker& worker, std::size_t bucket, std::size_t pass,
              const SampleSchedule& schedule);
    bool take_samples(Worker& worker, const CameraSampler& camera, const BucketRect& rect, int x,
                      int y, const SampleSchedule& schedule);
    void measure_noise(Worker& worker, std::size_t bucket, std::size_t layer);
    void report_noise();
    void report_progress(Worker& worker);
    void tell_progress();
    [[nodiscard]] bool has_noise(const PlannedLayer& layer) const;
    [[nodiscard]] double noise_so_far();
    void find_watched_layer();
    static void note_dropped(Worker& worker, int x, int y, int index);
    void deliver(Worker& worker, const BucketRect& rect);
    [[nodiscard]] bool is_deep_of_pass(const PlannedDriver& driver, std::size_t pass) const {
        return driver.driver->deep() && scene_.plan.layers[driver.layers[0]].pass == pass;
    }
    void close_drivers();
    void close_checkpoint();
    void report();
    void report_memory();
    void report_dropped();
    [[nodiscard]] bool stopped() const {
        return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed);
    }
    Worker& worker();

    const Scene& scene_;
    const RenderControl& control_;
    Diagnostics& diagnostics_;
    bool capture_, write_files_;
    RenderResult result_;
    Checkpoint checkpoint_;
    std::vector<FileClaim> claims_;  ///< on the files of all drivers
    std::optional<LiveView> viewer_;
    std::unique_ptr<const Guide> guide_;                        ///< null: none
    const Guide* guide_in_use_ = nullptr;                       ///< null: no ray is guided
    std::uint64_t samples_learned_ = 0, samples_to_learn_ = 0;  ///< of the guide's training
    std::mutex output_mutex_, progress_mutex_, workers_mutex_;
    std::atomic<std::uint64_t> samples_resumed_ = 0;
    std::atomic<std::uint64_t> samples_done_ = 0;
    std::vector<std::unique_ptr<Worker>> workers_, idle_;
    std::atomic<std::uint64_t> samples_total_ = 0;  ///< at most
    /// Sums over the pixels of each bucket, by layer: added up in order when all are done.
    struct NoiseSum {
        double mean = 0, square = 0, variance = 0;
        std::uint64_t n = 0;
    };
    std::vector<std::vector<NoiseSum>> noise_;
    /// What progress tells of noise: the layer that adaptive sampling goes by, or the first one of light.
    std::optional<std::size_t> watched_layer_;
    std::mutex watched_mutex_;
    NoiseSum watched_;
    Clock::time_point start_;
};

/// Says which camera sees each layer where there are several: the layers look alike otherwise.
void name_cameras(const AovPlan& plan, const PlannedDriver& driver, ImageHeader& header) {
    for (const std::uint32_t layer : driver.layers) {
        const NodeInstance* camera = plan.passes[plan.layers[layer].pass].camera_node;
        const bool one_of_several =
            camera != nullptr &&
            std::any_of(plan.passes.begin(), plan.passes.end(),
                        [&](const Pass& p) { return p.camera_node != camera; });
        if (one_of_several)
            header.metadata["arnold/aovs/" + plan.layers[layer].info.name + "/camera"] =
                camera->name().str();
    }
}

ImageHeader Renderer::header_of(const PlannedDriver& driver, std::size_t index) const {
    const RenderSettings& s = scene_.settings;
    ImageHeader h = frame_header(scene_, driver);
    name_cameras(scene_.plan, driver, h);
    h.metadata["lightsieve/version"] = std::string(kVersion);
    h.metadata["lightsieve/samples_per_pixel"] = s.samples;
    if (s.samples_max > s.samples) h.metadata["lightsieve/samples_per_pixel_max"] = s.samples_max;
    h.metadata["lightsieve/seed"] = static_cast<int>(s.seed);
    h.metadata["lightsieve/warnings"] = static_cast<int>(diagnostics_.n_warnings());
    h.metadata["lightsieve/errors"] = static_cast<int>(diagnostics_.n_errors());
    h.metadata["arnold/GI_diffuse_depth"] = int{s.depth.diffuse};
    h.metadata["arnold/GI_specular_depth"] = int{s.depth.specular};
    h.metadata["arnold/GI_transmission_depth"] = int{s.depth.transmission};
    h.metadata["arnold/GI_total_depth"] = int{s.depth.total};
    std::string partitions;
    for (const std::string& proved : proved_partitions(scene_.plan, index, scene_.events))
        partitions += (partitions.empty() ? "" : "\n") + proved;
    if (!partitions.empty()) h.metadata["lightsieve/partitions"] = partitions;
    describe_mattes(scene_.plan, driver, h);
    return h;
}

/// Throws (file-in-use) if another render is writing one of the files.
void Renderer::claim_files() {
    for (const PlannedDriver& planned : scene_.plan.drivers)
        claims_.emplace_back(planned.driver->path());
}

void Renderer::open_drivers() {
    if (!write_files_) return;
    claim_files();
    bool all = true;
    for (std::size_t i = 0; i < scene_.plan.drivers.size(); ++i) {
        const PlannedDriver& planned = scene_.plan.drivers[i];
        all &= planned.driver->open(header_of(planned, i), diagnostics_);
    }
    if (!all) diagnostics_.throw_if_errors();
}

void Renderer::open_viewer() {
    const ViewerSettings& settings = scene_.settings.viewer;
    if (settings.address.empty()) return;
    std::vector<ImageLayer> layers;
    for (const std::size_t layer : settings.layers)
        layers.push_back(scene_.plan.layers[layer].info);
    const std::string file =
        scene_.plan.drivers.empty() ? "" : scene_.plan.drivers.front().driver->path();
    viewer_.emplace(settings.address, std::filesystem::path(file).filename().string(),
                    scene_.settings.region, std::move(layers), scene_.color_spaces->rendering(),
                    diagnostics_);
}

/// Hours may have passed since the files were opened: a folder that somebody removed meanwhile is made again.
void Renderer::restore_folders() {
    if (!write_files_) return;
    for (const PlannedDriver& planned : scene_.plan.drivers) {
        const std::filesystem::path folder =
            std::filesystem::absolute(planned.driver->path()).parent_path();
        std::error_code failed;
        if (std::filesystem::exists(folder, failed)) continue;
        if (std::filesystem::create_directories(folder, failed))
            diagnostics_.warning(Code::FileUnwritable,
                                 "the folder \"" + folder.string() +
                                     "\" was removed while rendering; it was made again",
                                 {}, "everything that was rendered is in it");
    }
}

Worker& Renderer::worker() {
    const std::lock_guard lock(workers_mutex_);
    if (idle_.empty()) {
        idle_.push_back(std::make_unique<Worker>(scene_));
        idle_.back()->integrator.set_guide(guide_in_use_);
    }
    workers_.push_back(std::move(idle_.back()));
    idle_.pop_back();
    return *workers_.back();
}

/// Takes the memory for layers that are kept. Throws if there is not enough: taking it would end the program.
void Renderer::make_room() {
    const std::size_t n_pixels =
        static_cast<std::size_t>(result_.width) * static_cast<std::size_t>(result_.height);
    std::size_t n_bytes = 0;
    for (const PlannedLayer& layer : scene_.plan.layers)
        n_bytes += n_pixels * layer.info.n_channels * sizeof(float);
    if (n_bytes > available_memory())
        throw InputError({Code::LimitMemory,
                          "the layers need " + std::to_string(n_bytes >> 20U) +
                              " MiB of memory, more than there is",
                          {},
                          "render fewer layers or a region, or into files"});
    for (const PlannedLayer& layer : scene_.plan.layers)
        result_.layers.push_back(
            {layer.info, std::vector<float>(n_pixels * layer.info.n_channels)});
}

RenderResult Renderer::run() {
    for (const Pass& pass : scene_.plan.passes)
        if (!pass.camera)
            throw InputError(
                {Code::CameraMissing,
                 "the scene has no camera",
                 {},
                 "add options and a persp_camera, or render the scene that includes this file"});
    open_drivers();
    const RenderSettings& s = scene_.settings;
    result_.width = s.region.x1 - s.region.x0 + 1;
    result_.height = s.region.y1 - s.region.y0 + 1;
    if (capture_) make_room();
    open_viewer();
    for (const Pass& pass : scene_.plan.passes)
        samples_total_ += static_cast<std::uint64_t>(result_.width) *
                          static_cast<std::uint64_t>(result_.height) *
                          static_cast<std::uint64_t>(most_samples(pass));
    const std::vector<BucketRect> buckets = buckets_of(s);
    noise_.assign(buckets.size(), std::vector<NoiseSum>(scene_.plan.layers.size()));
    find_watched_layer();
    start_ = Clock::now();
    learn_guide();
    parallel_for(buckets.size(), s.threads, [&](std::size_t i) {
        if (stopped()) return;
        Worker& mine = worker();
        render_bucket(mine, i, buckets[i]);
        const std::lock_guard lock(workers_mutex_);
        const auto at = std::find_if(workers_.begin(), workers_.end(),
                                     [&](const auto& w) { return w.get() == &mine; });
        idle_.push_back(std::move(*at));
        workers_.erase(at);
    });
    result_.stopped = stopped();
    result_.samples = samples_done_;
    result_.seconds = seconds_since(start_) - result_.output_seconds;
    restore_folders();
    close_drivers();
    close_checkpoint();
    if (viewer_) viewer_->finish();
    report();
    return std::move(result_);
}

/// Samples of the training count as progress.
void Renderer::learn_guide() {
    samples_to_learn_ = training_samples(scene_);
    GuideTraining training = train_guide(
        scene_,
        [this](std::uint64_t n) {
            samples_learned_ += n;
            samples_to_learn_ = std::max(samples_to_learn_, samples_learned_);
            tell_progress();
        },
        control_.stop);
    samples_to_learn_ = samples_learned_;
    guide_ = std::move(training.guide);
    result_.training_samples = training.n_samples;
    for (std::size_t i = 0; i < training.rays.size(); ++i)
        result_.rays_by_kind[i] += training.rays[i];
    if (guide_ && guide_->guides()) guide_in_use_ = guide_.get();
    if (scene_.settings.guiding && guide_in_use_ == nullptr && !stopped())
        diagnostics_.warning(
            Code::GuidingUseless,
            "guiding has learned nothing that makes the picture quieter: no ray is guided", {},
            "render without it, or with more samples: it learns from an eighth of them");
}

/// Renders a bucket, or what there is time for: pixels are divided by the filter weight that they got, so a bucket that was
/// stopped holds the right means of fewer samples, and zero where there are none.
void Renderer::render_bucket(Worker& worker, std::size_t index, const BucketRect& rect) {
    worker.layers.resize(scene_.plan.layers.size());
    worker.deep.resize(scene_.plan.drivers.size());
    for (std::size_t p = 0; p < scene_.plan.passes.size(); ++p) {
        render_pass(worker, index, p, rect);
        for (std::size_t l = 0; l < scene_.plan.layers.size(); ++l)
            if (scene_.plan.layers[l].pass == p) {
                worker.film.resolve(scene_.plan.layers[l], worker.layers[l]);
                measure_noise(worker, index, l);
            }
        for (std::uint32_t d = 0; d < scene_.plan.drivers.size(); ++d)
            if (is_deep_of_pass(scene_.plan.drivers[d], p))
                worker.deep[d] = worker.film.resolve_deep(d);
    }
    if (viewer_) {
        std::vector<std::span<const float>> shown;
        for (const std::size_t layer : scene_.settings.viewer.layers)
            shown.emplace_back(worker.layers[layer]);
        viewer_->show(rect.x, rect.y, rect.width, rect.height, shown);
    }
    deliver(worker, rect);
    report_progress(worker);
}

/// Samples that pixels of a pass may take. Where no layer is a mean nobody can tell noise, and the least are enough.
int Renderer::most_samples(const Pass& pass) const {
    const RenderSettings& s = scene_.settings;
    const PixelFilter& filter = *scene_.plan.views[pass.sampling_view].filter;
    return filter.reduction() == Reduction::Mean ? s.samples_max : s.samples;
}

void Renderer::resume(Worker& worker, std::size_t bucket, std::size_t pass, const BucketRect& rect,
                      SampleSchedule& schedule) {
    const std::optional<std::vector<std::byte>> state =
        checkpoint_.load(static_cast<std::uint32_t>(bucket), static_cast<std::uint32_t>(pass));
    if (!state) return;
    const SampleSchedule fresh = schedule;
    ByteReader in(*state);
    std::uint64_t n = 0, not_taken = 0;
    const int most = most_samples(scene_.plan.passes[pass]);
    bool fits = schedule.load(in) && worker.film.load(in) && in.done();
    for (int y = 0; fits && y < rect.height; ++y)
        for (int x = 0; fits && x < rect.width; ++x) {
            fits = worker.film.count(x, y) <= most;
            n += static_cast<std::uint64_t>(worker.film.count(x, y));
            if (!schedule.goes_on(x, y))
                not_taken += static_cast<std::uint64_t>(most - worker.film.count(x, y));
        }
    if (!fits) {
        worker.film.begin(scene_.plan.passes[pass], rect.width, rect.height);
        schedule = fresh;
        return;
    }
    samples_resumed_ += n;
    samples_total_ -= n + not_taken;
}

void Renderer::save(Worker& worker, std::size_t bucket, std::size_t pass,
                    const SampleSchedule& schedule) {
    if (!checkpoint_.active()) return;
    ByteWriter out;
    schedule.save(out);
    worker.film.save(out);
    checkpoint_.save(static_cast<std::uint32_t>(bucket), static_cast<std::uint32_t>(pass),
                     out.take());
    worker.saved = Checkpoint::Clock::now();
}

void Renderer::render_pass(Worker& worker, std::size_t bucket, std::size_t index,
                           const BucketRect& rect) {
    const Pass& pass = scene_.plan.passes[index];
    const CameraSampler camera(scene_, pass);
    worker.film.begin(pass, rect.width, rect.height);
    const RenderSettings& s = scene_.settings;
    const PlannedLayer* noisy =
        scene_.plan.adaptive_layer ? &scene_.plan.layers[*scene_.plan.adaptive_layer] : nullptr;
    if (noisy != nullptr && &scene_.plan.passes[noisy->pass] != &pass) noisy = nullptr;
    const int most = most_samples(pass);
    SampleSchedule schedule(rect.width, rect.height, s.samples, most,
                            double{s.adaptive_threshold});
    resume(worker, bucket, index, rect, schedule);
    worker.saved = Checkpoint::Clock::now();
    while (!schedule.finished()) {
        for (int y = 0; y < rect.height; ++y)
            for (int x = 0; x < rect.width; ++x)
                if (schedule.goes_on(x, y) && !take_samples(worker, camera, rect, x, y, schedule))
                    return save(worker, bucket, index, schedule);
        if (schedule.decides()) worker.film.estimate_noise(noisy, 1, worker.noise);
        schedule.next_round(worker.noise);
        samples_total_ -= static_cast<std::uint64_t>(schedule.n_stopped()) *
                          static_cast<std::uint64_t>(most - schedule.done());
        if (!schedule.finished() && checkpoint_.due(worker.saved))
            save(worker, bucket, index, schedule);
    }
    save(worker, bucket, index, schedule);
}

/// Takes the samples of a pixel for this round. False if the render was stopped.
bool Renderer::take_samples(Worker& worker, const CameraSampler& camera, const BucketRect& rect,
                            int x, int y, const SampleSchedule& schedule) {
    // A resumed pixel may be ahead of its bucket.
    for (int i = std::max(schedule.done(), worker.film.count(x, y)); i < schedule.target(); ++i) {
        if (stopped()) return false;
        const std::uint64_t dropped_before = worker.integrator.counts.dropped;
        const CameraSample sample =
            camera.sample(rect.x + x, rect.y + y, static_cast<std::uint32_t>(i));
        worker.integrator.state = sample.state;
        worker.integrator.trace(sample.ray, sample.time, sample.camera_from_world, sample.sampler,
                                worker.sample);
        if (worker.integrator.counts.dropped != dropped_before)
            note_dropped(worker, rect.x + x, rect.y + y, i);
        if (scene_.plan.wants_motion && worker.sample.first.hit)
            worker.sample.first.motion = screen_motion(
                camera.camera(), sample, worker.sample.first.at_shutter, scene_.settings);
        remove_exposure(sample, worker.sample.probes);
        camera.weights(sample, worker.weights);
        worker.film.add(x, y, worker.sample, sample_clamp_factor(scene_, worker.sample.beauty),
                        sample.offset, worker.weights, schedule.in_half(i));
        if (++worker.n_unreported == kSamplesAReport) report_progress(worker);
    }
    return true;
}

void Renderer::report_progress(Worker& worker) {
    samples_done_ += std::exchange(worker.n_unreported, 0);
    tell_progress();
}

void Renderer::tell_progress() {
    if (!control_.progress) return;
    const std::lock_guard lock(progress_mutex_);
    control_.progress({samples_done_ + samples_learned_, samples_total_ + samples_to_learn_,
                       seconds_since(start_), noise_so_far()});
}

/// Halves of the samples tell the noise of means of light.
bool Renderer::has_noise(const PlannedLayer& layer) const {
    return is_light(layer.source) &&
           scene_.plan.views[layer.view].filter->reduction() == Reduction::Mean;
}

void Renderer::find_watched_layer() {
    watched_layer_ = scene_.plan.adaptive_layer;
    for (std::size_t l = 0; l < scene_.plan.layers.size() && !watched_layer_; ++l)
        if (has_noise(scene_.plan.layers[l])) watched_layer_ = l;
}

/// Of the layer that people watch, over the buckets that are done.
double Renderer::noise_so_far() {
    const std::lock_guard lock(watched_mutex_);
    return watched_.n > 0 && watched_.square > 0 ? std::sqrt(watched_.variance / watched_.square)
                                                 : -1;
}

/// Notes how noisy a layer of light is in a bucket.
void Renderer::measure_noise(Worker& worker, std::size_t bucket, std::size_t layer) {
    const PlannedLayer& planned = scene_.plan.layers[layer];
    if (!has_noise(planned)) return;
    worker.film.estimate_noise(&planned, kNoiseStep, worker.noise);
    NoiseSum& sum = noise_[bucket][layer];
    for (const PixelNoise& p : worker.noise) {
        if (!std::isfinite(p.variance)) continue;
        sum.mean += p.mean;
        sum.square += p.mean * p.mean;
        sum.variance += p.variance;
        ++sum.n;
    }
    if (layer != watched_layer_) return;
    const std::lock_guard lock(watched_mutex_);
    watched_.square += sum.square;
    watched_.variance += sum.variance;
    watched_.n += sum.n;
}

void Renderer::report_noise() {
    for (std::size_t l = 0; l < scene_.plan.layers.size(); ++l) {
        NoiseSum all;
        for (const std::vector<NoiseSum>& bucket : noise_) {
            all.mean += bucket[l].mean;
            all.square += bucket[l].square;
            all.variance += bucket[l].variance;
            all.n += bucket[l].n;
        }
        if (all.n == 0) continue;
        const auto n = static_cast<double>(all.n);
        result_.noise.push_back({scene_.plan.layers[l].info.name, all.mean / n,
                                 std::sqrt(all.square / n), std::sqrt(all.variance / n)});
    }
}

void Renderer::note_dropped(Worker& worker, int x, int y, int index) {
    const TraceCounts& counts = worker.integrator.counts;
    if (worker.dropped.size() < kDescribedDrops)
        worker.dropped.push_back({y, x, index, counts.dropped_depth, counts.dropped_event});
}

/// Hands a bucket to drivers and memory, one bucket at a time.
void Renderer::deliver(Worker& worker, const BucketRect& rect) {
    const std::lock_guard lock(output_mutex_);
    const Clock::time_point start = Clock::now();
    if (write_files_)
        for (std::size_t d = 0; d < scene_.plan.drivers.size(); ++d) {
            const PlannedDriver& planned = scene_.plan.drivers[d];
            if (planned.driver->deep()) {
                DeepBucket& deep = worker.deep[d];
                deep.x = rect.x;
                deep.y = rect.y;
                deep.width = rect.width;
                deep.height = rect.height;
                planned.driver->write_deep(deep);
                continue;
            }
            Bucket bucket{rect.x, rect.y, rect.width, rect.height, {}};
            for (const std::uint32_t layer : planned.layers)
                bucket.layers.emplace_back(worker.layers[layer]);
            planned.driver->write(bucket);
        }
    for (std::size_t l = 0; l < result_.layers.size(); ++l) {
        const std::size_t channels = result_.layers[l].info.n_channels,
                          row = static_cast<std::size_t>(rect.width) * channels;
        for (int y = 0; y < rect.height; ++y) {
            const std::size_t from = static_cast<std::size_t>(y) * row;
            const std::size_t to =
                (static_cast<std::size_t>(rect.y + y - scene_.settings.region.y0) *
                     static_cast<std::size_t>(result_.width) +
                 static_cast<std::size_t>(rect.x - scene_.settings.region.x0)) *
                channels;
            std::copy_n(worker.layers[l].begin() + static_cast<std::ptrdiff_t>(from), row,
                        result_.layers[l].pixels.begin() + static_cast<std::ptrdiff_t>(to));
        }
    }
    result_.output_seconds += seconds_since(start);
}

void Renderer::close_drivers() {
    if (!write_files_) return;
    const Clock::time_point start = Clock::now();
    for (const PlannedDriver& planned : scene_.plan.drivers)
        if (planned.driver->close(diagnostics_) &&
            write_sidecars(scene_.plan, planned, diagnostics_))
            result_.files.push_back(planned.driver->path());
    result_.output_seconds += seconds_since(start);
}

void Renderer::close_checkpoint() {
    result_.resumed_samples = samples_resumed_;
    if (result_.stopped) {
        checkpoint_.flush();
    } else {
        checkpoint_.finish();
    }
    const CheckpointSettings& settings = scene_.settings.checkpoint;
    if (!checkpoint_.problem().empty())
        diagnostics_.warning(Code::FileUnwritable, checkpoint_.problem(), {},
                             "what it had before is still good for --resume");
    else if (checkpoint_.active() && (result_.stopped || settings.keep))
        result_.checkpoint = settings.path;
}

void Renderer::report_dropped() {
    std::vector<DroppedSample> all;
    for (const auto& w : idle_)
        all.insert(all.end(), w->dropped.begin(), w->dropped.end());
    std::sort(all.begin(), all.end());
    if (all.size() > kDescribedDrops) all.resize(kDescribedDrops);
    Error warning{Code::RenderNonFinite,
                  std::to_string(result_.dropped_samples) +
                      " contributions were infinite or not a number and were left out",
                  {},
                  "look for lights, textures or parameters of extreme size",
                  {},
                  Severity::Warning};
    for (const DroppedSample& d : all) {
        std::string what = d.event == TraceCounts::kNoEvent
                               ? "while scattering"
                               : "arriving as " + lpe::print_event(scene_.events[d.event]);
        warning.notes.push_back({"pixel " + std::to_string(d.x) + "," + std::to_string(d.y) +
                                     " sample " + std::to_string(d.index) + ": " + what +
                                     " after " + std::to_string(d.depth) + " scattering events",
                                 {}});
    }
    diagnostics_.add(std::move(warning));
}

void Renderer::report_memory() {
    MemoryUse& use = result_.memory = memory_of(scene_);
    if (guide_) use.guide = guide_->memory();
    use.film = noise_.size() * scene_.plan.layers.size() * sizeof(NoiseSum);
    for (const auto& w : idle_)
        use.film += w->memory();
    for (const FrameLayer& layer : result_.layers)
        use.layers += layer.pixels.capacity() * sizeof(float);
    result_.peak_memory = peak_memory();
    use.other = result_.peak_memory - std::min(result_.peak_memory, use.total());
}

void Renderer::report() {
    std::uint64_t dropped_closures = 0;
    for (const auto& w : idle_) {
        const RaysByKind& rays = w->integrator.counts.rays;
        for (std::size_t i = 0; i < rays.size(); ++i)
            result_.rays_by_kind[i] += rays[i];
        result_.dropped_samples += w->integrator.counts.dropped;
        dropped_closures += w->integrator.counts.dropped_closures;
    }
    result_.rays = sum_of(result_.rays_by_kind);
    report_noise();
    report_memory();
    if (result_.dropped_samples > 0) report_dropped();
    if (dropped_closures > 0)
        diagnostics_.warning(
            Code::RenderNonFinite,
            std::to_string(dropped_closures) + " lobes did not fit at one hit and were left out",
            {},
            "materials of more than " + std::to_string(ClosureSet::kMaxClosures) +
                " lobes are not possible");
    scene_.textures->report_failures(diagnostics_);
}

}  // namespace

RenderResult render_scene(const Scene& scene, const RenderControl& control,
                          Diagnostics& diagnostics) {
    return Renderer(scene, control, diagnostics, scene.capture, scene.write_files).run();
}

}  // namespace lightsieve
