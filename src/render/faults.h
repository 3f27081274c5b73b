// Faults that can be built in on purpose, to show that the tests would notice them.
//
// Each is a mistake that a renderer of AOVs can make and still show the right beauty. Compiled in only with
// LIGHTSIEVE_FAULT_INJECTION, for render_mutants_test; otherwise `active_fault` is a constant and every hook vanishes.
#pragma once

#include <cstdint>

namespace lightsieve {

enum class Fault : std::uint8_t {
    None,
    CoatAsSpecular,         ///< the coat's lobe loses its label
    DrawnLobeTakesAll,      ///< the lobe that a direction was drawn from takes the whole sample
    TransmissionAsDiffuse,  ///< specular transmission makes the event TD
    LightHitAsObject,       ///< a light that a ray met counts as an emissive object
    DepthFromDrawnLobe,  ///< depth counters and ray type go by the lobe that a direction was drawn from
};

#ifdef LIGHTSIEVE_FAULT_INJECTION
/// Set by the test before a scene is compiled.
inline Fault injected_fault = Fault::None;
[[nodiscard]] inline Fault active_fault() { return injected_fault; }
#else
[[nodiscard]] constexpr Fault active_fault() { return Fault::None; }
#endif

}  // namespace lightsieve
