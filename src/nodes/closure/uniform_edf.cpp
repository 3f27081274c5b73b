// uniform_edf: light that leaves a surface evenly to all sides.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct UniformEdf {
    Color color{1, 1, 1};
    Name label;

    static NodeType describe() {
        Describe<UniformEdf> d("uniform_edf", NodeKind::Shader,
                               "Light that leaves a surface evenly to all sides.");
        d.lobe(0, EventKind::Object, EventLobe::None, "", "Emission.");
        d.param("color", &UniformEdf::color, "Radiance.");
        d.param("label", &UniformEdf::label, "Joins the event, as in C<O.'fire'>.");
        return d.done();
    }

    [[nodiscard]] static bool reads_coordinates() { return false; }
    void eval(const ShadePoint&, ClosureSet& out) const { out.emit(0, positive(color)); }
};

}  // namespace

NodeType node_uniform_edf() { return UniformEdf::describe(); }

}  // namespace lightsieve
