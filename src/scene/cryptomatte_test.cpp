// Ids and manifests against the specification's numbers.
#include "scene/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace lightsieve {
namespace {

TEST(Cryptomatte, HashesAsTheSpecificationDoes) {
    EXPECT_EQ(matte_id("bunny"), 0x13851a76U);
    EXPECT_EQ(matte_id("default"), 0x42c9679fU);
    EXPECT_EQ(matte_id("bunny_porcelain_mat"), 0xb24b26d4U);
}

TEST(Cryptomatte, HashesTextsOfEveryLength) {
    // Test vectors of MurmurHash3_x86_32 with seed 0 that are in public use.
    EXPECT_EQ(murmur_hash(""), 0U);
    EXPECT_EQ(murmur_hash("test"), 0xba6bd213U);
    EXPECT_EQ(murmur_hash("Hello, world!"), 0xc0363e43U);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

TEST(Cryptomatte, IdsAreOrdinaryFloats) {
    int toggled = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string name = "object" + std::to_string(i);
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(matte_id(name)))) << name;
        toggled += matte_id(name) != murmur_hash(name) ? 1 : 0;
    }
    // One of 128 names needs the bit: 31 of 4000 on average, with a standard deviation of 5.6.
    EXPECT_GT(toggled, 5);
    EXPECT_LT(toggled, 60);
}

TEST(Cryptomatte, KeysAreTheBeginningOfTheHash) {
    EXPECT_EQ(matte_key("bunny"), "13851a7");
    EXPECT_EQ(matte_key("default"), "42c9679");
}

TEST(Cryptomatte, ManifestsAreJson) {
    EXPECT_EQ(manifest_json({}), "{}");
    EXPECT_EQ(manifest_json({{"bunny", matte_id("bunny")}, {"default", matte_id("default")}}),
              R"({"bunny":"13851a76","default":"42c9679f"})");
    EXPECT_EQ(manifest_json({{"a\"b\\c\n", 1}}), R"({"a\"b\\c\u000a":"00000001"})");
    EXPECT_EQ(manifest_json({{"/a/m\xc3\xa4", 0xabcdef01U}}), "{\"/a/m\xc3\xa4\":\"abcdef01\"}");
}

}  // namespace
}  // namespace lightsieve
