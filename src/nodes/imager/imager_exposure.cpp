// imager_exposure: brighter or darker by stops.
#include <cmath>

#include "nodes/imager/imager_common.h"

namespace lightsieve {
namespace {

struct ImagerExposure : ImagerCommon {
    float exposure = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Imager> make_imager(NodeContext& context) const {
        return make_imager_of(*this, context,
                              [gain = std::exp2(exposure)](Color c) { return c * gain; });
    }
};

NodeType ImagerExposure::describe() {
    Describe<ImagerExposure> d("imager_exposure", NodeKind::Imager,
                               "Makes the written picture brighter or darker.");
    describe_imager_common(d);
    d.param("exposure", &ImagerExposure::exposure, "Each stop doubles the light.")
        .unit("stops")
        .hard_range(-100, 100);
    return d.done();
}

}  // namespace

NodeType node_imager_exposure() { return ImagerExposure::describe(); }

}  // namespace lightsieve
