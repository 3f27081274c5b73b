#include "render/statistics.h"

namespace lightsieve {

std::vector<std::pair<std::string_view, std::size_t>> MemoryUse::by_name() const {
    return {{"geometry", geometry}, {"accel", accel},
            {"volumes", volumes},   {"textures", textures},
            {"automata", automata}, {"guide", guide},
            {"film", film},         {"layers", layers},
            {"output", output},     {"checkpoint", checkpoint},
            {"other", other}};
}

std::size_t MemoryUse::total() const {
    std::size_t sum = 0;
    for (const auto& [name, bytes] : by_name())
        sum += bytes;
    return sum;
}

}  // namespace lightsieve
