// chiang_hair_bsdf: the fibre of hair and fur, each path with a tint and widths of its own.
#include "nodes/closure/closure_common.h"
#include "nodes/shader/hair_common.h"

namespace lightsieve {
namespace {

struct ChiangHair : ScatterCommon {
    Color tint_R{1, 1, 1}, tint_TT{1, 1, 1}, tint_TRT{1, 1, 1};
    float ior = 1.55F;
    Vec2f roughness_R{0.1F, 0.1F}, roughness_TT{0.05F, 0.05F}, roughness_TRT{0.2F, 0.2F};
    float cuticle_angle = 0.5F;
    Vec3f absorption_coefficient{0, 0, 0};
    Vec3f curve_direction{0, 0, 0};  ///< world space; acts only when linked

    void prepare(NodeContext& context) {
        ScatterCommon::prepare(context);
        if (!context.is_linked("curve_direction")) curve_direction = {};
    }

    static NodeType describe() {
        using C = ChiangHair;
        Describe<C> d("chiang_hair_bsdf", NodeKind::Shader,
                      "A fibre of hair or fur: reflection, transmission, reflection inside.");
        d.lobe(0, EventKind::Reflection, EventLobe::Specular, "hair", "Reflection, R.");
        d.lobe(1, EventKind::Transmission, EventLobe::Specular, "hair", "Transmission, TT.");
        d.lobe(2, EventKind::Reflection, EventLobe::Specular, "hair",
               "Reflection inside of the fibre, TRT and longer paths.");
        d.param("tint_R", &C::tint_R, "Factor on R.").range(0, 1);
        d.param("tint_TT", &C::tint_TT, "Factor on TT.").range(0, 1);
        d.param("tint_TRT", &C::tint_TRT, "Factor on TRT and longer paths.").range(0, 1);
        d.param("ior", &C::ior, "Index of refraction of the fibre.").range(1, 3);
        d.param("roughness_R", &C::roughness_R,
                "Widths of R: variance along the fibre, logistic scale around it.")
            .range(0, 1);
        d.param("roughness_TT", &C::roughness_TT, "Widths of TT.").range(0, 1);
        d.param("roughness_TRT", &C::roughness_TRT, "Widths of TRT.").range(0, 1);
        d.param("cuticle_angle", &C::cuticle_angle,
                "Tilt of the scales: 0 to 1 is -90 to 90 degrees, 0.5 none.")
            .range(0, 1);
        d.param("absorption_coefficient", &C::absorption_coefficient,
                "Absorption inside of the fibre, per radius.");
        d.param("curve_direction", &C::curve_direction,
                "Direction of the fibre, world space; acts when linked.");
        describe_scatter(d, false);
        return d.done();
    }

    /// Fibres that are not curves lie along the tangent.
    [[nodiscard]] static bool reads_coordinates() { return true; }
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const HairFibre fibre(at, out, curve_direction);
        const Color absorption{absorption_coefficient.x, absorption_coefficient.y,
                               absorption_coefficient.z};
        const float shift = unit(cuticle_angle) * kPi - 0.5F * kPi;
        const auto add = [&](int lobe, HairPath path, Color tint, Vec2f width) {
            out.add(lobe, HairLobe(path, {width.x, width.y}, ior, absorption, shift, fibre.offset),
                    unit(weight) * positive(tint), fibre.frame, true);
        };
        add(0, HairPath::R, tint_R, roughness_R);
        add(1, HairPath::TT, tint_TT, roughness_TT);
        add(2, HairPath::TRT, tint_TRT, roughness_TRT);
        add(2, HairPath::Rest, tint_TRT, roughness_TRT);
    }
};

}  // namespace

NodeType node_chiang_hair_bsdf() { return ChiangHair::describe(); }

}  // namespace lightsieve
