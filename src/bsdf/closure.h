// The closures at one hit: weighted lobes, emission and transparency, each with the event that it makes.
//
// Shaders fill a ClosureSet; the integrator samples the mixture and asks for each lobe's own value, because a
// direction drawn from the mixture belongs to every lobe (see docs/architecture.md, "From lobe to AOV, exactly").
// No allocation, no virtual calls: a lobe is a std::variant of small structs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "bsdf/lobe.h"
#include "bsdf/medium.h"
#include "bsdf/models.h"
#include "bsdf/subsurface.h"
#include "core/event.h"
#include "core/vec.h"

namespace lightsieve {

/// What the renderer needs to know of one lobe of a shader instance; made at compile, indexed by the lobe's index.
struct LobeRecord {
    std::uint32_t event_class = 0;  ///< scattering: the engine's class of the event
    std::uint32_t terminal = 0;     ///< emission: the engine's terminal
    std::uint32_t event = 0;        ///< position in the scene's list of events, for logs
    EventKind kind = EventKind::Reflection;
    EventLobe lobe = EventLobe::Diffuse;
    bool subsurface = false;  ///< TD that walks below the surface: counts as a subsurface ray
    bool exit_to_background =
        false;  ///< rays past their depth limit see the background instead of black
    /// transmit_aovs: the lobe makes no event; what is seen through it goes to AOVs, alpha and data as if it were seen past it.
    bool makes_no_event = false;
    std::uint8_t extra_depth = 0;  ///< bounces beyond GI_specular_depth and GI_transmission_depth
};

/// One weighted lobe.
struct Closure {
    LobeModel model;  ///< bsdf/models.h
    Color weight;     ///< multiplies eval, sample and albedo
    const LobeRecord* record = nullptr;
    std::uint8_t frame = 0;  ///< into the set's frames
    /// Specular lobes with the shader's `caustics` off are dead at vertices that a diffuse ray reached.
    bool caustics = true;
    float indirect = 1;             ///< factor on indirect light
    bool direct_light = true;       ///< false: lights do not reach it directly
    std::optional<Color> albedo{};  ///< of the model, for the viewer's direction: if it is known
};

struct Emission {
    Color radiance;  ///< leaving toward wo [W/(m^2 sr)]
    const LobeRecord* record = nullptr;
};

/// Light that goes below the surface and comes back somewhere else. Never evaluated for a direction: the renderer walks.
struct SubsurfaceClosure {
    SubsurfaceMedium medium;
    Color weight;  ///< multiplies what the walk brings
    const LobeRecord* record = nullptr;
    float indirect = 1;  ///< factor on indirect light

    [[nodiscard]] Color albedo() const { return weight * medium.reflectance; }
};

/// What lies behind the surface of a clear body.
struct Interior {
    Medium medium;         ///< what it is filled with
    float ior = 1;         ///< index of refraction, for the path's wavelength if it has one
    int priority = 0;      ///< where bodies overlap the higher one is there
    bool is_body = false;  ///< false: the surface has no inside
};

/// Factors on light that arrives from anything but a light, for diffuse and for specular reflection.
struct IndirectFactors {
    float diffuse = 1, specular = 1;
    bool direct_light = true;  ///< false: no light that comes from a light
};

/// A surface that shows nothing but shadows, over what would be seen without it: the renderer asks the lights.
struct ShadowMatte {
    Color background;  ///< seen where no shadow is
    bool sees_background =
        false;  ///< what lies behind in place of it: options.background, skydomes
    Color shadow_color{0, 0, 0};  ///< seen where the shadow is
    float opacity = 1;            ///< of the shadow
    float backlighting = 0;       ///< weight of light on the far side
    Color diffuse{1, 1, 1};       ///< reflectance, for the difference that the shadow makes
    bool alpha_is_mask = true;    ///< else the surface is opaque
    Color weight{1, 1, 1};        ///< its share of the surface; made by ClosureSet::show_shadows
    const LobeRecord* background_record = nullptr;
    const LobeRecord* shadow_record = nullptr;
};

class ClosureSet {
  public:
    static constexpr std::size_t kMaxClosures = 24;
    static constexpr std::size_t kMaxSubsurfaces = 4;
    static constexpr std::size_t kMaxFrames = 6;
    static constexpr std::size_t kMaxEmissions = 6;
    static constexpr std::size_t kMaxMedia = 4;

