// ray_switch_shader: another shader for each type of ray.
#include "nodes/closure/closure_common.h"
#include "nodes/shader/ray_switch.h"

namespace lightsieve {
namespace {

struct RaySwitchShader {
    ShaderRef camera, shadow, diffuse_reflection, diffuse_transmission, specular_reflection,
        specular_transmission, volume;

    static NodeType describe() {
        Describe<RaySwitchShader> d(
            "ray_switch_shader", NodeKind::Shader,
            "Another shader for each type of ray; black where none is linked.");
        d.param("camera", &RaySwitchShader::camera, "Seen by the camera.");
        d.param("shadow", &RaySwitchShader::shadow, "Whose transparency shadows show.");
        d.param("diffuse_reflection", &RaySwitchShader::diffuse_reflection,
                "Seen by diffusely reflected rays.");
        d.param("diffuse_transmission", &RaySwitchShader::diffuse_transmission,
                "Seen by diffusely transmitted rays and those from below a surface.");
        d.param("specular_reflection", &RaySwitchShader::specular_reflection,
                "Seen in reflections.");
        d.param("specular_transmission", &RaySwitchShader::specular_transmission,
                "Seen through clear bodies.");
        d.param("volume", &RaySwitchShader::volume, "Seen by rays that volumes scatter.");
        d.reads_ray_type();
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        input_for_ray(*this, at.ray_type).closures(at, out);
    }
};

}  // namespace

NodeType node_ray_switch_shader() { return RaySwitchShader::describe(); }

}  // namespace lightsieve
