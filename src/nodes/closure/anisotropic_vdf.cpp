// anisotropic_vdf: a medium that absorbs and scatters; on a volume, or as the base of a layer below a surface.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct AnisotropicVdf {
    Color absorption{0, 0, 0}, scattering{0, 0, 0};
    float anisotropy = 0;
    Name label;

    static NodeType describe() {
        Describe<AnisotropicVdf> d("anisotropic_vdf", NodeKind::Shader,
                                   "A medium that absorbs and scatters.");
        d.fills_volumes();
        d.lobe(0, EventKind::Volume, EventLobe::None, "", "Scattering.");
        d.param("absorption", &AnisotropicVdf::absorption, "Absorption coefficient.")
            .unit("1 / scene unit");
        d.param("scattering", &AnisotropicVdf::scattering, "Scattering coefficient.")
            .unit("1 / scene unit");
        d.param("anisotropy", &AnisotropicVdf::anisotropy,
                "Mean cosine of the scattering: above 0 light goes on forward.")
            .range(-1, 1);
        d.param("label", &AnisotropicVdf::label, "Joins the event, as in C<V.'haze'>.*.");
        return d.done();
    }

    void eval(const ShadePoint&, ClosureSet& out) const {
        out.add_medium(0, positive(absorption), positive(scattering), Phase(anisotropy));
    }
};

}  // namespace

NodeType node_anisotropic_vdf() { return AnisotropicVdf::describe(); }

}  // namespace lightsieve
