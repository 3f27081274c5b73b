// sphere: one exact sphere.
#include <cmath>

#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Sphere : ShapeNode {
    Vec3f center{0, 0, 0};
    float radius = 0.5F;

    static NodeType describe() {
        Describe<Sphere> d("sphere", NodeKind::Shape, "A sphere.");
        describe_shape_common(d);
        d.param("center", &Sphere::center, "Middle of the sphere, object space.")
            .unit("scene units");
        d.param("radius", &Sphere::radius, "Radius.").unit("scene units").range(0, kInfinity);
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        Diagnostics& diagnostics = context.diagnostics();
        if (!is_finite(center)) {
            diagnostics.error(Code::InvalidValue, "the center of the sphere is not finite",
                              context.where("center"));
            return nullptr;
        }
        if (!std::isfinite(radius)) {
            diagnostics.error(Code::InvalidValue, "the radius of the sphere is not finite",
                              context.where("radius"));
            return nullptr;
        }
        if (!(radius > 0)) {
            diagnostics.warning(Code::InvalidValue,
                                "a sphere without a radius above 0 shows nothing",
                                context.where("radius"));
            auto nothing = std::make_unique<ShapeGeometry>();
            nothing->data = SphereList{{{}}, {}};
            return nothing;
        }
        auto out = std::make_unique<ShapeGeometry>();
        out->data = SphereList{{{center}}, {radius}};
        return out;
    }
};

}  // namespace

NodeType node_sphere() { return Sphere::describe(); }

}  // namespace lightsieve
