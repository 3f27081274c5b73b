// OpenVDB's trees laid out as NanoVDB's flat blocks. Apart, because the library's converter takes long to compile.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "vdb_reader/vdb_file.h"

namespace lightsieve {

/// Converts a grid, which is used up, and hands the block to `take`.
void with_nano_grid(VdbGrid&& grid,
                    const std::function<void(std::span<const std::byte> block)>& take);

}  // namespace lightsieve
