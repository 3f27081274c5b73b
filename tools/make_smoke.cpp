// Writes scenes/smoke.vdb: a plume of smoke and fire made of noise, our own.
//
//   cmake --build build/release --target make_smoke && build/release/src/make_smoke scenes/smoke.vdb
//
// A column of 64 x 128 x 64 voxels, two units high, that stands on y = 0 and has its axis at x = z = 0. It widens as it
// rises and swirls around its axis; sums of noise of four sizes bend the place of every look-up, so that puffs curl, and
// eat into its edge. Density thins with height. Temperature is one at the hottest, in a core at the base that tongues of
// flame leave. The colour is what a dye in the smoke would look like: warm grey below, bluish grey above.
//
// Noise is trilinear between hashed lattice points: no random numbers, so that every machine writes the same values.
// Values are kept as halves and what is next to nothing is left out, for a small file.

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace {

using openvdb::Coord;
using openvdb::Vec3s;

constexpr int kWidth = 64, kHeight = 128;
/// Two units high.
constexpr double kVoxelSize = 2.0 / kHeight;
/// Less than this is left out: invisible, and most of the file otherwise.
constexpr float kLeast = 0.01F;
/// Values are rounded to multiples of this, so that they compress.
constexpr float kStep = 1.0F / 256;

struct Point {
    float x, y, z;
};

float smooth(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}
float mix(float a, float b, float t) { return a + (b - a) * t; }

/// Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d; three numbers in [-1,1).
Point lattice(int ix, int iy, int iz) {
    std::array<std::uint32_t, 3> v{static_cast<std::uint32_t>(ix), static_cast<std::uint32_t>(iy),
                                   static_cast<std::uint32_t>(iz)};
    for (std::uint32_t& c : v)
        c = c * 1664525U + 1013904223U;
    for (int round = 0; round < 2; ++round) {
        v[0] += v[1] * v[2];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        if (round == 0)
            for (std::uint32_t& c : v)
                c ^= c >> 16U;
    }
    const auto unit = [](std::uint32_t c) {
        return static_cast<float>(c >> 8U) * (1.0F / 8388608) - 1;
    };
    return {unit(v[0]), unit(v[1]), unit(v[2])};
}

/// Three smooth fields of noise at once, each in [-1,1], one bump to a unit.
Point noise(Point p) {
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const std::array<float, 3> t{smooth(0, 1, p.x - fx), smooth(0, 1, p.y - fy),
                                 smooth(0, 1, p.z - fz)};
    Point sum{0, 0, 0};
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const float weight = (dx != 0 ? t[0] : 1 - t[0]) * (dy != 0 ? t[1] : 1 - t[1]) *
                             (dz != 0 ? t[2] : 1 - t[2]);
        const Point v = lattice(static_cast<int>(fx) + dx, static_cast<int>(fy) + dy,
                                static_cast<int>(fz) + dz);
        sum = {sum.x + weight * v.x, sum.y + weight * v.y, sum.z + weight * v.z};
    }
    return sum;
}

/// Four octaves, each of half the size and half the strength.
Point octaves(Point p) {
    Point sum{0, 0, 0};
    float strength = 0.5F;
    for (int i = 0; i < 4; ++i) {
        const Point n = noise(p);
        sum = {sum.x + strength * n.x, sum.y + strength * n.y, sum.z + strength * n.z};
        // An offset apart from the doubling keeps octaves from sharing lattice points.
        p = {p.x * 2 + 17, p.y * 2 + 31, p.z * 2 + 47};
        strength *= 0.5F;
    }
    return sum;
}

struct Smoke {
    float density, temperature;
    Vec3s color;
};

