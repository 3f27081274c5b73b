// What a document means: types, links, errors; with the node types of test_nodes.h.
#include "scene/graph.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/ass_read.h"
#include "scene/ass_write.h"
#include "scene/test_nodes.h"

namespace lightsieve {
namespace {

/// `line:column severity code` of everything reported.
std::string reports(const Diagnostics& diagnostics) {
    std::string out;
    for (const Error& e : diagnostics.items()) {
        const LineColumn at = e.where.line_column();
        const char* kind = e.severity == Severity::Error     ? "error"
                           : e.severity == Severity::Warning ? "warning"
                                                             : "lint";
        out += (e.where.known() ? std::to_string(at.line) + ":" + std::to_string(at.column) + " "
                                : std::string()) +
               kind + " " + std::string(code_text(e.code)) + "\n";
    }
    return out;
}

struct Built {
    SceneGraph graph{test::registry()};
    std::string reported;  ///< places and codes
    std::string rendered;  ///< as people see it
};
Built build(const std::string& text, UnknownPolicy unknown = UnknownPolicy::Warn) {
    Diagnostics diagnostics;
    const Document document = read_ass(text, "t.ass", nullptr, diagnostics);
    Built out;
    out.graph = build_graph(document, test::registry(), {unknown}, diagnostics);
    out.reported = reports(diagnostics);
    out.rendered = diagnostics.render();
    return out;
}
/// Reports of one parameter line in a node of that type.
std::string reported(const std::string& type, const std::string& line) {
    return build(type + "\n{\n name n\n" + line + "\n}\n").reported;
}

template <class T>
std::vector<T> values(const Array<T>& array) {
    return {array.data, array.data + std::size_t{array.n} * array.n_keys};
}

// ---- blocks ----

TEST(Graph, DefaultsThenValues) {
    const Built b = build("persp_camera { name cam fov 30 }\n");
    EXPECT_EQ(b.reported, "");
    const NodeInstance* cam = b.graph.find("cam");
    ASSERT_NE(cam, nullptr);
    EXPECT_EQ(cam->get<float>("fov"), 30);
    EXPECT_EQ(cam->get<Vec2f>("screen_window_min"), (Vec2f{-1, -1}));
    EXPECT_EQ(cam->get<std::int32_t>("handedness"), 0);
    EXPECT_EQ(static_cast<const test::Camera*>(cam->block())->fov, 30);
    EXPECT_EQ(cam->find<float>("handedness"), nullptr);
    EXPECT_EQ(cam->find<float>("zoom"), nullptr);
    EXPECT_TRUE(cam->is_set("fov"));
    EXPECT_FALSE(cam->is_set("handedness"));
    EXPECT_EQ(cam->where("fov").line_column().column, 29U);
    EXPECT_EQ(cam->where("fov").text(), "30");
    EXPECT_EQ(cam->where("handedness").text(), "persp_camera");
    EXPECT_EQ(b.graph.options(), nullptr);
}

TEST(Graph, NodesStayWhereTheyAreWhenTheGraphMoves) {
    Built b = build("standard_surface { name s }\npolymesh { name m shader s }\noptions { }\n");
    const NodeInstance* s = b.graph.find("s");
    const SceneGraph moved = std::move(b.graph);
    EXPECT_EQ(moved.find("s"), s);
    EXPECT_EQ(moved.find("m")->get<Array<NodeRef>>("shader")[0].node, s);
    EXPECT_EQ(moved.options(), moved.find("options"));
    ASSERT_EQ(moved.nodes().size(), 3U);
    EXPECT_EQ(moved.nodes()[1]->name(), Name("m"));
}

TEST(Graph, FirstOfTwoNodesOfOneNameIsTheOneMeant) {
    const Built b =
        build("polymesh { name m id 1 }\npolymesh { name m id 2 }\nginstance { name i node m }\n");
    EXPECT_EQ(b.reported, "2:1 warning duplicate-name\n");
    EXPECT_EQ(b.graph.find("i")->get<NodeRef>("node").node, b.graph.nodes()[0].get());
    EXPECT_EQ(b.graph.nodes().size(), 3U);
}

TEST(Graph, UnnamedNodesHaveNamesThatNobodyCanSpell) {
    const Built b = build("polymesh { id 1 }\nginstance { node \"<polymesh 0>\" }\n");
    EXPECT_EQ(b.reported, "2:18 warning unknown-reference\n");
    EXPECT_FALSE(b.graph.nodes()[0]->is_named());
    EXPECT_FALSE(b.graph.nodes()[0]->name().empty());
}

// ---- types ----

TEST(Types, WrongOnesAreLocatedErrors) {
    EXPECT_EQ(reported("standard_surface", " base 1 2"), "4:7 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base_color 1 2"), "4:13 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base_color 0.5 0.5"), "4:13 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " normal 1 2 3 4"), "4:9 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base 2 1 FLOAT 1 2"), "4:7 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base 1 1 VECTOR 1 2 3"), "4:7 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base 1 1 STRING \"a\""), "4:7 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base \"a\" \"b\""), "4:7 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " vlist 2 1 VECTOR2 1 2 3 4"), "4:8 error wrong-type\n");
    EXPECT_EQ(reported("polymesh", " vlist 1 2 3 4"), "4:8 error wrong-type\n");
    EXPECT_EQ(reported("polymesh", " vidxs 2 1 UINT 1 2.5"), "4:19 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " vidxs 2 1 UINT 1 5000000000"), "4:19 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " vidxs 2 1 FLOAT 1 2.5"), "4:20 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " vlist 1 1 VECTOR 1 2 3x"), "4:23 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " shader 1 1 FLOAT 3"), "4:9 error wrong-type\n");
    EXPECT_EQ(reported("polymesh", " smoothing maybe"), "4:12 error bad-value\n");
    EXPECT_EQ(reported("polymesh", " visibility -3"), "4:13 error bad-value\n");
    EXPECT_EQ(reported("mesh_light", " samples 3000000000"), "4:10 error bad-value\n");
    EXPECT_EQ(reported("driver_tiff", " filename 1 2"), "4:11 error wrong-type\n");
    EXPECT_EQ(reported("driver_tiff", " filename 2 1 STRING \"a\" \"b\""),
              "4:11 error wrong-type\n");
    EXPECT_EQ(reported("persp_camera", " matrix 1 2 3"), "4:9 error wrong-type\n");
    EXPECT_EQ(reported("persp_camera", " handedness 1 1 FLOAT 1.5"),
              "4:23 error unknown-choice\n");
    EXPECT_EQ(reported("ramp_rgb", " interpolation 1 1 b85FLOAT y"), "4:16 error wrong-type\n");
    EXPECT_EQ(reported("polymesh", " smoothing[0] on"), "4:2 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base.r 1"), "4:2 error wrong-type\n");
    EXPECT_EQ(reported("standard_surface", " base_color.a 1"), "4:2 error wrong-type\n");
    EXPECT_EQ(reported("ramp_rgb", " color.r 1"), "4:2 error wrong-type\n");
}

