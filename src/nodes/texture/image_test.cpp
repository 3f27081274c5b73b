// image: parameters, missing files.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "io/image_write.h"
#include "io/testing/test_folder.h"
#include "io/texture.h"
#include "nodes/common/node_test_support.h"
#include "scene/shade_point.h"
#include "scene/shade_services.h"

namespace lightsieve {

NodeType node_image();

namespace {

/// A node's surroundings with textures and files.
class AssetContext final : public NodeContext {
  public:
    [[nodiscard]] Diagnostics& diagnostics() override { return plain.diagnostics(); }
    [[nodiscard]] SourceSpan where(Name param) const override { return plain.where(param); }
    [[nodiscard]] Name node_name() const override { return plain.node_name(); }
    [[nodiscard]] ColorInput color_input(Name param) override { return plain.color_input(param); }
    [[nodiscard]] bool is_linked(Name param) const override { return plain.is_linked(param); }
    [[nodiscard]] TextureCache& textures() override { return cache; }
    [[nodiscard]] std::optional<std::string> find_asset(std::string_view name) const override {
        const std::string path = (folder / name).string();
        return !name.empty() && std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
    }
    [[nodiscard]] bool ignore_missing_textures() const override { return ignore_missing; }
    [[nodiscard]] Frame frame() const override { return plain.frame(); }
    [[nodiscard]] std::unique_ptr<ShapeGeometry> geometry_of(NodeRef shape,
                                                             Mat4f& matrix) override {
        return plain.geometry_of(shape, matrix);
    }

    [[nodiscard]] float frame_number() const override { return frame_now; }
    [[nodiscard]] std::vector<Name> user_texts(Name attribute) override {
        return attribute == Name("paint") ? paints : std::vector<Name>{};
    }

