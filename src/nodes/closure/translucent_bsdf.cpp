// translucent_bsdf: diffuse transmission through a sheet.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Translucent : ScatterCommon {
    Color color{1, 1, 1};

    static NodeType describe() {
        Describe<Translucent> d("translucent_bsdf", NodeKind::Shader,
                                "Diffuse transmission through a sheet without thickness.");
        d.lobe(0, EventKind::Transmission, EventLobe::Diffuse, "", "Diffuse transmission.");
        d.param("color", &Translucent::color, "Transmittance.").range(0, 1);
        describe_scatter(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        out.add(0, DiffuseTransmit(positive(color)), Color::grey(unit(weight)), frame(at, out),
                true);
    }
};

}  // namespace

NodeType node_translucent_bsdf() { return Translucent::describe(); }

}  // namespace lightsieve
