// What shaders get from their surroundings: links of every form, user data of every class, the state of the ray.
#include <gtest/gtest.h>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A floor whose colour comes from `shader`, seen from above; x and -z of the world run along the picture's axes.
std::string shown(const std::string& nodes, const std::string& on_the_floor = "") {
    return frame_text(8, 8, 1, from_above(2)) + floor("ground", 0, 1, "paint", on_the_floor) +
           nodes;
}
Color seen(const std::string& nodes, const std::string& on_the_floor = "") {
    return render(shown(nodes, on_the_floor)).mean("RGBA");
}
/// Samples lie anywhere in their pixels, so means of what changes over the floor are only this good.
constexpr double kJitter = 0.01;

void expect_color(Color is, Color expected, const char* what, double tolerance = 1e-5) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(is[c], expected[c], tolerance) << what << ", channel " << c;
}

TEST(Links, ComponentsOnBothSides) {
    const std::string source = node("flat", "source", " color 0.1 0.2 0.3");
    expect_color(seen(source + node("flat", "paint", " color source.g")), Color::grey(0.2F),
                 "source");
    expect_color(seen(source + node("flat", "paint", " color 1 1 1\n color.b source.r")),
                 {1, 1, 0.1F}, "both");
    expect_color(seen(source + node("flat", "paint", " color source\n color.g source.b")),
                 {0.1F, 0.3F, 0.3F}, "the component wins");
}

TEST(Links, ElementsOfArrays) {
    const std::string source = node("flat", "source", " color 0.1 0.2 0.3");
    const std::string ramp =
        " input 0.5\n position 3 1 FLOAT 0 0.5 1\n color 3 1 RGB 1 0 0  0 1 0  0 0 1\n";
    expect_color(seen(source + node("ramp_rgb", "paint", ramp + " color[1] source")),
                 {0.1F, 0.2F, 0.3F}, "whole element");
    expect_color(seen(source + node("ramp_rgb", "paint", ramp + " color[1].r source.b")),
                 {0.3F, 1, 0}, "component of an element");
    expect_color(
        seen(source + node("ramp_rgb", "paint", ramp + " position[0] source.r\n input 0.1")),
        {1, 0, 0}, "floats");
}

TEST(Links, ConvertTypes) {
    const auto through = [](const std::string& vector) {
        return node("vector_to_rgb", "paint", " input " + vector);
    };
    expect_color(seen(node("float_to_rgb", "c", " r 1\n g 2\n b 3") + through("c")), {1, 2, 3},
                 "colour to vector");
    expect_color(seen(node("dot", "product", " input1 1 0 0\n input2 2 0 0") + through("product")),
                 Color::grey(2), "number to vector");
    expect_color(
        seen(node("compare", "yes", " test \"<\"\n input2 1") + node("flat", "c", " color 1 0 0") +
             node("ramp_rgb", "paint", " wrap_uvs yes\n color c\n interpolation 0")),
        {1, 0, 0}, "truth to BOOL, a colour to the only element of an array");
}

TEST(Links, MatricesAndTexts) {
    expect_color(seen(node("matrix_transform", "m", " translate 0 0 3") +
                      node("matrix_multiply_vector", "v", " input 1 2 0\n matrix m") +
                      node("vector_to_rgb", "paint", " input v")),
                 {1, 2, 3}, "a matrix");
    const TestScene scene(shown(node("user_data_string", "text", " default \"colour\"") +
                                node("user_data_rgb", "paint", " attribute text")),
                          in_memory());
    EXPECT_TRUE(scene.diagnostics().items().empty());
    expect_color(seen(node("user_data_string", "text", " default \"tint\"") +
                          node("user_data_rgb", "paint", " attribute text"),
                      " declare tint constant RGB\n tint 0.5 0.25 1"),
                 {0.5F, 0.25F, 1}, "a text");
}