TEST(Types, MessagesSayWhatIsWanted) {
    const Built b = build("standard_surface\n{\n name s\n base_color 1 2\n}\n");
    EXPECT_EQ(
        b.rendered,
        "t.ass:4:13: error[wrong-type]: standard_surface.base_color takes 3 numbers (RGB), not 2\n"
        "    4 |  base_color 1 2\n"
        "      |             ^~~\n");
}

TEST(Types, ElementsAndComponentsOfValues) {
    const Built b = build(
        "ramp_rgb { name r color 2 1 RGB 0 0 0 1 1 1 color[1] 0.5 0.25 0 color[0].g 0.75 "
        "position[2] 3 input.b 4 }\n");
    EXPECT_EQ(b.reported, "");
    const NodeInstance& r = *b.graph.find("r");
    EXPECT_EQ(values(r.get<Array<Color>>("color")),
              (std::vector<Color>{{0, 0.75F, 0}, {0.5F, 0.25F, 0}}));
    EXPECT_EQ(values(r.get<Array<float>>("position")), (std::vector<float>{0, 0, 3}));
    EXPECT_EQ(r.get<Color>("input"), Color(0, 0, 4));
}

TEST(Types, PackedArraysChangeFamily) {
    // "!" W N: the word 0 three times; y is 1.0f. B packs bytes: 0x01010101.
    const Built b = build(
        "polymesh { name m vidxs 4 1 b85FLOAT y!z$$$$' nsides 2 1 b85INT Ezy }\nramp_rgb { name r "
        "position 4 1 b85INT B$mAM$  interpolation 4 1 b85INT B!z$$$$% }\n");
    EXPECT_EQ(b.reported, "");
    EXPECT_EQ(values(b.graph.find("m")->get<Array<std::uint32_t>>("vidxs")),
              (std::vector<std::uint32_t>{1, 0, 0, 0}));
    EXPECT_EQ(values(b.graph.find("m")->get<Array<std::uint32_t>>("nsides")),
              (std::vector<std::uint32_t>{0, 0x3f800000}));
    EXPECT_EQ(b.graph.find("r")->get<Array<float>>("position").n, 4U);
}

