// Operators and procedurals on graphs, before anything is compiled.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "nodes/all_nodes.h"
#include "scene/ass_read.h"
#include "scene/assemble.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

/// A scene of one file, with its operators done.
struct Assembled {
    Diagnostics diagnostics;
    SceneGraph graph{builtin_registry()};

    explicit Assembled(const std::string& text, AssembleOptions options = {}) {
        graph = build_graph(read_ass(text, "t.ass", nullptr, diagnostics), builtin_registry(), {},
                            diagnostics);
        assemble(graph, options, diagnostics);
    }
    [[nodiscard]] const NodeInstance& node(const char* name) const { return *graph.find(name); }
    [[nodiscard]] std::size_t count(Code code) const {
        std::size_t n = 0;
        for (const Error& item : diagnostics.items())
            n += item.code == code ? 1 : 0;
        return n;
    }
    [[nodiscard]] bool says(std::string_view text) const {
        return diagnostics.render().find(text) != std::string::npos;
    }
};

/// A scene with two spheres, two flats, and these operators, of which `last` is the last.
std::string scene(const std::string& last, const std::string& operators) {
    return "options { operator " + last +
           " }\n"
           "sphere { name ball radius 2 shader red }\n"
           "sphere { name globe }\n"
           "flat { name red color 1 0 0 }\n"
           "flat { name green color 0 1 0 }\n"
           "checkerboard { name check }\n" +
           operators;
}
std::string set(const std::string& name, const std::string& selection,
                const std::string& assignment, const std::string& more = "") {
    return "set_parameter { name " + name + "\n selection \"" + selection + "\"\n assignment " +
           assignment + "\n " + more + "}\n";
}
Name shader_of(const NodeInstance& node) {
    const auto& shaders = node.get<Array<NodeRef>>("shader");
    return shaders.empty() || !shaders[0] ? Name{} : shaders[0].node->name();
}

