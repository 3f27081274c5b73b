// subsurface_bsdf: light that wanders below the surface.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct Subsurface : ScatterCommon {
    Color color{0.18F, 0.18F, 0.18F}, radius{1, 1, 1};
    float anisotropy = 0;

    static NodeType describe() {
        Describe<Subsurface> d("subsurface_bsdf", NodeKind::Shader,
                               "Scattering below the surface.");
        d.lobe_below_surface(0, "Subsurface scattering.");
        d.param("color", &Subsurface::color, "Reflectance of what comes back.").range(0, 1);
        d.param("radius", &Subsurface::radius, "Mean free path, a channel each.")
            .unit("scene units");
        d.param("anisotropy", &Subsurface::anisotropy,
                "Mean cosine of the scattering: above 0 light goes on forward.")
            .range(-1, 1);
        describe_scatter(d);
        return d.done();
    }

    void eval(const ShadePoint& at, ClosureSet& out) const {
        add_below_surface(out, 0, positive(color), positive(radius), anisotropy,
                          Color::grey(unit(weight)), frame(at, out));
    }
};

}  // namespace

NodeType node_subsurface_bsdf() { return Subsurface::describe(); }

}  // namespace lightsieve
