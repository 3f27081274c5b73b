// The eight AOVs that a surface shader may write a colour into, as standard_surface and standard_hair have them.
#pragma once

#include <array>
#include <string>

#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_services.h"

namespace lightsieve {

/// Parameters `aov_id1`, `id1`, ... A shader calls `prepare_ids` from its prepare and `write_ids` from its eval.
struct IdAovs {
    static constexpr std::size_t kIds = 8;
    Name aov_id1, aov_id2, aov_id3, aov_id4, aov_id5, aov_id6, aov_id7, aov_id8;
    Color id1, id2, id3, id4, id5, id6, id7, id8;
    std::array<std::uint32_t, kIds> id_numbers{};  ///< of the AOVs that have a name
    bool writes_ids = false;

    void prepare_ids(NodeContext& context) {
        const std::array aovs{aov_id1, aov_id2, aov_id3, aov_id4,
                              aov_id5, aov_id6, aov_id7, aov_id8};
        for (std::size_t i = 0; i < kIds; ++i) {
            if (aovs[i].empty()) continue;
            id_numbers[i] = context.written_aov(aovs[i]);
            writes_ids = true;
        }
    }
    /// Writes where the camera looks; behind transparent surfaces the AOVs go on, by opacity.
    void write_ids(const ShadePoint& at) const {
        if (!writes_ids || at.ray == nullptr || at.ray->written == nullptr) return;
        const std::array aovs{aov_id1, aov_id2, aov_id3, aov_id4,
                              aov_id5, aov_id6, aov_id7, aov_id8};
        const std::array colors{id1, id2, id3, id4, id5, id6, id7, id8};
        for (std::size_t i = 0; i < kIds; ++i)
            if (!aovs[i].empty()) at.ray->written[id_numbers[i]] = {{colors[i], 1}, true, true};
    }
};

template <class T>
void describe_ids(Describe<T>& d) {
    constexpr std::array names{&T::aov_id1, &T::aov_id2, &T::aov_id3, &T::aov_id4,
                               &T::aov_id5, &T::aov_id6, &T::aov_id7, &T::aov_id8};
    constexpr std::array colors{&T::id1, &T::id2, &T::id3, &T::id4,
                                &T::id5, &T::id6, &T::id7, &T::id8};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string id = "id" + std::to_string(i + 1), aov = "aov_" + id;
        d.param(aov.c_str(), names[i], "AOV into which " + id + " is written.");
        d.param(id.c_str(), colors[i], "Colour for " + aov + ".");
    }
}

}  // namespace lightsieve
