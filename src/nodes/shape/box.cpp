// box: a box along the axes of object space.
#include <array>

#include "nodes/shape/shape_checks.h"
#include "nodes/shape/shape_common.h"

namespace lightsieve {
namespace {

/// Texture coordinates of box_mesh: each side shows the whole unit square, upright on the four that stand.
void add_uvs(TriangleMesh& mesh) {
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    // Which of them the first corner of each side has.
    constexpr std::array<std::uint32_t, 6> kFirst{0, 1, 0, 3, 1, 0};
    for (std::uint32_t side = 0; side < kFirst.size(); ++side)
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            mesh.uv_indices.push_back((kFirst[side] + corner) % 4);
            mesh.corner.push_back(4 * side + corner);
        }
}

struct BoxNode : ShapeNode {
    Vec3f min{-0.5F, -0.5F, -0.5F}, max{0.5F, 0.5F, 0.5F};

    static NodeType describe() {
        Describe<BoxNode> d("box", NodeKind::Shape, "A box along the axes of object space.");
        describe_shape_common(d);
        d.param("min", &BoxNode::min, "One corner, object space.").unit("scene units");
        d.param("max", &BoxNode::max, "The opposite corner.").unit("scene units");
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!all_possible(context,
                          {{"min", min}, {"max", max}, {"volume_padding", volume_padding}}))
            return nullptr;
        Box3f box;
        box.grow(min);
        box.grow(max);
        auto out = std::make_unique<ShapeGeometry>();
        if (step_size > 0) {
            const float padding = std::max(volume_padding, 0.0F);
            box = {box.lower - Vec3f{padding, padding, padding},
                   box.upper + Vec3f{padding, padding, padding}};
            out->volume_box = box;
        }
        const Vec3f size = box.size();
        const int flat = (size.x > 0 ? 0 : 1) + (size.y > 0 ? 0 : 1) + (size.z > 0 ? 0 : 1);
        if (flat > (step_size > 0 ? 0 : 1)) {
            warn_left_out(context, "the box is empty", "max");
            return nullptr;
        }
        TriangleMesh mesh = box_mesh(box);
        add_uvs(mesh);
        out->data = std::move(mesh);
        return out;
    }
};

}  // namespace

NodeType node_box() { return BoxNode::describe(); }

}  // namespace lightsieve
