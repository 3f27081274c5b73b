// switch_rgba: one of twenty colours, by number.
#include <array>
#include <string>

#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

constexpr std::size_t kInputs = 20;

struct SwitchRgba {
    std::int32_t index = 0;
    std::array<Lazy<Rgba>, kInputs> input;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint& at) const {
        constexpr auto kLast = static_cast<std::int32_t>(kInputs) - 1;
        return input[static_cast<std::size_t>(std::clamp(index, 0, kLast))].at(at);
    }
};

NodeType SwitchRgba::describe() {
    Describe<SwitchRgba> d("switch_rgba", NodeKind::Shader, "One of twenty colours, by number.");
    d.param("index", &SwitchRgba::index, "Number of the input that is shown.").range(0, 19);
    for (std::size_t i = 0; i < kInputs; ++i)
        d.part(
            "input" + std::to_string(i), [=](SwitchRgba& p) -> Lazy<Rgba>& { return p.input[i]; },
            "Colour for index " + std::to_string(i) + ".");
    return d.done();
}

}  // namespace

NodeType node_switch_rgba() { return SwitchRgba::describe(); }

}  // namespace lightsieve
