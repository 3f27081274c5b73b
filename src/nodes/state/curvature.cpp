// curvature: edges and creases, by how the normals of what is near differ.
//
// Rays leave the point to all sides: those that meet something in front of the surface find creases, those that meet
// something behind it find edges; each counts by the angle between both normals and less the farther it is.
#include "nodes/bump/bump_common.h"
#include "nodes/math/math_node.h"
#include "nodes/state/occlusion.h"

namespace lightsieve {
namespace {

constexpr std::int32_t kMostSamples = 32;
enum class CurvatureOutput : std::int32_t { Convex, Concave, Both };

struct Curvature {
    CurvatureOutput output = CurvatureOutput::Convex;
    std::int32_t samples = 3;
    float radius = 0.1F, spread = 1, threshold = 0, bias = 0.5F, multiply = 1;
    Name trace_set;
    bool inclusive = true, self_only = false;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] float bent(const ShadePoint& at, Vec3f n, float side) const;
};

NodeType Curvature::describe() {
    Describe<Curvature> d("curvature", NodeKind::Shader, "Edges and creases of a surface.");
    d.param("output", &Curvature::output, "Edges, creases, or edges in red and creases in green.")
        .names({"convex", "concave", "both"});
    d.param("samples", &Curvature::samples, "Square root of the number of rays.").range(1, 32);
    d.param("radius", &Curvature::radius, "How far rays go.").unit("scene units");
    d.param("spread", &Curvature::spread, "Angle around the normal; 1: to all sides.").range(0, 1);
    d.param("threshold", &Curvature::threshold, "Smaller angles do not count; 1 is 180 degrees.")
        .range(0, 1);
    d.param("bias", &Curvature::bias, "Above 1/2 what is far counts more.").range(0, 1);
    d.param("multiply", &Curvature::multiply, "Factor on the result.");
    d.param("trace_set", &Curvature::trace_set, "Set of shapes that are met, or not met.");
    d.param("inclusive", &Curvature::inclusive,
            "Shapes of trace_set are met, else all but those.");
    d.param("self_only", &Curvature::self_only, "Only the shape itself is met.");
    return d.done();
}

/// side  1: in front of the surface; -1: behind it
float Curvature::bent(const ShadePoint& at, Vec3f n, float side) const {
    const Frame frame = Frame::from_z(n * side);
    const auto n_side = static_cast<std::uint32_t>(std::clamp(samples, 1, kMostSamples));
    float sum = 0;
    for (std::uint32_t i = 0; i < n_side * n_side; ++i) {
        const Vec3f wi = probe_direction(at, frame, spread, 50, i, n_side);
        const Probe probe{at.position + n * (side * 1e-3F * radius),
                          wi,
                          0,
                          radius,
                          self_only,
                          trace_set,
                          inclusive};
        ProbeHit hit;
        if (!at.services->trace(at, probe, hit)) continue;
        const float angle = std::acos(std::clamp(dot(n, hit.normal), -1.0F, 1.0F)) * kInvPi;
        if (angle <= unit(threshold)) continue;
        sum += std::min(2 * angle, 1.0F) * perlin_bias(1 - hit.t / radius, unit(bias));
    }
    return sum / static_cast<float>(n_side * n_side);
}

Color Curvature::eval(const ShadePoint& at) const {
    if (at.services == nullptr || !(radius > 0)) return kBlack;
    const Vec3f n = outward_normal(at, {});
    switch (output) {
        case CurvatureOutput::Convex: return Color::grey(bent(at, n, -1) * multiply);
        case CurvatureOutput::Concave: return Color::grey(bent(at, n, 1) * multiply);
        case CurvatureOutput::Both: break;
    }
    return Color{bent(at, n, -1), bent(at, n, 1), 0} * multiply;
}

}  // namespace

NodeType node_curvature() { return Curvature::describe(); }

}  // namespace lightsieve
