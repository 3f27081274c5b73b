// The common alphabet: what really happens along a path, whatever a renderer calls it.
//
// Dialects differ in what they see of a path: Arnold does not tell a mirror from a rough metal and
// never hears of cut-outs, RenderMan calls a light that the camera sees an emission. So the common
// alphabet is finer than each of them. A *common event* is
//
//     C                       the camera
//     RD RG RS  TD TG TS      reflection, transmission: diffuse, glossy (rough), mirror (delta)
//     V                       scattering in a medium
//     Ts                      straight through a surface, by opacity or presence
//     L O B                   a light, an emission that is no light, the background
//     A                       an albedo probe
//     U2 ...                  what only one renderer has (a user lobe); only where an expression
//                             names it
//
// with a lobe label (`RG'coat'`), an object label (`RD@'hero'`), and for L and B a light group
// (`L'key'`). Every dialect says how it sees each of these (dialect.h); an expression then *is* a
// set of common paths, and translations are compared as such sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lpe/dialects/symbol_set.h"

namespace lightsieve::lpe::dialects {

enum class CommonKind : std::uint8_t {
    Camera,
    Reflection,
    Transmission,
    Volume,
    Straight,  ///< through a surface without scattering
    Foreign,   ///< a scattering event that only one dialect has
    Light,     ///< terminal from here on
    Object,
    Background,
    Probe,
    ForeignEnd,  ///< a terminal event that only one dialect has
};

enum class CommonLobe : std::uint8_t { None, Diffuse, Glossy, Mirror };

struct CommonEvent {
    CommonKind kind = CommonKind::Camera;
    CommonLobe lobe = CommonLobe::None;
    std::string label{};   ///< lobe label; for V and O their own label; empty: none
    std::string object{};  ///< object label; empty: none
    std::string group{};   ///< light group, for L and B; empty: none
    std::string name{};    ///< of a foreign event, as its dialect writes it
    bool seen = false;     ///< L and B: reached from the camera with nothing but Ts between

    friend bool operator==(const CommonEvent&, const CommonEvent&) = default;
};

using CommonPath = std::vector<CommonEvent>;

/// `RG'coat'@'hero'`.
[[nodiscard]] std::string print_event(const CommonEvent& event);
/// `C RD L'key'`.
[[nodiscard]] std::string print_path(std::span<const CommonEvent> path);
/// "a path that leaves the camera, is reflected diffusely, and ends at a light of group 'key'".
[[nodiscard]] std::string describe_path(std::span<const CommonEvent> path);

/// What a proof is to leave out, because the scene has none of it.
enum class Without : std::uint8_t {
    Straight,      ///< nothing is cut out by opacity or presence
    Volumes,       ///< no scattering in media
    Background,    ///< nothing lies behind the scene but lights
    Glossy,        ///< every specular lobe is a perfect mirror or glass
    Mirrors,       ///< no specular lobe is perfect
    ObjectLabels,  ///< no object is labelled
};
inline constexpr std::size_t kWithouts = 6;
/// "straight", "volumes", "background", "glossy", "mirrors", "object-labels".
[[nodiscard]] std::string_view without_name(Without without);
/// What the scene does not have, for people: "nothing in the scene is cut out by opacity".
[[nodiscard]] std::string_view without_meaning(Without without);

/// The names that an alphabet tells apart.
struct CommonNames {
    std::vector<std::string> labels{};        ///< in expressions: each may be any kind of label
    std::vector<std::string> lobes{};         ///< further labels, of lobes only
    std::vector<std::string> foreign{};       ///< further events that scatter
    std::vector<std::string> foreign_ends{};  ///< further events that end a path
};

/// Labels that a proof tells apart.
inline constexpr std::size_t kMaxLabels = 12;

/// Every event that these names make, plain ones first; one label of each kind stands for all that
/// are not named. Event 0 is the camera.
class CommonAlphabet {
  public:
    CommonAlphabet(const CommonNames& names, std::span<const Without> without);

    [[nodiscard]] std::size_t size() const { return events_.size(); }
    [[nodiscard]] const CommonEvent& event(Symbol s) const { return events_[s]; }
    [[nodiscard]] SymbolSet none() const { return SymbolSet(size()); }
    [[nodiscard]] SymbolSet all() const;
    /// The events without what the scene does not have.
    [[nodiscard]] SymbolSet all_without(Without without) const;

    /// The same light or background, seen from the camera or not; any other event itself.
    [[nodiscard]] Symbol twin(Symbol s) const { return twins_[s]; }

    /// States of the automaton of paths: `C`, scattering, one terminal; a probe and a light that
    /// is not seen directly need a vertex before them.
    enum PathState : std::uint8_t { kStart, kAtCamera, kAfterVertex, kEnd, kNoPath, kPathStates };
    [[nodiscard]] PathState step(PathState state, Symbol s) const;

  private:
    void add(CommonEvent event);
    void add_labelled(const CommonEvent& event, std::span<const std::string> labels,
                      std::span<const std::string> objects);

    std::vector<CommonEvent> events_;
    std::vector<Symbol> twins_;
    std::vector<Without> without_;
};

}  // namespace lightsieve::lpe::dialects