/// The plume at a point [units, y from 0 to 2].
Smoke smoke_at(Point p) {
    const float height = p.y / 2;
    // Bend the place: more with height, and in the large before in the small.
    const Point large = octaves({p.x * 1.6F + 5, p.y * 1.3F + 9, p.z * 1.6F});
    const float bend = 0.06F + 0.32F * height;
    Point q{p.x + bend * large.x, p.y + 0.25F * large.y, p.z + bend * large.z};
    const float angle = 3.5F * height + 1.2F * large.y;
    const float c = std::cos(angle), s = std::sin(angle);
    q = {c * q.x - s * q.z, q.y, s * q.x + c * q.z};
    const Point small = octaves({q.x * 4.5F + 3, q.y * 3.5F + 1, q.z * 4.5F + 7});

    // The column: a narrow foot, a waist, and a head that is round at the top.
    const float rise = std::clamp(q.y / 2, 0.0F, 1.0F);
    const float radius = (0.10F + 0.30F * smooth(0, 0.95F, rise)) *
                         std::sqrt(std::max(0.0F, 1 - smooth(0.62F, 0.93F, rise)));
    const float from_axis = std::sqrt(q.x * q.x + q.z * q.z);
    const float body = radius - from_axis + 0.36F * (0.25F + rise) * small.x;
    const float foot = smooth(0.0F, 0.08F, p.y);
    const float density =
        foot * smooth(0.0F, 0.10F, body) * mix(1.0F, 0.45F, rise) * (0.75F + 0.5F * small.z);

    // The core: thin, at the base, torn upward by the small noise.
    const float flame = 0.085F * (1 - rise / 0.42F) - from_axis + 0.10F * small.y * (0.4F + rise);
    const float temperature =
        foot * smooth(-0.02F, 0.07F, flame) * (1 - smooth(0.15F, 0.45F, rise));

    const float blend = smooth(0.15F, 0.8F, rise + 0.15F * small.x);
    const Vec3s color(mix(0.85F, 0.55F, blend), mix(0.72F, 0.62F, blend),
                      mix(0.60F, 0.75F, blend));
    return {std::max(0.0F, density), std::max(0.0F, temperature), color};
}

float rounded(float x) { return std::round(x / kStep) * kStep; }

template <class Grid>
typename Grid::Ptr make_grid(const std::string& name, openvdb::GridClass kind) {
    const auto grid = Grid::create();
    grid->setName(name);
    grid->setSaveFloatAsHalf(true);
    grid->setGridClass(kind);
    const auto transform = openvdb::math::Transform::createLinearTransform(kVoxelSize);
    transform->postTranslate(openvdb::Vec3d(-0.5 * (kWidth - 1), 0.5, -0.5 * (kWidth - 1)) *
                             kVoxelSize);
    grid->setTransform(transform);
    return grid;
}

/// The library gives each file a number of its own, 36 characters after the head; without it the file is the same each time.
void erase_tag(const std::string& path) {
    constexpr int kHeadBytes = 21;
    const std::string zeros = "00000000-0000-0000-0000-000000000000";
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(kHeadBytes);
    file.write(zeros.data(), static_cast<std::streamsize>(zeros.size()));
}

void write(const std::string& path) {
    const auto density = make_grid<openvdb::FloatGrid>("density", openvdb::GRID_FOG_VOLUME);
    const auto temperature =
        make_grid<openvdb::FloatGrid>("temperature", openvdb::GRID_FOG_VOLUME);
    const auto color = make_grid<openvdb::Vec3SGrid>("color", openvdb::GRID_UNKNOWN);
    auto set_density = density->getAccessor(), set_temperature = temperature->getAccessor();
    auto set_color = color->getAccessor();
    for (int x = 0; x < kWidth; ++x)
        for (int y = 0; y < kHeight; ++y)
            for (int z = 0; z < kWidth; ++z) {
                const auto center = density->indexToWorld(Coord(x, y, z));
                const Smoke smoke =
                    smoke_at({static_cast<float>(center.x()), static_cast<float>(center.y()),
                              static_cast<float>(center.z())});
                if (smoke.density > kLeast) {
                    set_density.setValue(Coord(x, y, z), rounded(smoke.density));
                    // Colours vary slowly, so coarse steps do.
                    set_color.setValue(Coord(x, y, z),
                                       Vec3s(rounded(smoke.color[0]), rounded(smoke.color[1]),
                                             rounded(smoke.color[2])));
                }
                if (smoke.temperature > kLeast)
                    set_temperature.setValue(Coord(x, y, z), rounded(smoke.temperature));
            }
    openvdb::io::File file(path);
    file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write(openvdb::GridPtrVec{density, temperature, color});
    file.close();
    erase_tag(path);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s FILE.vdb\n", argv[0]);
        return 2;
    }
    openvdb::initialize();
    write(argv[1]);
    return 0;
}