TEST(Types, ElementsFarOutAreRefused) {
    EXPECT_EQ(reported("ramp_rgb", " color[4000000000] 1 1 1"), "4:2 error bad-value\n");
    EXPECT_EQ(build("checkerboard { name c }\nramp_rgb { position[5000] c }\n").reported,
              "2:12 error bad-value\n");
    EXPECT_EQ(reported("ramp_rgb", " position 1 2 FLOAT 1 2\n position[1] 3"),
              "5:2 error bad-value\n");
}

TEST(Types, ExpandedRunsAreLimited) {
    // 2^28 floats from 30 characters are 1 GiB; the second such array is too much. The data is never allocated.
    std::string n;
    std::uint64_t value = 400000000;
    for (int i = 0; i < 5; ++i, value /= 85)
        n.insert(n.begin(), static_cast<char>(36 + value % 85));
    const Built b = build("ramp_rgb\n{\n position 400000000 1 b85FLOAT !z" + n + "\n}\n");
    EXPECT_EQ(b.reported, "3:11 error limit-array\n");
}

TEST(Types, RangesAndChoices) {
    const Built b = build(
        "persp_camera\n{\n name c\n fov 200\n handedness lft\n}\n"
        "standard_surface\n{\n name s\n coat nan\n base 7\n}\n"
        "mesh_light { name l samples -5 }\n"
        "ramp_rgb { name r interpolation 2 1 INT 6 1 }\n");
    EXPECT_EQ(b.reported,
              "4:6 warning param-range\n5:13 error unknown-choice\n10:7 warning "
              "param-range\n13:29 warning param-range\n14:33 warning param-range\n");
    EXPECT_EQ(b.graph.find("c")->get<float>("fov"), 179);
    EXPECT_EQ(b.graph.find("s")->get<float>("coat"), 0);
    EXPECT_EQ(b.graph.find("s")->get<float>("base"), 7) << "a soft range is only advice";
    EXPECT_EQ(b.graph.find("l")->get<std::int32_t>("samples"), 0);
    EXPECT_EQ(b.graph.find("r")->get<Array<std::int32_t>>("interpolation")[0], 3);
    EXPECT_NE(b.rendered.find("hint: did you mean \"left\"?"), std::string::npos);
    EXPECT_NE(b.rendered.find("persp_camera.fov cannot be 200: 179 is used"), std::string::npos);
}

TEST(Types, MotionKeysOfSingleValues) {
    const Built b = build("persp_camera { name c fov 1 2 FLOAT 30 40 }\n");
    EXPECT_EQ(b.reported, "1:27 warning param-pending\n");
    EXPECT_EQ(b.graph.find("c")->get<float>("fov"), 30);
}

// ---- parameters that do nothing ----

TEST(Params, UnknownOnesAreCountedAndGuessed) {
    const std::string text =
        "standard_surface\n{\n name body\n base_colour 0.8 0.2 0.1\n}\nstandard_surface\n{\n name "
        "b\n base_colour 1 1 1\n zyx 3\n}\n";
    const Built b = build(text);
    EXPECT_EQ(b.rendered,
              "t.ass:4:2: warning[unknown-param]: standard_surface has no parameter "
              "\"base_colour\" (2 times)\n"
              "    4 |  base_colour 0.8 0.2 0.1\n"
              "      |  ^~~~~~~~~~~\n"
              "  hint: did you mean \"base_color\"?   `lightsieve nodes standard_surface` lists "
              "all of them\n"
              "  note: node \"body\" starts at t.ass:1:1\n"
              "t.ass:10:2: warning[unknown-param]: standard_surface has no parameter \"zyx\"\n"
              "   10 |  zyx 3\n"
              "      |  ^~~\n"
              "  hint: `lightsieve nodes standard_surface` lists all of them\n"
              "  note: node \"b\" starts at t.ass:6:1\n");
    EXPECT_EQ(b.graph.n_unknown_params(), 3U);
    EXPECT_EQ(build(text, UnknownPolicy::Error).reported,
              "4:2 error unknown-param\n10:2 error unknown-param\n");
    EXPECT_EQ(build(text, UnknownPolicy::Ignore).reported, "");
}

TEST(Params, PendingOnesWarnUnlessTheyAreAtTheirDefault) {
    EXPECT_EQ(reported("persp_camera", " exposure 0"), "");
    EXPECT_EQ(reported("persp_camera", " exposure 1"), "4:11 warning param-pending\n");
    EXPECT_EQ(build("checkerboard { name c }\npersp_camera { name d exposure c }\n").reported,
              "2:32 warning param-pending\n");
}

