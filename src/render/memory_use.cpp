#include "render/memory_use.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

#include "core/memory.h"
#include "core/parallel.h"
#include "render/adaptive.h"
#include "render/film.h"
#include "render/guide_training.h"
#include "render/scene.h"

namespace lightsieve {
namespace {

template <class T>
std::size_t bytes(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}
template <class T>
std::size_t bytes(const std::vector<std::vector<T>>& keys) {
    std::size_t sum = keys.capacity() * sizeof(std::vector<T>);
    for (const std::vector<T>& values : keys)
        sum += bytes(values);
    return sum;
}
/// All of them together.
template <class... Arrays>
std::size_t bytes_together(const Arrays&... arrays) {
    return (bytes(arrays) + ... + 0);
}

struct DataBytes {
    std::size_t operator()(const TriangleMesh& m) const {
        std::size_t sum = bytes_together(m.positions, m.indices, m.normals, m.normal_indices,
                                         m.uvs, m.uv_indices, m.face, m.corner, m.shader_index);
        if (const MeshOrigin* o = m.origin.get())
            sum += bytes_together(o->first_corner, o->corner, o->vertex, o->face, o->quarter,
                                  o->place);
        return sum;
    }
    std::size_t operator()(const SphereList& s) const {
        return bytes_together(s.centers, s.radii);
    }
    std::size_t operator()(const CurveList& c) const {
        return bytes_together(c.points, c.radii, c.own_radii, c.normals, c.segments, c.uvs);
    }
    std::size_t operator()(const PointList& p) const {
        return bytes_together(p.centers, p.radii, p.own_radii, p.aspect, p.rotation_rad, p.index);
    }
    std::size_t operator()(const SimpleShape&) const { return 0; }
};

/// For what libraries and threads take when they work: stacks, compression, paths that wait where they split [bytes]. Measured:
/// 20 to 60 MiB.
constexpr std::size_t kUncounted = std::size_t{64} << 20;

std::size_t n_region_pixels(const RenderSettings& s) {
    return static_cast<std::size_t>(s.region.x1 - s.region.x0 + 1) *
           static_cast<std::size_t>(s.region.y1 - s.region.y0 + 1);
}

/// What one thread needs for a bucket: its film and the layers that are made of it.
struct BucketMemory {
    std::size_t film = 0, layers = 0;
    std::size_t n_pixels = 0;
};

BucketMemory bucket_memory(const Scene& scene) {
    const RenderSettings& s = scene.settings;
    const int width = std::min(s.bucket_size, s.region.x1 - s.region.x0 + 1),
              height = std::min(s.bucket_size, s.region.y1 - s.region.y0 + 1);
    BucketMemory out;
    out.n_pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (const Pass& pass : scene.plan.passes)
        if (!pass.views.empty())
            out.film = std::max(out.film, Film::most_memory(scene.plan, pass, width, height));
    std::size_t pixel = sizeof(PixelNoise);
    for (const PlannedLayer& layer : scene.plan.layers)
        pixel += layer.info.n_channels * sizeof(float);
    out.layers = pixel * out.n_pixels;
    return out;
}

/// What helps against too much of a kind.
std::string_view help_against(std::string_view kind) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kHelp{
        {{"geometry", "instances (ginstance) of shapes that are alike share their geometry"},
         {"accel", "instances (ginstance) of shapes that are alike share their structure"},
         {"volumes", "load fewer grids (volume.grids), or coarser ones"},
         {"textures", "a smaller options.texture_max_memory_MB is slower, but takes less"},
         {"automata", "ask for fewer expressions"},
         {"guide", "render without guiding, or fewer samples"},
         {"film", "use fewer --threads or a smaller options.bucket_size, or ask for fewer layers"},
         {"layers", "write files instead of keeping layers, or render a region"},
         {"output", "a driver_exr with tiles and without autocrop writes as it goes"},
         {"checkpoint", "--no-checkpoint takes none"}}};
    for (const auto& [name, help] : kHelp)
        if (name == kind) return help;
    return "the scene itself is that large: simplify it, or use a machine with more memory";
}

}  // namespace

std::size_t bytes_of(const ShapeGeometry& geometry) {
    return sizeof(ShapeGeometry) + std::visit(DataBytes{}, geometry.data);
}

