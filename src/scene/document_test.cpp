// Reading what is damaged, includes, edits.
#include "scene/document.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "scene/ass_read.h"
#include "scene/ass_write.h"

namespace lightsieve {
namespace {

/// `line:column code` of everything reported.
std::string reports(const Diagnostics& diagnostics) {
    std::string out;
    for (const Error& e : diagnostics.items()) {
        const LineColumn at = e.where.line_column();
        out += (e.where.known() ? std::to_string(at.line) + ":" + std::to_string(at.column) + " "
                                : std::string()) +
               std::string(code_text(e.code)) + "\n";
    }
    return out;
}

struct Read {
    Document document;
    std::string errors;
};
Read read(const std::string& text, const ReadFile& files = nullptr) {
    Diagnostics diagnostics;
    Document document = read_ass(text, "t.ass", files, diagnostics);
    EXPECT_EQ(write_ass(document), text) << "a damaged document is written back as it is, too";
    return {std::move(document), reports(diagnostics)};
}

// ---- damage ----

TEST(Damage, AllErrorsAtOnceAndTheRestIsRead) {
    const Read r = read(
        "polymesh\n{\n name a\n vlist 3 1 VECTOR 1 2\n id 4\n}\n"
        "polymesh\n{\n name b\n 5 6\n id 7\n nsides 2 1 UNIT 3 3\n}\n"
        "} nonsense\npolymesh\n{\n name c\n id\n}\n");
    EXPECT_EQ(
        r.errors,
        "4:8 array-count\n10:2 ass-syntax\n12:13 ass-syntax\n14:1 ass-syntax\n18:2 ass-syntax\n");
    EXPECT_EQ(dump(r.document),
              "polymesh \"a\"\n  name: word a\n  id: numbers 4\n"
              "polymesh \"b\"\n  name: word b\n  id: numbers 7\n"
              "polymesh \"c\"\n  name: word c\n");
}

TEST(Damage, TheMessageShowsThePlaceAndWhatToDo) {
    Diagnostics diagnostics;
    (void)read_ass("polymesh\n{\n name a\n vlist 12 1 VECTOR\n  1 2 3", "shot.ass", nullptr,
                   diagnostics);
    EXPECT_EQ(
        diagnostics.render(),
        "shot.ass:4:8: error[array-count]: array \"vlist\" has 1 elements, but its head says 12\n"
        "    4 |  vlist 12 1 VECTOR\n"
        "      |        ^~~~~~~~~~~\n"
        "  hint: the file ends here: it may be cut off\n"
        "shot.ass:1:1: error[ass-unclosed]: node \"polymesh\" does not end\n"
        "    1 | polymesh\n"
        "      | ^~~~~~~~\n"
        "  hint: the file ends here: it may be cut off\n");
}

TEST(Damage, UnclosedNode) {
    const Read r = read("polymesh\n{\n name a\nsphere\n{\n name b\n}\n");
    EXPECT_EQ(r.errors, "1:1 ass-unclosed\n");
    ASSERT_EQ(r.document.nodes().size(), 2U);
    EXPECT_EQ(r.document.nodes()[1].name, Name("b"));
}

TEST(Damage, UnclosedString) {
    const Read r = read("driver_tiff\n{\n name a\n filename \"x.tif\n half_precision on\n}\n");
    EXPECT_EQ(r.errors, "4:11 ass-unclosed\n");
    ASSERT_EQ(r.document.nodes().size(), 1U);
    EXPECT_EQ(r.document.nodes()[0].params.size(), 2U);
}

TEST(Damage, PackedArrays) {
    EXPECT_EQ(read("m\n{\n v 3 1 b85FLOAT zz\n}\n").errors, "3:4 array-count\n");
    EXPECT_EQ(read("m\n{\n v 3 1 b85UINT Qzz\n id 3\n}\n").errors, "3:16 array-data\n");
    EXPECT_EQ(read("m\n{\n v 1 1 b85FLOAT xxxxx\n id 3\n}\n").errors, "3:17 array-data\n");
    EXPECT_EQ(read("m\n{\n v 4 1 b85FLOAT !z$$$$)\n id 3\n}\n").errors, "3:19 array-data\n");
    EXPECT_EQ(read("m\n{\n v 2 1 b85STRING $$$$$\n id 3\n}\n").errors, "3:8 ass-syntax\n");
    EXPECT_EQ(read("m\n{\n v 2 1 b64FLOAT AAAA\n}\n").errors, "3:4 array-count\n");
    const Read r = read("m\n{\n v 3 1 b85UINT Qzz\n zzz$$\n id 3\n}\nm\n{\n name b\n}\n");
    ASSERT_EQ(r.document.nodes().size(), 2U);
    EXPECT_EQ(dump(r.document), "m \"\"\n  id: numbers 3\nm \"b\"\n  name: word b\n");
}

TEST(Damage, HugeCounts) {
    EXPECT_EQ(read("m\n{\n vlist 4000000000 1 VECTOR\n  1 2 3\n}\n").errors, "3:8 array-count\n");
    EXPECT_EQ(read("m\n{\n vlist 4000000000 4000000000 b85MATRIX\n  yyy\n}\n").errors,
              "3:8 array-count\n");
    EXPECT_EQ(read("m\n{\n vlist 99999999999999999999999 1 FLOAT\n  1 2 3\n}\n").errors,
              "3:8 array-count\n");
    EXPECT_EQ(read("m\n{\n vlist 4000000000 1 STRING\n  \"a\"\n}\n").errors, "3:8 array-count\n");
    EXPECT_EQ(read("m\n{\n vlist 4000000000 2 b64FLOAT\n AAAA\n}\n").errors, "3:8 array-count\n");
    EXPECT_EQ(read("m\n{\n vlist 3 0 VECTOR 1 2 3\n id 3\n}\n").errors,
              "3:8 array-count\n3:19 ass-syntax\n");
}

TEST(Damage, MissingElementsDoNotSwallowWhatFollows) {
    const Read r = read("m\n{\n outputs 3 1 STRING \"a\" \"b\"\n id 3\n}\n");
    EXPECT_EQ(r.errors, "3:10 array-count\n");
    EXPECT_EQ(dump(r.document), "m \"\"\n  id: numbers 3\n");
}

TEST(Damage, Declarations) {
    EXPECT_EQ(read("m\n{\n declare x sometimes FLOAT\n id 3\n}\n").errors, "3:2 ass-syntax\n");
    EXPECT_EQ(read("m\n{\n declare x uniform WORD\n id 3\n}\n").errors, "3:2 ass-syntax\n");
    EXPECT_EQ(read("m\n{\n declare }\n").errors, "3:2 ass-syntax\n");
}

TEST(Damage, NoSceneFileAtAll) {
    EXPECT_EQ(read(std::string("\x7f"
                               "ELF\0\0\0",
                               7))
                  .errors,
              "file-format\n");
    EXPECT_EQ(read("{{{{{{{{{{").errors, "1:1 ass-syntax\n");
    EXPECT_EQ(read("hello world").errors, "1:1 ass-syntax\n");
    EXPECT_EQ(read("\"a string\"").errors, "1:1 ass-syntax\n");
    EXPECT_EQ(read("m { { { { { } } } }").errors, "1:5 ass-syntax\n1:15 ass-syntax\n");
}

/// Every prefix of a file, and the file with bytes changed: reports, but neither crashes nor hangs.
TEST(Damage, TruncationsAndNoise) {
    const std::string text =
        "# c\npolymesh\n{\n name a\n declare c uniform RGB\n c 2 1 RGB 1 2 3 4 5 6\n vlist 4 1 "
        "b85VECTOR\nyz!z$$$$,y\n y\n"
        " shader 2 1 NODE \"a\" \"b\\\"\"\n outputs \"x y\" \"z\"\n color[1].r b.g\n v 2 1 "
        "b64FLOAT AACAPwAAAEA\n}\ninclude \"x\"\n";
    for (std::size_t n = 0; n <= text.size(); ++n)
        (void)read(text.substr(0, n));
    std::mt19937 random(11);
    const std::string bytes = "{}\"\\#\n $!zyBx0123.eA[]\xff\x01";
    for (int i = 0; i < 3000; ++i) {
        std::string noisy = text;
        for (int k = 0; k < 4; ++k)
            noisy[random() % noisy.size()] = bytes[random() % bytes.size()];
        (void)read(noisy);
    }
    for (int i = 0; i < 300; ++i) {
        std::string garbage;
        for (int k = 0; k < 400; ++k)
            garbage += bytes[random() % bytes.size()];
        (void)read(garbage);
    }
}

/// Would take hours if recovery looked for the end of each string from each place.
TEST(Damage, RecoveryTakesTimeInProportionToTheText) {
    const std::size_t n = 200000;
    for (const std::string line :
         {"\\\"\n", "\"\\\"", "a \"\n", "{\n", "}\n", "5 5\n", "x[\n", "# \n", "\n", "a\n",
          "declare\n", "v 9 1 b85UINT Q\n", "\\\" "}) {
        std::string text = "m\n{\n 5\n";
        for (std::size_t i = 0; i < n; ++i)
            text += line;
        Diagnostics diagnostics;
        (void)read_ass(text, "t.ass", nullptr, diagnostics);
        (void)read_ass(text.substr(4), "t.ass", nullptr, diagnostics);
        EXPECT_TRUE(diagnostics.has_errors());
    }
}

// ---- includes ----

ReadFile files(std::map<std::string, std::string> content) {
    return [content = std::move(content)](const std::string& path) -> std::optional<std::string> {
        const auto found = content.find(path);
        return found == content.end() ? std::nullopt : std::optional(found->second);
    };
}

TEST(Include, NodesComeInPlaceOfTheStatement) {
    const Read r = read("m { name a }\ninclude \"sub/b.ass\"\nm { name z }\n",
                        files({{"sub/b.ass", "m { name b }\ninclude \"c.ass\"\n"},
                               {"sub/c.ass", "m { name c }"}}));
    EXPECT_EQ(r.errors, "");
    std::string names;
    for (const NodeBlock& node : r.document.nodes())
        names += node.name.str();
    EXPECT_EQ(names, "abcz");
    // Places are in the file that a node was written in.
    EXPECT_EQ(r.document.span(r.document.nodes()[2].type_range).source->name, "sub/c.ass");
}

TEST(Include, IsWrittenOutWhereItWasEdited) {
    const ReadFile all = files({{"b.ass", "# b\nm { name b }\n"}, {"c.ass", "m { name c }\n"}});
    Diagnostics diagnostics;
    Document document =
        read_ass("include \"b.ass\"\ninclude \"c.ass\"\n", "t.ass", all, diagnostics);
    ASSERT_TRUE(
        document.set_param(static_cast<std::size_t>(document.find("b")), "id", "5", diagnostics));
    EXPECT_EQ(write_ass(document), "# b\nm { name b \n id 5\n}\n\ninclude \"c.ass\"\n");
}

TEST(Include, Errors) {
    EXPECT_EQ(read("include \"none.ass\"\nm { name a }\n", files({})).errors,
              "1:1 file-not-found\n");
    EXPECT_EQ(read("include \"none.ass\"\n").errors, "1:1 file-not-found\n");
    EXPECT_EQ(read("include \"./t.ass\"\n", files({{"t.ass", ""}})).errors, "1:1 include-cycle\n");
    EXPECT_EQ(
        read("include \"b.ass\"\n", files({{"b.ass", "\n include \"x/../t.ass\""}, {"t.ass", ""}}))
            .errors,
        "2:2 include-cycle\n");
    EXPECT_EQ(read("include \"b.ass").errors, "1:9 ass-unclosed\n");
}

TEST(Include, PipesAreNotWaitedFor) {
    const std::string folder = testing::TempDir() + "lightsieve_include";
    std::filesystem::create_directories(folder);
    ASSERT_EQ(::mkfifo((folder + "/pipe").c_str(), 0600), 0);
    std::ofstream(folder + "/scene.ass") << "include \"pipe\"\nm { name a }\n";
    Diagnostics diagnostics;
    const Document document = read_ass_file(folder + "/scene.ass", diagnostics);
    EXPECT_EQ(diagnostics.items().at(0).code, Code::FileNotFound);
    EXPECT_EQ(document.nodes().size(), 1U);
    std::filesystem::remove_all(folder);
}

TEST(Include, DoublingFilesEnd) {
    // Each file includes the next twice: 2^30 files if nobody counted.
    std::map<std::string, std::string> content;
    for (int i = 1; i < 30; ++i)
        content["f" + std::to_string(i)] = "include \"f" + std::to_string(i + 1) +
                                           "\"\ninclude \"f" + std::to_string(i + 1) + "\"\n";
    content["f30"] = "m { }\n";
    const Read r = read("include \"f1\"\n", files(content));
    EXPECT_NE(r.errors.find("limit-includes"), std::string::npos);
    std::map<std::string, std::string> deep;
    for (int i = 1; i < 60; ++i)
        deep["f" + std::to_string(i)] = "include \"f" + std::to_string(i + 1) + "\"\n";
    EXPECT_EQ(read("include \"f1\"\n", files(deep)).errors, "1:1 limit-includes\n");
}

// ---- edits ----

constexpr const char* kScene =
    "# keep\noptions { AA_samples 3 } # keep too\n\npolymesh\n{\n name  a\n\tid   4 # four\n "
    "vlist 1 1 VECTOR\n  1 2 3\n}\n";

TEST(Edit, OnlyTheEditedBytesChange) {
    Diagnostics diagnostics;
    Document document = read_ass(kScene, "t.ass", nullptr, diagnostics);
    ASSERT_TRUE(document.set_param(1, "id", "77", diagnostics));
    ASSERT_TRUE(document.set_param(1, "vlist", "2 1 VECTOR 0 0 0 1 1 1", diagnostics));
    ASSERT_TRUE(document.set_param(1, "color[2].g", "checker", diagnostics));
    ASSERT_TRUE(document.set_param(1, "id", "78", diagnostics));
    ASSERT_TRUE(document.remove_param(0, "AA_samples"));
    EXPECT_FALSE(document.remove_param(0, "AA_samples"));
    EXPECT_EQ(write_ass(document),
              "# keep\noptions {  } # keep too\n\npolymesh\n{\n name  a\n\tid 78 # four\n vlist 2 "
              "1 VECTOR 0 0 0 1 1 1\n color[2].g checker\n}\n");
}

TEST(Edit, NodesComeAndGo) {
    Diagnostics diagnostics;
    Document document = read_ass(kScene, "t.ass", nullptr, diagnostics);
    const std::size_t sphere = document.add_node("sphere", "a \"ball\"");
    ASSERT_TRUE(document.set_param(sphere, "radius", "2", diagnostics));
    document.remove_node(static_cast<std::size_t>(document.find("a")));
    EXPECT_EQ(write_ass(document),
              "# keep\noptions { AA_samples 3 } # keep too\n\n\n\nsphere\n{\n name \"a "
              "\\\"ball\\\"\"\n radius 2\n}\n");
    Diagnostics again;
    const Document back = read_ass(write_ass(document), "t.ass", nullptr, again);
    EXPECT_EQ(reports(again), "");
    EXPECT_GE(back.find("a \"ball\""), 0);
    EXPECT_EQ(back.find("a"), -1);
    EXPECT_EQ(back.find("options"), 0);
}

TEST(Edit, BadValuesChangeNothing) {
    Diagnostics diagnostics;
    Document document = read_ass(kScene, "t.ass", nullptr, diagnostics);
    EXPECT_FALSE(document.set_param(1, "id", "", diagnostics));
    EXPECT_FALSE(document.set_param(1, "id", "4 name b", diagnostics));
    EXPECT_FALSE(document.set_param(1, "id", "}", diagnostics));
    EXPECT_FALSE(document.set_param(1, "id", "\"open", diagnostics));
    EXPECT_FALSE(document.set_param(1, "1d", "4", diagnostics));
    EXPECT_FALSE(document.set_param(1, "vlist", "3 1 VECTOR 1 2 3", diagnostics));
    EXPECT_EQ(write_ass(document), kScene);
    EXPECT_EQ(diagnostics.n_errors(), 6U);
}

// ---- files ----

class File : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("lightsieve_document_test_" +
                   std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    void write_gz(const std::string& name, const std::string& text) const {
        gzFile file = gzopen(path(name).c_str(), "wb");
        gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
        gzclose(file);
    }

  private:
    std::filesystem::path folder_;
};

TEST_F(File, PlainAndCompressed) {
    write("a.ass", "m { name a }\ninclude \"b.ass.gz\"\n");
    write_gz("b.ass.gz", "m { name b }\n");
    Diagnostics diagnostics;
    const Document document = read_ass_file(path("a.ass"), diagnostics);
    EXPECT_EQ(reports(diagnostics), "");
    EXPECT_EQ(document.nodes().size(), 2U);
    // The content tells, not the name.
    std::filesystem::rename(path("b.ass.gz"), path("c.ass"));
    EXPECT_EQ(read_ass_file(path("c.ass"), diagnostics).nodes().size(), 1U);
}

TEST_F(File, Errors) {
    Diagnostics diagnostics;
    (void)read_ass_file(path("none.ass"), diagnostics);
    (void)read_ass_file(path("."), diagnostics);
    write_gz("cut.gz", std::string(100000, 'x') + "m { name b }\n");
    std::filesystem::resize_file(path("cut.gz"), 60);
    (void)read_ass_file(path("cut.gz"), diagnostics);
    EXPECT_EQ(reports(diagnostics), "file-not-found\nfile-unreadable\nfile-format\n");
}

TEST_F(File, DecompressionIsLimited) {
    write_gz("bomb.gz", std::string(std::size_t{8} << 20U, ' '));
    Diagnostics diagnostics;
    EXPECT_FALSE(read_text_file(path("bomb.gz"), diagnostics, std::size_t{4} << 20U));
    EXPECT_EQ(reports(diagnostics), "limit-file-size\n");
}

}  // namespace
}  // namespace lightsieve
