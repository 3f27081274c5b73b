// Look-ups in volumes: values, bounds, maxima. Files that are damaged and readers that fail are in volume_reader_test.cpp.

#include "io/volume_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "core/error.h"
#include "io/testing/test_volumes.h"

namespace lightsieve {

namespace {

using enum VolumeInterpolation;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::shared_ptr<const VolumeGrids> load(const std::string& name,
                                        const std::vector<std::string>& grids = {}) {
    return load_volume(std::string(LIGHTSIEVE_SOURCE_DIR) + "/tests/data/volumes/" + name, grids);
}

/// Object-space place of a point between voxels.
Vec3f place(double x, double y, double z, const VolumeTransform& m = kTestTransform) {
    const auto at = [&](std::size_t i) {
        return static_cast<float>(x * m[0][i] + y * m[1][i] + z * m[2][i] + m[3][i]);
    };
    return {at(0), at(1), at(2)};
}
Vec3f place(const TestVoxel& v) {
    return place(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

/// Numbers from 0 to 1 that are the same everywhere: distributions of the standard library are not.
class Numbers {
  public:
    explicit Numbers(std::uint32_t seed) : bits_(seed) {}
    float unit() { return static_cast<float>(bits_() >> 8U) * 0x1p-24F; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    int below(int n) { return static_cast<int>(bits_() % static_cast<unsigned>(n)); }

  private:
    std::mt19937 bits_;
};

/// Any voxel in or around the box of active ones.
TestVoxel any_voxel(Numbers& numbers) {
    TestVoxel v{};
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = kTestLower[i] - 5 + numbers.below(kTestUpper[i] - kTestLower[i] + 11);
    return v;
}

Color expected(const std::string& type, const TestVoxel& v) {
    const auto value = [&](std::uint32_t seed) { return test_value(v, seed); };
    if (type == "density" || type == "half") return Color::grey(value(1));
    if (type == "double") return Color::grey(value(2));
    if (type == "int32") return Color::grey(std::floor(value(3)));
    if (type == "int64") return Color::grey(std::floor(value(4)));
    if (type == "bool") return Color::grey(value(5) > 2 ? 1 : 0);
    if (type == "mask") return Color::grey(test_active(v) ? 1 : 0);
    if (type == "color") return {value(6), value(7), value(8)};
    if (type == "vec3d") return {value(9), value(10), value(11)};
    return {std::floor(value(12)), std::floor(value(13)), std::floor(value(14))};
}

TEST(Volume, EveryTypeOfGridBecomesFloats) {
    const auto volume = load("every_type.vdb");
    std::set<std::string> names;
    for (const VolumeGrids::Info& info : volume->grids())
        names.insert(info.name.str());
    // Points hold no numbers.
    EXPECT_EQ(names, (std::set<std::string>{"bool", "color", "density", "double", "half", "int32",
                                            "int64", "mask", "vec3d", "vec3i"}));
    Numbers numbers(1);
    for (const std::string& name : names) {
        const int grid = volume->find(name);
        ASSERT_GE(grid, 0);
        const bool vector = name == "color" || name.starts_with("vec");
        EXPECT_EQ(volume->grids()[static_cast<std::size_t>(grid)].vector, vector);
        for (int i = 0; i < 500; ++i) {
            const TestVoxel v = any_voxel(numbers);
            ASSERT_EQ(volume->sample(grid, place(v), Closest), expected(name, v)) << name;
        }
    }
    EXPECT_EQ(volume->find("nothing"), -1);
}

TEST(Volume, OnlyGridsThatWereAskedForAreReadInThatOrder) {
    const auto all = load("every_type.vdb");
    const auto two = load("every_type.vdb", {"mask", "color", "mask"});
    ASSERT_EQ(two->grids().size(), 2U);
    EXPECT_EQ(two->grids()[0].name, Name("mask"));
    EXPECT_EQ(two->grids()[1].name, Name("color"));
    EXPECT_LT(two->memory(), all->memory() / 2);
    EXPECT_GT(two->memory(), std::size_t{1} << 20);
}

TEST(Volume, GridsOfOneNameAreToldApart) {
    const auto volume = load("twins.vdb");
    ASSERT_EQ(volume->grids().size(), 2U);
    EXPECT_NE(volume->grids()[0].name, volume->grids()[1].name);
}

TEST(Volume, BoundsHaveHalfAVoxelAround) {
    const auto volume = load("every_type.vdb", {"density", "color"});
    Box3f box;
    for (unsigned corner = 0; corner < 8; ++corner) {
        std::array<double, 3> p{};
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = (corner >> i & 1U) != 0 ? kTestUpper[i] + 0.5 : kTestLower[i] - 0.5;
        box.grow(place(p[0], p[1], p[2]));
    }
    for (const Box3f& bounds : {volume->bounds(), volume->grids()[0].bounds}) {
        EXPECT_LT(length(bounds.lower - box.lower), 1e-4F);
        EXPECT_LT(length(bounds.upper - box.upper), 1e-4F);
    }
    EXPECT_FLOAT_EQ(volume->grids()[0].voxel_size, 0.25F);
}

/// Interpolates along each axis in turn, from values by number; n is 2 or 4 voxels.
double reference(std::array<double, 3> p, int n, std::uint32_t seed) {
    std::array<int, 3> base{};
    std::array<std::array<double, 4>, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = p[i] - std::floor(p[i]);
        base[i] = static_cast<int>(std::floor(p[i])) - (n == 4 ? 1 : 0);
        if (n == 2) {
            weights[i] = {1 - t, t};
            continue;
        }
        // The cubic through p0..p3 with slopes (p2-p0)/2 and (p3-p1)/2, in Hermite form.
        const double h1 = t * t * (3 - 2 * t), h0 = 1 - h1, s0 = t * (1 - t) * (1 - t),
                     s1 = t * t * (t - 1);
        weights[i] = {-s0 / 2, h0 - s1 / 2, h1 + s0 / 2, s1 / 2};
    }
    double sum = 0, low = 1e9, high = -1e9;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z) {
                const double value = test_value({base[0] + x, base[1] + y, base[2] + z}, seed);
                sum += value * weights[0][static_cast<std::size_t>(x)] *
                       weights[1][static_cast<std::size_t>(y)] *
                       weights[2][static_cast<std::size_t>(z)];
                low = std::min(low, value);
                high = std::max(high, value);
            }
    return std::clamp(sum, low, high);
}

TEST(Volume, InterpolatesAsItShould) {
    const auto volume = load("every_type.vdb", {"density", "color"});
    Numbers numbers(2);
    for (int i = 0; i < 2000; ++i) {
        const TestVoxel v = any_voxel(numbers);
        const std::array<double, 3> p{v[0] + static_cast<double>(numbers.unit()),
                                      v[1] + static_cast<double>(numbers.unit()),
                                      v[2] + static_cast<double>(numbers.unit())};
        const Vec3f at = place(p[0], p[1], p[2]);
        // A float of object space is good to some 1e-4 of a voxel here, and values differ by up to 4 between voxels.
        EXPECT_NEAR(volume->sample(0, at, Trilinear).r, reference(p, 2, 1), 4e-3);
        EXPECT_NEAR(volume->sample(0, at, Tricubic).r, reference(p, 4, 1), 6e-3);
        EXPECT_NEAR(volume->sample(1, at, Trilinear).b, reference(p, 2, 8), 4e-3);
        EXPECT_NEAR(volume->sample(1, at, Tricubic).g, reference(p, 4, 7), 6e-3);
    }
}

TEST(Volume, EverywhereElseIsTheBackground) {
    const auto volume = load("every_type.vdb", {"density"});
    const Color background = Color::grey(kTestBackground);
    for (const Vec3f p : {Vec3f{1e6F, 0, 0}, Vec3f{3e38F, -3e38F, 3e38F}, Vec3f{kNaN, 0, 0},
                          Vec3f{0, kInfinity, 0}, Vec3f{0, 0, -kInfinity}})
        for (const VolumeInterpolation how : {Closest, Trilinear, Tricubic})
            EXPECT_EQ(volume->sample(0, p, how), background);
    const Box3f far{{1e6F, 1e6F, 1e6F}, {2e6F, 2e6F, 2e6F}};
    EXPECT_EQ(volume->maximum(0, far), background);
}

TEST(Volume, AGridWithoutVoxelsIsItsBackground) {
    const auto volume = load("no_voxels.vdb");
    EXPECT_TRUE(volume->bounds().empty());
    EXPECT_EQ(volume->sample(0, {1, 2, 3}, Tricubic), Color::grey(2));
    EXPECT_EQ(volume->maximum(0, {{0, 0, 0}, {1, 1, 1}}), Color::grey(2));
}

TEST(Volume, TilesAreLookedUpWithoutVoxelsOfTheirOwn) {
    const auto volume = load("tiles.vdb");
    // A billion voxels.
    EXPECT_LT(volume->memory(), std::size_t{4} << 20);
    const auto at = [&](double x, double y, double z) {
        return volume->sample(0, place(x, y, z), Closest).r;
    };
    EXPECT_EQ(at(-512, 0, 511), 2);
    EXPECT_EQ(at(511, -512, 0), 2);
    EXPECT_EQ(at(512, 0, 0), 0);
    EXPECT_EQ(at(-513, 0, 0), 0);
    EXPECT_EQ(at(3, 4, 5), 7);
    EXPECT_EQ(at(-400, 4, 5), 0.5F);
    EXPECT_EQ(at(9000, 100, 100), 3);
    EXPECT_EQ(at(-8000, 100, 100), 5);  // a value that is not active
    const auto upper = place(12287.5, 4095.5, 4095.5);
    EXPECT_NEAR(volume->bounds().upper.z, upper.z, 0.01F);
    EXPECT_LT(volume->bounds().lower.z, place(-512.5, 511.5, -512.5).z + 0.01F);
}

TEST(Volume, ValuesThatAreNotFiniteAreZero) {
    const auto volume = load("not_finite.vdb");
    const int density = volume->find("density"), color = volume->find("color");
    const auto at = [&](float x) { return volume->sample(density, {x, 0, 0}, Closest).r; };
    EXPECT_EQ(at(0), 1);
    for (const float x : {1.0F, 2.0F, 3.0F, 500.0F})
        EXPECT_EQ(at(x), 0) << x;
    EXPECT_EQ(volume->sample(color, {0, 0, 0}, Closest), (Color{1, 0, 2}));
    EXPECT_EQ(volume->sample(volume->find("wide"), {0, 0, 0}, Closest), kBlack);
    // The largest floats stay far from overflow.
    for (float x = -2; x < 7; x += 0.125F)
        for (const VolumeInterpolation how : {Trilinear, Tricubic}) {
            const Color c = volume->sample(density, {x, 0.25F, 0.5F}, how);
            EXPECT_TRUE(is_finite(c)) << x;
        }
    EXPECT_GT(at(4), 1e29F);
}

/// A box of any size and place about a volume: tiny, middling, larger than all.
Box3f any_box(Numbers& numbers, const Box3f& about) {
    const float size = std::exp2(numbers.between(-8, 1.5F));
    Box3f box;
    for (int i = 0; i < 3; ++i) {
        const float width = about.size()[i];
        const float middle = about.center()[i] + width * numbers.between(-0.7F, 0.7F);
        const float half = 0.5F * width * size * numbers.unit();
        box.lower[i] = middle - half;
        box.upper[i] = middle + half;
    }
    return box;
}

class VolumeMaximum : public testing::TestWithParam<const char*> {};

TEST_P(VolumeMaximum, IsNotLessThanAnyValueInTheBox) {
    const auto volume = load(GetParam());
    Numbers numbers(3);
    const int n_grids = static_cast<int>(volume->grids().size());
    for (int i = 0; i < 3000; ++i) {
        const int grid = numbers.below(n_grids);
        const Box3f box = any_box(numbers, volume->grids()[static_cast<std::size_t>(grid)].bounds);
        const Color bound = volume->maximum(grid, box);
        for (int j = 0; j < 30; ++j) {
            Vec3f p;
            for (int k = 0; k < 3; ++k)
                p[k] = std::clamp(numbers.between(box.lower[k], box.upper[k]), box.lower[k],
                                  box.upper[k]);
            const auto how = static_cast<VolumeInterpolation>(numbers.below(3));
            const Color value = volume->sample(grid, p, how);
            for (int k = 0; k < 3; ++k)
                ASSERT_LE(value[k], bound[k]) << grid << " " << p.x << " " << p.y << " " << p.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Files, VolumeMaximum,
                         testing::Values("every_type.vdb", "tiles.vdb", "sparse.vdb",
                                         "not_finite.vdb", "small.vdb"),
                         [](const auto& file) {
                             const std::string name = file.param;
                             return name.substr(0, name.find('.'));
                         });

TEST(Volume, MaximaOfSmallBoxesAreTight) {
    const auto around = [](const VolumeGrids& volume, Vec3f p) {
        const Box3f box{p - Vec3f{0.1F, 0.1F, 0.1F}, p + Vec3f{0.1F, 0.1F, 0.1F}};
        return volume.maximum(volume.find("density"), box).r;
    };
    // Voxels from (1,0,12) with the value 1 to (12,6,1) with the value 12; leaves of 8^3.
    const auto line = load("small.vdb");
    EXPECT_EQ(around(*line, {2, 1, 11}), 5);
    EXPECT_EQ(around(*line, {11, 5, 2}), 12);
    EXPECT_EQ(around(*line, {2, 1, 2}), 7);
    EXPECT_EQ(around(*line, {12, 6, 12}), 0);
    // Few nodes in a large space: the cells are as large as it takes to make them few.
    const auto tiles = load("tiles.vdb");
    EXPECT_EQ(around(*tiles, place(3, 4, 5)), 7);
    EXPECT_EQ(around(*tiles, place(2000, 2000, -2000)), 0);
    EXPECT_EQ(around(*tiles, place(9000, 1000, 1000)), 3);
}

TEST(Volume, BoxesThatAreNoBoxesHaveTheWholeGridsMaximum) {
    const auto volume = load("tiles.vdb");
    EXPECT_EQ(volume->maximum(0, Box3f{}), Color::grey(7));
    EXPECT_EQ(volume->maximum(0, {{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}}), Color::grey(7));
    EXPECT_EQ(volume->maximum(
                  0, {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}),
              Color::grey(7));
}

TEST(Volume, LeavesFarApartTakeLittleMemory) {
    const auto volume = load("sparse.vdb");
    EXPECT_LT(volume->memory(), std::size_t{1} << 20);
    EXPECT_EQ(volume->sample(0, {-1e8F, 3, 0}, Closest), Color::grey(1));
    EXPECT_EQ(volume->sample(0, {1e8F, 0, 7e7F}, Trilinear), Color::grey(2));
}

TEST(Volume, TheSceneOfSmokeIsThere) {
    const auto volume = load_volume(std::string(LIGHTSIEVE_SOURCE_DIR) + "/scenes/smoke.vdb", {});
    for (const char* name : {"density", "temperature", "color"})
        EXPECT_GE(volume->find(name), 0) << name;
    const Color most = volume->maximum(volume->find("density"), volume->bounds());
    EXPECT_GT(most.r, 0.5F);
    EXPECT_LT(most.r, 2);
    EXPECT_TRUE(volume->grids()[static_cast<std::size_t>(volume->find("color"))].vector);
}

}  // namespace

}  // namespace lightsieve
