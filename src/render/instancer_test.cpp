// Instancers: one shape at many places, nested, with values and user data of their own.
#include <gtest/gtest.h>

#include <bit>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

constexpr std::string_view kHere = " 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1";

/// A matrix that moves by (x, 0, z).
std::string moved(float x, float z = 0) {
    return " 1 0 0 0  0 1 0 0  0 0 1 0  " + text_of(Vec3f{x, 0, z});
}
std::string at(float x, float z = 0) { return moved(x, z) + " 1 "; }

/// A picture of four by one pixels from above, each a scene unit wide: pixel i sees x = i - 1.5.
std::string four_columns() {
    return frame_text(4, 1, 1, ortho_camera({0, 5, 0}, {0, 0, 0}, 4, {0, 0, -1}),
                      " pixel_aspect_ratio 1") +
           node("flat", "red", " color 1 0 0") + node("flat", "green", " color 0 1 0") +
           node("flat", "blue", " color 0 0 1");
}
/// A tile of one unit that only instances show.
std::string tile(std::string_view name, std::string_view shader, std::string_view more = "") {
    return floor(name, 0, 0.5F, shader, " visibility 0\n" + std::string(more));
}
std::string instancer(std::string_view name, std::string_view body) {
    return node("instancer", name, body);
}
std::string matrices(std::initializer_list<float> xs) {
    std::string out = " instance_matrix " + std::to_string(xs.size()) + " 1 MATRIX ";
    for (const float x : xs)
        out += at(x);
    return out + '\n';
}

/// The four columns as letters: r, g, b, w, or . for black.
std::string columns(const Picture& picture) {
    std::string out;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        const Color c = picture.color("RGBA", i);
        out += c == Color{1, 0, 0}   ? 'r'
               : c == Color{0, 1, 0} ? 'g'
               : c == Color{0, 0, 1} ? 'b'
               : is_black(c)         ? '.'
                                     : 'w';
    }
    return out;
}
std::string columns(const std::string& text, const std::vector<std::string>& warnings = {}) {
    return columns(render(TestScene(text, in_memory(), warnings)));
}

TEST(Instancers, PlaceNodesByIndex) {
    EXPECT_EQ(columns(four_columns() + tile("a", "red") + tile("b", "green") +
                      instancer("many", " nodes 2 1 NODE a b\n node_idxs 3 1 UINT 1 0 1\n" +
                                            matrices({-1.5F, -0.5F, 1.5F}))),
              "gr.g");
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-1.5F, 0.5F}))),
              "r.r.");
}

TEST(Instancers, OwnMatrixComesLast) {
    // Mirrored and moved by 1, after the instance's own -0.5.
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-0.5F}) +
                                            " matrix -1 0 0 0  0 1 0 0  0 0 1 0  1 0 0 1\n")),
              "...r");
}

TEST(Instancers, InheritTheMatrixOfWhatTheyPlaceOnlyIfAsked) {
    const std::string text = four_columns() + tile("a", "red", " matrix" + at(1)) +
                             instancer("many", " nodes a\n" + matrices({-1.5F}));
    EXPECT_EQ(columns(text), "r...");
    const std::string more = " instance_inherit_xform on";
    EXPECT_EQ(columns(four_columns() + tile("a", "red", " matrix" + at(1)) +
                      instancer("many", " nodes a\n" + matrices({-1.5F}) + more)),
              ".r..");
    // Exporters declare it, as user data.
    EXPECT_EQ(columns(four_columns() + tile("a", "red", " matrix" + at(1)) +
                      instancer("many", " nodes a\n" + matrices({-1.5F, 0.5F}) +
                                            " declare instance_inherit_xform constant ARRAY "
                                            "BOOL\n instance_inherit_xform 2 1 BOOL on off")),
              ".rr.");
}

TEST(Instancers, GiveVisibilityAndShadersByInstance) {
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F, 0.5F}) +
                                            " instance_visibility 3 1 BYTE 255 0 254\n"
                                            " instance_shader 3 1 NODE green blue blue\n")),
              "g...");
    // One value stands for all; NULL leaves the shape's own.
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F}) +
                                            " instance_visibility 1\n"
                                            " instance_shader 2 1 NODE NULL blue\n")),
              "rb..");
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-1.5F}) + " visibility 0")),
              "....");
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      instancer("many", " nodes a\n" + matrices({-1.5F}) + " shader blue")),
              "b...");
}

