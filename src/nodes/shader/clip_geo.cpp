// clip_geo: a closed shape with this shader cuts away what lies inside of it.
//
// The renderer does the cutting (render/cutting.h); what is computed here is the look of the cut, where the shape's own surface
// runs through what it cuts.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct ClipGeo {
    ShaderRef intersection;
    Name trace_set;
    bool inclusive = true;

    static NodeType describe() {
        Describe<ClipGeo> d("clip_geo", NodeKind::Shader,
                            "A closed shape with this shader is not seen: it cuts away what lies "
                            "inside of it.");
        d.param("intersection", &ClipGeo::intersection,
                "Shader of the faces where closed shapes are cut; none: one sees their insides.");
        d.param("trace_set", &ClipGeo::trace_set,
                "The shapes that are cut, by their trace_sets; empty: all.");
        d.param("inclusive", &ClipGeo::inclusive,
                "Cut is what is in trace_set; off: what is not.");
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const { intersection.closures(at, out); }
};

}  // namespace

NodeType node_clip_geo() { return ClipGeo::describe(); }

}  // namespace lightsieve
