// What a lobe model is. One file a model; a model is a small trivially copyable struct with four functions:
//
//     LobeEval eval(Vec3f wo, Vec3f wi) const noexcept;                 value and density together
//     LobeSample sample(Vec3f wo, Vec2f u, float u_choice) const noexcept;
//     Color albedo(Vec3f wo) const noexcept;                            directional albedo, for layering, probes and picking
//     bool delta() const noexcept;                                      can never be evaluated for a given direction
//
// All directions are unit, local (z = normal) and leave the surface; wo.z > 0 always (the frame is flipped to the
// side of wo), wi.z < 0 is transmission. Values are f * |wi.z|, without the closure's weight.
#pragma once

#include "core/vec.h"

namespace lightsieve {

struct LobeEval {
    Color f;        ///< f(wo, wi) * |cos theta_i| [1/sr]; black for delta lobes
    float pdf = 0;  ///< per solid angle [1/sr] with which sample() returns wi; 0 for delta lobes
};

struct LobeSample {
    Vec3f wi;
    /// Delta lobes: f * |cos| / pdf, i.e. the weight. Otherwise f * |cos| as eval() gives it.
    Color f;
    float pdf = 0;  ///< per solid angle; 1 for delta lobes; 0: the sample failed
};

}  // namespace lightsieve
