// cache: a colour as it is. Arnold keeps it, so that a network that uses it often computes it once; here that is no need of
// correctness.
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct Cache {
    Color input;

    static NodeType describe() {
        Describe<Cache> d("cache", NodeKind::Shader, "A colour as it is.");
        d.param("input", &Cache::input, "The colour.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const { return input; }
};

}  // namespace

NodeType node_cache() { return Cache::describe(); }

}  // namespace lightsieve
