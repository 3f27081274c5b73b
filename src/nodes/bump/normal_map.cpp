// normal_map: normals from a picture.
#include "nodes/bump/bump_common.h"

namespace lightsieve {
namespace {

struct NormalMap : MappedVector {
    float strength = 1;

    static NodeType describe() {
        Describe<NormalMap> d("normal_map", NodeKind::Shader, "Normals from a picture.");
        describe_mapped_vector(d);
        d.param("strength", &NormalMap::strength, "Factor on how far normals lean.").range(0, 10);
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const {
        const Vec3f n = outward_normal(at, normal);
        Vec3f v = along_axes();
        if (!(length_squared(v) > 0)) return n;
        if (!tangent_space) return normalize(lerp_toward(n, normalize(v)), n);
        v = {v.x * strength, v.y * strength, v.z};
        return normalize(tangent_frame(at, n, tangent).world_from_local(v), n);
    }

  private:
    [[nodiscard]] Vec3f lerp_toward(Vec3f from, Vec3f to) const {
        return from + (to - from) * strength;
    }
};

}  // namespace

NodeType node_normal_map() { return NormalMap::describe(); }

}  // namespace lightsieve
