// standard_volume: smoke, fire, fog and clouds.
//
// The grids of the shape (VolumeLookup) are channels, asked for by name. `transparent` is what a thickness of
// `transparent_depth` lets through at density 1, so its default, 1/e, makes density the extinction coefficient.
#include "bsdf/closure.h"
#include "core/blackbody.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/volume_lookup.h"

namespace lightsieve {
namespace {

enum class EmissionMode : std::int32_t { None, Channel, Density, Blackbody };

struct StandardVolume {
    float density = 1;
    Name density_channel = "density";
    float scatter = 1;
    Color scatter_color{0.5F, 0.5F, 0.5F};
    Name scatter_color_channel;
    float scatter_anisotropy = 0, scatter_secondary_anisotropy = 0,
          scatter_secondary_anisotropy_mix = 0;
    Color transparent{0.36787945F, 0.36787945F, 0.36787945F};
    float transparent_depth = 1;
    Name transparent_channel;
    EmissionMode emission_mode = EmissionMode::Blackbody;
    float emission = 1;
    Color emission_color{1, 1, 1};
    Name emission_channel;
    float temperature = 1;
    Name temperature_channel = "temperature";
    float blackbody_kelvin = 5000, blackbody_intensity = 1, blackbody_contrast = 1;
    Vec3f displacement{0, 0, 0};
    ChannelInterpolation interpolation = ChannelInterpolation::Trilinear;
    Name label;

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const;

  private:
    /// A channel's value; `without` where it is not named or the volume has no grids at all, black where it lacks this one.
    [[nodiscard]] Color channel(Name name, const ShadePoint& at, Color without) const {
        if (name.empty() || at.volume == nullptr) return without;
        Color value;
        return at.volume->channel(name, interpolation, value) ? positive(value) : kBlack;
    }
    /// Extinction at density 1 [1/scene unit].
    [[nodiscard]] Color extinction(const ShadePoint& at) const;
    [[nodiscard]] Color emitted(const ShadePoint& at, float amount) const;
};

enum Lobe : int { kScatter, kEmission };

NodeType StandardVolume::describe() {
    using S = StandardVolume;
    Describe<S> d("standard_volume", NodeKind::Shader, "Smoke, fire, fog and clouds.");
    d.fills_volumes();
    d.lobe(kScatter, EventKind::Volume, EventLobe::None, "", "Scattering.");
    d.lobe(kEmission, EventKind::Object, EventLobe::None, "", "Emission.");
    d.param("density", &S::density, "Factor on how thick the volume is.").range(0, kInfinity);
    d.param("density_channel", &S::density_channel, "Grid of the density; empty: it is even.");
    d.param("scatter", &S::scatter, "Weight of the scattering.").range(0, 1);
    d.param("scatter_color", &S::scatter_color,
            "What of the light that meets a particle goes on: the single-scattering albedo.")
        .range(0, 1);
    d.param("scatter_color_channel", &S::scatter_color_channel, "Grid: factor on scatter_color.");
    d.param("scatter_anisotropy", &S::scatter_anisotropy,
            "Mean cosine of the scattering: above 0 light goes on forward.")
        .range(-1, 1);
    d.param("scatter_secondary_anisotropy", &S::scatter_secondary_anisotropy,
            "The same of a second lobe.")
        .range(-1, 1);
    d.param("scatter_secondary_anisotropy_mix", &S::scatter_secondary_anisotropy_mix,
            "Share of the second lobe.")
        .range(0, 1);
    d.param("transparent", &S::transparent,
            "What a thickness of transparent_depth lets through at density 1.")
        .range(0, 1);
    d.param("transparent_depth", &S::transparent_depth, "Thickness for `transparent`.")
        .unit("scene units")
        .range(0, kInfinity);
    d.param("transparent_channel", &S::transparent_channel, "Grid: factor on `transparent`.");
    d.param("emission_mode", &S::emission_mode,
            "none; channel: the grid emission_channel; density: like the density; blackbody: by "
            "temperature.")
        .names({"none", "channel", "density", "blackbody"});
    d.param("emission", &S::emission, "Weight of the emission.").range(0, kInfinity);
    d.param("emission_color", &S::emission_color, "Factor on the emission, per scene unit.");
    d.param("emission_channel", &S::emission_channel, "Grid for emission_mode channel.");
    d.param("temperature", &S::temperature, "Factor on the temperature channel.")
        .range(0, kInfinity);
    d.param("temperature_channel", &S::temperature_channel,
            "Grid of the temperature, from 0 to 1.");
    d.param("blackbody_kelvin", &S::blackbody_kelvin, "Temperature where the channel is 1.")
        .unit("K")
        .range(0, 40000);
    d.param("blackbody_intensity", &S::blackbody_intensity, "Factor on blackbody emission.")
        .range(0, kInfinity);
    d.param("blackbody_contrast", &S::blackbody_contrast,
            "Exponent of the temperature channel: above 1 only the hottest parts glow.")
        .range(0, 10);
    d.param("displacement", &S::displacement, "Moves the point at which grids are asked.")
        .pending();
    d.param("interpolation", &S::interpolation, "Between voxels.")
        .names({"closest", "trilinear", "tricubic"});
    d.param("label", &S::label, "Joins the events of the volume, as in C<V.'smoke'>.*.");
    return d.done();
}

void StandardVolume::eval(const ShadePoint& at, ClosureSet& out) const {
    const float amount = positive(density) * channel(density_channel, at, kWhite).r;
    if (amount > 0) {
        const Color total = extinction(at) * amount;
        const Color albedo = unit(positive(scatter) * positive(scatter_color) *
                                  channel(scatter_color_channel, at, kWhite));
        out.add_medium(kScatter, total * (kWhite - albedo), total * albedo,
                       Phase(scatter_anisotropy, scatter_secondary_anisotropy,
                             scatter_secondary_anisotropy_mix));
    }
    if (emission_mode != EmissionMode::None && emission > 0)
        out.emit(kEmission, positive(emission_color) * positive(emission) * emitted(at, amount));
}

Color StandardVolume::extinction(const ShadePoint& at) const {
    // Glass thinner than a millionth of a unit, or blacker than a millionth, is as good as a wall.
    constexpr float kLeast = 1e-6F;
    const Color through = transparent * channel(transparent_channel, at, kWhite);
    const float per_length = 1 / std::max(positive(transparent_depth), kLeast);
    Color out;
    for (int c = 0; c < 3; ++c)
        out[c] = -std::log(std::max(unit(through[c]), kLeast)) * per_length;
    return out;
}

Color StandardVolume::emitted(const ShadePoint& at, float amount) const {
    switch (emission_mode) {
        case EmissionMode::Channel: return channel(emission_channel, at, kWhite);
        case EmissionMode::Density: return Color::grey(amount);
        case EmissionMode::Blackbody: {
            const float heat = positive(temperature) * channel(temperature_channel, at, kBlack).r;
            if (!(heat > 0)) return kBlack;
            const float glow = std::pow(heat, positive(blackbody_contrast));
            // Stefan-Boltzmann: what is emitted grows with the fourth power.
            return positive(blackbody_color(positive(blackbody_kelvin) * glow)) *
                   (positive(blackbody_intensity) * square(square(glow)));
        }
        case EmissionMode::None: break;
    }
    return kBlack;
}

}  // namespace

NodeType node_standard_volume() { return StandardVolume::describe(); }

}  // namespace lightsieve
