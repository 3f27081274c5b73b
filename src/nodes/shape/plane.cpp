// plane: a plane without end.
#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"

namespace lightsieve {
namespace {

struct Plane : ShapeNode {
    Vec3f point{0, 0, 0}, normal{0, 1, 0};

    static NodeType describe() {
        Describe<Plane> d("plane", NodeKind::Shape, "A plane without end.");
        describe_shape_common(d);
        d.param("point", &Plane::point, "A point of the plane, object space.").unit("scene units");
        d.param("normal", &Plane::normal, "Direction that the plane faces; of any length.");
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!all_possible(context, {{"point", point}, {"normal", normal}})) return nullptr;
        SimpleShape out;
        out.kind = SimpleShape::Kind::Plane;
        out.base = point;
        out.axis = normalize(normal, {});
        if (out.axis == Vec3f{}) {
            warn_left_out(context, "the normal has no direction", "normal");
            return nullptr;
        }
        return geometry_from(out);
    }
};

}  // namespace

NodeType node_plane() { return Plane::describe(); }

}  // namespace lightsieve
