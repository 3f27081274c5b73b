// Every lobe model that a closure can hold, as one closed set.
//
// A new model is one .h/.cpp pair (see lobe.h for its four functions), one line here and one row in the tests'
// all_lobe_cases(). Constructors clamp and replace what is not finite, so that textures may feed them anything.
// Keep the models small: a ClosureSet holds 24 of them.
#pragma once

#include <type_traits>
#include <variant>

#include "bsdf/burley.h"
#include "bsdf/conductor.h"
#include "bsdf/dielectric.h"
#include "bsdf/diffuse.h"
#include "bsdf/hair.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phase.h"
#include "bsdf/schlick.h"
#include "bsdf/sheen.h"
#include "bsdf/thin_film.h"
#include "bsdf/thin_transmit.h"

namespace lightsieve {

/// One lobe; the first alternative is the cheapest to default-construct.
using LobeModel =
    std::variant<DiffuseReflect, DiffuseTransmit, DielectricReflect, DielectricTransmit,
                 ThinTransmit, ConductorReflect, SchlickReflect, SheenReflect, FilmReflect,
                 FilmedSchlickReflect, HairLobe, BurleyReflect, OrenNayarReflect, PhaseLobe>;

/// Lobes of fibres and of volumes have no sides: light from behind the shading normal counts as much.
[[nodiscard]] inline bool has_no_sides(const LobeModel& model) noexcept {
    return std::holds_alternative<HairLobe>(model) || std::holds_alternative<PhaseLobe>(model);
}

/// Broad lobes take light from most of a hemisphere: where it comes from matters more than what the lobe says.
[[nodiscard]] inline bool is_broad(const LobeModel& model) noexcept {
    return std::holds_alternative<DiffuseReflect>(model) ||
           std::holds_alternative<DiffuseTransmit>(model) ||
           std::holds_alternative<BurleyReflect>(model) ||
           std::holds_alternative<OrenNayarReflect>(model) ||
           std::holds_alternative<SheenReflect>(model);
}

/// Diffuse reflection by Arnold's diffuse_roughness.
[[nodiscard]] inline LobeModel rough_diffuse(Color color, float roughness) noexcept {
    if (roughness > 0) return OrenNayarReflect(color, roughness);
    return DiffuseReflect(color);
}

/// std::visit, with a short way for the lobe that most surfaces have.
template <class Visitor>
[[nodiscard]] inline decltype(auto) visit_lobe(const Visitor& visitor, const LobeModel& model) {
    if (const auto* diffuse = std::get_if<DiffuseReflect>(&model)) return visitor(*diffuse);
    return std::visit(visitor, model);
}

static_assert(std::is_trivially_copyable_v<LobeModel>);
static_assert(sizeof(LobeModel) <= 64, "closures are copied at every hit");

}  // namespace lightsieve
