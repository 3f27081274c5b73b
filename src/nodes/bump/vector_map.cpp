// vector_map: vectors from a picture, for displacement.
#include "nodes/bump/bump_common.h"

namespace lightsieve {
namespace {

struct VectorMap : MappedVector {
    VectorMap() {
        color_to_signed = false;
        order = MapOrder::Xzy;
    }
    float scale = 1;

    static NodeType describe() {
        Describe<VectorMap> d("vector_map", NodeKind::Shader, "Vectors from a picture.");
        describe_mapped_vector(d);
        d.param("scale", &VectorMap::scale, "Factor on the vector.");
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const {
        const Vec3f v = along_axes() * scale;
        if (!tangent_space) return v;
        return tangent_frame(at, outward_normal(at, normal), tangent).world_from_local(v);
    }
};

}  // namespace

NodeType node_vector_map() { return VectorMap::describe(); }

}  // namespace lightsieve
