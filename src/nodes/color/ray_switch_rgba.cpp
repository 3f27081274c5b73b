// ray_switch_rgba: another colour for each type of ray.
#include "nodes/shader/ray_switch.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct RaySwitchRgba {
    Lazy<Rgba> camera, shadow, diffuse_reflection, diffuse_transmission, specular_reflection,
        specular_transmission, volume;

    static NodeType describe() {
        Describe<RaySwitchRgba> d("ray_switch_rgba", NodeKind::Shader,
                                  "Another colour for each type of ray.");
        d.param("camera", &RaySwitchRgba::camera, "For rays from the camera.");
        d.param("shadow", &RaySwitchRgba::shadow, "For shadow rays.");
        d.param("diffuse_reflection", &RaySwitchRgba::diffuse_reflection,
                "For diffusely reflected rays.");
        d.param("diffuse_transmission", &RaySwitchRgba::diffuse_transmission,
                "For diffusely transmitted rays and those from below a surface.");
        d.param("specular_reflection", &RaySwitchRgba::specular_reflection, "For reflections.");
        d.param("specular_transmission", &RaySwitchRgba::specular_transmission,
                "For rays through clear bodies.");
        d.param("volume", &RaySwitchRgba::volume, "For rays that volumes scatter.");
        d.reads_ray_type();
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint& at) const {
        return input_for_ray(*this, at.ray_type).at(at);
    }
};

}  // namespace

NodeType node_ray_switch_rgba() { return RaySwitchRgba::describe(); }

}  // namespace lightsieve
