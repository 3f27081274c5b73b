// What procedurals hold, in the world: matrices, overrides, lights, instances of them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/testing/checks.h"

namespace lightsieve::testing {
namespace {

/// A scene with files beside it.
class Procedurals : public ::testing::Test {
  protected:
    Procedurals() {
        std::string pattern = ::testing::TempDir() + "lightsieve_procedural_XXXXXX";
        folder_ = mkdtemp(pattern.data());
        // A red tile and a blue one beside it.
        write("tiles.ass", tile("left", -0.5F, "inner_red") + tile("right", 0.5F, "inner_blue") +
                               node("flat", "inner_red", " color 1 0 0") +
                               node("flat", "inner_blue", " color 0 0 1"));
    }
    ~Procedurals() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ + "/" + name) << text;
    }
    [[nodiscard]] RenderOptions beside(std::vector<std::string> aovs = {}) const {
        RenderOptions out = in_memory(std::move(aovs));
        out.scene_path = folder_ + "/scene.ass";
        return out;
    }
    static std::string tile(std::string_view name, float x, std::string_view shader,
                            std::string_view more = "") {
        return floor(name, 0, 0.5F, shader, " matrix" + at(x) + std::string(more));
    }
    static std::string at(float x) {
        return " 1 0 0 0  0 1 0 0  0 0 1 0  " + text_of(Vec3f{x, 0, 0}) + " 1\n";
    }
    static std::string procedural(std::string_view name, std::string_view file,
                                  std::string_view more = "") {
        return node("procedural", name,
                    " filename \"" + std::string(file) + "\"\n" + std::string(more));
    }
    /// Four columns of a unit each from above, the middle of the first at x = -1.5; r, g, b, w, or . for black.
    [[nodiscard]] std::string columns(const std::string& text,
                                      const std::vector<std::string>& warnings = {}) const {
        const Picture picture = render(TestScene(head() + text, beside(), warnings));
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
    static std::string head() {
        return frame_text(4, 1, 1, ortho_camera({0, 5, 0}, {0, 0, 0}, 4, {0, 0, -1})) +
               node("flat", "green", " color 0 1 0");
    }

  private:
    std::string folder_;
};

TEST_F(Procedurals, AreMovedByTheirMatrices) {
    EXPECT_EQ(columns(procedural("p", "tiles.ass")), ".rb.");
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " matrix" + at(-1))), "rb..");
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " matrix" + at(-1)) +
                      procedural("q", "tiles.ass", " matrix" + at(1))),
              "rbrb");
    write("outer.ass", procedural("in", "tiles.ass", " matrix" + at(2)));
    EXPECT_EQ(columns(procedural("p", "outer.ass", " matrix" + at(-1))), "..rb") << "nested";
}

TEST_F(Procedurals, OverrideWhatTheyHold) {
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " shader green")), ".gg.");
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " shader NULL")), ".rb.");
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " visibility 254")), "....");
    EXPECT_EQ(columns(procedural("p", "tiles.ass", " visibility 0")), "....");
    const std::string below = floor("below", -1, 9, "green");
    EXPECT_EQ(columns(below + procedural("p", "tiles.ass", " matte on")), "g..g");
    EXPECT_EQ(columns(below + procedural("p", "tiles.ass", " sidedness 0\n invert_normals on")),
              "gggg");
    // Hidden sources stay hidden where exporters write visibility 255 on every procedural.
    write("hidden.ass", tile("a", -0.5F, "green", " visibility 0"));
    EXPECT_EQ(columns(procedural("p", "hidden.ass", " visibility 255")), "....");
    EXPECT_EQ(columns(procedural("p", "hidden.ass", " visibility 255\n override_nodes on")),
              "....")
        << "what is hidden is never asked for";
    // Defaults that are written override only if asked to.
    write("matte.ass", tile("a", -0.5F, "green", " matte on"));
    EXPECT_EQ(columns(procedural("p", "matte.ass", " matte off")), "....");
    EXPECT_EQ(columns(procedural("p", "matte.ass", " matte off\n override_nodes on")), ".g..");
}

TEST_F(Procedurals, CanBeInstanced) {
    const std::string source = procedural("p", "tiles.ass", " visibility 0");
    EXPECT_EQ(columns(source + node("ginstance", "i", " node p\n matrix" + at(-1))), "rb..");
    EXPECT_EQ(columns(source + node("ginstance", "i", " node p\n shader green")), ".gg.");
    EXPECT_EQ(columns(source + node("instancer", "many",
                                    " nodes p\n instance_matrix 2 1 MATRIX" + at(-1) + at(1) +
                                        " instance_shader 2 1 NODE NULL green")),
              "rbgg");
    write("instances.ass", tile("a", -0.5F, "green", " visibility 0") +
                               node("ginstance", "i", " node a\n matrix" + at(1)));
    EXPECT_EQ(columns(procedural("p", "instances.ass")), "..g.");
}

