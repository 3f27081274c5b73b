// options.ignore_*, shader_override and background: each switch acts, on what procedurals hold too.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

std::string above(std::string_view options, std::string_view camera_more = "") {
    std::string camera = ortho_camera({0, 5, 0}, {0, 0, 0}, 0.1F, {0, 0, -1});
    camera.insert(camera.rfind('}'), camera_more);
    return frame_text(1, 1, 32, camera, options);
}
Color seen(const std::string& text) { return render(text).color("RGBA", 0); }
/// The value without and with the switch.
std::pair<Color, Color> both(std::string_view option, const std::string& body,
                             std::string_view camera_more = "") {
    return {seen(above("", camera_more) + body),
            seen(above(" " + std::string(option) + '\n', camera_more) + body)};
}

const std::string kSun = node("distant_light", "sun", " direction 0 -1 0\n intensity 3");
const std::string kGround = lambert("grey", 0.5F) + floor("ground", 0, 1, "grey");
constexpr float kLit = 1.5F * kInvPi;

TEST(Switches, Lights) {
    const auto [without, with] = both("ignore_lights on", kSun + kGround);
    EXPECT_NEAR(without.r, kLit, 1e-4F);
    EXPECT_EQ(with.r, 0);
}

TEST(Switches, Shadows) {
    // An invisible roof that casts a shadow.
    const auto [without, with] =
        both("ignore_shadows on", kSun + kGround + floor("roof", 1, 1, "grey", " visibility 2"));
    EXPECT_EQ(without.r, 0);
    EXPECT_NEAR(with.r, kLit, 1e-4F);
}

TEST(Switches, Shaders) {
    const auto [without, with] =
        both("ignore_shaders on",
             kSun + floor("ground", 0, 1, "red") + node("flat", "red", " color 1 0 0"));
    EXPECT_EQ(without, (Color{1, 0, 0}));
    EXPECT_NEAR(with.r, 0.7F * 3 * kInvPi, 1e-4F) << "a lambert with its defaults";
}

TEST(Switches, Override) {
    const auto [without, with] =
        both("shader_override blue", kSun + kGround + node("flat", "blue", " color 0 0 1"));
    EXPECT_NEAR(without.r, kLit, 1e-4F);
    EXPECT_EQ(with, (Color{0, 0, 1}));
}

TEST(Switches, Bump) {
    // The normal is turned away from the sun by 60 degrees.
    const std::string text =
        kSun + node("lambert", "grey", " Kd 0.5\n Kd_color 1 1 1\n normal up") +
        node("float_to_rgb", "parts", " r 0.8660254\n g 0.5\n b 0") +
        node("rgb_to_vector", "up", " input parts") + floor("ground", 0, 1, "grey");
    const auto [without, with] = both("ignore_bump on", text);
    EXPECT_NEAR(without.r, 0.5F * kLit, 1e-3F);
    EXPECT_NEAR(with.r, kLit, 1e-4F);
}

TEST(Switches, Textures) {
    const std::string picture = std::string(LIGHTSIEVE_SOURCE_DIR) + "/tests/data/red.png";
    const std::string text = node("flat", "paint", " color 0 1 0\n color map") +
                             node("image", "map",
                                  " filename \"" + picture +
                                      "\"\n ignore_missing_textures on\n"
                                      " missing_texture_color 1 0 0 1") +
                             floor("ground", 0, 1, "paint");
    RenderOptions options = in_memory();
    EXPECT_EQ(render(TestScene(above(" ignore_textures on\n") + text, options, {"given twice"}))
                  .color("RGBA", 0),
              (Color{0, 1, 0}));
}

TEST(Switches, Smoothing) {
    // Vertex normals that lean by 60 degrees, all the same way.
    const std::string text =
        kSun + lambert("grey", 0.5F) +
        floor("ground", 0, 1, "grey",
              " smoothing on\n nidxs 4 1 UINT 0 0 0 0\n nlist 1 1 VECTOR 0.8660254 0.5 0");
    const auto [without, with] = both("ignore_smoothing on", text);
    EXPECT_NEAR(without.r, 0.5F * kLit, 1e-3F);
    EXPECT_NEAR(with.r, kLit, 1e-4F);
}

