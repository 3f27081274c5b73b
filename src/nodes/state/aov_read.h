// What the aov_read_* nodes share: what was written into an AOV at this hit, before.
//
// Shaders of a surface run first, then options.aov_shaders in their order; each sees what those before it wrote. Where
// the camera does not look nothing is written, and nothing is read.
#pragma once

#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_services.h"

namespace lightsieve {

struct AovRead {
    Name aov_name;
    std::uint32_t number = 0;  ///< of the AOV, found by prepare()

    void prepare(NodeContext& context) {
        if (!aov_name.empty()) number = context.written_aov(aov_name);
    }
    /// 0 where nothing was written.
    [[nodiscard]] ShaderValue read(const ShadePoint& at) const {
        if (aov_name.empty() || at.ray == nullptr || at.ray->written == nullptr)
            return {kBlack, 0};
        const WrittenAov& aov = at.ray->written[number];
        return aov.set ? aov.value : ShaderValue{kBlack, 0};
    }
};

template <class T>
void describe_aov_read(Describe<T>& d) {
    d.param("aov_name", &T::aov_name,
            "The AOV; what an aov_write_* before wrote into it at this hit.");
}

}  // namespace lightsieve
