// cylinder: the exact side of a cylinder. Its ends are open; disks close them.
#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"

namespace lightsieve {
namespace {

struct Cylinder : ShapeNode {
    Vec3f bottom{0, 0, 0}, top{0, 1, 0};
    float radius = 0.5F, bevel_width = 0, bevel_angle = 45;

    static NodeType describe() {
        Describe<Cylinder> d("cylinder", NodeKind::Shape,
                             "The side of a cylinder, exact; its ends are open.");
        describe_shape_common(d);
        d.param("bottom", &Cylinder::bottom, "Middle of one end, object space.")
            .unit("scene units");
        d.param("top", &Cylinder::top, "Middle of the other end.").unit("scene units");
        d.param("radius", &Cylinder::radius, "Radius.").unit("scene units").range(0, kInfinity);
        d.param("bevel_width", &Cylinder::bevel_width,
                "Width of the bevel at the ends; they stay sharp here.")
            .unit("scene units")
            .pending();
        d.param("bevel_angle", &Cylinder::bevel_angle,
                "Angle of the bevel; acts with bevel_width.")
            .unit("degrees")
            .ignored();
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!all_possible(context, {{"bottom", bottom}, {"top", top}, {"radius", radius}}) ||
            !not_negative(context, "radius", radius))
            return nullptr;
        return mantle(context, bottom, top, radius, radius, "radius");
    }
};

}  // namespace

NodeType node_cylinder() { return Cylinder::describe(); }

}  // namespace lightsieve
