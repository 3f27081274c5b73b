// The path tracer: one camera sample to light in every AOV.
//
// A unidirectional path tracer with next event estimation, multiple importance sampling of lights and lobes, and a
// throughput that is split by lobe history (render/path_terms.h). `trace` reads top to bottom; the numbers of the sampler's
// dimensions are fixed by the segment, so that a sample never depends on what other paths did.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "bsdf/dispersion.h"
#include "core/sobol.h"
#include "render/film.h"
#include "render/gi_kind.h"
#include "render/guide_training.h"
#include "render/interiors.h"
#include "render/media_path.h"
#include "render/path_terms.h"
#include "render/scene.h"
#include "render/subsurface_walk.h"
#include "render/surface.h"
#include "render/trackers.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// Counts of one thread; added up at the end.
struct TraceCounts {
    RaysByKind rays{};          ///< closest-hit and shadow rays
    std::uint64_t dropped = 0;  ///< contributions that were not finite
    std::uint32_t dropped_event =
        kNoEvent;  ///< the last one's terminal, into Scene::events; kNoEvent: dropped while scattering
    int dropped_depth = 0;  ///< scattering events before it
    static constexpr std::uint32_t kNoEvent = UINT32_MAX;
    std::uint64_t dropped_closures = 0;  ///< closures that did not fit into a ClosureSet

    [[nodiscard]] std::uint64_t& rays_of(RayKind kind) {
        return rays[static_cast<std::size_t>(kind)];
    }
};

template <class Tracker>
class Integrator {
  public:
    explicit Integrator(const Scene& scene)
        : scene_(scene),
          culling_(scene.culling),
          tracker_(scene),
          depth_steps_(scene.depth_rules) {}

    /// Sends part of the rays of broad lobes where the guide says. It must outlive all paths; null: no rays.
    void set_guide(const Guide* guide) { guide_ = guide; }
    /// Paths are traced to learn from, with what `guide` knows so far: all light counts, whatever outputs want of it.
    void train(const Guide& guide, GuideRecorder& recorder)
        requires std::is_same_v<Tracker, AovTracker>
    {
        guide_ = &guide;
        recorder_ = &recorder;
        culling_ = Culling::None;
        tracker_.follow_nothing();
    }

    /// Traces one camera sample; everything that it brings is added to `out`.
    void trace(const CameraRay& camera_ray, float time, const Mat4f& camera_from_world,
               const Sampler& sampler, SampleBuffer& out);

    TraceCounts counts;
    /// What shaders see of the sample: its pixel and place in it, set before `trace`.
    RayState state;
    [[nodiscard]] Tracker& tracker() { return tracker_; }

  private:
    /// Which lights a vertex asks.
    enum class LightPlan : std::uint8_t {
        Pick,           ///< one, chosen by what it may bring
        Once,           ///< each, once
        Often,          ///< each, as often as its `samples` say
        OftenInVolume,  ///< each, as often as its `volume_samples` say
    };
    /// The vertex that the current ray left: what MIS must know when the ray meets a light.
    struct LastVertex {
        Vec3f position;
        Vec3f pick_normal;  ///< as given to the light sampler
        Vec3f facing;       ///< as given to lights, see Light::sample_facing
        const LightSampler* lights = nullptr;
        LightPlan plan = LightPlan::Pick;  ///< which lights were asked there
        float pdf = 0;      ///< of the direction, all lobes and rays together, per solid angle
        bool delta = true;  ///< the direction could not have come from a light sample
        bool samples_only =
            false;  ///< shadows on the surface are tampered with: rays find no lights
        std::uint32_t next_segment = 0;  ///< of the path: the first one after the vertex
    };
    /// What surfaces between a point and a light let through.
    struct Visibility {
        Color straight;  ///< by opacity: rays that meet the light by chance see the same
        Color
            tinted;  ///< with what transmissive surfaces let through to diffuse light besides; never less than `straight`
    };
    /// Shadow rays end this much (relative) before a light, so that they do not meet its own shape.
    static constexpr float kShadowEpsilon = 1e-5F;
    /// Segments of a path, transparent surfaces included: a guard against geometry that rays cannot leave.
    static constexpr std::uint32_t kMaxSegments = 1024;
    /// The sampler's pairs of dimensions before the path's own, and of each segment of the path.
    static constexpr std::uint32_t kFirstPair = 4, kPairsPerSegment = 4;
    /// A segment's points.
    struct SegmentPoints {
        Vec2f choice;     ///< x: lobe, y: light
        Vec2f direction;  ///< direction of the lobe
        Vec2f light;      ///< point on the light
        Vec2f roulette;   ///< x: roulette, y: choice within a lobe
    };

