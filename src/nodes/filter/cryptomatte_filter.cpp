// cryptomatte_filter: how Arnold's cryptomatte shader has its layers filtered; scenes that were written out again name it.
//
// Here every matte is filtered with the weights of its output's filter, so the node is such a filter: one of six kinds.
#include "nodes/common/filter_weights.h"

namespace lightsieve {
namespace {

enum class MatteMode : std::int32_t { DoubleRgba };

struct CryptomatteFilter {
    float width = 2;
    std::int32_t rank = -1;
    FilterWeights filter = FilterWeights::Gaussian;
    MatteMode mode = MatteMode::DoubleRgba;
    bool noop = false;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<PixelFilter> make_filter(NodeContext&) const {
        return make_weights(filter, filter == FilterWeights::Box ? 1 : width);
    }
};

NodeType CryptomatteFilter::describe() {
    using Node = CryptomatteFilter;
    Describe<Node> d("cryptomatte_filter", NodeKind::Filter,
                     "Filters a layer of a Cryptomatte; chosen by its shader, not by people.");
    d.param("width", &Node::width, "Width of the support; a box is one pixel wide.")
        .unit("pixels")
        .hard_range(0.01F, 64);
    d.param("rank", &Node::rank,
            "Of the first of the layer's two ids, the greatest first; below 0: by the name of the "
            "output, whose last two digits are half of it.");
    d.param("filter", &Node::filter, "The weights of samples.").names(filter_weight_names());
    d.param("mode", &Node::mode, "How ids are stored.").names({"double_rgba"}).ignored();
    d.param("noop", &Node::noop, "The output stays out of EXR files: it only stands for a matte.");
    return d.done();
}

}  // namespace

NodeType node_cryptomatte_filter() { return CryptomatteFilter::describe(); }

}  // namespace lightsieve