TEST(Instancers, GiveOtherValuesByInstance) {
    const auto many = [&](const std::string& more) {
        return four_columns() + tile("a", "red") + floor("below", -1, 9, "green") +
               instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F}) + more);
    };
    EXPECT_EQ(columns(many(" instance_matte 2 1 BOOL off on")), "r.gg");
    EXPECT_EQ(columns(many(" instance_sidedness 2 1 BYTE 255 254\n"
                           " instance_invert_normals 2 1 BOOL on on")),
              "rggg");
    const Picture ids = render(many(" instance_id 2 1 UINT 7 9"), in_memory({"ID UINT"}));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(ids.layer("ID").pixels[0]), 7U);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(ids.layer("ID").pixels[1]), 9U);
}

TEST(Instancers, CarryUserDataByInstance) {
    const std::string shown = node("user_data_rgb", "shown", " attribute tint\n default 1 1 1") +
                              node("flat", "paint", " color shown");
    EXPECT_EQ(columns(four_columns() + shown + tile("a", "paint") +
                      instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F, 0.5F}) +
                                            " declare instance_tint constant ARRAY RGB\n"
                                            " instance_tint 3 1 RGB 1 0 0  0 0 1  0 1 0")),
              "rbg.");
    // The shape's own stands behind the instancer's, and the instancer's plain one is the same for all.
    const std::string own = " declare tint constant RGB\n tint 1 0 0";
    EXPECT_EQ(columns(four_columns() + shown + tile("a", "paint", own) +
                      instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F}))),
              "rr..");
    EXPECT_EQ(columns(four_columns() + shown + tile("a", "paint", own) +
                      instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F}) +
                                            " declare tint constant RGB\n tint 0 1 0")),
              "gg..");
}

TEST(Instancers, NestAndKeepApartWhatEachInstanceSays) {
    const std::string shown = node("user_data_rgb", "shown", " attribute tint\n default 1 1 1") +
                              node("flat", "paint", " color shown");
    // Pairs of tiles: the inner instancer has one at 0 and one at 1, the outer one places the pair twice.
    const std::string pair = instancer("pair", " nodes a\n visibility 0\n" + matrices({0, 1}) +
                                                   " declare instance_tint constant ARRAY RGB\n"
                                                   " instance_tint 2 1 RGB 1 0 0  0 0 1");
    EXPECT_EQ(columns(four_columns() + shown + tile("a", "paint") + pair +
                      instancer("two", " nodes pair\n" + matrices({-1.5F, 0.5F}))),
              "rbrb");
    // The outer one's values win.
    EXPECT_EQ(columns(four_columns() + shown + tile("a", "paint") + pair +
                      instancer("two", " nodes pair\n" + matrices({-1.5F, 0.5F}) +
                                           " declare instance_tint constant ARRAY RGB\n"
                                           " instance_tint 2 1 RGB 0 1 0  1 0 0")),
              "ggrr");
    // An instance of an instancer, with a shader of its own.
    EXPECT_EQ(
        columns(four_columns() + shown + tile("a", "paint") + pair +
                node("ginstance", "again", " node pair\n shader green\n matrix" + at(-0.5F))),
        ".gg.");
    // An instancer of instances takes what they say.
    EXPECT_EQ(columns(four_columns() + tile("a", "red") +
                      node("ginstance", "blue_one", " node a\n shader blue\n visibility 0") +
                      instancer("two", " nodes blue_one\n" + matrices({-1.5F, 0.5F}))),
              "b.b.");
}

TEST(Instancers, ShareGeometry) {
    const TestScene scene(four_columns() + tile("a", "red") +
                          instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F, 0.5F})));
    ASSERT_EQ(scene.scene().objects.size(), 3U);
    EXPECT_EQ(scene.scene().objects[0].geometry, scene.scene().objects[2].geometry);
    EXPECT_EQ(scene.scene().objects[0].shaders.data(), scene.scene().objects[2].shaders.data());
    EXPECT_LE(sizeof(SceneObject), 144U) << "a million of them must stay small";
}

