// cell_noise: patterns of cells in space. Arnold's own function is private: the same patterns, other cells.
#include "nodes/texture/cells.h"
#include "nodes/texture/coord_space.h"

namespace lightsieve {
namespace {

enum class Pattern : std::int32_t { Noise1, Noise2, Cell1, Cell2, Worley1, Worley2, Alligator };

struct CellNoise : SolidPlace {
    Pattern pattern = Pattern::Noise1;
    bool additive = false;
    std::int32_t octaves = 1;
    float randomness = 1, lacunarity = 1.92F, amplitude = 1;
    Vec3f scale{1, 1, 1}, offset;
    float time = 0;
    Color color{1, 1, 1};
    Lazy<Color> palette{{1, 1, 1}, {}};
    float density = 0.5F;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Color of_cell(const CellPoint& cell, const ShadePoint& at) const;
};

NodeType CellNoise::describe() {
    Describe<CellNoise> d("cell_noise", NodeKind::Shader, "Patterns of cells in space.");
    d.param("pattern", &CellNoise::pattern,
            "noise1, noise2: bumps and their ridges; cell1, cell2: a colour or a grey a cell; "
            "worley1, worley2: distance to the nearest point, to the border; alligator: scales.")
        .names({"noise1", "noise2", "cell1", "cell2", "worley1", "worley2", "alligator"});
    d.param("additive", &CellNoise::additive, "Octaves are added; off: the largest counts.");
    d.param("octaves", &CellNoise::octaves, "How many patterns of finer and finer grain.")
        .range(1, 8);
    d.param("randomness", &CellNoise::randomness, "0: cells are cubes.").range(0, 1);
    d.param("lacunarity", &CellNoise::lacunarity, "How much finer each octave is than the last.");
    d.param("amplitude", &CellNoise::amplitude, "Factor on the pattern.");
    describe_solid_place(d);
    d.param("scale", &CellNoise::scale, "Frequency along each axis.");
    d.param("offset", &CellNoise::offset, "Moves the pattern.");
    d.param("time", &CellNoise::time, "Cells move smoothly with it.");
    d.param("color", &CellNoise::color, "Factor on the pattern.");
    d.param(
        "palette", &CellNoise::palette,
        "For patterns cell1 and cell2: where cells get their colour from, at a random place of "
        "the texture.");
    d.param("density", &CellNoise::density, "Part of the cells that have a colour.").range(0, 1);
    return d.done();
}

/// Colour of a whole cell.
Color CellNoise::of_cell(const CellPoint& cell, const ShadePoint& at) const {
    const auto random = [&](std::uint32_t i) { return unit_from_bits(mixed_bits(cell.id, i)); };
    if (random(10) >= unit(density) * 2) return kBlack;
    if (palette.linked()) {
        ShadePoint point = at;
        point.uv = {random(11), random(12)};
        point.uv_width = 0;
        point.dp_du = point.dp_dv = {};
        return palette.at(point);
    }
    if (pattern == Pattern::Cell2) return palette.value * random(11);
    return palette.value * Color{random(11), random(12), random(13)};
}

Color CellNoise::eval(const ShadePoint& at) const {
    const Vec3f at_rest = place(at);
    Vec3f p{at_rest.x * scale.x + offset.x, at_rest.y * scale.y + offset.y,
            at_rest.z * scale.z + offset.z};
    constexpr std::int32_t kMost = 16;
    Color sum;
    float weight = 1;
    for (std::int32_t i = 0; i < std::clamp(octaves, 1, kMost); ++i) {
        const CellPoint cell = cell_at(p, unit(randomness), time);
        Color here;
        switch (pattern) {
            case Pattern::Noise1: here = Color::grey(unit(1 - cell.nearest)); break;
            case Pattern::Noise2:
                here = Color::grey(unit(1 - (cell.second - cell.nearest)));
                break;
            case Pattern::Cell1:
            case Pattern::Cell2: here = of_cell(cell, at); break;
            case Pattern::Worley1: here = Color::grey(unit(cell.nearest)); break;
            case Pattern::Worley2: here = Color::grey(unit(cell.second - cell.nearest)); break;
            case Pattern::Alligator: here = Color::grey(cell.alligator1 - cell.alligator2); break;
        }
        for (int c = 0; c < 3; ++c)
            sum[c] = additive ? sum[c] + here[c] * weight : std::max(sum[c], here[c] * weight);
        weight *= 0.5F;
        p = p * lacunarity;
    }
    return sum * color * amplitude;
}

}  // namespace

NodeType node_cell_noise() { return CellNoise::describe(); }

}  // namespace lightsieve
