// Selections and assignments of operators: what they take, and what they say of mistakes.
#include "scene/selection.h"

#include <gtest/gtest.h>

#include "scene/ass_read.h"
#include "scene/assignment.h"
#include "scene/test_nodes.h"

namespace lightsieve {
namespace {

TEST(Globs, Match) {
    const auto yes = [](std::string_view pattern, std::string_view name) {
        EXPECT_TRUE(glob_matches(pattern, name)) << pattern << " " << name;
    };
    const auto no = [](std::string_view pattern, std::string_view name) {
        EXPECT_FALSE(glob_matches(pattern, name)) << pattern << " " << name;
    };
    yes("", "");
    no("", "a");
    yes("*", "");
    yes("*", "/a/b|c");
    yes("/a/*", "/a/b/c");
    no("/a/*", "/b/a/c");
    yes("*Shape?", "sphereShape1");
    no("*Shape?", "sphereShape");
    yes("a*b*c", "aXbYbZc");
    no("a*b*c", "aXbYbZ");
    yes("s[123]", "s2");
    no("s[123]", "s4");
    yes("s[a-f]x", "sdx");
    yes("s[!0-9]", "sx");
    no("s[!0-9]", "s5");
    yes("a[b", "a[b");  // a bracket that never closes is a letter
    // Many stars do not take exponential time.
    no("*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*b", std::string(200, 'a'));
}

/// Names of the nodes that an expression selects, in order.
std::string selected(std::string_view expression, std::string_view prefix = "") {
    static const SceneGraph graph = [] {
        Diagnostics diagnostics;
        return build_graph(
            read_ass(
                "polymesh { name /a/ball visibility 255 id 7 smoothing on }\n"
                "polymesh { name /a/box visibility 254 declare tag constant STRING tag \"hero\""
                " shader 1 1 NODE red }\n"
                "polymesh { name |persp trace_sets 2 1 STRING \"x\" \"y\" }\n"
                "persp_camera { name cam handedness left fov 30.1 }\n"
                "standard_surface { name red base_color 1 0 0 }\n",
                "t.ass", nullptr, diagnostics),
            test::registry(), {}, diagnostics);
    }();
    const Selection selection = Selection::parse(expression, {});
    const auto collections = [](Name name, const Selection::Candidate& c) {
        return name.view() == "boxes" && glob_matches("*box*", c.node->name().view());
    };
    std::string out;
    for (const auto& node : graph.nodes())
        if (selection.matches({node.get(), prefix}, collections))
            out += (out.empty() ? "" : " ") + node->name().str();
    return out;
}

TEST(Selections, ByName) {
    EXPECT_EQ(selected("/a/ball"), "/a/ball");
    EXPECT_EQ(selected("/a/*"), "/a/ball /a/box");
    EXPECT_EQ(selected("|persp"), "|persp") << "a bar within a name is a letter";
    EXPECT_EQ(selected("cam red"), "cam red") << "words in a row";
    EXPECT_EQ(selected("nobody"), "");
}

TEST(Selections, ByTypeAndPath) {
    EXPECT_EQ(selected("*.(@node=='polymesh')"), "/a/ball /a/box |persp");
    EXPECT_EQ(selected(".(@node == \"persp_camera\")"), "cam");
    EXPECT_EQ(selected("*.(@node!='polymesh')"), "cam red");
    EXPECT_EQ(selected("*.(@name=='r?d')"), "red");
    EXPECT_EQ(selected("/a/*.(@node=='persp_camera')"), "");
    // In procedurals: by their own name, or with the path.
    EXPECT_EQ(selected("red", "car^"), "red");
    EXPECT_EQ(selected("car^red", "car^"), "red");
    EXPECT_EQ(selected("car/r*", "car^"), "red");
    EXPECT_EQ(selected("bus^*", "car^"), "");
}

TEST(Selections, ByValues) {
    EXPECT_EQ(selected("*.(visibility==255)"), "/a/ball |persp");
    EXPECT_EQ(selected("*.(visibility<255)"), "/a/box");
    EXPECT_EQ(selected("*.(id>=7)"), "/a/ball");
    EXPECT_EQ(selected("*.(smoothing)"), "/a/ball");
    EXPECT_EQ(selected("*.(smoothing==off)"), "/a/box |persp");
    EXPECT_EQ(selected("*.(not smoothing and @node=='polymesh')"), "/a/box |persp");
    EXPECT_EQ(selected("*.(tag=='hero')"), "/a/box") << "user data";
    EXPECT_EQ(selected("*.(tag=='he*')"), "/a/box");
    EXPECT_EQ(selected("*.(handedness=='left')"), "cam");
    EXPECT_EQ(selected("*.(fov==30.1)"), "cam") << "as a float";
    EXPECT_EQ(selected("*.(base_color.r==1)"), "red");
    EXPECT_EQ(selected("*.(base_color.g!=0)"), "");
    EXPECT_EQ(selected("*.(shader=='red')"), "/a/box") << "the name of a link";
    EXPECT_EQ(selected("*.(trace_sets[1]=='y')"), "|persp");
    EXPECT_EQ(selected("*.(trace_sets[7]=='y')"), "") << "an element that is not there";
    EXPECT_EQ(selected("*.(no_such_thing==1)"), "");
}

TEST(Selections, Combined) {
    EXPECT_EQ(selected("/a/* and not */box"), "/a/ball");
    EXPECT_EQ(selected("/a/* && !#boxes"), "/a/ball");
    EXPECT_EQ(selected("cam or red"), "cam red");
    EXPECT_EQ(selected("cam | red"), "cam red");
    EXPECT_EQ(selected("not (cam or red or /a/*)"), "|persp");
    EXPECT_EQ(selected("#boxes"), "/a/box");
    EXPECT_EQ(selected("#unknown"), "");
    EXPECT_EQ(selected("*.(id==7 or (visibility==254 and tag=='hero'))"), "/a/ball /a/box");
    EXPECT_EQ(selected("/a/*.(id==7) or cam"), "/a/ball cam") << "and binds before or";
}

TEST(Selections, ByRegularExpression) {
    EXPECT_EQ(selected("r'/a/b(all|ox)'"), "/a/ball /a/box");
    EXPECT_EQ(selected("r\"/a/b.*\" and not */box"), "/a/ball");
    EXPECT_EQ(selected("r'/a/b'"), "") << "the whole name";
    EXPECT_EQ(selected("red or r'c.m'"), "cam red");
    EXPECT_EQ(selected("r'car.red'", "car^"), "red");
    // Backtracking would take the age of the universe.
    EXPECT_FALSE(Selection::parse("r'(a*)*b'", {}).matches_text(std::string(500, 'a')));
}

TEST(Selections, OfOtherNamesThanNodes) {
    const auto takes = [](const std::string& text, const char* name) {
        return Selection::parse(text, {}).matches_text(name);
    };
    EXPECT_TRUE(takes("RGBA or r'diff.*'", "diffuse_direct"));
    EXPECT_FALSE(takes("RGBA or r'diff.*'", "specular"));
    EXPECT_TRUE(takes("* and not (RGBA or Z)", "specular"));
    EXPECT_FALSE(takes("* and not (RGBA or Z)", "Z"));
    EXPECT_FALSE(takes("#set", "set")) << "collections hold nodes";
    EXPECT_FALSE(takes("*.(id==7)", "a"));
}

/// The report of a bad selection.
std::string problem(const std::string& text) {
    try {
        (void)Selection::parse(text, {});
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors().front().code, Code::OperatorSelection);
        return e.errors().front().message;
    }
    return "none";
}

TEST(Selections, SayWhereTheyAreWrong) {
    EXPECT_EQ(problem(""), "the selection is empty (column 1 of \"\")");
    EXPECT_EQ(problem("a )"), "this parenthesis closes nothing (column 3 of \"a )\")");
    EXPECT_EQ(problem("(a"), "this parenthesis is never closed (column 1 of \"(a\")");
    EXPECT_EQ(problem("*.(id==7"), "this parenthesis is never closed (column 3 of \"*.(id==7\")");
    EXPECT_EQ(problem("*.(id==)"), "a value is expected here (column 8 of \"*.(id==)\")");
    EXPECT_EQ(problem("*.(==7)"),
              "a parameter or @node is expected here (column 4 of \"*.(==7)\")");
    EXPECT_EQ(problem("*.(@kind=='x')"),
              "\"@kind\" is not known (column 4 of \"*.(@kind=='x')\")");
    EXPECT_EQ(problem("*.(@node=='x)"), "this text does not end (column 11 of \"*.(@node=='x)\")");
    EXPECT_EQ(problem("*.(id<'x')"), "a number is expected here (column 7 of \"*.(id<'x')\")");
    EXPECT_EQ(problem("a r'(b"), "this regular expression does not end (column 3 of \"a r'(b\")");
    EXPECT_EQ(problem("r'((a{90}){90}){9}'"),
              "regular expressions with counts are not taken (column 6 of "
              "\"r'((a{90}){90}){9}'\")");
    EXPECT_EQ(problem("r'(b'"), "this is no regular expression (column 3 of \"r'(b'\")");
    EXPECT_TRUE(problem("r'" + std::string(300, 'a') + "'")
                    .starts_with("this regular expression is too long"));
    EXPECT_EQ(problem("a and"), "a name is expected here (column 6 of \"a and\")");
    EXPECT_EQ(problem("*.(a.q==1)"),
              "components are .r .g .b .a or .x .y .z (column 6 of \"*.(a.q==1)\")");
    EXPECT_EQ(problem("*.(a[x]==1)"),
              "the number of an element is expected here (column 6 of \"*.(a[x]==1)\")");
    EXPECT_TRUE(problem(std::string(500, '(')).starts_with("parentheses are nested too deep"));
    // Nothing is nested here, however long it is.
    std::string row = "a";
    for (int i = 0; i < 5000; ++i)
        row += " or a";
    EXPECT_EQ(problem(row), "none");
}

TEST(Assignments, AreReadAsASceneFileWouldWriteThem) {
    const auto value = [](std::string_view text) {
        const Assignment a = parse_assignment(text, {});
        return a.param + ": " + a.value;
    };
    EXPECT_EQ(value("visibility=254"), "visibility: 254");
    EXPECT_EQ(value(" Kd_color = 1 0 0.5 "), "Kd_color: 1 0 0.5");
    EXPECT_EQ(value("Kd_color=[1, 0, 0.5]"), "Kd_color: 1 0 0.5");
    EXPECT_EQ(value("shader='aiFlat2'"), "shader: \"aiFlat2\"");
    EXPECT_EQ(value("shader=\"a b\""), "shader: \"a b\"");
    EXPECT_EQ(value("shader='a' 'b'"), "shader: \"a\" \"b\"");
    EXPECT_EQ(value("color[1].r = 'ramp.g'"), "color[1].r: \"ramp.g\"");
    EXPECT_EQ(value("filename='a=b'"), "filename: \"a=b\"");
    EXPECT_EQ(value("text=''"), "text: \"\"");
    const Assignment declared = parse_assignment("rgb[] tints = 1 0 0", {});
    EXPECT_EQ(declared.declared, ParamType::Rgb);
    EXPECT_TRUE(declared.is_array);
    EXPECT_EQ(parse_assignment("constant FLOAT x=1", {}).declared, ParamType::Float);
}

TEST(Assignments, SayWhatIsWrong) {
    const auto wrong = [](const std::string& text) -> std::string {
        try {
            (void)parse_assignment(text, {});
        } catch (const InputError& e) {
            return e.errors().front().message;
        }
        return "none";
    };
    EXPECT_EQ(wrong("visibility"), "an = is missing (column 11 of the assignment \"visibility\")");
    EXPECT_EQ(wrong("=1"), "a parameter's name is expected (column 1 of the assignment \"=1\")");
    EXPECT_EQ(wrong("a="), "a value is missing (column 3 of the assignment \"a=\")");
    EXPECT_EQ(wrong("a='x"), "a text does not end (column 3 of the assignment \"a='x\")");
    EXPECT_EQ(wrong("thing a=1"),
              "\"THING\" is no type (column 1 of the assignment \"thing a=1\")");
    EXPECT_EQ(wrong("varying float a=1"),
              "\"varying\" cannot be declared by an operator (column 1 of the assignment "
              "\"varying float a=1\")");
}

}  // namespace
}  // namespace lightsieve