TEST(UserData, ClassesOnMeshes) {
    const auto data = [](const std::string& declared) {
        return seen(node("user_data_rgb", "paint", " attribute \"tint\"\n default 9 9 9"),
                    declared);
    };
    expect_color(data(""), Color::grey(9), "none");
    expect_color(data(" declare tint constant RGB\n tint 0.1 0.2 0.3"), {0.1F, 0.2F, 0.3F},
                 "constant");
    expect_color(data(" declare tint uniform FLOAT\n tint 1 1 FLOAT 0.25"), Color::grey(0.25F),
                 "uniform");
    // Corners of the square: 0 at two neighbouring ones, 1 at the others.
    expect_color(data(" declare tint varying FLOAT\n tint 4 1 FLOAT 0 0 1 1"), Color::grey(0.5F),
                 "varying", kJitter);
    expect_color(data(" declare tint indexed VECTOR\n tint 2 1 VECTOR 0 0 0  1 2 3\n tintidxs 4 1 "
                      "UINT 0 0 1 1"),
                 {0.5F, 1, 1.5F}, "indexed", kJitter);
    expect_color(data(" declare tint constant STRING\n tint \"no number\""), Color::grey(9),
                 "text");
}

TEST(UserData, TypesOfNodes) {
    const std::string declared =
        " declare a constant FLOAT\n a 0.75\n declare b constant INT\n b 3\n"
        " declare c constant RGBA\n c 0.1 0.2 0.3 0.4\n declare d constant VECTOR2\n d 5 6";
    const auto shows = [&](const char* type, const char* attribute) {
        return seen(node(type, "data", std::string(" attribute \"") + attribute + "\"") +
                        node("flat", "paint", " color data"),
                    declared);
    };
    expect_color(shows("user_data_float", "a"), Color::grey(0.75F), "float");
    expect_color(shows("user_data_int", "b"), Color::grey(3), "int");
    expect_color(shows("user_data_rgba", "c"), {0.1F, 0.2F, 0.3F}, "rgba");
    expect_color(shows("user_data_vec2", "d"), {5, 6, 0}, "vec2");
    expect_color(shows("user_data_vec3", "c"), {0.1F, 0.2F, 0.3F}, "vec3");
}

TEST(UserData, InstancesHaveTheirOwnOrThatOfTheirSource) {
    const std::string paint = node("user_data_float", "paint", " attribute \"tint\"");
    const auto instance = [&](const std::string& own) {
        return render(frame_text(4, 4, 1, from_above(1)) + paint +
                      floor("source", 0, 1, "paint",
                            " visibility 0\n declare tint constant FLOAT\n tint 0.25") +
                      node("ginstance", "copy", " node \"source\"\n" + own))
            .mean("RGBA");
    };
    expect_color(instance(""), Color::grey(0.25F), "of the source");
    expect_color(instance(" declare tint constant FLOAT\n tint 0.75"), Color::grey(0.75F),
                 "its own");
}

TEST(UserData, OnCurves) {
    const std::string curves =
        " points 4 1 VECTOR -2 0 -0.5  2 0 -0.5  -2 0 0.5  2 0 0.5\n num_points 2 1 UINT 2 2\n"
        " basis \"linear\"\n radius 0.4\n shader \"paint\"\n";
    const auto picture = [&](const std::string& data) {
        return render(frame_text(8, 8, 1, from_above(2)) + node("curves", "hair", curves + data) +
                      node("user_data_float", "paint", " attribute \"tint\""));
    };
    const Picture uniform = picture(" declare tint uniform FLOAT\n tint 2 1 FLOAT 0.25 0.75");
    // Rows of the picture run down: +z.
    EXPECT_NEAR(uniform.color("RGBA", 2 * 8 + 4).r, 0.25, 1e-5);
    EXPECT_NEAR(uniform.color("RGBA", 5 * 8 + 4).r, 0.75, 1e-5);
    const Picture varying = picture(" declare tint varying FLOAT\n tint 4 1 FLOAT 0 4 0 8");
    EXPECT_NEAR(varying.color("RGBA", 2 * 8 + 4).r, 4 * (2 + 0.25) / 4, 0.25);
    EXPECT_NEAR(varying.color("RGBA", 5 * 8 + 4).r, 8 * (2 + 0.25) / 4, 0.5);
}

