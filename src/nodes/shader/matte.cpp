// matte: a hole in the picture, or a colour with an alpha of its own.
#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct Matte {
    Rgba color{{0, 0, 0}, 0};
    Color opacity{1, 1, 1};
    ShaderRef passthrough;

    static NodeType describe() {
        Describe<Matte> d("matte", NodeKind::Shader,
                          "A hole in the picture: a colour, by default black, with an alpha of "
                          "its own, by default 0.");
        d.param("color", &Matte::color, "What is seen, unlit, and its alpha.");
        d.param("opacity", &Matte::opacity, "Below 1, rays pass straight through for the rest.")
            .range(0, 1);
        d.param("passthrough", &Matte::passthrough,
                "Shader that is run for the AOVs that it writes.");
        d.lobe(0, EventKind::Object, EventLobe::None, "", "The colour.");
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        if (passthrough) {
            // What it looks like goes nowhere.
            ClosureSet unseen;
            unseen.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
            passthrough.closures(at, unseen);
        }
        const Color visible = unit(opacity);
        out.transparent(kWhite - visible);
        out.matte(visible * (1 - unit(color.a)));
        if (const Color seen = visible * positive(color.rgb); !is_black(seen)) out.emit(0, seen);
    }
};

}  // namespace

NodeType node_matte() { return Matte::describe(); }

}  // namespace lightsieve
