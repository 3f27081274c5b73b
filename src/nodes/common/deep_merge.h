// The samples of one deep pixel, from nearest to farthest, merged where that loses little.
//
// What arrives adds up (scene/driver.h); what deep files hold is composited: a sample's opacity and colour are in relation to
// what those before it let through. So opacities are divided by what is left, and a flattened file is the flat picture.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

/// How far samples may be merged.
struct DeepTolerance {
    bool merge = true;
    float depth = 0.01F;  ///< samples that lie within it are one [scene units]
    float alpha =
        0.01F;  ///< so are those whose opacity, summed along the ray, is a straight line but for this
    std::span<const float> values;  ///< the same for values, one each; below 0: they do not matter
};

/// Samples of a pixel as a file holds them.
struct DeepRun {
    std::vector<float> front, back;  ///< depths: where a sample begins and ends
    std::vector<float> alpha;        ///< in relation to what those before it let through
    std::vector<float> values;       ///< n_values each, the same
};

/// depths, opacities, values  of one pixel as in a DeepBucket, in any order
[[nodiscard]] DeepRun merge_deep(std::span<const float> depths, std::span<const Color> opacities,
                                 std::span<const float> values, std::size_t n_values,
                                 const DeepTolerance& tolerance);

}  // namespace lightsieve