TEST(Params, IgnoredOnesAreSilentWhateverTheySay) {
    EXPECT_EQ(reported("mesh_light", " volume_samples 7"), "");
    EXPECT_EQ(reported("mesh_light", " volume_samples \"nonsense\""), "");
}

TEST(Params, GivenTwice) {
    const Built b = build(
        "mesh_light\n{\n name l\n samples 2\n samples 3\n color 1 1 1\n color c\n}\ncheckerboard "
        "{ name c }\n");
    EXPECT_EQ(b.reported, "5:2 lint duplicate-param\n");
    EXPECT_EQ(b.graph.find("l")->get<std::int32_t>("samples"), 3);
}

TEST(Values, NumbersAndColorsStandForEachOther) {
    // ground_albedo of physical_sky was a number once, and scales were one for all axes.
    const Built b = build(
        "standard_surface { name s base_color 0.25 base 0.5 0.5 0.5 normal 2 }\n"
        "standard_surface { name t base 0.125 0.2 0.3 }\n");
    EXPECT_EQ(b.reported, "2:32 warning wrong-type\n");
    EXPECT_EQ(b.graph.find("s")->get<Color>("base_color"), Color::grey(0.25F));
    EXPECT_EQ(b.graph.find("s")->get<float>("base"), 0.5F);
    EXPECT_EQ(b.graph.find("s")->get<Vec3f>("normal"), (Vec3f{2, 2, 2}));
    EXPECT_EQ(b.graph.find("t")->get<float>("base"), 0.125F);
}

// ---- unknown nodes ----

TEST(UnknownNodes, OfArnoldSayWhatIsLost) {
    const auto hint = [](const std::string& type) {
        return build("\n" + type + " { name a }").rendered;
    };
    EXPECT_NE(hint("usd").find("everything in its file is missing from the picture"),
              std::string::npos);
    EXPECT_NE(hint("volume_sample_rgb").find("keeps the value that is written"),
              std::string::npos);
    EXPECT_EQ(hint("zzz_nobody_knows").find("hint"), std::string::npos);
}

TEST(UnknownNodes, AreSkippedAndReferencesToThemAreWarnings) {
    const std::string text =
        "options { operator op }\nset_parametr { name op }\nset_parametr { name op2 inputs op }\n"
        "standard_surfase { name s }\npolymesh { name m shader s }\nstandard_surface { name t "
        "base_color s.r }\n";
    const Built b = build(text);
    EXPECT_EQ(b.reported,
              "1:20 warning unknown-reference\n5:26 warning unknown-reference\n6:38 warning "
              "unknown-reference\n2:1 warning unknown-node\n4:1 warning unknown-node\n");
    EXPECT_NE(b.rendered.find("node type \"set_parametr\" is not known: it is skipped (2 times)"),
              std::string::npos);
    EXPECT_NE(b.rendered.find("did you mean \"standard_surface\"?"), std::string::npos);
    EXPECT_EQ(b.graph.skipped().size(), 3U);
    EXPECT_NE(build("imager_tonemap { name film mode \"filmic\" }\n")
                  .rendered.find("files have the picture without it"),
              std::string::npos);
    EXPECT_EQ(b.graph.options()->get<NodeRef>("operator").node, nullptr);
    EXPECT_EQ(build(text, UnknownPolicy::Ignore).reported, "");
    EXPECT_NE(build(text, UnknownPolicy::Error).reported.find("2:1 error unknown-node"),
              std::string::npos);
}

// ---- links ----

TEST(Links, BothSidesMayNameAChannel) {
    const Built b = build(
        "standard_surface { name s base_color.g c.b base c.r emission_color c base_color 1 0 0 "
        "base_color c }\ncheckerboard { name c }\n");
    EXPECT_EQ(b.reported, "");
    const NodeInstance& s = *b.graph.find("s");
    ASSERT_EQ(s.links().size(), 4U);
    // Whole parameters first: applied in order, the component wins.
    EXPECT_EQ(s.links()[0].param->name, Name("base"));
    EXPECT_EQ(s.links()[0].source_component, 0);
    EXPECT_EQ(s.links()[0].component, -1);
    EXPECT_EQ(s.links()[2].param->name, Name("base_color"));
    EXPECT_EQ(s.links()[2].component, -1);
    EXPECT_EQ(s.links()[3].component, 1);
    EXPECT_EQ(s.links()[3].source_component, 2);
    EXPECT_EQ(s.links()[3].source, b.graph.find("c"));
    EXPECT_EQ(s.links()[3].where.text(), "c.b");
    EXPECT_TRUE(s.is_linked("base_color"));
    EXPECT_FALSE(s.is_linked("normal"));
    EXPECT_EQ(s.get<Color>("base_color"), Color(1, 0, 0));
}

