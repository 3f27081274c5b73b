// The eight AOVs that a surface shader may write a colour into, as standard_surface and standard_hair have them.
#pragma once

#include <array>
#include <string>

#include "scene/describe.h"

namespace lightsieve {

struct IdAovs {
    Name aov_id1, aov_id2, aov_id3, aov_id4, aov_id5, aov_id6, aov_id7, aov_id8;
    Color id1, id2, id3, id4, id5, id6, id7, id8;
};

template <class T>
void describe_ids(Describe<T>& d) {
    constexpr std::array names{&T::aov_id1, &T::aov_id2, &T::aov_id3, &T::aov_id4,
                               &T::aov_id5, &T::aov_id6, &T::aov_id7, &T::aov_id8};
    constexpr std::array colors{&T::id1, &T::id2, &T::id3, &T::id4,
                                &T::id5, &T::id6, &T::id7, &T::id8};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string id = "id" + std::to_string(i + 1), aov = "aov_" + id;
        d.param(aov.c_str(), names[i], "AOV into which " + id + " is written.").pending();
        d.param(id.c_str(), colors[i], "Colour for " + aov + ".").ignored();
    }
}

}  // namespace lightsieve
