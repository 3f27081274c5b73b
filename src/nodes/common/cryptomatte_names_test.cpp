// Names as exporters write them, and what mattes call them.
#include "nodes/common/cryptomatte_names.h"

#include <gtest/gtest.h>

namespace lightsieve {
namespace {

struct Case {
    const char *name, *object, *asset;
};

void expect_names(const std::vector<Case>& cases, const NameRules& rules) {
    for (const Case& c : cases) {
        const ShapeNames names = shape_names(c.name, rules);
        EXPECT_EQ(names.object, c.object) << c.name;
        EXPECT_EQ(names.asset, c.asset) << c.name;
    }
}

TEST(CryptomatteNames, OfShapes) {
    expect_names({{"roof", "roof", "default"},
                  {"house1:roof", "roof", "house1"},
                  {"a:b:roof", "b:roof", "a"},
                  {"town:house|town:roof", "house|roof", "town"},
                  {"house|roof", "house|roof", "default"},
                  {"/town/house/roof", "roof", "/town/house"},
                  {"/town/house|roof", "roof", "/town/house"},
                  {"/roof", "roof", "default"},
                  {"c4d|house|roof", "roof", "house"},
                  {"c4d|roof", "roof", "default"},
                  {"house.roof.SItoA.2000", "roof", "house"},
                  {"roof.SItoA.2000", "roof", "default"},
                  {"cloud.SItoA.Instance.1.7 tree.SItoA.2000", "tree", "default"},
                  {"", "", "default"},
                  {"m\xc3\xa4:d\xc3\xb6", "d\xc3\xb6", "m\xc3\xa4"}},
                 {});
}

TEST(CryptomatteNames, OfShapesWithNamespaces) {
    NameRules rules;
    rules.strip_namespaces = false;
    expect_names({{"house1:roof", "house1:roof", "house1"},
                  {"/town/house/roof", "/town/house/roof", "/town/house"},
                  {"c4d|house|roof", "house|roof", "house"},
                  {"house.roof.SItoA.2000", "house.roof", "house"}},
                 rules);
}

TEST(CryptomatteNames, EveryRuleCanBeOff) {
    NameRules rules;
    rules.maya = false;
    expect_names({{"house1:roof", "house1:roof", "default"}}, rules);
    rules = {};
    rules.paths = false;
    expect_names({{"/town/roof", "/town/roof", "default"}}, rules);
    rules = {};
    rules.pipes_in_paths = false;
    expect_names({{"/town/house|roof", "house|roof", "/town"}}, rules);
    rules = {};
    rules.legacy = false;
    expect_names({{"c4d|house|roof", "c4d|house|roof", "default"},
                  {"house.roof.SItoA.2000", "house.roof.SItoA.2000", "default"}},
                 rules);
    expect_names({{"house1:roof", "house1:roof", "default"}},
                 {false, false, false, false, false, false});
}

TEST(CryptomatteNames, OfMaterials) {
    const auto plain = [](const char* name) { return material_name(name, {}); };
    EXPECT_EQ(plain("tiles"), "tiles");
    EXPECT_EQ(plain("house1:tiles"), "tiles");
    EXPECT_EQ(plain("/shop/mat/tiles|standard_surface1"), "tiles");
    EXPECT_EQ(plain("c4d|tiles|root"), "tiles");
    EXPECT_EQ(plain("Sources.Materials.library.tiles.Standard_Mattes.uBasic.SItoA.25000"),
              "tiles");
    NameRules rules;
    rules.strip_namespaces = false;
    EXPECT_EQ(material_name("house1:tiles", rules), "house1:tiles");
    EXPECT_EQ(material_name("/shop/mat/tiles|root", rules), "/shop/mat/tiles");
    EXPECT_EQ(material_name("Sources.Materials.library.tiles.x.SItoA.25000", rules),
              "library.tiles");
    rules = {};
    rules.material_pipes = false;
    EXPECT_EQ(material_name("/shop/tiles|root", rules), "tiles|root");
    rules = {};
    rules.paths = rules.maya = rules.legacy = false;
    EXPECT_EQ(material_name("/shop/tiles", rules), "/shop/tiles");
    EXPECT_EQ(material_name("house1:tiles", rules), "house1:tiles");
    EXPECT_EQ(material_name("c4d|tiles|root", rules), "c4d|tiles|root");
}

}  // namespace
}  // namespace lightsieve
