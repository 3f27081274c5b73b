// complex_ior: the colour of a metal by the angle under which it is seen, for specular colours of the old `standard`.
//
// Presets are the optical constants at 650, 550 and 450 nm of Palik's Handbook of Optical Constants of Solids (1985) and
// Johnson and Christy (1972), as commonly tabulated. Presets without figures here take the colours, and say so.
#include <optional>

#include "bsdf/conductor.h"
#include "bsdf/fresnel.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class Metal : std::int32_t {
    Custom,
    Aluminium,
    Copper,
    Gold,
    Iron,
    Lead,
    Magnesium,
    Mercury,
    Nickel,
    Platinum,
    Silver,
    Sodium
};
enum class ControlMode : std::int32_t { Artistic, Physical };

struct Constants {
    Color n, k;
};
std::optional<Constants> constants_of(Metal metal) {
    switch (metal) {
        case Metal::Aluminium:
            return Constants{{1.3456F, 0.96521F, 0.61722F}, {7.4746F, 6.3995F, 5.3031F}};
        case Metal::Copper:
            return Constants{{0.27105F, 0.67693F, 1.3164F}, {3.6092F, 2.6248F, 2.2921F}};
        case Metal::Gold:
            return Constants{{0.18299F, 0.42108F, 1.3734F}, {3.4242F, 2.3459F, 1.7704F}};
        case Metal::Iron:
            return Constants{{2.9114F, 2.9497F, 2.5845F}, {3.0893F, 2.9318F, 2.767F}};
        case Metal::Lead: return Constants{{1.91F, 1.83F, 1.44F}, {3.51F, 3.4F, 3.18F}};
        case Metal::Mercury:
            return Constants{{2.0733F, 1.5523F, 1.0606F}, {5.3383F, 4.651F, 3.8628F}};
        case Metal::Platinum:
            return Constants{{2.3757F, 2.0847F, 1.8453F}, {4.2655F, 3.7153F, 3.1365F}};
        case Metal::Silver:
            return Constants{{0.15943F, 0.14512F, 0.13547F}, {3.9291F, 3.19F, 2.3808F}};
        default: return std::nullopt;
    }
}

struct ComplexIor {
    Metal material = Metal::Custom;
    ControlMode mode = ControlMode::Artistic;
    Color reflectivity{0.925952F, 0.720866F, 0.504154F}, edgetint{0.995506F, 0.957331F, 0.822776F};
    Vec3f n{0.27105F, 0.67693F, 1.3164F}, k{3.60920F, 2.62480F, 2.29210F};

    static NodeType describe();
    void prepare(NodeContext& context) const;
    [[nodiscard]] Color eval(const ShadePoint& at) const;
};

NodeType ComplexIor::describe() {
    Describe<ComplexIor> d("complex_ior", NodeKind::Shader,
                           "Reflectance of a metal under the angle at which it is seen.");
    d.param("material", &ComplexIor::material, "A metal; custom: by the other parameters.")
        .names({"custom", "aluminium", "copper", "gold", "iron", "lead", "magnesium", "mercury",
                "nickel", "platinum", "silver", "sodium"});
    d.param("mode", &ComplexIor::mode,
            "artistic: by reflectivity and edgetint; physical: by n and k.")
        .names({"artistic", "physical"});
    d.param("reflectivity", &ComplexIor::reflectivity, "Reflectance face on.");
    d.param("edgetint", &ComplexIor::edgetint, "Tint toward the edge; 1 is the brightest.");
    d.param("n", &ComplexIor::n, "Index of refraction for red, green and blue.");
    d.param("k", &ComplexIor::k, "Extinction for red, green and blue.");
    return d.done();
}

void ComplexIor::prepare(NodeContext& context) const {
    if (material == Metal::Custom || constants_of(material)) return;
    context.diagnostics().warning(
        Code::ParamPending, "the constants of that metal are not known here",
        context.where("material"), "the shader goes by its colours, or by n and k");
}

Color ComplexIor::eval(const ShadePoint& at) const {
    const float cosine = unit(std::abs(dot(at.normal, at.wo)));
    if (const auto metal = constants_of(material))
        return fresnel_conductor(cosine, metal->n, metal->k);
    const ConductorReflect metal =
        mode == ControlMode::Physical
            ? ConductorReflect({}, {n.x, n.y, n.z}, {k.x, k.y, k.z})
            : ConductorReflect::from_artistic({}, reflectivity, edgetint);
    return fresnel_conductor(cosine, metal.n, metal.k);
}

}  // namespace

NodeType node_complex_ior() { return ComplexIor::describe(); }

}  // namespace lightsieve
