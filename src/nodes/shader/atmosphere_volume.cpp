// atmosphere_volume: thin haze that fills the scene and shows the beams of lights.
//
// Light is scattered once, and how much is scattered (density) and how much is lost (attenuation) are independent, as an
// artist's tool has it. Lights at infinity do not shine into it: along their rays it has no end.
#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct AtmosphereVolume {
    float density = 0;
    Color rgb_density{1, 1, 1};
    float attenuation = 0;
    Color rgb_attenuation{1, 1, 1};
    float eccentricity = 0;
    std::int32_t samples = 5;
    float affect_camera = 1, affect_diffuse = 0, affect_specular = 1;

    static NodeType describe() {
        using A = AtmosphereVolume;
        Describe<A> d("atmosphere_volume", NodeKind::Shader,
                      "Haze that fills the scene, for options.atmosphere.");
        d.fills_volumes();
        d.reads_ray_type();
        d.lobe(0, EventKind::Volume, EventLobe::None, "", "Scattering.");
        d.param("density", &A::density, "How much light is scattered a unit of length.")
            .unit("1 / scene unit")
            .range(0, kInfinity);
        d.param("rgb_density", &A::rgb_density, "Factor on the density.");
        d.param("attenuation", &A::attenuation, "How much light is lost a unit of length.")
            .unit("1 / scene unit")
            .range(0, kInfinity);
        d.param("rgb_attenuation", &A::rgb_attenuation, "Factor on the attenuation.");
        d.param("eccentricity", &A::eccentricity,
                "Mean cosine of the scattering: above 0 light goes on forward.")
            .range(-1, 1);
        d.param("samples", &A::samples, "Points along a camera ray at which lights are asked.")
            .hard_range(1, 100);
        d.param("affect_camera", &A::affect_camera, "Share of it that camera rays see.")
            .range(0, 1);
        d.param("affect_diffuse", &A::affect_diffuse, "The same for diffuse rays.").range(0, 1);
        d.param("affect_specular", &A::affect_specular, "The same for specular rays.").range(0, 1);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        const float share = unit(affected_by(at.ray_type));
        out.add_haze(0, positive(attenuation) * positive(rgb_attenuation) * share,
                     positive(density) * positive(rgb_density) * share, Phase(eccentricity));
    }

  private:
    [[nodiscard]] float affected_by(RayType type) const {
        switch (type) {
            case RayType::Camera:
            case RayType::Shadow: return affect_camera;
            case RayType::SpecularReflect:
            case RayType::SpecularTransmit: return affect_specular;
            default: return affect_diffuse;
        }
    }
};

}  // namespace

NodeType node_atmosphere_volume() { return AtmosphereVolume::describe(); }

}  // namespace lightsieve