    /// How a part of a ray ends.
    enum class Passage : std::uint8_t {
        Free,       ///< it goes on
        Scattered,  ///< in a medium, at medium_vertex_
        Ended       ///< absorbed, or hidden by a light
    };

    void trace_path(const CameraRay& camera_ray, float time, const Mat4f& camera_from_world,
                    const Sampler& sampler, SampleBuffer& out);
    // Steps of `trace`, in order.
    void follow(Ray ray, const Mat4f& camera_from_world);
    void open_slot(Vec3f position);
    void choose_mask_group();
    void update_state();
    [[nodiscard]] std::uint32_t ray_mask() const;
    void begin_media(const Ray& ray, float t_end);
    /// Through media and past area lights up to the next surface.
    [[nodiscard]] Passage pass(const Ray& ray, float t_surface);
    [[nodiscard]] Passage add_area_lights(const Ray& ray, float t_surface);
    [[nodiscard]] bool misses_area_lights(const Ray& ray) const;
    void add_infinite_end(const Ray& ray);
    void add_escape(const Ray& ray);
    float add_infinite_lights(const Ray& ray);
    void add_exit_background(const Ray& ray);
    [[nodiscard]] ShaderValue background_along(const Ray& ray, bool behind_picture) const;
    /// What shaders must know of the path.
    void tell_path(ShadePoint& at, const Interiors& inside, const ShaderProgram* shader) const;
    void go_straight(const Surface& surface, Ray& ray) const;
    /// What comes of a surface that the ray met.
    enum class Arrival : std::uint8_t {
        There,   ///< closures_ say what it does
        Passed,  ///< the ray goes on behind it
        Ended
    };
    /// Runs the shader of a surface: emission, data of the first hit.
    [[nodiscard]] Arrival arrive(Surface& surface, Ray& ray, const Mat4f& camera_from_world);
    void absorb(const Surface& surface);
    [[nodiscard]] bool is_hidden(const Surface& surface, const Interior& own,
                                 const Interiors& inside) const;
    /// A body's surface inside of a body that wins: the ray goes on as if there were nothing. False if the surface is there.
    bool pass_hidden_surface(const Surface& surface, Ray& ray);
    void note_first_hit(const Surface& surface, const Mat4f& camera_from_world);
    void add_shadow_matte(const Surface& surface, const Ray& ray);
    [[nodiscard]] ShadowShown shadow_on(const Surface& surface, const ShadowMatte& matte);
    [[nodiscard]] bool find_behind(const Surface& front, Surface& out);
    void add_emission(float factor = 1);
    void start_writing();
    void write_aovs(const ShadePoint& at);
    void run_aov_shaders(const ShadePoint& at);
    void note_mattes(float weight);
    void gather_channels(const Surface& surface);
    void add_probes();
    [[nodiscard]] Color reach(const Channel& channel) const;
    void choose_probabilities();
    void add_light_samples(const Surface& surface);
    /// Goes on straight or by a scatterer, whichever is drawn; false if the path ends.
    bool go_on(const Surface& surface, Ray& ray);
    void pass_straight(const Surface& surface, Ray& ray, float probability);
    /// Draws the next direction among the scatterers, or those of a kind; false if the path ends.
    bool scatter(const Surface& surface, std::size_t drawn, Ray& ray);
    bool survives_roulette();
    [[nodiscard]] bool is_worth_a_ray() const;
    /// The same through a subsurface closure: a walk, light at its end, a direction from there.
    bool scatter_below(const Surface& surface, std::size_t drawn, Ray& ray);

