// A walk below the surface, from where light (followed backwards) goes in to where it comes out.
//
// Distances and channels are chosen by the mixture of the three channels' densities, so that no channel is noisier than it
// must be, and the walk stays unbiased for each. Boundaries are the object's own; other things inside it do not matter.
// Source: Chiang, Kutz and Burley 2016, "Practical and Controllable Subsurface Scattering for Production Path Tracing";
// the mixture of channels is Veach's balance heuristic (1997, eq. 9.8).
#pragma once

#include <cstdint>
#include <optional>

#include "bsdf/subsurface.h"
#include "core/sobol.h"
#include "render/scene.h"
#include "render/surface.h"

namespace lightsieve {

/// Where a walk comes out.
struct WalkExit {
    Surface surface;
    Vec3f outside;     ///< unit geometric normal away from the inside
    Vec3f normal;      ///< unit shading normal on that side
    Color throughput;  ///< of the walk
};

/// Walks from `entry` into the side away from its viewer.
///
/// u_entry  direction into the medium, cosine-weighted
/// sampler  gives the walk's numbers, from streams that begin with `stream`
/// n_rays   grows by the rays that were traced
/// Curves have no inside: there the light comes out where it went in, with the medium's reflectance.
/// Nothing if the light is absorbed. A walk that does not end comes out where it went in: energy is kept.
[[nodiscard]] std::optional<WalkExit> walk_below(const Scene& scene, const Surface& entry,
                                                 const SubsurfaceMedium& medium, Vec2f u_entry,
                                                 const Sampler& sampler, std::uint32_t stream,
                                                 std::uint64_t& n_rays);

}  // namespace lightsieve