MemoryUse memory_of(const Scene& scene) {
    MemoryUse use;
    for (const auto& geometry : scene.geometries)
        use.geometry += bytes_of(*geometry);
    use.geometry += bytes(scene.objects);
    for (const SceneObject& object : scene.objects)
        use.geometry += object.world_from_object.size_bytes();
    for (const Accel* accel : {scene.accel.get(), scene.light_accel.get()})
        if (accel != nullptr) use.accel += accel->memory();
    std::set<const VolumeGrids*> seen;
    for (const SceneVolume& volume : scene.volumes) {
        if (volume.boundary) use.accel += volume.boundary->memory();
        use.volumes += volume.majorants.memory();
        if (volume.grids() != nullptr && seen.insert(volume.grids()).second)
            use.volumes += volume.grids()->memory();
    }
    use.textures = scene.textures->memory();
    if (scene.plan.program) use.automata = scene.plan.program->table_bytes();
    return use;
}

MemoryForecast forecast_memory(const Scene& scene) {
    MemoryForecast out;
    const RenderSettings& s = scene.settings;
    MemoryUse& use = out.use = memory_of(scene);
    const std::size_t now = resident_memory();
    use.other = now - std::min(now, use.total()) + kUncounted;
    use.textures = std::max(use.textures, scene.textures->most_memory());

    const auto side = static_cast<std::size_t>(s.bucket_size);
    const std::size_t n_pixels = n_region_pixels(s);
    const std::size_t n_buckets =
        (static_cast<std::size_t>(s.region.x1 - s.region.x0) / side + 1) *
        (static_cast<std::size_t>(s.region.y1 - s.region.y0) / side + 1);
    const std::size_t n_threads = std::min(
        n_buckets, static_cast<std::size_t>(s.threads > 0 ? s.threads : hardware_threads()));
    const BucketMemory bucket = bucket_memory(scene);
    use.guide = training_memory(scene);
    // Three sums and a count tell the noise of a layer in a bucket.
    use.film = n_threads * (bucket.film + bucket.layers) +
               n_buckets * scene.plan.layers.size() * 4 * sizeof(double);
    if (scene.capture)
        for (const PlannedLayer& layer : scene.plan.layers)
            use.layers += n_pixels * layer.info.n_channels * sizeof(float);
    for (const PlannedDriver& driver : scene.plan.drivers) {
        const OutputForecast file = driver.driver
                                        ? driver.driver->forecast(frame_header(scene, driver))
                                        : OutputForecast{};
        if (scene.write_files) use.output += file.memory;
        out.file_bytes.push_back(file.file_bytes);
    }
    if (!s.checkpoint.path.empty()) {
        out.checkpoint_file_bytes =
            bucket.film / bucket.n_pixels * scene.plan.passes.size() * n_pixels;
        // What waits, and one state that is packed and copied.
        use.checkpoint =
            std::min(Checkpoint::kMostPending, out.checkpoint_file_bytes) + 2 * bucket.film;
    }
    return out;
}

ImageHeader frame_header(const Scene& scene, const PlannedDriver& driver) {
    const RenderSettings& s = scene.settings;
    ImageHeader h;
    h.width = s.width;
    h.height = s.height;
    h.data_x = s.region.x0;
    h.data_y = s.region.y0;
    h.data_width = s.region.x1 - s.region.x0 + 1;
    h.data_height = s.region.y1 - s.region.y0 + 1;
    h.pixel_aspect_ratio = s.pixel_aspect_ratio;
    h.bucket_size = s.bucket_size;
    for (const std::uint32_t layer : driver.layers)
        h.layers.push_back(scene.plan.layers[layer].info);
    return h;
}

std::string size_text(std::size_t bytes) {
    const bool large = bytes >= std::size_t{1} << 30;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), large ? "%.1f GiB" : "%.0f MiB",
                  static_cast<double>(bytes) / (large ? 0x1p30 : 0x1p20));
    return text.data();
}

void check_memory(const MemoryForecast& forecast, std::size_t limit, Diagnostics& diagnostics) {
    const std::size_t total = forecast.use.total();
    if (limit == 0 || total <= limit) return;
    const auto kinds = forecast.use.by_name();
    const auto most =
        std::max_element(kinds.begin(), kinds.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    diagnostics.error(Code::LimitMemory,
                      "the render may take " + size_text(total) + " of memory, more than the " +
                          size_text(limit) + " that it is allowed",
                      {},
                      "most of it, " + size_text(most->second) + ", is for \"" +
                          std::string(most->first) +
                          "\": " + std::string(help_against(most->first)));
}

}  // namespace lightsieve
