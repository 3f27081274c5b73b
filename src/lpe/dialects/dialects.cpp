#include "lpe/dialects/dialect.h"

#include <algorithm>
#include <array>

namespace lightsieve::lpe::dialects {

std::span<const Dialect* const> dialects() {
    static const std::array all{
        &arnold_dialect(),  &osl_dialect(),       &osl_placeholder_dialect(),
        &moonray_dialect(), &renderman_dialect(), &karma_dialect(),
    };
    return all;
}

const Dialect* find_dialect(std::string_view name) {
    const auto all = dialects();
    const auto row = std::ranges::find(all, name, [](const Dialect* d) { return d->name; });
    return row == all.end() ? nullptr : *row;
}

}  // namespace lightsieve::lpe::dialects
