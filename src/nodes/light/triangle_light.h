// A light made of triangles that shine on one side: meshes, cylinders, quadrilaterals that are no rectangles.
//
// A point is drawn uniformly over the area, so the density of a direction is distance^2 / (cos * area), cos at the
// light. What rays meet are exactly these triangles, so both strategies of MIS speak of the same points.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/sampling.h"
#include "nodes/light/flat_profile.h"
#include "nodes/light/light_common.h"

namespace lightsieve {

class TriangleLight final : public Light {
  public:
    /// mesh      world space, one key; the winding says which side shines
    /// emission  color * intensity * 2^exposure
    /// profile   of a flat light; meshes have none
    /// Area 0 gives a black light.
    TriangleLight(TriangleMesh mesh, const Emission& emission, bool normalize_by_area,
                  const FlatProfile& profile = {})
        : profile_(profile) {
        const std::vector<Vec3f>& p = mesh.positions[0];
        const std::size_t n = mesh.indices.size() / 3;
        std::vector<float> areas(n);
        double sum = 0;
        faces_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3f a = p[mesh.indices[3 * i]], b = p[mesh.indices[3 * i + 1]],
                        c = p[mesh.indices[3 * i + 2]];
            const Vec3f double_area = cross(b - a, c - a);
            areas[i] = length(double_area) * 0.5F;
            faces_[i].normal = normalize(double_area);
            sum += static_cast<double>(areas[i]);
        }
        area_ = static_cast<float>(sum);
        geometry_.data = std::move(mesh);
        if (!(area_ > kMinLightArea) || !std::isfinite(area_)) {
            area_ = 0;
            return;
        }
        emission_ = emission.scaled(normalize_by_area ? 1 / area_ : 1);
        // The density that the table really has, rounding and all: large meshes have triangles below its resolution.
        choice_ = Distribution1D(areas);
        for (std::size_t i = 0; i < n; ++i)
            faces_[i].pdf_area = areas[i] > 0 ? choice_.probability(i) / areas[i] : 0;
        set_bounds(areas);
    }

    [[nodiscard]] float area() const { return area_; }

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        if (!(area_ > 0)) return {};
        const TriangleMesh& mesh = std::get<TriangleMesh>(geometry_.data);
        const Distribution1D::Sample pick = choice_.sample(u.x);
        const Vec2f b = sample_uniform_triangle({pick.remapped, u.y});
        const std::vector<Vec3f>& p = mesh.positions[0];
        const std::uint32_t* corner = &mesh.indices[3 * pick.index];
        const Vec3f on = p[corner[0]] * b.x + p[corner[1]] * b.y + p[corner[2]] * (1 - b.x - b.y);
        Vec2f uv;
        if (!mesh.uvs.empty()) {
            const std::uint32_t* t = &mesh.uv_indices[3 * pick.index];
            uv = mesh.uvs[t[0]] * b.x + mesh.uvs[t[1]] * b.y + mesh.uvs[t[2]] * (1 - b.x - b.y);
        }
        const LightEval eval = at(from, on, pick.index, uv);
        const float distance = length(on - from);
        if (!(eval.pdf > 0)) return {};
        return {(on - from) / distance, distance, eval.radiance, eval.pdf, false};
    }

    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& hit) const override {
        return area_ > 0 ? at(from, hit.position, hit.primitive, hit.uv) : LightEval{};
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override {
        return area_ > 0 ? &geometry_ : nullptr;
    }
    [[nodiscard]] LightBounds bounds() const override { return bounds_; }

  private:
    struct Face {
        Vec3f normal;
        float pdf_area = 0;  ///< of choosing a point of this triangle, per area
    };

    [[nodiscard]] LightEval at(Vec3f from, Vec3f on, std::size_t triangle, Vec2f uv) const {
        const Face& face = faces_[triangle];
        const Vec3f back = from - on;
        const float distance_squared = length_squared(back);
        const float facing = dot(face.normal, back);  // distance * cos
        if (!(facing > 0)) return {};
        const float distance = std::sqrt(distance_squared);
        const float pdf = face.pdf_area * (distance_squared * distance / facing);
        const float factor = profile_.at(face.normal, back, uv);
        if (!std::isfinite(pdf) || !(factor > 0)) return {};
        return {emission_.at(on, face.normal, uv) * factor, pdf};
    }

    /// The cone of normals around their mean, and the most area that is seen from one side along an axis.
    void set_bounds(const std::vector<float>& areas) {
        Vec3f mean{};
        std::array<float, 6> seen{};
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const Vec3f directed = faces_[i].normal * areas[i];
            mean += directed;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float along = directed[static_cast<int>(axis)];
                seen[2 * axis + (along > 0 ? 0 : 1)] += std::abs(along);
            }
        }
        for (const Vec3f p : std::get<TriangleMesh>(geometry_.data).positions[0])
            bounds_.box.grow(p);
        bounds_.axis = normalize(mean);
        bounds_.cos_spread = 1;
        for (std::size_t i = 0; i < faces_.size(); ++i)
            if (areas[i] > 0)
                bounds_.cos_spread =
                    std::min(bounds_.cos_spread, dot(faces_[i].normal, bounds_.axis));
        // Normals are rounded too: leave room, but keep a flat light flat.
        bounds_.cos_spread =
            bounds_.cos_spread > 1 - 1e-6F ? 1 : std::max(-1.0F, bounds_.cos_spread - 1e-6F);
        float most = length(mean);
        for (const float s : seen)
            most = std::max(most, s);
        bounds_.intensity = emission_.magnitude() * most * profile_.spread.peak();
        bounds_.cos_emission = profile_.spread.cosine();
    }

    ShapeGeometry geometry_;
    std::vector<Face> faces_;
    Distribution1D choice_;
    Emission emission_;
    FlatProfile profile_;
    LightBounds bounds_;
    float area_ = 0;
};

}  // namespace lightsieve
