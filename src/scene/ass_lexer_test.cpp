#include "scene/ass_lexer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "scene/value_text.h"

namespace lightsieve {
namespace {

TEST(Numbers, FloatsInEverySpelling) {
    EXPECT_EQ(parse_float("1"), 1.0F);
    EXPECT_EQ(parse_float("+1.5"), 1.5F);
    EXPECT_EQ(parse_float(".5"), 0.5F);
    EXPECT_EQ(parse_float("1."), 1.0F);
    EXPECT_EQ(parse_float("6.12323426e-017"), 6.12323426e-17F);
    EXPECT_EQ(parse_float("1.19386565e-39"), 1.19386565e-39F);
    EXPECT_TRUE(std::signbit(*parse_float("-0")));
    EXPECT_EQ(parse_float("1e999"), HUGE_VALF);
    EXPECT_EQ(parse_float("-1.#INF"), -HUGE_VALF);
    EXPECT_TRUE(std::isnan(*parse_float("1.#QNAN")));
    EXPECT_TRUE(std::isnan(*parse_float("-nan")));
    for (const char* no :
         {"", "-", "+", ".", "1x", "0test", "1.2.3", "e5", "+-1", "infx", "name", "0x10", "1,5"})
        EXPECT_FALSE(parse_float(no)) << no;
}

TEST(Numbers, ShortestTextReadsBackToTheSameBits) {
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        const auto bits = static_cast<std::uint32_t>(random());
        float value = 0;
        std::memcpy(&value, &bits, sizeof(value));
        if (std::isnan(value)) continue;
        const std::optional<float> back = parse_float(float_text(value));
        ASSERT_TRUE(back);
        ASSERT_EQ(std::memcmp(&*back, &value, sizeof(value)), 0) << float_text(value);
    }
}

TEST(Numbers, Integers) {
    EXPECT_EQ(parse_integer("3518428338"), 3518428338);
    EXPECT_EQ(parse_integer("-7"), -7);
    EXPECT_EQ(parse_integer("+7"), 7);
    EXPECT_EQ(parse_integer("4.0"), 4);
    EXPECT_EQ(parse_integer("1e3"), 1000);
    for (const char* no : {"", "4.5", "x", "1e30", "nan", "inf", "99999999999999999999999"})
        EXPECT_FALSE(parse_integer(no)) << no;
}

TEST(Names, Suffixes) {
    const auto name = parse_param_name("color[12].g");
    ASSERT_TRUE(name);
    EXPECT_EQ(name->base, "color");
    EXPECT_EQ(name->element, 12);
    EXPECT_EQ(name->component, 1);
    EXPECT_EQ(parse_param_name("input.z")->component, 2);
    EXPECT_EQ(parse_param_name("input.a")->component, 3);
    EXPECT_EQ(parse_param_name("foo.bar")->base, "foo.bar");
    for (const char* no : {"", "3", "-x", "[1]", "a[", "a[]", "a[x]", "a[-1]", "a[1", "a[1][2]",
                           "a[99999999999999999999]", "a\x01"})
        EXPECT_FALSE(parse_param_name(no)) << no;
}

TEST(Strings, Escapes) {
    EXPECT_EQ(unquote(R"("a \"b\" \\ c:\new")"), R"(a "b" \ c:\new)");
    EXPECT_EQ(unquote(R"("")"), "");
}

}  // namespace
}  // namespace lightsieve