TEST(UvSets, AreUserDataOfCorners) {
    const std::string sets =
        " declare map2 indexed VECTOR2\n map2 2 1 VECTOR2 0.25 0.75  0.75 0.25\n map2idxs 4 1 "
        "UINT 0 0 1 1";
    const auto ramp = [&](const char* uvset) {
        return seen(
            node("ramp_rgb", "paint", std::string(" type \"v\"\n uvset \"") + uvset + "\""), sets);
    };
    expect_color(ramp(""), Color::grey(0.5F), "first", kJitter);
    const Picture picture =
        render(shown(node("ramp_rgb", "paint", " type \"v\"\n uvset \"map2\""), sets));
    float low = 1, high = 0;
    for (std::size_t i = 0; i < picture.n_pixels(); ++i) {
        low = std::min(low, picture.color("RGBA", i).r);
        high = std::max(high, picture.color("RGBA", i).r);
    }
    // 8 pixels over 0.25..0.75, with samples anywhere in the outer ones.
    EXPECT_GT(low, 0.25);
    EXPECT_LT(low, 0.25 + 1.0 / 16);
    EXPECT_LT(high, 0.75);
    EXPECT_GT(high, 0.75 - 1.0 / 16);
}

TEST(State, OfTheRayAndThePoint) {
    const auto pixel = [](const std::string& nodes, std::size_t i) {
        return render(shown(nodes)).color("RGBA", i).r;
    };
    const auto floats = [](const char* variable) {
        return node("state_float", "paint", std::string(" variable \"") + variable + '"');
    };
    EXPECT_NEAR(pixel(floats("sx"), 8 * 3 + 7), 0.875, 0.125);
    EXPECT_NEAR(pixel(floats("sy"), 3), 0.875, 0.125);
    EXPECT_NEAR(pixel(floats("Rl"), 0), 2, 1e-5);
    const auto ints = [](const char* variable) {
        return node("state_int", "i", std::string(" variable \"") + variable + '"') +
               node("flat", "paint", " color i");
    };
    EXPECT_EQ(pixel(ints("x"), 8 * 3 + 7), 7);
    EXPECT_EQ(pixel(ints("y"), 8 * 3 + 7), 3);
    EXPECT_EQ(pixel(ints("Rt"), 0), 1);
    const auto vectors = [](const char* variable) {
        return seen(node("state_vector", "v", std::string(" variable \"") + variable + '"') +
                    node("vector_to_rgb", "paint", " input v\n mode \"canonical\""));
    };
    expect_color(vectors("Rd"), {0.5F, 0, 0.5F}, "Rd");
    expect_color(vectors("N"), {0.5F, 1, 0.5F}, "N");
    expect_color(vectors("Ng"), {0.5F, 1, 0.5F}, "Ng");
    // The floor is 2 wide and its uv run from 0 to 1.
    const Color along = vectors("dPdu") - Color::grey(0.5F);
    EXPECT_NEAR(length({along.r, along.g, along.b}), 1, 1e-4);
    // Bounces: seen in a mirror.
    const Picture mirror = render(frame_text(4, 4, 1, from_above(1, 1), " GI_specular_depth 2") +
                                  node("standard_surface", "metal",
                                       " metalness 1\n base_color 1 1 1\n specular_roughness 0") +
                                  floor("ground", 0, 1, "metal") +
                                  node("state_int", "i", " variable \"bounces_reflect\"") +
                                  node("flat", "paint", " color i") + floor("lid", 2, 5, "paint"));
    EXPECT_NEAR(mirror.mean("RGBA").g, 1, 0.01);
}

TEST(DataAovs, AreRenderedWithoutTheBeauty) {
    const std::string only_depth = frame_text(8, 8, 1, from_above(2), " outputs \"Z FLOAT f d\"") +
                                   floor("ground", 0, 1, "paint") + node("flat", "paint", "");
    EXPECT_NEAR(render(only_depth).mean("Z").r, 2, 1e-5);
}

TEST(Background, IsAPlaneBehindThePicture) {
    const std::string ramp = node("ramp_rgb", "sky", " type \"u\"");
    const Picture picture = render(frame_text(8, 8, 1, from_above(1), " background sky") + ramp);
    EXPECT_NEAR(picture.color("RGBA", 0).r, 0.5 / 8, 0.5 / 8);
    EXPECT_NEAR(picture.color("RGBA", 7).r, 7.5 / 8, 0.5 / 8);
    const Picture clear = render(frame_text(4, 4, 1, from_above(1), " background sky") +
                                 node("shuffle", "sky", " color 1 1 1\n alpha 0.25"));
    EXPECT_NEAR(clear.mean_alpha("RGBA"), 0.25, 1e-5);
}

}  // namespace
}  // namespace lightsieve::testing
