// trace_set: a shader whose rays meet a set of shapes only.
#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

struct TraceSet {
    ShaderRef passthrough;
    Name trace_set;
    bool inclusive = true;

    static NodeType describe() {
        Describe<TraceSet> d("trace_set", NodeKind::Shader,
                             "A shader whose rays meet a set of shapes only.");
        d.param("passthrough", &TraceSet::passthrough, "The shader.");
        d.param("trace_set", &TraceSet::trace_set, "The set; its rays meet everything so far.")
            .pending();
        d.param("inclusive", &TraceSet::inclusive, "Acts with trace_set.").ignored();
        return d.done();
    }
    void eval(const ShadePoint& at, ClosureSet& out) const { passthrough.closures(at, out); }
};

}  // namespace

NodeType node_trace_set() { return TraceSet::describe(); }

}  // namespace lightsieve