TEST(Links, LaterOnesReplaceEarlierOnes) {
    const Built b = build(
        "standard_surface { name s base a base b }\ncheckerboard { name a }\ncheckerboard { name "
        "b }\n");
    ASSERT_EQ(b.graph.find("s")->links().size(), 1U);
    EXPECT_EQ(b.graph.find("s")->links()[0].source, b.graph.find("b"));
}

TEST(Links, IntoLightsAndOptionsToo) {
    const Built b = build(
        "mesh_light { name l color c }\noptions { background c }\ncheckerboard { name c }\n");
    EXPECT_EQ(b.reported, "");
    EXPECT_EQ(b.graph.find("l")->links().size(), 1U);
    EXPECT_EQ(b.graph.options()->links().size(), 1U);
}

TEST(Links, ClosuresAreReferences) {
    const Built b = build(
        "mix_shader { name m shader1 s shader2 c mix c.r }\nstandard_surface { name s "
        "}\ncheckerboard { name c }\n");
    EXPECT_EQ(b.reported, "");
    const NodeInstance& m = *b.graph.find("m");
    EXPECT_EQ(m.get<ShaderRef>("shader1").node, b.graph.find("s"));
    EXPECT_EQ(m.get<ShaderRef>("shader2").node, b.graph.find("c"));
    EXPECT_EQ(m.get<ShaderRef>("shader1").program, nullptr);
    EXPECT_EQ(m.links().size(), 1U);
    EXPECT_EQ(m.references(), (std::vector<const NodeInstance*>{
                                  b.graph.find("c"), b.graph.find("s"), b.graph.find("c")}));
}

TEST(Links, Errors) {
    const Built b = build(
        "checkerboard { name checker1 }\n"
        "standard_surface { name s base_color checkr1 }\n"
        "standard_surface { name t base_color checker1.outColor }\n"
        "polymesh { name m shader 2 1 NODE \"s\" \"u\" }\n"
        "standard_surface { name v base_color m }\n"
        "standard_surface { name w base_color s }\n"
        "ramp_rgb { name r placement checker1 }\n"
        "driver_tiff { name d half_precision checker1 filename checker1 }\n");
    EXPECT_EQ(b.reported,
              "2:38 error unknown-reference\n3:38 error unknown-reference\n4:39 warning "
              "unknown-reference\n5:38 error link-type\n6:38 warning link-type\n7:29 warning "
              "link-type\n");
    EXPECT_NE(b.rendered.find("hint: did you mean \"checker1\"?"), std::string::npos);
    EXPECT_NE(b.rendered.find("hint: components are .r .g .b .a or .x .y .z"), std::string::npos);
    EXPECT_TRUE(b.graph.find("d")->is_linked("half_precision"));
    EXPECT_EQ(b.graph.find("d")->get<Name>("filename"), Name("checker1"))
        << "a STRING is a text even if a node has its name";
}

TEST(Links, MissingShadersOfShapesAreErrorsOnlyWhenStrict) {
    const std::string text = "polymesh { name m shader \"nobody\" }\n";
    EXPECT_EQ(build(text).reported, "1:26 warning unknown-reference\n");
    EXPECT_EQ(build(text, UnknownPolicy::Error).reported, "1:26 error unknown-reference\n");
}

TEST(Links, CirclesAreNamedAndCut) {
    const Built b = build(
        "checkerboard { name a color1 b }\ncheckerboard { name b color2.r c }\ncheckerboard { "
        "name c color1 a color2 c }\n");
    EXPECT_EQ(b.reported, "3:30 error cyclic-link\n3:39 error cyclic-link\n");
    EXPECT_NE(b.rendered.find("\"a\" -> \"b\" -> \"c\" -> \"a\""), std::string::npos);
    EXPECT_NE(b.rendered.find("\"c\" -> \"c\""), std::string::npos);
    EXPECT_EQ(b.graph.find("c")->links().size(), 0U);
    const Built instances = build(
        "ginstance { name i node j }\nginstance { name j node i }\nmix_shader { name m shader1 m "
        "}\n");
    EXPECT_EQ(instances.reported, "2:25 error cyclic-link\n3:29 error cyclic-link\n");
    EXPECT_EQ(instances.graph.find("j")->get<NodeRef>("node").node, nullptr);
    EXPECT_EQ(instances.graph.find("m")->get<ShaderRef>("shader1").node, nullptr);
}

TEST(Links, ShapesAndLightsMayNameEachOther) {
    EXPECT_EQ(build("polymesh { name m light_group l }\nmesh_light { name l mesh m }\n").reported,
              "");
}

