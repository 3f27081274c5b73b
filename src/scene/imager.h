// Imagers: what changes finished colours on their way to a driver.
#pragma once

#include <memory>
#include <vector>

#include "core/vec.h"

namespace lightsieve {

struct ImageLayer;  // scene/driver.h

class Imager {
  public:
    virtual ~Imager() = default;
    /// Whether it acts on a layer. Only colours are asked about.
    [[nodiscard]] virtual bool selects(const ImageLayer& layer) const = 0;
    /// A pixel's colour after it; rendering space.
    [[nodiscard]] virtual Color changed(Color color) const = 0;
};

/// In the order in which they act.
using Imagers = std::vector<std::unique_ptr<Imager>>;

}  // namespace lightsieve
