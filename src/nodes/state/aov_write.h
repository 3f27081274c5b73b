// What the aov_write_* nodes share: a shader as it is, and a value that goes into an AOV beside it.
#pragma once

#include "nodes/closure/closure_common.h"
#include "scene/shade_services.h"

namespace lightsieve {

template <class T>
struct AovWrite {
    ShaderRef passthrough;
    T aov_input{};
    Name aov_name;
    std::uint32_t number = 0;  ///< of the AOV, found by prepare()

    void prepare(NodeContext& context) {
        if (!aov_name.empty()) number = context.written_aov(aov_name);
    }
    /// Writes where the camera looks, and does what the shader does.
    void write(const ShadePoint& at, ClosureSet& out, ShaderValue value, bool blend) const {
        if (!aov_name.empty() && at.ray != nullptr && at.ray->written != nullptr)
            at.ray->written[number] = {value, true, blend};
        passthrough.closures(at, out);
    }
};

template <class T>
void describe_aov_write(Describe<T>& d) {
    d.param("passthrough", &T::passthrough, "The shader beside which the AOV is written.");
    d.param("aov_input", &T::aov_input, "What is written.");
    d.param("aov_name", &T::aov_name, "The AOV that it is written into.");
}

}  // namespace lightsieve
