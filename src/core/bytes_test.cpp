#include "core/bytes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/fingerprint.h"

namespace lightsieve {
namespace {

TEST(Bytes, ComeBackAsTheyWere) {
    ByteWriter out;
    out.put(7);
    out.put(std::vector<float>{1, 2.5F});
    out.put(std::vector<double>{});
    const std::vector<std::byte> bytes = out.take();
    ByteReader in(bytes);
    int number = 0;
    std::vector<float> some;
    std::vector<double> none{1};
    EXPECT_TRUE(in.get(number) && in.get(some, 2));
    EXPECT_FALSE(in.done());
    EXPECT_TRUE(in.get(none, 0));
    EXPECT_TRUE(in.done());
    EXPECT_EQ(number, 7);
    EXPECT_EQ(some, (std::vector<float>{1, 2.5F}));
    EXPECT_TRUE(none.empty());
}

TEST(Bytes, WhatIsMissingOrOfAnotherSizeFailsForGood) {
    ByteWriter out;
    out.put(std::vector<int>{1, 2, 3});
    std::vector<std::byte> bytes = out.take();
    std::vector<int> values{9};
    ByteReader other(bytes);
    EXPECT_FALSE(other.get(values, 4));
    char c = 0;
    EXPECT_FALSE(other.get(c)) << "not even what would be there";
    bytes.pop_back();
    ByteReader cut(bytes);
    EXPECT_FALSE(cut.get(values, 3));
    EXPECT_FALSE(cut.done());
    EXPECT_EQ(values, std::vector<int>{9});
}

TEST(Fingerprint, TellsTextsApart) {
    std::set<std::uint64_t> seen;
    std::size_t n = 0;
    const auto note = [&](auto... texts) {
        Fingerprint sum;
        (sum.add(std::string_view(texts)), ...);
        seen.insert(sum.value());
        ++n;
    };
    const std::string text = "a text of more than two words of eight bytes";
    note();
    note("");
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string changed = text;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        note(changed);
        note(text.substr(0, i), text.substr(i));
        if (i > 0) note(text.substr(0, i));
    }
    note(std::string(8, '\0'));
    note(std::string(16, '\0'));
    EXPECT_EQ(seen.size(), n);
    Fingerprint sum;
    EXPECT_EQ(sum.text().size(), 16U);
}

}  // namespace
}  // namespace lightsieve
