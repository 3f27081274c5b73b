// Every lexical habit of .ass files has a small file in tests/data/ass; what it must mean stands beside it as NAME.expect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/ass_read.h"
#include "scene/ass_write.h"
#include "scene/graph.h"
#include "scene/test_nodes.h"

namespace lightsieve {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(LIGHTSIEVE_SOURCE_DIR) / "tests/data/ass"; }

std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder()))
        if (entry.path().extension() == ".ass") out.push_back(entry.path().stem().string());
    std::sort(out.begin(), out.end());
    return out;
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream out;
    out << file.rdbuf();
    return out.str();
}

class Oddity : public testing::TestWithParam<std::string> {};

TEST_P(Oddity, ReadsWithoutComplaint) {
    Diagnostics diagnostics;
    const Document document =
        read_ass_file((folder() / (GetParam() + ".ass")).string(), diagnostics);
    (void)build_graph(document, test::registry(), {}, diagnostics);
    EXPECT_EQ(diagnostics.render(), "");
}

TEST_P(Oddity, IsWrittenBackByteForByte) {
    const fs::path path = folder() / (GetParam() + ".ass");
    Diagnostics diagnostics;
    EXPECT_EQ(write_ass(read_ass_file(path.string(), diagnostics)), content(path));
}

TEST_P(Oddity, MeansWhatItShould) {
    const fs::path expected = folder() / (GetParam() + ".expect");
    Diagnostics diagnostics;
    // Read under a short name: the dump shows it.
    const Document document = read_ass(content(folder() / (GetParam() + ".ass")),
                                       GetParam() + ".ass", nullptr, diagnostics);
    const std::string dumped = dump(build_graph(document, test::registry(), {}, diagnostics));
    if (std::getenv("LIGHTSIEVE_UPDATE_EXPECTED") != nullptr)
        std::ofstream(expected, std::ios::binary) << dumped;
    EXPECT_EQ(dumped, content(expected));
}

TEST_P(Oddity, GraphSurvivesWritingAndReading) {
    Diagnostics diagnostics;
    const Document document =
        read_ass_file((folder() / (GetParam() + ".ass")).string(), diagnostics);
    const std::string once = write_ass(build_graph(document, test::registry(), {}, diagnostics));
    Diagnostics again;
    const SceneGraph graph =
        build_graph(read_ass(once, "again.ass", nullptr, again), test::registry(), {}, again);
    EXPECT_EQ(again.render(), "");
    EXPECT_EQ(write_ass(graph), once);
}

INSTANTIATE_TEST_SUITE_P(Files, Oddity, testing::ValuesIn(names()),
                         [](const auto& file) { return file.param; });

}  // namespace
}  // namespace lightsieve
