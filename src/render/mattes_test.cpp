// Cryptomatte: which ids pixels get and how much of them, through opacity, blur, glass, instances and user data.
#include "render/mattes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>

#include "render/testing/checks.h"
#include "scene/cryptomatte.h"

namespace lightsieve::testing {
namespace {

/// What covers a pixel, by id.
using Cover = std::map<std::uint32_t, double>;

Cover cover_of(const Picture& picture, std::size_t pixel, const std::string& matte,
               int n_layers = 3) {
    Cover out;
    double last = 2;
    for (int i = 0; i < n_layers; ++i) {
        const FrameLayer& layer = picture.layer(matte + "0" + std::to_string(i));
        EXPECT_EQ(layer.info.n_channels, 4U);
        for (std::size_t pair = 0; pair < 2; ++pair) {
            const float id = layer.pixels[pixel * 4 + pair * 2],
                        part = layer.pixels[pixel * 4 + pair * 2 + 1];
            EXPECT_LE(double{part}, last) << "ranks fall";
            last = double{part};
            if (part > 0) out[std::bit_cast<std::uint32_t>(id)] += double{part};
        }
    }
    return out;
}

/// Mean coverage of a name over the picture.
double coverage(const Picture& picture, const std::string& matte, std::string_view name,
                int n_layers = 3) {
    const std::uint32_t id = name.empty() ? 0 : matte_id(name);
    double sum = 0;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i)
        sum += cover_of(picture, i, matte, n_layers)[id];
    return sum / static_cast<double>(picture.n_pixels());
}

std::string outputs_of(const std::string& mattes, const std::string& more = "") {
    return " outputs " + mattes + "\n aov_shaders \"marks\"\n" + more;
}
const std::string kObjects = R"(2 1 STRING "RGBA RGBA f d" "crypto_object RGB f d")";

std::string marks(std::string_view more = "") { return node("cryptomatte", "marks", more); }
std::string half_open(std::string_view name, float opacity) {
    const std::string o = text_of(opacity);
    return node("lambert", name, " opacity " + o + ' ' + o + ' ' + o);
}

/// A node with more parameters.
std::string with(std::string node, std::string_view more) {
    return node.insert(node.rfind('}'), more);
}

TEST(Mattes, CoverWhatShapesCover) {
    // A square of a quarter of the picture before nothing.
    const Picture picture =
        render(frame_text(8, 8, 4, from_above(2), outputs_of(kObjects)) + marks() +
               lambert("grey", 0.5F) + floor("tile", 0, 0.5F, "grey"));
    EXPECT_FALSE(picture.has("crypto_object")) << "previews are asked for";
    EXPECT_NEAR(coverage(picture, "crypto_object", "tile"), 0.25, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_object", ""), 0.75, 1e-6);
    EXPECT_NEAR(picture.mean_alpha("RGBA"), 0.25, 1e-6);
}

TEST(Mattes, ShareAPixelByOpacity) {
    const Picture picture =
        render(frame_text(2, 2, 2, from_above(1), outputs_of(kObjects)) + marks() +
               half_open("veil", 0.25F) + lambert("grey", 0.5F) + half_open("glassy", 0.5F) +
               floor("upper", 1, 5, "veil") + floor("lower", 0.5F, 5, "glassy") +
               quad("half", {0, 0, -5}, {0, 0, 5}, {5, 0, 5}, {5, 0, -5}, "grey"));
    for (const std::size_t pixel : {0U, 2U}) {
        const Cover cover = cover_of(picture, pixel, "crypto_object");
        EXPECT_NEAR(cover.at(matte_id("upper")), 0.25, 1e-6);
        EXPECT_NEAR(cover.at(matte_id("lower")), 0.375, 1e-6);
        EXPECT_NEAR(cover.at(0), 0.375, 1e-6) << "nothing behind them";
        EXPECT_EQ(cover.size(), 3U);
    }
    EXPECT_NEAR(cover_of(picture, 1, "crypto_object").at(matte_id("half")), 0.375, 1e-6);
}

TEST(Mattes, ArePossibleWithoutThePicture) {
    const std::string only = R"(1 1 STRING "crypto_object RGB f d")";
    const Picture picture = render(frame_text(2, 2, 1, from_above(1), outputs_of(only)) + marks() +
                                   half_open("veil", 0.25F) + lambert("grey", 0.5F) +
                                   floor("upper", 1, 5, "veil") + floor("lower", 0.5F, 5, "grey"));
    EXPECT_NEAR(coverage(picture, "crypto_object", "upper"), 0.25, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_object", "lower"), 0.75, 1e-6);
}

TEST(Mattes, FollowMotionAndLenses) {
    // Moves over half of its own width while the shutter is open: each column is covered part of the time.
    const std::string moving =
        node("polymesh", "tile",
             " nsides 4\n vidxs 4 1 UINT 0 1 2 3\n vlist 4 1 VECTOR -1 0 -5 -1 0 5 0 0 5 0 0 -5\n"
             " shader grey\n matrix 1 2 MATRIX\n 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
             " 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1\n motion_start 0\n motion_end 1");
    const std::string camera = with(from_above(2), " shutter_start 0\n shutter_end 1\n");
    const Picture picture = render(frame_text(2, 1, 32, camera, outputs_of(kObjects)) + marks() +
                                   lambert("grey", 0.5F) + moving);
    // Left pixel [-1,0]: covered by 1 - t; right pixel: by t. Means 1/2, and as much as alpha says.
    for (const std::size_t pixel : {0U, 1U}) {
        const double part = cover_of(picture, pixel, "crypto_object").at(matte_id("tile"));
        EXPECT_NEAR(part, 0.5, 0.05) << "1024 samples, 3 standard errors";
        EXPECT_NEAR(part, double{picture.alpha("RGBA", pixel)}, 1e-6);
    }
    const std::string lens = with(persp_camera({0, 2, 0}, {0, 0, 0}, 50, {0, 0, -1}),
                                  " aperture_size 0.3\n focus_distance 1\n");
    const Picture blurred = render(frame_text(8, 8, 6, lens, outputs_of(kObjects)) + marks() +
                                   lambert("grey", 0.5F) + floor("tile", 0, 0.4F, "grey"));
    int between = 0;
    for (std::size_t i = 0; i < blurred.n_pixels(); ++i) {
        Cover cover = cover_of(blurred, i, "crypto_object");
        EXPECT_NEAR(cover[matte_id("tile")], double{blurred.alpha("RGBA", i)}, 1e-6);
        between += cover.size() == 2 ? 1 : 0;
    }
    EXPECT_GT(between, 8) << "the edge is wide";
}

TEST(Mattes, AreFilteredLikeTheBeauty) {
    const std::string filters =
        node("gaussian_filter", "g", " width 3") + node("closest_filter", "near", "");
    const Picture picture =
        render(frame_text(8, 8, 4, from_above(8),
                          outputs_of(R"(3 1 STRING "RGBA RGBA g d" "crypto_object RGB g d"
                                 "crypto_asset RGB near d")")) +
               filters + marks() + lambert("grey", 0.5F) +
               quad("half", {-20, 0, -20}, {-20, 0, 20}, {0.3F, 0, 20}, {0.3F, 0, -20}, "grey"));
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const double alpha = double{picture.alpha("RGBA", i)};
        EXPECT_NEAR(cover_of(picture, i, "crypto_object")[matte_id("half")], alpha, 1e-6);
        EXPECT_NEAR(cover_of(picture, i, "crypto_asset")[matte_id("default")], alpha, 1e-6)
            << "one sample makes no mask: the beauty's filter is taken";
    }
}

TEST(Mattes, KnowAssetsAndMaterials) {
    const Picture picture =
        render(frame_text(2, 1, 2, from_above(2),
                          outputs_of(R"(4 1 STRING "RGBA RGBA f d" "crypto_object RGB f d"
                                 "crypto_asset RGB f d" "crypto_material RGB f d")")) +
               marks() + lambert("lib:grey", 0.5F) +
               quad("house:roof", {-1, 0, -1}, {-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, "lib:grey") +
               quad("/town/door", {0, 0, -1}, {0, 0, 1}, {1, 0, 1}, {1, 0, -1}, "lib:grey"));
    EXPECT_NEAR(coverage(picture, "crypto_object", "roof"), 0.5, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_object", "door"), 0.5, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_asset", "house"), 0.5, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_asset", "/town"), 0.5, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_material", "grey"), 1, 1e-6);
}

TEST(Mattes, TakeMaterialsOfFaces) {
    const std::string two =
        node("polymesh", "pair",
             " nsides 2 1 UINT 4 4\n vidxs 8 1 UINT 0 1 2 3 3 2 4 5\n"
             " vlist 6 1 VECTOR -1 0 -1 -1 0 1 0 0 1 0 0 -1 1 0 1 1 0 -1\n shidxs 2 1 BYTE 0 1\n"
             " shader 2 1 NODE \"left\" \"right\"");
    const Picture picture = render(
        frame_text(2, 1, 2, from_above(2), outputs_of(R"(1 1 STRING "crypto_material RGB f d")")) +
        marks() + lambert("left", 0.5F) + lambert("right", 0.5F) + two);
    EXPECT_NEAR(cover_of(picture, 0, "crypto_material")[matte_id("left")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 1, "crypto_material")[matte_id("right")], 1, 1e-6);
}

TEST(Mattes, ListenToUserData) {
    const std::string named =
        " declare crypto_object constant STRING\n crypto_object \"hero\"\n"
        " declare crypto_material_offset constant INT\n"
        " crypto_material_offset 7\n"
        " declare crew constant STRING\n crew \"kitchen\"";
    const TestScene scene(
        frame_text(2, 1, 2, from_above(2),
                   outputs_of(R"(4 1 STRING "RGBA RGBA f d" "crypto_object RGB f d"
                                 "crypto_material RGB f d" "crews RGB f d")")) +
        marks(" user_crypto_aov_0 \"crews\"\n user_crypto_src_0 \"crew\"") +
        lambert("grey", 0.5F) +
        quad("roof", {-1, 0, -1}, {-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, "grey", named) +
        quad("door", {0, 0, -1}, {0, 0, 1}, {1, 0, 1}, {1, 0, -1}, "grey"));
    const Picture picture = render(scene);
    EXPECT_NEAR(cover_of(picture, 0, "crypto_object")[matte_id("hero")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 1, "crypto_object")[matte_id("door")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 0, "crypto_material")[matte_id("grey_7")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 1, "crypto_material")[matte_id("grey")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 0, "crews")[matte_id("kitchen")], 1, 1e-6);
    EXPECT_NEAR(cover_of(picture, 1, "crews")[0], 1, 1e-6);
    // The manifests know all of them and nothing else.
    std::map<std::string, MatteManifest> manifests;
    for (const Matte& matte : scene.scene().plan.mattes)
        manifests[matte.name.str()] = matte.manifest;
    const auto one = [](const char* name) { return std::pair{std::string(name), matte_id(name)}; };
    EXPECT_EQ(manifests["crypto_object"], (MatteManifest{one("door"), one("hero")}));
    EXPECT_EQ(manifests["crypto_material"], (MatteManifest{one("grey"), one("grey_7")}));
    EXPECT_EQ(manifests["crews"], (MatteManifest{one("kitchen")}));
}

TEST(Mattes, TellInstancesApartByTheirData) {
    const std::string placed =
        node("instancer", "crowd",
             " nodes \"tile\"\n instance_matrix 2 1 MATRIX\n 1 0 0 0 0 1 0 0 0 0 1 0 -0.5 0 0 1\n"
             " 1 0 0 0 0 1 0 0 0 0 1 0 0.5 0 0 1\n node_idxs 2 1 UINT 0 0\n"
             " declare instance_crypto_object constant ARRAY STRING\n"
             " instance_crypto_object 2 1 STRING \"ann\" \"bob\"");
    const Picture picture =
        render(frame_text(2, 1, 2, from_above(2), outputs_of(kObjects)) + marks() +
               lambert("grey", 0.5F) + floor("tile", 0, 0.5F, "grey", " visibility 0") + placed);
    EXPECT_NEAR(cover_of(picture, 0, "crypto_object")[matte_id("ann")], 0.5, 0.5 + 1e-6);
    EXPECT_GT(cover_of(picture, 0, "crypto_object")[matte_id("ann")], 0.4);
    EXPECT_GT(cover_of(picture, 1, "crypto_object")[matte_id("bob")], 0.4);
}

TEST(Mattes, LookThroughTransmitAovs) {
    const std::string pane =
        node("standard_surface", "pane",
             " transmission 1\n transmit_aovs on\n thin_walled on\n specular 0.5");
    const Picture picture = render(frame_text(2, 2, 2, from_above(1), outputs_of(kObjects)) +
                                   marks() + pane + lambert("grey", 0.5F) +
                                   floor("window", 1, 5, "pane") + floor("ground", 0, 5, "grey"));
    EXPECT_NEAR(coverage(picture, "crypto_object", "ground"), 1, 1e-6);
    const std::string glass = node("standard_surface", "pane", " transmission 1");
    const Picture seen = render(frame_text(2, 2, 2, from_above(1), outputs_of(kObjects)) +
                                marks() + glass + lambert("grey", 0.5F) +
                                floor("window", 1, 5, "pane") + floor("ground", 0, 5, "grey"));
    EXPECT_NEAR(coverage(seen, "crypto_object", "window"), 1, 1e-6);
}

TEST(Mattes, HaveAsManyRanksAsAsked) {
    std::string veils;
    for (int i = 0; i < 5; ++i)
        veils += floor("veil" + std::to_string(i), 1 - 0.1F * static_cast<float>(i), 5, "veil");
    const auto scene = [&](const char* depth) {
        return frame_text(1, 1, 1, from_above(1), outputs_of(kObjects)) +
               marks(std::string(" cryptomatte_depth ") + depth) + half_open("veil", 0.5F) + veils;
    };
    const Picture few = render(scene("3"));
    EXPECT_TRUE(few.has("crypto_object01"));
    EXPECT_FALSE(few.has("crypto_object02"));
    EXPECT_NEAR(coverage(few, "crypto_object", "veil3", 2), 0.0625, 1e-6);
    EXPECT_NEAR(coverage(few, "crypto_object", "veil4", 2), 0, 1e-6);
    EXPECT_NEAR(coverage(render(scene("6")), "crypto_object", "veil4"), 0.03125, 1e-6);
}

TEST(Mattes, ShowAPreviewWhereItIsAskedFor) {
    const Picture picture =
        render(frame_text(2, 2, 1, from_above(1), outputs_of(kObjects)) +
               marks(" preview_in_exr on") + lambert("grey", 0.5F) + floor("bunny", 0, 5, "grey"));
    // 13851a76: green is 851a76.., blue is 1a76..
    const Color color = picture.color("crypto_object", 0);
    EXPECT_EQ(color.r, 0);
    EXPECT_NEAR(color.g, 0x851a7600U * 0x1p-32F, 1e-6);
    EXPECT_NEAR(color.b, 0x1a760000U * 0x1p-32F, 1e-6);
}

TEST(Mattes, DoNotNeedAShader) {
    const Picture picture = render(
        frame_text(2, 2, 1, from_above(1)) + lambert("grey", 0.5F) + floor("a:tile", 0, 5, "grey"),
        in_memory({"crypto_object", "crypto_asset"}));
    EXPECT_NEAR(coverage(picture, "crypto_object", "tile"), 1, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_asset", "a"), 1, 1e-6);
}

TEST(Mattes, ReadWhatArnoldWroteOutAgain) {
    const std::string expanded = node("cryptomatte_filter", "noop", " noop on") +
                                 node("cryptomatte_filter", "f0", " filter \"box\" rank 0") +
                                 node("cryptomatte_filter", "f1", " filter \"box\" rank 2");
    const Picture picture = render(
        frame_text(2, 2, 2, from_above(1),
                   outputs_of(R"(4 1 STRING "RGBA RGBA f d" "crypto_object RGB noop d"
                                 "crypto_object00 FLOAT f0 d" "crypto_object01 FLOAT f1 d")")) +
        expanded + marks(" cryptomatte_depth 4\n preview_in_exr on") + half_open("veil", 0.75F) +
        lambert("grey", 0.5F) + floor("upper", 1, 5, "veil") + floor("lower", 0, 5, "grey"));
    EXPECT_FALSE(picture.has("crypto_object")) << "noop";
    EXPECT_NEAR(coverage(picture, "crypto_object", "upper", 2), 0.75, 1e-6);
    EXPECT_NEAR(coverage(picture, "crypto_object", "lower", 2), 0.25, 1e-6);
}

TEST(Mattes, DoNotDependOnThreadsOrBuckets) {
    const auto scene = [&](const char* more) {
        return frame_text(16, 16, 3, from_above(2),
                          outputs_of(kObjects, std::string(" bucket_size ") + more)) +
               marks() + half_open("veil", 0.3F) + lambert("grey", 0.5F) +
               sphere("ball", {0, 0, 0}, 0.7F, "veil") +
               sphere("core", {0.2F, 0, 0}, 0.3F, "grey");
    };
    RenderOptions two = in_memory();
    two.threads = 2;
    const Picture a = render(scene("16")), b = render(scene("8"), two);
    for (const char* layer : {"crypto_object00", "crypto_object01", "crypto_object02"})
        EXPECT_TRUE(check_identical(a, layer, b, layer));
}

TEST(Mattes, AreWrittenByAovShadersOnly) {
    const TestScene scene(frame_text(2, 2, 1, from_above(1), outputs_of(kObjects)) + marks() +
                              lambert("grey", 0.5F) +
                              node("passthrough", "both", " passthrough grey\n eval1 marks") +
                              floor("tile", 0, 5, "both"),
                          in_memory(),
                          {"mattes are written by shaders of options.aov_shaders only"});
    EXPECT_EQ(scene.diagnostics().n_warnings(), 1U);
}

}  // namespace
}  // namespace lightsieve::testing
