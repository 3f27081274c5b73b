// Finds what rays meet. Embree 3 is used here and nowhere else.
//
// Objects are geometries placed in the world. A geometry that is placed once is stored in world space; one that is
// placed often is stored once and instanced. Motion keys are spread evenly over the shutter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/matrix.h"
#include "render/ray.h"
#include "scene/shape.h"

namespace lightsieve {

/// How far from the origin rays may begin, and how much the inverse of a placement may magnify or move. Embree ends the program
/// at rays beyond 1.8e18, also within a placement: kRayReach * kMaxMagnification * 3 + kMaxUndoneShift is less.
inline constexpr float kRayReach = 1e10F, kMaxMagnification = 1e7F, kMaxUndoneShift = 1e17F;

/// One placed geometry.
struct AccelObject {
    const ShapeGeometry* geometry = nullptr;  ///< keys over the shutter; must outlive the Accel
    std::span<const Mat4f>
        world_from_object;   ///< at least one; keys over the shutter; within kMaxMagnification
    std::uint32_t mask = 0;  ///< rays with a common bit see it
};

class Accel {
  public:
    /// objects  RayHit::object is an index into this list
    /// isa      "", "sse2", "avx2" or "avx512": pins Embree's kernels, for equal bits on unlike machines
    /// sparse   most rays are expected to meet nothing (lights): a few boxes are looked at first
    /// Throws InputError (limit-memory) if the structure does not fit into memory.
    Accel(std::span<const AccelObject> objects, const std::string& isa, bool sparse = false);
    ~Accel();
    Accel(const Accel&) = delete;
    Accel& operator=(const Accel&) = delete;

    /// The nearest hit with t_min <= t <= t_max of an object whose mask has a bit of `mask`.
    [[nodiscard]] bool intersect(const Ray& ray, std::uint32_t mask, RayHit& hit) const noexcept;
    /// Whether anything lies between t_min and t_max.
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t mask) const noexcept;
    /// Bounds of everything that has an end (planes have none), over the whole shutter; empty if there is nothing.
    [[nodiscard]] Box3f bounds() const;
    [[nodiscard]] bool empty() const;
    /// What Embree holds [bytes].
    [[nodiscard]] std::size_t memory() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lightsieve
