// lambert: ideal diffuse reflection.
#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Lambert {
    float Kd = 0.7F;
    Color Kd_color{1, 1, 1}, opacity{1, 1, 1};
    Vec3f normal{0, 0, 0};  ///< world space; acts only when linked

    static NodeType describe() {
        Describe<Lambert> d("lambert", NodeKind::Shader, "Ideal diffuse reflection.");
        d.param("Kd", &Lambert::Kd, "Weight of the diffuse lobe.").range(0, 1);
        d.param("Kd_color", &Lambert::Kd_color, "Reflectance.").range(0, 1);
        d.param("opacity", &Lambert::opacity, "Below 1, rays pass straight through for the rest.")
            .range(0, 1);
        d.param("normal", &Lambert::normal, "Shading normal, world space; acts when linked.");
        d.lobe(0, EventKind::Reflection, EventLobe::Diffuse, "", "Diffuse reflection.");
        return d.done();
    }

    void prepare(NodeContext& context) {
        if (!context.is_linked("normal")) normal = {};
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const Color visible = unit(opacity);
        out.transparent(kWhite - visible);
        std::uint8_t frame = 0;
        if (!(normal == Vec3f{}))
            frame = out.add_frame(Frame::from_z_x(shading_normal(at, normal), at.tangent));
        out.add(0, DiffuseReflect(positive(Kd) * positive(Kd_color)), visible, frame, true);
    }
};

}  // namespace

NodeType node_lambert() { return Lambert::describe(); }

}  // namespace lightsieve