TEST(SetParameter, GivesValuesOfEveryKind) {
    const Assembled a(
        scene("op", set("op", "*ball or red",
                        R"(9 1 STRING "radius=3.5" "visibility = 254" "shader='green'" "matte=on"
                     "center=[1, 2, 3]" "trace_sets='a' 'b'" "color.g='check.r'" "color.r=0.25"
                     "float my_data=4")")));
    EXPECT_FALSE(a.diagnostics.has_errors()) << a.diagnostics.render();
    EXPECT_EQ(a.diagnostics.n_warnings(), 0U) << a.diagnostics.render();
    const NodeInstance& ball = a.node("ball");
    EXPECT_EQ(ball.get<float>("radius"), 3.5F);
    EXPECT_EQ(ball.get<std::uint8_t>("visibility"), 254);
    EXPECT_EQ(shader_of(ball), Name("green"));
    EXPECT_TRUE(ball.get<bool>("matte"));
    EXPECT_EQ(ball.get<Vec3f>("center"), (Vec3f{1, 2, 3}));
    EXPECT_EQ(ball.get<Array<Name>>("trace_sets").n, 2U);
    ASSERT_NE(ball.find_user_data("my_data"), nullptr);
    EXPECT_EQ(ball.find_user_data("my_data")->values<float>()[0], 4.0F);
    const NodeInstance& red = a.node("red");
    EXPECT_TRUE(red.is_linked("color"));
    EXPECT_EQ(red.get<Color>("color").r, 0.25F);
    // Not selected: as it was.
    EXPECT_EQ(a.node("globe").get<std::uint8_t>("visibility"), 255);
}

TEST(SetParameter, ChangesUserDataThatIsThere) {
    const Assembled a(
        "options { operator op }\n"
        "sphere { name ball declare tint constant RGB tint 1 0 0 }\n" +
        set("op", "ball", "\"tint=0 0 1\""));
    EXPECT_EQ(a.node("ball").find_user_data("tint")->values<Color>()[0], (Color{0, 0, 1}));
}

TEST(SetParameter, CanBeSwitchedOff) {
    EXPECT_EQ(Assembled(scene("op", set("op", "ball", "\"visibility=1\"", "enable off")))
                  .node("ball")
                  .get<std::uint8_t>("visibility"),
              255);
    const Assembled half(scene("op", set("op", "ball", "2 1 STRING \"visibility=1\" \"matte=on\"",
                                         "enable_assignment 2 1 BOOL off on")));
    EXPECT_EQ(half.node("ball").get<std::uint8_t>("visibility"), 255);
    EXPECT_TRUE(half.node("ball").get<bool>("matte"));
    AssembleOptions ignored;
    ignored.ignore_operators = true;
    EXPECT_EQ(Assembled(scene("op", set("op", "ball", "\"visibility=1\"")), ignored)
                  .node("ball")
                  .get<std::uint8_t>("visibility"),
              255);
}

TEST(SetParameter, TellsWhatMeetsNothing) {
    const Assembled name(scene("op", set("op", "bal", "\"visibility=1\"")));
    EXPECT_EQ(name.count(Code::OperatorUnused), 1U) << name.diagnostics.render();
    EXPECT_TRUE(name.says("did you mean \"ball\"")) << name.diagnostics.render();
    const Assembled param(
        scene("op", set("op", "ball", "2 1 STRING \"visibilty=1\" \"matte=on\"")));
    EXPECT_EQ(param.count(Code::OperatorUnused), 1U) << param.diagnostics.render();
    EXPECT_TRUE(param.says("did you mean \"visibility\"")) << param.diagnostics.render();
    // Some of the selected nodes have it: nothing to tell.
    EXPECT_EQ(Assembled(scene("op", set("op", "*", "\"radius=1\""))).count(Code::OperatorUnused),
              0U);
    const Assembled bad(scene("op", set("op", "ball.(radius==", "\"matte=on\"")));
    EXPECT_EQ(bad.count(Code::OperatorSelection), 1U) << bad.diagnostics.render();
    EXPECT_EQ(bad.count(Code::OperatorUnused), 0U) << bad.diagnostics.render();
    EXPECT_TRUE(bad.says("t.ass:8:27")) << bad.diagnostics.render();
    EXPECT_EQ(
        Assembled(scene("op", set("op", "ball", "\"matte\""))).count(Code::OperatorSelection), 1U);
    // A value of the wrong type is told as in the scene file.
    EXPECT_TRUE(
        Assembled(scene("op", set("op", "ball", "\"radius='x'\""))).diagnostics.has_errors());
}

TEST(Operators, ActInTheOrderOfTheirInputs) {
    const std::string two =
        set("first", "ball", "\"visibility=1\"") + set("second", "ball", "\"visibility=2\"");
    const auto visibility = [&](const std::string& last, const std::string& more) {
        return Assembled(scene(last, two + more)).node("ball").get<std::uint8_t>("visibility");
    };
    EXPECT_EQ(visibility("m", "merge { name m inputs 2 1 NODE first second }"), 2);
    EXPECT_EQ(visibility("m", "merge { name m inputs 2 1 NODE second first }"), 1);
    EXPECT_EQ(visibility("chain",
                         set("chain", "ball.(visibility==1)", "\"visibility=3\"", "inputs first")),
              3)
        << "an operator sees what its inputs did";
    EXPECT_EQ(visibility("s", "switch_operator { name s inputs 2 1 NODE first second index 1 }"),
              2);
    EXPECT_EQ(visibility("s", "switch_operator { name s inputs 2 1 NODE first second index -1 }"),
              255);
    const Assembled high(
        scene("s", two + "switch_operator { name s inputs 2 1 NODE first second index 9 }"));
    EXPECT_TRUE(high.says("input 9 of 2")) << high.diagnostics.render();
    EXPECT_TRUE(Assembled(scene("a", set("a", "*", "\"matte=on\"", "inputs b") +
                                         set("b", "*", "\"matte=on\"", "inputs a")))
                    .says("cyclic-link"));
    EXPECT_TRUE(Assembled(scene("red", "")).says("not an operator"));
    EXPECT_TRUE(Assembled(scene("m", "merge { name m inputs red }")).says("not an operator"));
}

TEST(Operators, DisableTakesNodesOut) {
    const Assembled a(scene("op", "disable { name op selection \"ball or red\" }") +
                      "ginstance { name twin node ball }\nsphere { name third shader red }\n");
    EXPECT_EQ(a.graph.find("ball"), nullptr);
    EXPECT_EQ(a.graph.find("red"), nullptr);
    EXPECT_FALSE(a.node("twin").get<NodeRef>("node"));
    EXPECT_EQ(shader_of(a.node("third")), Name{});
    EXPECT_NE(a.graph.find("globe"), nullptr);
}

TEST(Operators, SetTransformMovesNodes) {
    const auto matrix_of = [](const std::string& op, const std::string& own = "") {
        const Assembled a("options { operator op }\nsphere { name ball " + own +
                          " }\nset_transform { name op selection ball " + op + " }\n");
        EXPECT_EQ(a.diagnostics.n_warnings(), 0U) << a.diagnostics.render();
        const auto& keys = a.node("ball").get<Array<Mat4f>>("matrix");
        return std::vector<Mat4f>(keys.data, keys.data + std::size_t{keys.n} * keys.n_keys);
    };
    const std::string moved =
        "matrix 1 2 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1"
        " 1 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1";
    EXPECT_EQ(matrix_of("translate 0 1 0")[0].point({0, 0, 0}), (Vec3f{0, 1, 0}));
    const std::vector<Mat4f> both = matrix_of("translate 0 1 0", moved);
    ASSERT_EQ(both.size(), 2U) << "motion keys stay";
    EXPECT_EQ(both[1].point({0, 0, 0}), (Vec3f{2, 1, 0}));
    EXPECT_EQ(matrix_of("translate 0 1 0 mode replace", moved)[0].point({0, 0, 0}),
              (Vec3f{0, 1, 0}));
    // Scale, then a quarter turn about z, then translation.
    const Vec3f p = matrix_of("scale 2 1 1 rotate 0 0 90 translate 0 0 5")[0].point({1, 0, 0});
    EXPECT_NEAR(p.x, 0, 1e-6F);
    EXPECT_NEAR(p.y, 2, 1e-6F);
    EXPECT_NEAR(p.z, 5, 1e-6F);
    const Vec3f q =
        matrix_of("rotate 0 0 90 translate 1 0 0 transform_order trs")[0].point({0, 0, 0});
    EXPECT_NEAR(q.y, 1, 1e-6F);
}

TEST(Operators, CollectionsNameSelections) {
    const std::string text =
        "collection { name c1 selection \"*.(@node=='sphere')\" collection round }\n"
        "collection { name c2 selection \"#round and not globe\" collection chosen inputs c1 }\n" +
        set("op", "#chosen", "\"visibility=1\"", "inputs c2");
    const Assembled a(scene("op", text));
    EXPECT_EQ(a.node("ball").get<std::uint8_t>("visibility"), 1) << a.diagnostics.render();
    EXPECT_EQ(a.node("globe").get<std::uint8_t>("visibility"), 255);
    // A collection that names itself is not there yet.
    EXPECT_EQ(Assembled(scene("op", "collection { name c selection \"#x\" collection x }\n" +
                                        set("op", "#x", "\"matte=on\"", "inputs c")))
                  .count(Code::OperatorUnused),
              1U);
}

TEST(Operators, StringReplaceChangesTexts) {
    const Assembled a(
        "options { operator op }\nimage { name map filename \"/proxy/a.proxy.png\" }\n"
        "string_replace { name op selection map match proxy replace final }\n");
    EXPECT_EQ(a.node("map").get<Name>("filename"), Name("/final/a.final.png"));
}

// ---- files ----

/// Files in a folder of their own.
class Folder {
  public:
    Folder() {
        std::string pattern = testing::TempDir() + "lightsieve_assemble_XXXXXX";
        path_ = mkdtemp(pattern.data());
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ + "/" + name) << text;
    }
    [[nodiscard]] AssembleOptions options() const {
        AssembleOptions out;
        out.scene_path = path_ + "/scene.ass";
        out.find_file = [folder = path_](std::string_view name, const std::string&) {
            const std::string full = folder + "/" + std::string(name);
            return std::filesystem::exists(full) ? std::optional(full) : std::nullopt;
        };
        return out;
    }

  private:
    std::string path_;
};

std::string procedural(const std::string& name, const std::string& file,
                       const std::string& more = "") {
    return "procedural { name " + name + " filename \"" + file + "\" " + more + " }\n";
}

TEST(Procedurals, HaveNamesOfTheirOwnAndLookOutward) {
    const Folder folder;
    folder.write("tree.ass",
                 "sphere { name ball shader red }\nflat { name red color 0 0 1 }\n"
                 "sphere { name other shader green }\nsphere { name rooted shader ^red }\n");
    const Assembled a(scene("NULL", procedural("tree", "tree.ass")), folder.options());
    EXPECT_EQ(a.diagnostics.n_warnings(), 0U) << a.diagnostics.render();
    const NodeScope* inside = a.graph.contents(a.node("tree"));
    ASSERT_NE(inside, nullptr);
    ASSERT_EQ(inside->nodes.size(), 4U);
    const auto shader = [&](const char* name) {
        return inside->find(name)->get<Array<NodeRef>>("shader")[0].node;
    };
    EXPECT_EQ(shader("ball")->get<Color>("color"), (Color{0, 0, 1})) << "the inner red";
    EXPECT_EQ(shader("other"), a.graph.find("green")) << "outward";
    EXPECT_EQ(shader("rooted"), a.graph.find("red")) << "the scene's own";
    EXPECT_EQ(shader_of(a.node("ball")), Name("red"));
    EXPECT_EQ(a.graph.nodes().size(), 7U) << "the scene itself has no more nodes than before";
}

TEST(Procedurals, ShareFilesUnlessAnOperatorCouldTellThemApart) {
    const Folder folder;
    folder.write("tree.ass", "sphere { name ball }\n");
    const std::string two = procedural("one", "tree.ass") + procedural("two", "tree.ass");
    const auto shared = [&](const std::string& text) {
        const Assembled a(text, folder.options());
        return a.graph.contents(a.node("one")) == a.graph.contents(a.node("two"));
    };
    EXPECT_TRUE(shared(two));
    EXPECT_FALSE(shared(procedural("one", "tree.ass", "auto_instancing off") +
                        procedural("two", "tree.ass")));
    EXPECT_FALSE(shared(two + scene("op", set("op", "one^ball", "\"matte=on\""))));
}

TEST(Procedurals, AreEditedByTheirOwnOperatorAndTheScenes) {
    const Folder folder;
    folder.write("tree.ass", "sphere { name ball }\nsphere { name leaf }\n");
    const Assembled a(scene("op", set("op", "two^ball", "\"visibility=1\"") +
                                      set("inner", "leaf", "\"visibility=2\"")) +
                          procedural("one", "tree.ass", "operator inner") +
                          procedural("two", "tree.ass"),
                      folder.options());
    EXPECT_EQ(a.diagnostics.n_warnings(), 0U) << a.diagnostics.render();
    const auto visibility = [&](const char* of, const char* name) {
        return a.graph.contents(a.node(of))->find(name)->get<std::uint8_t>("visibility");
    };
    EXPECT_EQ(visibility("one", "ball"), 255);
    EXPECT_EQ(visibility("two", "ball"), 1);
    EXPECT_EQ(visibility("one", "leaf"), 2);
    EXPECT_EQ(visibility("two", "leaf"), 255);
    EXPECT_EQ(a.node("ball").get<std::uint8_t>("visibility"), 255);
}

TEST(Procedurals, ThatContainThemselvesAreAnError) {
    const Folder folder;
    folder.write("a.ass", procedural("b", "b.ass"));
    folder.write("b.ass", procedural("a", "a.ass"));
    folder.write("scene.ass", "");
    const Assembled circle(procedural("a", "a.ass"), folder.options());
    EXPECT_EQ(circle.count(Code::IncludeCycle), 1U) << circle.diagnostics.render();
    EXPECT_EQ(Assembled(procedural("me", "scene.ass"), folder.options()).count(Code::IncludeCycle),
              1U);
    // One file may be read by others that lie beside each other.
    folder.write("c.ass", procedural("d", "d.ass") + procedural("e", "d.ass"));
    folder.write("d.ass", "sphere { name ball }\n");
    EXPECT_FALSE(Assembled(procedural("c", "c.ass"), folder.options()).diagnostics.has_errors());
}

TEST(Procedurals, ThatAreNestedTooDeepAreAnError) {
    const Folder folder;
    for (int i = 0; i <= kMaxProceduralDepth; ++i)
        folder.write("p" + std::to_string(i) + ".ass",
                     procedural("next", "p" + std::to_string(i + 1) + ".ass"));
    EXPECT_EQ(Assembled(procedural("p", "p0.ass"), folder.options()).count(Code::LimitIncludes),
              1U);
}

TEST(Procedurals, ThatCannotBeReadAreLeftOut) {
    const Folder folder;
    folder.write("bad.ass", "sphere { name ball radius \"x\" }\n");
    const auto told = [&](const std::string& text, std::string_view what) {
        const Assembled a(text, folder.options());
        EXPECT_TRUE(a.says(what)) << a.diagnostics.render();
        EXPECT_FALSE(a.diagnostics.has_errors()) << a.diagnostics.render();
        EXPECT_EQ(a.diagnostics.n_warnings(), 1U);
    };
    told(procedural("p", "gone.ass"), "which does not exist; nothing of it is shown");
    told(procedural("p", "city.usd"), "which is no .ass file");
    told("procedural { name p }\n", "names no file");
    EXPECT_TRUE(Assembled(procedural("p", "bad.ass"), folder.options()).says("bad.ass:1:"));
}

TEST(Operators, IncludeGraphReadsOperatorsOfAnotherFile) {
    const Folder folder;
    folder.write("ops.ass", set("a", "ball", "\"visibility=1\"") +
                                set("b", "globe", "\"visibility=2\"", "inputs a"));
    const auto scene_with = [&](const std::string& more) {
        return Assembled(scene("op", "include_graph { name op filename \"ops.ass\" " + more + "}"),
                         folder.options());
    };
    EXPECT_EQ(scene_with("").node("ball").get<std::uint8_t>("visibility"), 1);
    EXPECT_EQ(scene_with("").node("globe").get<std::uint8_t>("visibility"), 2);
    EXPECT_EQ(scene_with("target a").node("globe").get<std::uint8_t>("visibility"), 255);
    EXPECT_TRUE(scene_with("target c").says("has no operator \"c\""));
    EXPECT_TRUE(
        Assembled(scene("op", "include_graph { name op filename \"none.ass\" }"), folder.options())
            .says("does not exist"));
}

}  // namespace
}  // namespace lightsieve
