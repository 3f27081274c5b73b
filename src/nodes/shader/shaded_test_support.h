// For tests of surfaces: what a shader makes of one hit.
#pragma once

#include <array>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

struct Shaded {
    /// cosine  of the angle at which the surface is seen
    explicit Shaded(const TestNode& node, float cosine = 1) {
        at.wo = {safe_sqrt(1 - cosine * cosine), 0, cosine};
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
    }
    /// Weighted albedo of a lobe, by its number among the node's.
    [[nodiscard]] Color albedo(int lobe) const {
        Color sum;
        for (std::size_t i = 0; i < set.closures().size(); ++i)
            if (set.closures()[i].record == &records[static_cast<std::size_t>(lobe)])
                sum += set.albedo(i);
        return sum;
    }
    std::array<LobeRecord, 8> records;
    ShadePoint at;
    ClosureSet set;
};

}  // namespace lightsieve
