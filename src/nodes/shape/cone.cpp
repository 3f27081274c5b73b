// cone: the exact side of a cone, whole or cut. Its ends are open; disks close them.
#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"

namespace lightsieve {
namespace {

struct Cone : ShapeNode {
    Vec3f bottom{0, 0, 0}, top{0, 1, 0};
    float bottom_radius = 0.5F, top_radius = 0;

    static NodeType describe() {
        Describe<Cone> d("cone", NodeKind::Shape, "The side of a cone, exact; its ends are open.");
        describe_shape_common(d);
        d.param("bottom", &Cone::bottom, "Middle of one end, object space.").unit("scene units");
        d.param("top", &Cone::top, "Middle of the other end.").unit("scene units");
        d.param("bottom_radius", &Cone::bottom_radius, "Radius at the bottom.")
            .unit("scene units")
            .range(0, kInfinity);
        d.param("top_radius", &Cone::top_radius, "Radius at the top; 0 for a tip.")
            .unit("scene units")
            .range(0, kInfinity);
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!all_possible(context, {{"bottom", bottom},
                                    {"top", top},
                                    {"bottom_radius", bottom_radius},
                                    {"top_radius", top_radius}}) ||
            !not_negative(context, "bottom_radius", bottom_radius) ||
            !not_negative(context, "top_radius", top_radius))
            return nullptr;
        return mantle(context, bottom, top, bottom_radius, top_radius, "bottom_radius");
    }
};

}  // namespace

NodeType node_cone() { return Cone::describe(); }

}  // namespace lightsieve