    // Splitting (integrator_fan.cpp).
    /// Which lights the vertex asks: all of them where paths split, if there are few.
    [[nodiscard]] LightPlan light_plan(const LightSampler& lights, bool in_medium) const;
    /// How many samples of a light a vertex takes, on average.
    [[nodiscard]] float light_samples(LightPlan plan, const LightSampler& lights, Vec3f position,
                                      Vec3f normal, std::uint32_t light) const;
    void ask_lights(const Surface& surface, LightPlan plan);
    /// Which way a surface faces for lights all around. Zero where no rays find what their samples leave to them: light
    /// that lobes with normals of their own, or that see both sides, get from behind.
    [[nodiscard]] Vec3f facing(const Surface& surface) const {
        const bool both_sides = transmissive_ || surface.object->tampers_with_shadows();
        return both_sides ? Vec3f{} : surface.at.normal;
    }
    /// How many rays go on by each kind of scattering.
    struct RayCounts {
        std::array<float, kGiKinds> rays{};  ///< that a kind's rays stand for: below 1 by chance
        std::array<std::uint32_t, kGiKinds> n{};  ///< that there are
        std::uint32_t total = 0;                  ///< of n
        std::size_t last = 0;                     ///< kind that has some
        float left = 0;  ///< if it is one ray: a number in [0, rays[last])
        /// From averages to numbers; u in [0,1).
        void round(float u);
    };
    /// The scatterers of a kind together.
    struct KindSum {
        float probability = 0;
        Color carries;  ///< throughput times albedo; black if there is one scatterer only
        const Channel* channel = nullptr;  ///< of one of them
        bool goes_on = false;              ///< its rays may find something
    };
    [[nodiscard]] std::array<KindSum, kGiKinds> sort_by_kind();
    [[nodiscard]] RayCounts choose_ray_counts();
    [[nodiscard]] bool leads_nowhere(const Channel& channel) const;
    [[nodiscard]] float volume_rays(const Channel& channel) const;
    [[nodiscard]] float carried() const;
    [[nodiscard]] float rays_of(GiKind kind, const Channel& channel, float share,
                                float largest_share) const;
    /// As `go_on`, where the path splits: puts one aside for each ray that leaves the surface.
    bool fan_out(const Surface& surface, Ray& ray);
    void split(const Surface& surface, const Ray& ray, const RayCounts& counted);
    void put_aside(const Ray& ray);
    /// GI_*_samples 0 switches a kind of scattering off.
    [[nodiscard]] bool is_enabled(const Channel& channel) const {
        return scene_.settings.gi_samples.of(gi_kind(*channel.record, false)) > 0;
    }
    [[nodiscard]] bool is_enabled(std::size_t scatterer) const {
        return mixture_[channel_of_[scatterer]] != kNoRays;
    }
    void separate_kinds();

    // Media (integrator_media.cpp).
    /// Whether there is anything but surfaces on the ray's way.
    [[nodiscard]] bool through_media() const {
        return !scene_.volumes.empty() || scene_.atmosphere != nullptr || !path_.interiors.empty();
    }
    /// Through media from where the ray has come to up to `to`.
    [[nodiscard]] Passage travel(const Ray& ray, float to) {
        if (!media_.active() && scene_.atmosphere == nullptr) return Passage::Free;
        return travel_through_media(ray, to);
    }
    [[nodiscard]] Passage travel_through_media(const Ray& ray, float to);
    [[nodiscard]] Passage collide(const Ray& ray, const Collision& collision);
    void make_vertex(const Ray& ray, const Collision& collision);
    void add_media_opacity(const Ray& ray, float to);
    [[nodiscard]] Vec3f somewhere_in_media(const Ray& ray, float to);
    [[nodiscard]] Color media_transmittance(const Ray& ray);