    /// Starts a hit: z of `shading` is the shading normal on the side of the surface that `wo` leaves from. It may lean away
    /// from `wo` itself (interpolated normals near a silhouette): lobes then see `wo` at the horizon.
    void begin(Vec3f wo, const Frame& shading);
    /// Starts a point in a volume, seen along -wo: media and emission (a unit of length each) are what counts there.
    void begin_volume(Vec3f wo);

    // For shaders ----------------------------------------------------------------------------------------------
    /// Lobes of the shader instance that adds from now on; set by whoever calls the shader.
    void set_records(std::span<const LobeRecord> records) { records_ = records; }
    [[nodiscard]] std::span<const LobeRecord> records() const { return records_; }
    /// Factor on everything added from now on (mix_shader); starts white.
    void set_scale(Color scale) { scale_ = scale; }
    [[nodiscard]] Color scale() const { return scale_; }
    /// Factors on indirect light of the lobes that are added from now on; start at 1. Diffuse transmission and subsurface
    /// scattering go by the diffuse one, specular transmission by none.
    void set_indirect(IndirectFactors factors) { indirect_ = factors; }
    [[nodiscard]] IndirectFactors indirect() const { return indirect_; }
    /// Adds lobe number `lobe` of the shader with the hit's shading frame. Black or non-finite weights are left out.
    void add(int lobe, const LobeModel& model, Color weight, bool caustics = true) {
        add(lobe, model, weight, 0, caustics);
    }
    /// The same with a frame made by add_frame.
    ///
    /// albedo  of the model for `local_wo(frame)`, if the shader knows it: it need not be worked out again
    void add(int lobe, const LobeModel& model, Color weight, std::uint8_t frame, bool caustics,
             const std::optional<Color>& albedo = {});
    /// Registers a frame (turned to the side of the first one); returns its number.
    std::uint8_t add_frame(const Frame& frame);
    /// Adds subsurface scattering through lobe number `lobe` of the shader.
    void add_subsurface(int lobe, const SubsurfaceMedium& medium, Color weight);
    /// Adds emission through lobe number `lobe` of the shader.
    void emit(int lobe, Color radiance);
    /// Adds to the part of the hit that rays pass straight through; 1 - opacity.
    void transparent(Color weight) { transparency_ += scale_ * weight; }
    /// Adds to what shadow rays of diffusely reflected light pass where other rays are refracted: with `caustics` off, glass
    /// casts tinted shadows instead of focusing light. Makes no event, as opacity.
    void transmit_shadow(Color weight) { shadow_transmission_ += scale_ * weight; }
    /// The surface is that of a clear body. The last call counts.
    void set_interior(const Interior& interior) {
        interior_ = interior;
        interior_.is_body = true;
    }
    /// A medium as this set takes it: what is negative or not finite becomes 0.
    ///
    /// lobe  of the scattering event, or -1 if the medium only absorbs
    [[nodiscard]] Medium medium(int lobe, Color extinction, Color scattering,
                                const Phase& phase) const;
    /// What the set transmits on the far side bends by wavelength: ShadePoint::wavelength was used.
    void disperse() { disperses_ = true; }
    /// The surface shows shadows; lobes number `background` and `shadow` of the shader make its events. The last call counts.
    void show_shadows(int background, int shadow, ShadowMatte matte);
    /// Adds a medium: at a point in a volume, what is there; at a surface, what the body behind it is filled with. In a
    /// volume it is scaled as all else is; a body's inside does not depend on how much of its surface a layer hides.
    void add_medium(int lobe, Color absorption, Color scattering, const Phase& phase = {}) {
        add_haze(lobe, absorption + scattering, scattering, phase);
    }
    /// The same where what is lost and what is scattered are given independently.
    void add_haze(int lobe, Color extinction, Color scattering, const Phase& phase);
    /// The hit is a hole in the picture: black, and alpha is reduced by this.
    void matte(Color weight) { matte_ += scale_ * weight; }

