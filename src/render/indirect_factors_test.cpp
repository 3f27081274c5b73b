// indirect_diffuse and indirect_specular: factors on light that arrives from anything but a light.
#include <gtest/gtest.h>

#include "render/path_log.h"
#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

const std::vector<std::string> kLpes{
    "direct_d C<RD>L",    "glow_d C<RD>O",           "sky_d C<RD>B",
    "bounced C<RD><RD>L", "glow_bounced C<RD><RD>O", "direct_s C<RS>L",
    "glow_s C<RS>O",      "mirrored C<RS><RD>L",     "through C<TD>.*"};

/// A corner of two walls with a glowing ball and three kinds of lights.
std::string corner(std::string_view wall) {
    return frame_text(16, 16, 4, persp_camera({1, 2, 4}, {0, 0.4F, 0}, 40),
                      " GI_diffuse_depth 2\n GI_specular_depth 2\n GI_total_depth 3") +
           node("standard_surface", "wall", wall) +
           node("standard_surface", "glow", " base 0\n specular 0\n emission 3") +
           floor("ground", 0, 3, "wall") +
           quad("back", {-3, 0, -1}, {3, 0, -1}, {3, 3, -1}, {-3, 3, -1}, "wall") +
           sphere("ember", {0.6F, 0.5F, 0.3F}, 0.3F, "glow") +
           node("distant_light", "sun", " direction -0.3 -1 -0.4") +
           square_light("lamp", 2.5F, 0.5F, " intensity 4") +
           node("skydome_light", "dome", " intensity 0.2");
}

Picture picture_of(std::string_view wall, std::string_view factors) {
    const std::vector<std::string> aovs{"direct", "indirect", "emission", "background"};
    return render(corner(std::string(wall) + std::string(factors)), in_memory(aovs, kLpes));
}

/// scaled = factor * plain, pixel by pixel: the factor changes no random choice here.
void expect_scaled(const Picture& scaled, const Picture& plain, const std::string& layer,
                   float factor) {
    ASSERT_TRUE(check_lit(plain, layer)) << layer;
    for (std::size_t i = 0; i < plain.n_pixels(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(scaled.color(layer, i)[c], factor * plain.color(layer, i)[c],
                        1e-5F * plain.color(layer, i)[c] + 1e-7F)
                << layer << " " << i;
}

TEST(IndirectFactors, DiffuseScalesAllButLights) {
    const char* wall = " specular 0";
    const Picture plain = picture_of(wall, ""), half = picture_of(wall, "\n indirect_diffuse 0.5");
    expect_scaled(half, plain, "direct_d", 1);
    expect_scaled(half, plain, "glow_d", 0.5F);
    expect_scaled(half, plain, "bounced", 0.5F);
    expect_scaled(half, plain, "glow_bounced", 0.25F);
    EXPECT_TRUE(check_sum(half, "RGBA", {"direct", "indirect", "emission", "background"}));
}

TEST(IndirectFactors, ZeroLeavesDirectLightAlone) {
    for (const char* wall : {" specular 0", " base 0\n specular_roughness 0.3\n metalness 1",
                             " base 0\n specular_roughness 0.05\n metalness 1"}) {
        const Picture plain = picture_of(wall, ""),
                      none = picture_of(wall, "\n indirect_diffuse 0\n indirect_specular 0");
        EXPECT_TRUE(check_equal(none, "direct", plain, "direct")) << wall;
        EXPECT_TRUE(check_black(none, "indirect")) << wall;
        EXPECT_TRUE(check_lit(plain, "indirect")) << wall;
        EXPECT_TRUE(check_sum(none, "RGBA", {"direct", "indirect", "emission", "background"}));
    }
}

TEST(IndirectFactors, EachKindHasItsOwn) {
    const char* wall = " specular 1\n specular_roughness 0.4\n specular_IOR 3\n caustics on";
    const Picture plain = picture_of(wall, ""),
                  diffuse = picture_of(wall, "\n indirect_diffuse 2"),
                  specular = picture_of(wall, "\n indirect_specular 2");
    for (const char* same : {"direct_d", "direct_s"}) {
        EXPECT_TRUE(check_same_mean(plain, same, diffuse, same));
        EXPECT_TRUE(check_same_mean(plain, same, specular, same));
    }
    EXPECT_TRUE(check_same_mean(plain, "glow_s", diffuse, "glow_s"));
    EXPECT_TRUE(check_same_mean(plain, "glow_d", specular, "glow_d"));
    EXPECT_FALSE(check_same_mean(plain, "glow_d", diffuse, "glow_d"));
    EXPECT_FALSE(check_same_mean(plain, "glow_s", specular, "glow_s"));
}

TEST(IndirectFactors, GoWithTheShareInTheLogToo) {
    const TestScene scene(corner(" specular_roughness 0.3\n indirect_diffuse 0.4\n "
                                 "indirect_specular 0.7\n subsurface 0.3\n thin_walled on"),
                          in_memory({"direct", "indirect", "specular", "sss"}, kLpes));
    const Picture picture = render(scene);
    EXPECT_TRUE(check_oracle(scene.scene(), picture, log_paths(scene.scene())));
    EXPECT_TRUE(check_lit(picture, "glow_s"));
    EXPECT_TRUE(check_lit(picture, "bounced"));
}

}  // namespace
}  // namespace lightsieve::testing