    TestContext plain;
    TextureCache cache;
    float frame_now = 1;
    std::vector<Name> paints;  ///< what shapes carry as "paint"
    std::filesystem::path folder;
    bool ignore_missing = false;
};

class ImageNodeTest : public FolderTest {
  protected:
    ImageNodeTest() {
        context_.folder = in_folder("");
        // Upper row red, green; lower row blue, white; then a float file of one texel.
        PictureSpec spec;
        spec.width = spec.height = 2;
        spec.n_channels = 3;
        write_picture(in_folder("a.png"), spec,
                      std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
        spec.width = spec.height = 1;
        spec.n_channels = 4;
        spec.format = PictureFormat::Tiff;
        spec.type = PictureType::Float;
        write_picture(in_folder("one.tif"), spec, std::vector<float>{0.5F, 2, 3, 0.25F});
        node_.set("filename", Name("a.png")).set("color_space", Name("")).set_enum("filter", 0);
    }
    void prepare() { node_.type().prepare(node_.block(), context_); }
    [[nodiscard]] Rgba at(float u, float v) const {
        ShadePoint point;
        point.uv = {u, v};
        return node_.type().eval_value(node_.block(), point);
    }
    [[nodiscard]] Color color_at(float u, float v) const { return at(u, v).rgb; }

    AssetContext context_;
    TestNode node_{node_image()};
};

const Color kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};

TEST_F(ImageNodeTest, VGoesUp) {
    prepare();
    EXPECT_EQ(color_at(0.25F, 0.75F), kRed);
    EXPECT_EQ(color_at(0.75F, 0.75F), kGreen);
    EXPECT_EQ(color_at(0.25F, 0.25F), kBlue);
    EXPECT_EQ(color_at(0.75F, 0.25F), kWhite);
    EXPECT_EQ(color_at(1.25F, -0.25F), kRed);  // periodic
}

TEST_F(ImageNodeTest, CoordinatesMayBeScaledMovedFlippedAndSwapped) {
    node_.set("sflip", true);
    prepare();
    EXPECT_EQ(color_at(0.75F, 0.75F), kRed);
    node_.set("sflip", false).set("tflip", true);
    prepare();
    EXPECT_EQ(color_at(0.25F, 0.25F), kRed);
    node_.set("tflip", false).set("swap_st", true);
    prepare();
    EXPECT_EQ(color_at(0.25F, 0.75F), kWhite);
    EXPECT_EQ(color_at(0.75F, 0.25F), kRed);
    node_.set("swap_st", false).set("sscale", 2.0F).set("soffset", 0.5F);
    prepare();
    EXPECT_EQ(color_at(0.125F, 0.75F), kGreen);  // s = 0.75
}

TEST_F(ImageNodeTest, WrapModes) {
    node_.set_enum("swrap", 2).set_enum("twrap", 1);
    prepare();
    EXPECT_EQ(color_at(7, 0.75F), kGreen);
    EXPECT_EQ(color_at(0.25F, 1.75F), kBlack);
    node_.set_enum("swrap", 5)
        .set_enum("twrap", 3)
        .set("missing_texture_color", Rgba{{0.1F, 0.2F, 0.3F}, 0.4F});
    prepare();
    EXPECT_EQ(at(1.25F, 0.75F), (Rgba{{0.1F, 0.2F, 0.3F}, 0.4F}));
    EXPECT_EQ(color_at(0.25F, 1.25F), kRed);
    EXPECT_EQ(color_at(0.75F, 0.25F), kWhite);
}

TEST_F(ImageNodeTest, MultiplyOffsetAlphaAndChannels) {
    node_.set("filename", Name("one.tif"))
        .set("multiply", Color(2, 0.5F, 1))
        .set("offset", Color(0, 0, 1));
    prepare();
    EXPECT_EQ(at(0.5F, 0.5F), (Rgba{{1, 1, 4}, 0.25F}));
    node_.set("multiply", kWhite)
        .set("offset", kBlack)
        .set("single_channel", true)
        .set("start_channel", std::int32_t{1});
    prepare();
    EXPECT_EQ(at(0.5F, 0.5F), (Rgba{{2, 2, 2}, 1}));
}

TEST_F(ImageNodeTest, ColorSpacesApply) {
    node_.set("color_space", Name("auto"));
    prepare();
    const Color green = ColorConversion(kSrgb, kRenderingSpace)(kGreen);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(color_at(0.75F, 0.75F)[i], green[i], 1e-5F);
}

/// Shapes of one text each.
class Painted final : public ShadeServices {
  public:
    explicit Painted(const char* text) : text_(text) {}
    [[nodiscard]] bool user_value(const ShadePoint&, Name, ShaderValue&) const override {
        return false;
    }
    [[nodiscard]] bool user_text(const ShadePoint&, Name name, Name& out) const override {
        if (name != Name("paint") || text_.empty()) return false;
        out = text_;
        return true;
    }
    [[nodiscard]] bool uv_set(const ShadePoint&, Name, UvPoint&) const override { return false; }
    [[nodiscard]] Mat4f world_from_object(const ShadePoint&) const override { return {}; }
    [[nodiscard]] Mat4f object_from_world(const ShadePoint&) const override { return {}; }
    [[nodiscard]] bool triangle(const ShadePoint&, Triangle&) const override { return false; }
    [[nodiscard]] Name shape_name(const ShadePoint&) const override { return {}; }
    [[nodiscard]] bool trace(const ShadePoint&, const Probe&, ProbeHit&) const override {
        return false;
    }
    [[nodiscard]] std::int32_t n_lights() const override { return 0; }