TEST_F(Procedurals, ShareGeometryAndKeepNamesApart) {
    const TestScene scene(head() + procedural("p", "tiles.ass", " matrix" + at(-1)) +
                              procedural("q", "tiles.ass", " namespace forest\n matrix" + at(1)),
                          beside());
    const auto& objects = scene.scene().objects;
    ASSERT_EQ(objects.size(), 4U);
    EXPECT_EQ(objects[0].geometry, objects[2].geometry);
    EXPECT_EQ(objects[0].name, Name("p^left"));
    EXPECT_EQ(objects[3].name, Name("forest^right"));
    EXPECT_NE(objects[0].id, objects[2].id);
}

TEST_F(Procedurals, GiveUserDataToWhatTheyHold) {
    write("painted.ass", tile("a", -0.5F, "paint") +
                             tile("b", 0.5F, "paint", " declare tint constant RGB\n tint 1 0 0") +
                             node("flat", "paint", " color look") +
                             node("user_data_rgb", "look", " attribute tint\n default 0 0 1"));
    EXPECT_EQ(columns(procedural("p", "painted.ass")), ".br.");
    EXPECT_EQ(columns(procedural("p", "painted.ass", " declare tint constant RGB\n tint 0 1 0")),
              ".gg.");
}

TEST_F(Procedurals, BringLights) {
    write("lamp.ass", node("point_light", "lamp", " position 0 1 0\n intensity 3"));
    write("mesh_lamp.ass",
          floor("shape", 0.5F, 0.1F, "dark", " visibility 0\n invert_normals off") +
              node("flat", "dark", " color 0 0 0") +
              node("mesh_light", "lamp", " mesh shape\n intensity 3"));
    const std::string lit = frame_text(2, 1, 8, ortho_camera({1, 5, 0}, {1, 0, 0}, 0.01F)) +
                            lambert("grey", 0.5F) + floor("ground", 0, 3, "grey");
    const auto radiance = [&](const std::string& text) {
        return render(TestScene(lit + text, beside())).color("RGBA", 0).r;
    };
    EXPECT_NEAR(radiance(procedural("p", "lamp.ass", " matrix" + at(1))), 1.5F * kInvPi, 1e-3F);
    EXPECT_NEAR(radiance(procedural("p", "lamp.ass", " matrix" + at(1)) +
                         procedural("q", "lamp.ass", " matrix" + at(1))),
                3.0F * kInvPi, 1e-3F)
        << "each of two that share a file has its own";
    write("nested.ass", procedural("in", "lamp.ass", " matrix" + at(2)));
    EXPECT_NEAR(radiance(procedural("p", "nested.ass", " matrix" + at(-1))), 1.5F * kInvPi, 1e-3F);
    // The mesh of a mesh light moves with it: under the camera, or two units beside it.
    const std::string turned = " matrix 1 0 0 0  0 -1 0 0  0 0 1 0  1 1 0 1";
    EXPECT_GT(radiance(procedural("p", "mesh_lamp.ass", turned)), 0.5F);
}

TEST_F(Procedurals, MoveOverTheShutter) {
    std::string camera = ortho_camera({0, 5, 0}, {0, 0, 0}, 4, {0, 0, -1});
    camera.insert(camera.rfind('}'), " shutter_start 0\n shutter_end 1\n");
    write("tile.ass", floor("a", 0, 0.5F, "red", " matrix 1 2 MATRIX" + at(-1) + at(1)) +
                          node("flat", "red", " color 1 0 0"));
    const Picture picture =
        render(TestScene(frame_text(4, 1, 32, camera) +
                             procedural("p", "tile.ass", " matrix 1 2 MATRIX" + at(-1) + at(1)),
                         beside()));
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(picture.color("RGBA", i).r, 0.25F, 0.07F)
            << i << ": both motions together go from -2 to 2";
}

TEST_F(Procedurals, ThatAreMissingAreToldAndTheRestRenders) {
    EXPECT_EQ(
        columns(tile("a", -1.5F, "green") + procedural("p", "gone.ass"), {"which does not exist"}),
        "g...");
}

TEST_F(Procedurals, ThatPlaceThemselvesAreAnError) {
    write("again.ass", node("ginstance", "a", " node p\n") + node("ginstance", "b", " node p\n"));
    try {
        (void)columns(procedural("p", "again.ass"));
        FAIL() << "it compiles";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("\"p\" holds itself"), std::string::npos) << e.what();
    }
}

TEST_F(Procedurals, ThatExplodeAreAnError) {
    // Thirty files, each of which places the next one twice.
    write("p30.ass", tile("a", 0, "green"));
    for (int i = 0; i < 30; ++i) {
        const std::string next = "p" + std::to_string(i + 1) + ".ass";
        write("p" + std::to_string(i) + ".ass", procedural("x", next) + procedural("y", next));
    }
    try {
        (void)columns(procedural("p", "p0.ass"));
        FAIL() << "it compiles";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("limit-instances"), std::string::npos) << e.what();
    }
}

TEST_F(Procedurals, AreEditedByOperators) {
    EXPECT_EQ(columns(procedural("p", "tiles.ass") + "options { operator op }\n" +
                      node("set_parameter", "op",
                           " selection \"p^left\"\n assignment \"shader='green'\"")),
              ".gb.");
}

}  // namespace
}  // namespace lightsieve::testing