TEST(Links, LongChainsDoNotExhaustTheStack) {
    std::string text;
    for (int i = 0; i < 20000; ++i)
        text += "checkerboard { name c" + std::to_string(i) + " color1 c" + std::to_string(i + 1) +
                " }\n";
    EXPECT_EQ(build(text + "checkerboard { name c20000 }\n").reported, "");
    EXPECT_EQ(build(text + "checkerboard { name c20000 color1 c0 }\n").reported,
              "20001:35 error cyclic-link\n");
}

// ---- user data ----

TEST(UserDataOfNodes, TypesAndClasses) {
    const Built b = build(
        "polymesh\n{\n name m\n declare rgbPP uniform RGB\n declare uvs indexed VECTOR2\n declare "
        "tag constant STRING\n"
        " rgbPP 2 1 RGB 1 0 0 0 1 0\n uvs 2 1 VECTOR2 0 0 1 1\n uvsidxs 3 1 UINT 0 1 1\n tag "
        "\"x\"\n}\n");
    EXPECT_EQ(b.reported, "");
    const NodeInstance& m = *b.graph.find("m");
    ASSERT_EQ(m.user_data().size(), 3U);
    const UserData* rgb = m.find_user_data("rgbPP");
    ASSERT_NE(rgb, nullptr);
    EXPECT_EQ(rgb->user_class, UserDataClass::Uniform);
    EXPECT_EQ(rgb->values<Color>()[1], Color(0, 1, 0));
    EXPECT_EQ(values(m.find_user_data("uvs")->indices), (std::vector<std::uint32_t>{0, 1, 1}));
    EXPECT_EQ(m.find_user_data("tag")->values<Name>()[0], Name("x"));
    EXPECT_EQ(m.find_user_data("none"), nullptr);
}

TEST(UserDataOfNodes, Complaints) {
    EXPECT_EQ(reported("polymesh", " declare id constant INT\n id 3"), "4:2 warning user-data\n");
    EXPECT_EQ(reported("polymesh", " declare id constant UINT\n id 3"), "") << "as it is anyway";
    EXPECT_EQ(reported("polymesh", " declare a constant INT\n declare a constant FLOAT\n a 3"),
              "5:2 warning user-data\n");
    EXPECT_EQ(reported("polymesh", " declare a constant INT\n a 3 1 INT 1 2 3"),
              "5:4 warning user-data\n");
    EXPECT_EQ(reported("polymesh", " declare a indexed INT\n a 3 1 INT 1 2 3"),
              "5:4 warning user-data\n");
    EXPECT_EQ(
        reported("polymesh", " declare a indexed INT\n a 3 1 INT 1 2 3\n aidxs 2 1 UINT 0 3"),
        "5:4 error user-data\n");
    EXPECT_EQ(reported("polymesh", " declare a constant RGB\n a someshader"),
              "5:4 warning user-data\n");
    EXPECT_EQ(reported("polymesh", " declare a constant RGB\n a 1 2"), "5:4 error wrong-type\n");
    EXPECT_EQ(reported("polymesh", " undeclared 1 2"), "4:2 warning unknown-param\n");
}

// ---- edits ----

TEST(Set, ValuesTextsAndLinks) {
    Built b = build(
        "driver_tiff { name d }\nstandard_surface { name s.1 base_color c }\ncheckerboard { name "
        "c }\nramp_rgb { name r position 2 1 FLOAT 0 1 }\n");
    Diagnostics diagnostics;
    EXPECT_TRUE(b.graph.set("d", "filename", "my file.exr", diagnostics));
    EXPECT_TRUE(b.graph.set("d", "color_space", "", diagnostics));
    EXPECT_TRUE(b.graph.set("s.1", "base_color", "1 0.5 0", diagnostics));
    EXPECT_TRUE(b.graph.set("s.1", "base", "c.r", diagnostics));
    EXPECT_TRUE(b.graph.set("r", "position", "3 1 FLOAT 1 2 3", diagnostics));
    EXPECT_TRUE(b.graph.set("r", "position[1]", "7", diagnostics));
    EXPECT_TRUE(b.graph.set("options", "AA_samples", "5", diagnostics));
    EXPECT_TRUE(b.graph.set("options", "outputs", "2 1 STRING \"a b\" \"c\"", diagnostics));
    EXPECT_EQ(reports(diagnostics), "");
    EXPECT_EQ(b.graph.find("d")->get<Name>("filename"), Name("my file.exr"));
    EXPECT_TRUE(b.graph.find("d")->get<Name>("color_space").empty());
    EXPECT_FALSE(b.graph.find("s.1")->is_linked("base_color"));
    EXPECT_TRUE(b.graph.find("s.1")->is_linked("base"));
    EXPECT_EQ(values(b.graph.find("r")->get<Array<float>>("position")),
              (std::vector<float>{1, 7, 3}));
    EXPECT_EQ(b.graph.options()->get<std::int32_t>("AA_samples"), 5);
    EXPECT_EQ(b.graph.options()->get<Array<Name>>("outputs")[0], Name("a b"));
    EXPECT_EQ(b.graph.find("d")->where("filename").source->name, "<d.filename>");
}