    // Light along parts of rays (integrator_along.cpp).
    /// A part of a ray in a medium that is the same everywhere.
    struct AlongRay {
        Medium medium;
        float start = 0;                      ///< to where the path's throughput is known
        float begin = 0, end = 0;             ///< of the part
        float collisions = 0;                 ///< bound by which they are drawn; 0: there are none
        const SceneObject* object = nullptr;  ///< the volume; null: the atmosphere
    };
    void add_haze(const Ray& ray, float to);
    void add_glow(float to);
    void fade_in_haze(float from, float to);
    void add_fog(const Ray& ray, float to);
    void add_light_along(const Ray& ray, const AlongRay& part, Vec2f u, Vec2f on_light, int n);
    [[nodiscard]] AlongRay along(const VolumeInterval& interval, float to);
    [[nodiscard]] float share_of_collisions(const Ray& ray, const AlongRay& part, float t,
                                            std::uint32_t light, float asked) const;

    // Guided rays (integrator_guide.cpp).
    /// Finds out which closures are guided here, and what is known here.
    void find_guide(const Surface& surface);
    [[nodiscard]] bool is_guided(std::size_t closure) const {
        return ((guided_ >> closure) & 1U) != 0;
    }
    /// Density of guided rays in a direction; 0 where no closure is guided.
    [[nodiscard]] float guide_pdf(Vec3f wi) const {
        return guided_share_ > 0 ? directions_->pdf(wi) : 0;
    }
    /// Density of a closure's rays, of which part may be guided.
    [[nodiscard]] float blended_pdf(std::size_t closure, float pdf, float guide_pdf) const {
        return is_guided(closure) ? lerp(pdf, guide_pdf, guided_share_) : pdf;
    }
    /// A direction for the closure, from the guide or from the closure itself. Nothing if there is none.
    [[nodiscard]] std::optional<LobeSample> sample(std::size_t drawn) const;
    /// Notes for training that the path goes on.
    void record(std::size_t drawn, Vec3f wi, std::span<const Color> factors, float carried);

