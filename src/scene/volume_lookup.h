// The channels of a volume at the point that a shader looks at.
#pragma once

#include <cstdint>

#include "core/name.h"
#include "core/vec.h"

namespace lightsieve {

/// How values between voxels are found; as a parameter of shaders.
enum class ChannelInterpolation : std::int32_t { Closest, Trilinear, Tricubic };

/// Made by the renderer for each point. When bounds of a medium are sought, it stands for a whole cell of the volume and
/// answers with the largest values there.
class VolumeLookup {
  public:
    /// The channel's value; scalars in all three components. False, and `value` as it was, if the volume has no such channel.
    virtual bool channel(Name name, ChannelInterpolation interpolation, Color& value) const = 0;

  protected:
    ~VolumeLookup() = default;
};

}  // namespace lightsieve