TEST(Set, ErrorsLeaveTheGraphAsItWas) {
    Built b = build(
        "standard_surface { name s base_color 1 0 0 base c }\ncheckerboard { name c color1 d "
        "}\ncheckerboard { name d }\nramp_rgb { name r position 2 1 FLOAT 0 1 }\n");
    const std::string before = write_ass(b.graph);
    Diagnostics diagnostics;
    EXPECT_FALSE(b.graph.set("t", "base", "1", diagnostics));
    EXPECT_FALSE(b.graph.set("s", "bse", "1", diagnostics));
    EXPECT_FALSE(b.graph.set("s", "base", "1 2", diagnostics));
    EXPECT_FALSE(b.graph.set("s", "base", "", diagnostics));
    EXPECT_FALSE(b.graph.set("s", "base", "1 name x", diagnostics));
    EXPECT_FALSE(b.graph.set("s", "base_color", "nobody", diagnostics));
    EXPECT_FALSE(b.graph.set("d", "color2", "c", diagnostics));
    EXPECT_FALSE(b.graph.set("r", "position", "3 1 FLOAT 1 2 x", diagnostics));
    EXPECT_FALSE(b.graph.set("r", "position[9000]", "1", diagnostics));
    EXPECT_EQ(write_ass(b.graph), before);
    EXPECT_EQ(reports(diagnostics),
              "error unknown-reference\nerror unknown-param\n1:1 error wrong-type\n1:1 error "
              "ass-syntax\n1:3 error ass-syntax\n1:1 error unknown-reference\n"
              "2:30 error cyclic-link\n1:1 error array-count\n1:1 error bad-value\n");
}

TEST(Set, Assignments) {
    Built b = build(
        "standard_surface { name s.1 }\nstandard_surface { name s }\nstandard_surface { name a=b "
        "}\noptions { }\ndriver_tiff { name d }\n");
    Diagnostics diagnostics;
    EXPECT_TRUE(b.graph.assign("s.1.base=0.25", diagnostics));
    EXPECT_TRUE(b.graph.assign("s.base_color.g=0.5", diagnostics));
    EXPECT_TRUE(b.graph.assign("a=b.coat=0.75", diagnostics));
    EXPECT_TRUE(b.graph.assign("options.AA_samples=4", diagnostics));
    EXPECT_TRUE(b.graph.assign("d.filename=a.b=c.exr", diagnostics));
    EXPECT_EQ(reports(diagnostics), "");
    EXPECT_EQ(b.graph.find("s.1")->get<float>("base"), 0.25F);
    EXPECT_EQ(b.graph.find("s")->get<Color>("base_color"), Color(0.8F, 0.5F, 0.8F));
    EXPECT_EQ(b.graph.find("a=b")->get<float>("coat"), 0.75F);
    EXPECT_EQ(b.graph.find("d")->get<Name>("filename"), Name("a.b=c.exr"));
    EXPECT_FALSE(b.graph.assign("nonsense", diagnostics));
    EXPECT_FALSE(b.graph.assign("x.y=1", diagnostics));
    EXPECT_EQ(reports(diagnostics), "error ass-syntax\nerror unknown-reference\n");
}

TEST(Add, NodesByProgram) {
    SceneGraph graph(test::registry());
    Diagnostics diagnostics;
    NodeInstance* checker = graph.add("checkerboard", "c", diagnostics);
    ASSERT_NE(checker, nullptr);
    EXPECT_TRUE(graph.set("c", "color1", "1 0 0", diagnostics));
    EXPECT_EQ(graph.add("checkerbord", "d", diagnostics), nullptr);
    EXPECT_EQ(graph.add("checkerboard", "c", diagnostics), nullptr);
    EXPECT_EQ(reports(diagnostics), "error unknown-node\nerror duplicate-name\n");
    NodeInstance* unnamed = graph.add("polymesh", "", diagnostics);
    ASSERT_NE(unnamed, nullptr);
    EXPECT_FALSE(unnamed->is_named());
    EXPECT_EQ(write_ass(graph),
              "checkerboard\n{\n name c\n color1 1 0 0\n}\n\npolymesh\n{\n}\n\n");
}

