// The vocabulary of light path events, shared by the engine (lpe), the closures (bsdf) and the renderer.
//
// One event is a kind, a lobe and a set of labels; the reference page's letters are in the comments.
// Only the standard library: the engine is embedded in other renderers.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace lightsieve {

enum class EventKind : std::uint8_t {
    Camera,        ///< C
    Reflection,    ///< R
    Transmission,  ///< T
    Volume,        ///< V
    Light,         ///< L, terminal
    Object,        ///< O, terminal
    Background,    ///< B, terminal
    Albedo,        ///< A, terminal: a probe, not light
};

enum class EventLobe : std::uint8_t {
    None,      ///< camera, volume and terminal events
    Diffuse,   ///< D
    Specular,  ///< S
};

/// What happened at one vertex of a path.
struct Event {
    EventKind kind = EventKind::Camera;
    EventLobe lobe = EventLobe::None;
    /// Lobe label, object label; for Light and Background exactly the light's group (or none for Background).
    /// Sorted, no duplicates.
    std::vector<std::string> labels{};

    friend auto operator<=>(const Event&, const Event&) = default;
    friend bool operator==(const Event&, const Event&) = default;
};

[[nodiscard]] constexpr bool is_terminal(EventKind kind) { return kind >= EventKind::Light; }

}  // namespace lightsieve