    // For the integrator ---------------------------------------------------------------------------------------
    [[nodiscard]] std::span<const Closure> closures() const { return {closures_.data(), n_}; }
    [[nodiscard]] std::span<const SubsurfaceClosure> subsurfaces() const {
        return {subsurfaces_.data(), n_subsurfaces_};
    }
    [[nodiscard]] std::span<const Emission> emissions() const {
        return {emissions_.data(), n_emissions_};
    }
    [[nodiscard]] Color transparency() const { return transparency_; }
    [[nodiscard]] Color shadow_transmission() const { return shadow_transmission_; }
    [[nodiscard]] Color matte() const { return matte_; }
    [[nodiscard]] const Interior& interior() const { return interior_; }
    [[nodiscard]] bool disperses() const { return disperses_; }
    /// Null: the surface is none of those.
    [[nodiscard]] const ShadowMatte* shadow_matte() const {
        return shadow_matte_.background_record == nullptr ? nullptr : &shadow_matte_;
    }
    /// At a point in a volume.
    [[nodiscard]] std::span<const Medium> media() const { return {media_.data(), n_media_}; }
    /// Makes light scatter in the media: adds the phase function of each, weighted by what it scatters a unit of length.
    void scatter_in_media(float weight);
    /// Adds a medium as it is: that of a body at a point inside of it.
    void add_medium(const Medium& medium);
    /// Extinction of a volume's media together [1/scene unit].
    [[nodiscard]] Color extinction() const;
    /// Closures that did not fit; counted by the renderer, reported at the end.
    [[nodiscard]] std::uint32_t n_dropped() const { return n_dropped_; }

    /// Value with the closure's weight and density of closure `i` for world directions.
    [[nodiscard]] LobeEval eval(std::size_t i, Vec3f wi) const noexcept;
    /// Samples closure `i`; directions in world space, f with the closure's weight. `delta` lobes give weights, see LobeSample.
    [[nodiscard]] LobeSample sample(std::size_t i, Vec2f u, float u_choice) const noexcept;
    /// Weight times directional albedo.
    [[nodiscard]] Color albedo(std::size_t i) const noexcept;
    [[nodiscard]] bool delta(std::size_t i) const noexcept;
    [[nodiscard]] Vec3f wo() const { return wo_; }
    /// The same as lobes of a frame see it: local, at or above the horizon.
    [[nodiscard]] Vec3f local_wo(std::uint8_t frame) const { return wo_local_[frame]; }

  private:
    [[nodiscard]] const LobeRecord& record(int lobe) const;
    [[nodiscard]] float indirect_of(const LobeRecord& record) const;

    std::array<Closure, kMaxClosures> closures_;
    std::array<SubsurfaceClosure, kMaxSubsurfaces> subsurfaces_;
    std::array<Emission, kMaxEmissions> emissions_;
    std::array<Frame, kMaxFrames> frames_;
    std::array<Vec3f, kMaxFrames> wo_local_;
    std::array<Medium, kMaxMedia> media_;
    std::size_t n_ = 0, n_subsurfaces_ = 0, n_emissions_ = 0, n_frames_ = 0, n_media_ = 0;
    bool in_volume_ = false;
    std::uint32_t n_dropped_ = 0;
    std::span<const LobeRecord> records_;
    Color scale_{1, 1, 1}, transparency_, shadow_transmission_, matte_;
    IndirectFactors indirect_;
    Interior interior_;
    bool disperses_ = false;
    ShadowMatte shadow_matte_;
    Vec3f wo_;
};

}  // namespace lightsieve