  private:
    Name text_;
};

class ImageTokens : public ImageNodeTest {
  protected:
    /// A picture of one texel.
    void write(const std::string& name, Color c) {
        PictureSpec spec;
        spec.width = spec.height = 1;
        spec.n_channels = 3;
        write_picture(in_folder(name), spec, std::vector<float>{c.r, c.g, c.b});
    }
};

TEST_F(ImageTokens, TilesAreFilesByUnitSquares) {
    struct Case {
        const char *token, *first, *last;
    };
    for (const Case& c :
         {Case{"<udim>", "1001", "1013"}, Case{"<UDIM>", "1001", "1013"},
          Case{"<tile>", "_u1_v1", "_u3_v2"}, Case{"<uvtile>", "u1_v1", "u3_v2"}}) {
        write(std::string("t") + c.first + ".png", kRed);
        write(std::string("t") + c.last + ".png", kGreen);
        node_.set("filename", Name(std::string("t") + c.token + ".png"))
            .set<Rgba>("missing_texture_color", {{0.25F, 0.5F, 0.75F}, 0.5F});
        prepare();
        EXPECT_EQ(color_at(0.5F, 0.5F), kRed) << c.token;
        EXPECT_EQ(color_at(2.5F, 1.5F), kGreen) << c.token;
        // Squares without a file, and where there can be none.
        EXPECT_EQ(at(1.5F, 0.5F).a, 0.5F) << c.token;
        for (const Vec2f far : {Vec2f{-0.5F, 0.5F}, Vec2f{10.5F, 0}, Vec2f{0, 1e30F}})
            EXPECT_EQ(at(far.x, far.y).a, 0.5F) << c.token;
    }
    EXPECT_EQ(context_.plain.diagnostics().items().size(), 0U);
}

TEST_F(ImageTokens, FramesAreNumbers) {
    write("f12.png", kRed);
    write("f0012.png", kGreen);
    context_.frame_now = 12.75F;
    node_.set("filename", Name("f<frame>.png"));
    prepare();
    EXPECT_EQ(color_at(0.5F, 0.5F), kRed);
    node_.set("filename", Name("f<frame:04>.png"));
    prepare();
    EXPECT_EQ(color_at(0.5F, 0.5F), kGreen);
}

TEST_F(ImageTokens, TextsOfShapesChoose) {
    write("red.png", kRed);
    write("green.png", kGreen);
    write("blue.1001.png", kBlue);
    context_.paints = {Name("red"), Name("blue.<udim>"), Name("lost")};
    node_.set("filename", Name("<attr:paint default:green>.png"));
    prepare();
    const auto seen = [&](const char* text) {
        const Painted shape(text);
        ShadePoint point;
        point.uv = {0.5F, 0.5F};
        point.services = &shape;
        return node_.type().eval_value(node_.block(), point).rgb;
    };
    EXPECT_EQ(seen("red"), kRed);
    EXPECT_EQ(seen("blue.<udim>"), kBlue);
    EXPECT_EQ(seen(""), kGreen) << "a shape without the text";
    EXPECT_EQ(color_at(0.5F, 0.5F), kGreen) << "no shape at all";
    EXPECT_EQ(seen("lost"), kBlack) << "a text without a file";
}

TEST_F(ImageNodeTest, LinkedCoordinatesReplaceTheShapes) {
    node_.set("uvcoords", Vec2f{0.75F, 0.75F});
    prepare();
    EXPECT_EQ(color_at(0.25F, 0.75F), kRed);
    context_.plain.linked.insert("uvcoords");
    prepare();
    EXPECT_EQ(color_at(0.25F, 0.75F), kGreen);
}

TEST_F(ImageNodeTest, MissingFilesAreErrorsUnlessIgnored) {
    node_.set("filename", Name("none.png"))
        .set("missing_texture_color", Rgba{{0.1F, 0.2F, 0.3F}, 0.4F});
    prepare();
    ASSERT_EQ(context_.diagnostics().n_errors(), 1U);
    EXPECT_EQ(context_.diagnostics().items()[0].code, Code::FileNotFound);
    EXPECT_EQ(context_.diagnostics().items()[0].where.text(), "filename");

    for (const bool by_options : {true, false}) {
        AssetContext quiet;
        quiet.ignore_missing = by_options;
        node_.set("ignore_missing_textures", !by_options);
        node_.type().prepare(node_.block(), quiet);
        EXPECT_EQ(quiet.diagnostics().n_errors(), 0U);
        EXPECT_EQ(quiet.diagnostics().n_warnings(), 1U);
        EXPECT_EQ(at(0.5F, 0.5F), (Rgba{{0.1F, 0.2F, 0.3F}, 0.4F}));
    }
}

}  // namespace
}  // namespace lightsieve
