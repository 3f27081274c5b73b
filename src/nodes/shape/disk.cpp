// disk: a flat disk, exact, with or without a hole.
#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"

namespace lightsieve {
namespace {

struct Disk : ShapeNode {
    Vec3f center{0, 0, 0}, normal{0, 1, 0};
    float radius = 0.5F, hole = 0, bevel_width = 0, bevel_angle = 45;

    static NodeType describe() {
        Describe<Disk> d("disk", NodeKind::Shape, "A flat disk, exact, that may have a hole.");
        describe_shape_common(d);
        d.param("center", &Disk::center, "Middle of the disk, object space.").unit("scene units");
        d.param("normal", &Disk::normal, "Direction that the disk faces; of any length.");
        d.param("radius", &Disk::radius, "Radius.").unit("scene units").range(0, kInfinity);
        d.param("hole", &Disk::hole, "Radius of the hole in the middle.")
            .unit("scene units")
            .range(0, kInfinity);
        d.param("bevel_width", &Disk::bevel_width,
                "Width of the bevel at the rim; it stays sharp here.")
            .unit("scene units")
            .pending();
        d.param("bevel_angle", &Disk::bevel_angle, "Angle of the bevel; acts with bevel_width.")
            .unit("degrees")
            .ignored();
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!all_possible(
                context,
                {{"center", center}, {"normal", normal}, {"radius", radius}, {"hole", hole}}) ||
            !not_negative(context, "radius", radius) || !not_negative(context, "hole", hole))
            return nullptr;
        SimpleShape out;
        out.kind = SimpleShape::Kind::Disk;
        out.base = center;
        out.axis = normalize(normal, {});
        out.radius = radius;
        out.second_radius = hole;
        if (out.axis == Vec3f{}) {
            warn_left_out(context, "the normal has no direction", "normal");
            return nullptr;
        }
        if (!(radius > hole)) {
            warn_left_out(context,
                          hole > 0 ? "the hole is as large as the disk" : "the radius is 0",
                          hole > 0 ? "hole" : "radius");
            return nullptr;
        }
        return geometry_from(out);
    }
};

}  // namespace

NodeType node_disk() { return Disk::describe(); }

}  // namespace lightsieve