TEST(Instancers, MoveWithMotionKeys) {
    // From x = -1.5 to 1.5 while the shutter is open: a quarter of the time over each column.
    std::string camera = ortho_camera({0, 5, 0}, {0, 0, 0}, 4, {0, 0, -1});
    camera.insert(camera.rfind('}'), " shutter_start 0\n shutter_end 1\n");
    const std::string moving = " nodes a\n instance_matrix 1 2 MATRIX " + at(-2.0F) + at(2.0F);
    const auto render_with = [&](const std::string& more) {
        return render(frame_text(4, 1, 32, camera) + node("flat", "red", " color 1 0 0") +
                      tile("a", "red") + instancer("many", moving + more));
    };
    const Picture picture = render_with("");
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(picture.color("RGBA", i).r, 0.25F, 0.07F) << i;
    // Its own clock: at rest in the middle of the motion.
    const Picture middle = render_with(" instance_motion_start -1000\n instance_motion_end 1001");
    EXPECT_NEAR(middle.color("RGBA", 1).r, 0.5F, 0.07F);
    EXPECT_NEAR(middle.color("RGBA", 3).r, 0, 0.07F);
}

TEST(Instancers, LightGroupsByInstance) {
    const std::string text =
        frame_text(4, 1, 4, ortho_camera({0, 5, 0}, {0, 0, 0}, 4, {0, 0, -1})) +
        lambert("grey", 0.5F) + node("distant_light", "sun", " direction 0 -1 0\n intensity 3") +
        tile("a", "grey") +
        instancer("many", " nodes a\n" + matrices({-1.5F, -0.5F}) +
                              " instance_use_light_group 2 1 BOOL off on\n");
    const Picture picture = render(text);
    EXPECT_NEAR(picture.color("RGBA", 0).r, 1.5F * kInvPi, 1e-4F);
    EXPECT_EQ(picture.color("RGBA", 1).r, 0) << "an empty light group";
}

TEST(Instancers, BadInputIsToldAndTheRestRenders) {
    const auto with = [&](const std::string& body) {
        return four_columns() + tile("a", "red") +
               floor("c", 0, 0.5F, "green", " matrix" + at(1.5F)) + instancer("many", body);
    };
    EXPECT_EQ(columns(with(" nodes a\n node_idxs 2 1 UINT 0 5\n" + matrices({-1.5F, -0.5F})),
                      {"instance 1 asks for node 5 of 1"}),
              "r..g");
    EXPECT_EQ(columns(with(matrices({-1.5F})), {"has no nodes"}), "...g");
    EXPECT_EQ(columns(with(" nodes a\n"), {"has no instance_matrix"}), "...g");
    EXPECT_EQ(columns(with(" nodes a\n" + matrices({-1.5F, -0.5F}) +
                           " instance_shader 3 1 NODE blue red red"),
                      {"instance_shader has 3 values for 2 instances"}),
              "br.g");
    EXPECT_EQ(
        columns(with(" nodes a\n instance_matrix 2 1 MATRIX 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1" +
                     at(-0.5F)),
                {"flattens it"}),
        ".r.g");
    EXPECT_EQ(columns(with(" nodes 2 1 NODE a red\n node_idxs 2 1 UINT 0 0\n" +
                           matrices({-1.5F, -0.5F}))),
              "rr.g")
        << "a node that is never placed need not be a shape";
}

/// What is reported of a scene that does not compile.
std::string errors_of(const std::string& text) {
    try {
        const TestScene scene(text);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "none";
}

TEST(Instancers, RecursionAndExplosionsAreErrors) {
    const std::string circle = four_columns() + instancer("one", " nodes two\n" + matrices({0})) +
                               instancer("two", " nodes one\n" + matrices({0}));
    EXPECT_NE(errors_of(circle).find("cyclic-link"), std::string::npos) << errors_of(circle);

    std::string nested = four_columns() + tile("i0", "red");
    for (int i = 1; i <= 5; ++i) {
        std::string many =
            " visibility 0\n nodes i" + std::to_string(i - 1) + "\n instance_matrix 200 1 MATRIX ";
        for (int k = 0; k < 200; ++k)
            many += kHere;
        nested += instancer("i" + std::to_string(i), many);
    }
    nested += node("ginstance", "all", " node i5");
    EXPECT_NE(errors_of(nested).find("limit-instances"), std::string::npos) << errors_of(nested);

    // Longer than the stack is deep.
    std::string chain = four_columns() + tile("n0", "red");
    for (int i = 1; i <= 30'000; ++i)
        chain += node("ginstance", "n" + std::to_string(i),
                      " visibility 0\n node n" + std::to_string(i - 1));
    chain += node("ginstance", "end", " node n30000");
    EXPECT_NE(errors_of(chain).find("deep"), std::string::npos);

    const std::string no_shape = four_columns() + instancer("one", " nodes red\n" + matrices({0}));
    EXPECT_NE(errors_of(no_shape).find("not a shape"), std::string::npos) << errors_of(no_shape);
}

}  // namespace
}  // namespace lightsieve::testing