/// Every parameter of every type with random values: written, read and written again, nothing changes.
TEST(RoundTrip, RandomValuesOfEveryType) {
    std::mt19937 random(5);
    const auto number = [&](ParamType type) -> std::string {
        switch (type) {
            case ParamType::Bool: return (random() & 1U) != 0 ? "on" : "off";
            case ParamType::Byte: return std::to_string(random() % 256);
            case ParamType::Int: return std::to_string(static_cast<int>(random() % 1000));
            case ParamType::UInt: return std::to_string(random());
            case ParamType::Enum: return std::to_string(random() % 2);
            case ParamType::String: return "\"te\\\"xt " + std::to_string(random()) + "\"";
            default: return std::to_string(static_cast<double>(random()) / 4e9);
        }
    };
    for (int round = 0; round < 20; ++round) {
        SceneGraph graph(test::registry());
        Diagnostics diagnostics;
        for (const NodeType* type : test::registry().all()) {
            (void)graph.add(type->name, type->name, diagnostics);
            for (const ParamInfo& info : type->params) {
                if (info.type == ParamType::Node || info.type == ParamType::Closure) continue;
                const std::size_t n = info.is_array ? random() % 4 : 1,
                                  per = info.type == ParamType::Matrix    ? 16
                                        : info.type == ParamType::Rgba    ? 4
                                        : info.type == ParamType::Vector2 ? 2
                                        : info.type == ParamType::Rgb ||
                                                info.type == ParamType::Vector
                                            ? 3
                                            : 1;
                std::string text =
                    info.is_array ? std::to_string(n) + " 2 " + std::string(type_text(info.type))
                                  : "";
                for (std::size_t i = 0; i < n * per * (info.is_array ? 2 : 1); ++i)
                    text += " " + number(info.type);
                ASSERT_TRUE(graph.set(type->name, info.name.view(),
                                      info.is_array ? text : text.substr(1), diagnostics))
                    << diagnostics.render();
            }
        }
        const std::string once = write_ass(graph);
        EXPECT_EQ(write_ass(build(once).graph), once);
    }
}

TEST(Registry, FindsAndLists) {
    EXPECT_EQ(test::registry().find("nothing"), nullptr);
    ASSERT_NE(test::registry().find("polymesh"), nullptr);
    EXPECT_EQ(test::registry().find("polymesh")->find("vlist")->type, ParamType::Vector);
    EXPECT_EQ(test::registry().find("polymesh")->find("nothing"), nullptr);
    const std::vector<const NodeType*> all = test::registry().all();
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const NodeType* a, const NodeType* b) {
        return a->name < b->name;
    }));
    EXPECT_EQ(test::registry().names().size(), all.size());
}

TEST(Registry, TypeNamesAndSizes) {
    EXPECT_EQ(type_text(ParamType::Vector2), "VECTOR2");
    EXPECT_EQ(type_text(ParamType::Closure), "CLOSURE");
    EXPECT_EQ(type_size(ParamType::Matrix), 64U);
    EXPECT_EQ(type_size(ParamType::Bool), 1U);
    EXPECT_EQ(type_size(ParamType::Rgba), sizeof(Rgba));
    EXPECT_EQ(kind_text(NodeKind::Options), "options");
    EXPECT_EQ(kind_text(NodeKind::Driver), "driver");
}

/// Whatever the reader lets through, the graph survives.
TEST(Hostile, NoiseInTheMiddle) {
    const std::string text =
        "options { camera c outputs \"a\" background k }\npersp_camera { name c fov 1 1 FLOAT 30 "
        "matrix 1 2 b85MATRIX !z$$$$@!y$$$$4 }\n"
        "checkerboard { name k color1 r.g }\nramp_rgb { name r color[2].r s position 2 1 FLOAT 0 "
        "1 interpolation 2 1 INT 0 1 input k.r }\nstandard_surface { name s base_color k }\n"
        "polymesh { name m declare u indexed RGB u 2 1 RGB 1 1 1 0 0 0 uidxs 3 1 UINT 0 1 1 "
        "shader 2 1 NODE \"s\" \"k\" vidxs 3 1 b85UINT B$$$$% shidxs 2 1 BYTE 0 1 }\n";
    std::mt19937 random(23);
    const std::string bytes = "{}\"\\#\n $!zyBx0123.eA[]ksrm";
    for (int i = 0; i < 3000; ++i) {
        std::string noisy = text;
        for (int k = 0; k < 4; ++k)
            noisy[random() % noisy.size()] = bytes[random() % bytes.size()];
        const Built b = build(noisy);
        (void)build(write_ass(b.graph));
        (void)dump(b.graph);
    }
}

}  // namespace
}  // namespace lightsieve