TEST(Switches, Subsurface) {
    const std::string text = kSun +
                             node("standard_surface", "wax",
                                  " base 0\n specular 0\n subsurface 1\n subsurface_color 1 1 1") +
                             sphere("ball", {0, 0, 0}, 1, "wax");
    const auto [without, with] = both("ignore_sss on", text);
    EXPECT_GT(without.r, 0.01F);
    EXPECT_EQ(with.r, 0);
}

TEST(Switches, DepthOfField) {
    // A black wall with a small white window, far from the plane of focus.
    const std::string text =
        node("flat", "white", " color 1 1 1") + floor("window", 0, 0.2F, "white");
    const std::string camera =
        node("persp_camera", "lens",
             " position 0 5 0\n look_at 0 0 0\n up 0 0 -1\n fov 0.1\n aperture_size 1\n"
             " focus_distance 1");
    const auto [without, with] = both("camera lens", text + camera);
    const Color sharp = seen(above(" camera lens\n ignore_dof on\n") + text + camera);
    EXPECT_EQ(without.r, 1);
    EXPECT_LT(with.r, 0.5F);
    EXPECT_EQ(sharp.r, 1);
}

TEST(Switches, Motion) {
    // At rest half of the time under the camera, then away.
    const std::string text = node("flat", "white", " color 1 1 1") +
                             floor("tile", 0, 0.5F, "white",
                                   " matrix 1 3 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
                                   " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
                                   " 1 0 0 0 0 1 0 0 0 0 1 0 900 0 0 1");
    const std::string_view open = " shutter_start 0\n shutter_end 1\n";
    const auto [blurred, first] = both("ignore_motion on", text, open);
    EXPECT_NEAR(blurred.r, 0.5F, 0.05F);
    EXPECT_EQ(first.r, 1);
    EXPECT_EQ(both("ignore_motion_blur on", text, open).second.r, 1) << "at time 0";
    EXPECT_EQ(both("ignore_motion_blur on\n reference_time 1", text, open).second.r, 0);
    // A third of the way to the last key it has left the picture; a shutter that is closed at that time does not matter.
    EXPECT_EQ(both("ignore_motion_blur on\n reference_time 0.67", text, open).second.r, 0);
    EXPECT_EQ(both("ignore_motion_blur on\n reference_time 0.4", text,
                   " shutter_start 0.6\n shutter_end 1\n")
                  .second.r,
              1);
}

TEST(Switches, ListOfTypes) {
    const auto [without, with] =
        both("ignore_list \"sphere\"", kSun + kGround + sphere("ball", {0, 2, 0}, 0.5F, "red") +
                                           node("flat", "red", " color 1 0 0"));
    EXPECT_EQ(without, (Color{1, 0, 0}));
    EXPECT_NEAR(with.r, kLit, 1e-4F);
}

TEST(Switches, Atmosphere) {
    const auto [without, with] =
        both("atmosphere fog\n ignore_atmosphere on",
             kSun + kGround + node("atmosphere_volume", "fog", " density 1\n attenuation 1"));
    EXPECT_NEAR(without.r, kLit, 1e-4F);
    EXPECT_NEAR(with.r, kLit, 1e-4F);
    EXPECT_LT(seen(above(" atmosphere fog\n") + kSun + kGround +
                   node("atmosphere_volume", "fog", " density 1\n attenuation 1"))
                  .r,
              0.9F * kLit);
}

TEST(Switches, BackgroundVisibility) {
    const std::string sky = node("flat", "sky", " color 0 0 1");
    EXPECT_EQ(seen(above(" background sky\n") + sky), (Color{0, 0, 1}));
    EXPECT_EQ(seen(above(" background sky\n background_visibility 254\n") + sky), kBlack);
    // 1: the camera alone; the mirror below it sees nothing.
    const std::string mirror = node("standard_surface", "mirror",
                                    " base 0\n metalness 1\n specular_roughness 0\n"
                                    " base_color 1 1 1\n specular_color 1 1 1\n base 1") +
                               floor("ground", 0, 1, "mirror");
    const std::string depth = " GI_specular_depth 1\n background sky\n";
    RenderOptions options = in_memory();
    const auto reflected = [&](const std::string& more) {
        return render(TestScene(above(depth + more) + sky + mirror, options, {"given twice"}))
            .color("RGBA", 0);
    };
    EXPECT_GT(reflected("").b, 0.9F);
    EXPECT_EQ(reflected(" background_visibility 1\n").b, 0);
}

}  // namespace
}  // namespace lightsieve::testing