    // Parts of them.
    [[nodiscard]] std::size_t n_scatterers() const {
        return closures_.closures().size() + closures_.subsurfaces().size();
    }
    /// Weighted albedo of a scatterer.
    [[nodiscard]] Color albedo_of(std::size_t scatterer) const;
    /// The scatterer that the number chooses among all, or among those of a kind; or nothing.
    ///
    /// u  below the sum of their probabilities
    [[nodiscard]] std::optional<std::size_t> draw(float u, std::optional<GiKind> kind = {}) const;
    /// Asks one light.
    ///
    /// samples  how many this vertex takes of it, on average
    /// coin     for samples of little effect
    void ask_light(const Surface& surface, std::uint32_t light, float samples, Vec2f u,
                   float coin);
    /// Moves all shares on through the channels; false if the path ends. factors[c] = f_c / density
    bool advance(std::span<const Color> factors, std::size_t drawn);
    void see_past(std::span<const Color> factors);
    void add_light_at_exit(const WalkExit& exit);
    void drop(std::uint32_t event);
    template <class Value>
    void deposit(Terminal terminal, const Value& value);
    void add_met_light(std::uint32_t index, const LightEval& eval, Terminal terminal,
                       const Ray& ray, float distance);
    [[nodiscard]] bool by_shadow_rays() const;
    template <class Value>
    void deposit_scattered(Terminal terminal, const Value& value);
    /// The same for light of a light: its event depends on whether anything but surfaces that make no event came before.
    template <class Value>
    void deposit_scattered_light(const SceneLight& light, const Value& value);
    /// How much light gets from the light to the surface.
    [[nodiscard]] Visibility visibility(const Surface& surface, std::uint32_t light,
                                        const LightSample& sample);
    /// ignore  a shape that casts no shadow here, or null
    /// light   whose shadows they are: shapes may cast them in some lights only
    [[nodiscard]] Visibility visibility_along(Ray ray, const SceneObject* ignore,
                                              std::uint32_t light);
    /// weights  of the light sample, by channel
    [[nodiscard]] float low_light_survival(std::span<const Color> by_channel,
                                           std::span<const float> weights, Color incident) const;
    /// Scatterers of one mixture share their rays: each ray carries what all of them scatter into its direction. Where the
    /// path splits there is one for each kind of rays, elsewhere one for all. The last is of those that send no rays.
    static constexpr std::uint8_t kNoRays = kGiKinds;
    /// Density of the rays of each mixture in a direction, per solid angle.
    using Densities = std::array<float, kGiKinds + 1>;
    /// Adds up values by channel and densities for a direction.
    [[nodiscard]] Densities evaluate(const Surface& surface, Vec3f wi,
                                     std::span<Color> by_channel) const;
    /// The same for the direction that closure `drawn` was sampled in, and its mixture alone.
    [[nodiscard]] float evaluate(const Surface& surface, std::size_t drawn,
                                 const LobeSample& sample, std::span<Color> by_channel) const;
    [[nodiscard]] float light_factor(const LightCommon& light, RayType type, int n_scatter) const;
    [[nodiscard]] float direct_light_factor(const LightCommon& light,
                                            const Channel& channel) const;
    [[nodiscard]] float clamp_factor(Color total, int n_scatter) const;
    [[nodiscard]] float random(std::uint32_t stream) const {
        return path_.sampler.random(hash_combine(path_.segment, stream));
    }
    /// Black for each channel of the vertex. One array for all: whoever asks next overwrites it.
    [[nodiscard]] std::span<Color> cleared_values() {
        std::fill_n(values_.begin(), n_channels_, kBlack);
        return {values_.data(), n_channels_};
    }
    [[nodiscard]] bool some_group_is_seen() const;
    /// Whether the camera sees what the ray meets: no event yet, and not nothing left.
    [[nodiscard]] bool seen() const { return !is_black(path_.passed); }
    /// Colour of the path's wavelength, if a direction at the current vertex makes the path take it; else white.
    [[nodiscard]] Color color_of_wavelength(const Surface& surface, Vec3f wi) const {
        const bool takes =
            closures_.disperses() && !path_.monochromatic && dot(wi, surface.outward) < 0;
        return takes ? wavelength_.weight : kWhite;
    }
    /// Whether anybody still asks for light, or for what the camera ray meets.
    [[nodiscard]] bool wanted() const {
        return culling_ == Culling::None || tracker_.live() ||
               (path_.n_scatter == 0 && (writes_aovs_ || !out_->first.hit));
    }

    /// Whether anybody asks for the light that the vertex gets from a light.
    [[nodiscard]] bool wanted_from(const SceneLight& light) const {
        const std::span<const Channel> channels(channels_.data(), n_channels_);
        return culling_ == Culling::None || tracker_.takes(channels, light.as_light) ||
               (light.is_skydome && tracker_.takes(channels, light.as_background));
    }
    /// What a path carries from one vertex to the next: all that is put aside where it splits.
    struct Path {
        Sampler sampler{0, 0, 0, 0};
        PathGroups groups;
        Interiors interiors;  ///< that the path is inside of
        LastVertex last;
        Footprint footprint;
        Color
            passed;  ///< what surfaces that the camera sees through have let through; black: it does not see the path's end
        Color
            start;  ///< throughput at the camera, which roulette compares with; the path's part of it where it split
        RayState state;  ///< what shaders see of it
        std::uint32_t segment = 0;
        std::uint32_t slot = 0;  ///< of the sample: where the path left what the camera sees
        std::uint32_t place = GuideRecorder::kNone;  ///< the last that training noted
        int n_scatter = 0;                           ///< scattering events so far
        int n_transparent = 0;                       ///< transparent surfaces passed
        float siblings = 1;          ///< paths that share what this one stands for, at least 1
        bool monochromatic = false;  ///< it has taken its wavelength
        bool exit_pending =
            false;  ///< the ray just left a surface past a depth limit with exit_to_background
        bool fans_out =
            true;  ///< it has come by perfect mirrors only: it splits at the next vertex
    };
    /// A path that waits for its turn.
    struct Fork {
        Path path;
        Ray ray;
        typename Tracker::Saved terms;
    };

