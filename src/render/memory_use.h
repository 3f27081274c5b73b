// Bytes: what a compiled scene holds, and what a render of it will take.
//
// The forecast counts what will be made by making it small: a film of 64 pixels into all of whose atoms light falls, the
// header that each driver will get. What the scene holds is there already and is measured.
#pragma once

#include "render/statistics.h"
#include "scene/driver.h"

namespace lightsieve {

class Scene;
struct PlannedDriver;
struct ShapeGeometry;

/// Vertices, indices and the like; without volumes.
[[nodiscard]] std::size_t bytes_of(const ShapeGeometry& geometry);
/// What the scene holds now; other kinds are 0.
[[nodiscard]] MemoryUse memory_of(const Scene& scene);
/// What a render will take at most: everything in `Scene` is known.
[[nodiscard]] MemoryForecast forecast_memory(const Scene& scene);

/// Frame and layers of a driver's file; without metadata.
[[nodiscard]] ImageHeader frame_header(const Scene& scene, const PlannedDriver& driver);

/// "3.2 GiB", "17 MiB".
[[nodiscard]] std::string size_text(std::size_t bytes);
/// An error (limit-memory) if the forecast exceeds the limit [bytes]; it says what takes most, and what would help.
void check_memory(const MemoryForecast& forecast, std::size_t limit, Diagnostics& diagnostics);

}  // namespace lightsieve