    const Scene& scene_;
    Culling culling_;
    Tracker tracker_;
    const Guide* guide_ = nullptr;
    GuideRecorder* recorder_ = nullptr;  ///< null: no training
    Path path_;
    std::vector<Fork> forks_;  ///< the first n_forks_ wait; the others keep their memory for later
    std::size_t n_forks_ = 0;
    Fork before_;            ///< the path as it came to the vertex where it splits
    PathGroups::Step step_;  ///< of `advance`
    DepthSteps depth_steps_;
    ClosureSet closures_, shadow_closures_;
    std::vector<WrittenAov> written_;    ///< by shaders at the current hit
    std::vector<std::uint32_t> mattes_;  ///< ids that they write there
    SampleBuffer* out_ = nullptr;
    SegmentPoints points_;      ///< of this segment
    bool knows_first_ = false;  ///< what data layers show has been decided
    bool writes_aovs_ = false;  ///< shaders write AOVs and mattes at the current hit
    ShadowShown shadow_;        ///< of the current vertex, where it has a shadow_matte
    bool lights_only_ = false;  ///< no share of the path may meet anything but lights

    // Of the current vertex.
    std::array<Channel, kMaxChannels> channels_;
    std::size_t n_channels_ = 0;
    std::array<Color, kMaxChannels> carries_;  ///< what each of several scatterers may carry on
    std::array<Color, kMaxChannels> reach_;    ///< throughput that may use each channel
    std::array<Color, kMaxChannels> values_;   ///< see cleared_values
    /// What light brings through each channel to each group, group after group: see deposit_scattered.
    std::array<Color, PathGroups::kMaxGroups * kMaxChannels> shares_;
    /// By scatterer: the closures of the set, then its subsurface closures.
    std::array<std::uint8_t, kMaxChannels> channel_of_;
    /// How many rays each scatterer sends on, on average: where there is one ray, the probability of drawing it.
    std::array<float, kMaxChannels> probability_;
    std::array<GiKind, kMaxChannels> kind_of_;  ///< each scatterer's, where the path splits
    std::array<std::uint8_t, kMaxChannels>
        mixture_;                                ///< that the scatterers of each channel share
    std::uint32_t guided_ = 0;                   ///< closures, as bits
    std::uint32_t cell_ = 0;                     ///< of the guide, where any is guided
    const DirectionTree* directions_ = nullptr;  ///< null: nothing is known here
    float guided_share_ = 0;                     ///< of their rays
    Wavelength wavelength_;                      ///< that the path takes when it must
    MediaPath media_;                            ///< along the current ray
    float media_t_ = 0;                          ///< how far the ray has come through them
    /// Of the segment: 0 the first collision; 1 point along the ray and choice of light; 2 point on that light.
    std::array<Vec2f, 4> media_points_;
    /// The atmosphere along the current ray.
    struct Haze {
        Medium medium;
        float far = 0;        ///< where it ends for rays without end
        Color left = kWhite;  ///< of what the ray carries, after all haze so far
    };
    Haze haze_;
    std::uint32_t n_shadow_rays_ = 0;  ///< through media: each draws numbers of its own
    Surface medium_vertex_;            ///< where the path scattered in a medium
    /// The part of the ray where it did, if points along it were asked for light, too.
    std::optional<AlongRay> vertex_part_;
    Ray vertex_ray_;
    float pass_probability_ = 0;  ///< of going straight through
    bool transmissive_ = false;   ///< some lobe sends light to the other side
    bool all_delta_ = false;      ///< no light sample can get through any lobe
};

extern template class Integrator<AovTracker>;

}  // namespace lightsieve
