// Files that are damaged or ask for too much, and readers that fail: always a message, never a hang or a crash.

#include "io/volume_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>

#include "core/error.h"
#include "io/testing/test_folder.h"

namespace lightsieve {

namespace {

std::string test_file(const std::string& name) {
    return std::string(LIGHTSIEVE_SOURCE_DIR) + "/tests/data/volumes/" + name;
}

/// The error that `body` throws; code Code{} and no text if none.
Error error_of(const std::function<void()>& body) {
    try {
        body();
    } catch (const InputError& error) {
        EXPECT_EQ(error.errors().size(), 1U);
        return error.errors().front();
    }
    ADD_FAILURE() << "no error";
    return {};
}

class VolumeReaderTest : public FolderTest {
  protected:
    [[nodiscard]] static Error error_with(const std::string& reader,
                                          const VolumeLimits& limits = {}) {
        return error_of(
            [&] { (void)load_volume_with(reader, test_file("small.vdb"), {}, limits); });
    }
    [[nodiscard]] static Error error_in(const std::string& path,
                                        const std::vector<std::string>& names = {},
                                        const VolumeLimits& limits = {}) {
        return error_of([&] { (void)load_volume(path, names, limits); });
    }
    /// What the reader says about a good file.
    [[nodiscard]] std::string good_stream() const {
        const std::string path = in_folder("stream");
        const std::string command = "'" + volume_reader_path() + "' 100000000 10 '" +
                                    test_file("small.vdb") + "' > '" + path + "'";
        EXPECT_EQ(std::system(command.c_str()), 0);
        return bytes_of(path);
    }
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(VolumeReaderTest, FilesThatAreNotThere) {
    EXPECT_EQ(error_in(in_folder("none.vdb")).code, Code::FileNotFound);
    EXPECT_EQ(error_in(in_folder("")).code, Code::FileUnreadable);
    ASSERT_EQ(::mkfifo(in_folder("pipe").c_str(), 0600), 0);
    EXPECT_EQ(error_in(in_folder("pipe")).code, Code::FileUnreadable);
}

TEST_F(VolumeReaderTest, FilesThatAreNoVolumes) {
    write_bytes(in_folder("empty.vdb"), "");
    write_bytes(in_folder("text.vdb"), std::string(1000, 'x'));
    for (const char* name : {"empty.vdb", "text.vdb"}) {
        const Error error = error_in(in_folder(name));
        EXPECT_EQ(error.code, Code::FileFormat) << error.message;
        EXPECT_TRUE(contains(error.message, name));
    }
    EXPECT_TRUE(contains(error_in(in_folder("text.vdb")).message, "not a VDB file"));
}

TEST_F(VolumeReaderTest, AMissingGridNamesThoseThatAreThere) {
    const Error error = error_in(test_file("small.vdb"), {"density", "smoke"});
    EXPECT_EQ(error.code, Code::UnknownGrid);
    EXPECT_TRUE(contains(error.message, "has no grid \"smoke\""));
    EXPECT_EQ(error.hint, "it has \"color\", \"density\"");
    EXPECT_EQ(error_in(test_file("no_grids.vdb"), {"density"}).hint, "the file holds no grids");
}

TEST_F(VolumeReaderTest, AFileWithoutGridsIsNoGrids) {
    const auto volume = load_volume(test_file("no_grids.vdb"), {});
    EXPECT_TRUE(volume->grids().empty());
    EXPECT_TRUE(volume->bounds().empty());
}

TEST_F(VolumeReaderTest, GridsThatCannotBeUsed) {
    for (const char* name : {"flat", "huge", "beyond", "frustum"}) {
        const Error error = error_in(test_file("odd_transforms.vdb"), {"good", name});
        EXPECT_EQ(error.code, Code::VolumeGrid) << error.message;
        EXPECT_TRUE(contains(error.message, "\"" + std::string(name) + "\"")) << error.message;
    }
    EXPECT_TRUE(contains(error_in(test_file("every_type.vdb"), {"points"}).message, "no numbers"));
    EXPECT_TRUE(contains(error_in(test_file("far_away.vdb")).message, "too far"));
    EXPECT_EQ(load_volume(test_file("odd_transforms.vdb"), std::vector<std::string>{"good"})
                  ->grids()[0]
                  .voxel_size,
              1);
}

TEST_F(VolumeReaderTest, LimitsHold) {
    // Of what arrives, and of what the reader may take before.
    const Error arrived = error_in(test_file("every_type.vdb"), {}, {std::size_t{1} << 20, 60});
    EXPECT_EQ(arrived.code, Code::LimitVolume);
    EXPECT_TRUE(contains(arrived.message, "more than 1 MiB")) << arrived.message;
    const std::string command =
        "'" + volume_reader_path() + "' 1000000 10 '" + test_file("every_type.vdb") + "'";
    EXPECT_EQ(error_with(script("exec " + command)).code, Code::LimitVolume);
}

TEST_F(VolumeReaderTest, AReaderThatIsMissingOrIsNoProgram) {
    const Error missing = error_with(in_folder("nowhere"));
    EXPECT_EQ(missing.code, Code::VolumeReader);
    EXPECT_TRUE(contains(missing.message, "cannot be started"));
    write_bytes(in_folder("text"), "no program");
    EXPECT_EQ(error_with(in_folder("text")).code, Code::VolumeReader);
}

TEST_F(VolumeReaderTest, AReaderThatIsStoppedBySignal) {
    const Error crash = error_with(script("kill -SEGV $$"));
    EXPECT_EQ(crash.code, Code::VolumeReader);
    EXPECT_TRUE(contains(crash.message, "signal 11")) << crash.message;
    EXPECT_TRUE(contains(error_with(script("kill -KILL $$")).hint, "memory"));
    EXPECT_EQ(error_with(script("kill -XCPU $$")).code, Code::LimitVolume);
}

TEST_F(VolumeReaderTest, AReaderThatNeverEndsIsEnded) {
    const VolumeLimits soon{std::size_t{1} << 30, 0.2};
    for (const char* body : {"exec sleep 1000",                           // says nothing
                             "exec >&- 2>&-; exec sleep 1000",            // and closes its streams
                             "while :; do echo x >&2; done",              // only complains
                             "printf LSVOL001; exec cat /dev/zero >&2"})  // begins well
        EXPECT_EQ(error_with(script(body), soon).code, Code::LimitVolume) << body;
}

TEST_F(VolumeReaderTest, AReaderThatTalksNonsense) {
    for (const char* body :
         {"exit 0", "exit 3", "echo hello", "exec head -c 100000 /dev/urandom", "printf LSVOL001",
          "exec head -c 100000000 /dev/zero", "echo VDB:other >&2; exit 1"})
        EXPECT_EQ(error_with(script(body)).code, Code::VolumeReader) << body;
    EXPECT_EQ(error_with(script("echo 'VDB:damaged\tit is bent' >&2; exit 1")).code,
              Code::FileFormat);
}

TEST_F(VolumeReaderTest, AStreamThatClaimsTooMuchIsRefusedBeforeMemoryIsTaken) {
    std::string stream = good_stream();
    const std::uint64_t bytes = std::uint64_t{1} << 62;
    std::memcpy(stream.data() + 8 + offsetof(VolumeStreamGrid, grid_bytes), &bytes, sizeof bytes);
    write_bytes(in_folder("claims"), stream);
    EXPECT_EQ(error_with(script("exec cat '" + in_folder("claims") + "'")).code,
              Code::LimitVolume);
}

/// Reads `bytes` as a file, or as what the reader says of one; looks a few values up if it can be read.
class Damage : public VolumeReaderTest {
  protected:
    void try_volume(const std::function<std::shared_ptr<const VolumeGrids>()>& load) {
        ++n_tried_;
        try {
            const auto volume = load();
            ++n_read_;
            for (int grid = 0; grid < static_cast<int>(volume->grids().size()); ++grid) {
                const Box3f bounds = volume->grids()[static_cast<std::size_t>(grid)].bounds;
                const Color value =
                    volume->sample(grid, bounds.center(), VolumeInterpolation::Tricubic);
                EXPECT_TRUE(is_finite(value));
                EXPECT_GE(volume->maximum(grid, bounds).r, value.r);
            }
        } catch (const InputError& error) {
            EXPECT_FALSE(error.errors().front().hint.empty());
        }
    }
    void try_file(const std::string& bytes) {
        write_bytes(in_folder("damaged.vdb"), bytes);
        try_volume([&] { return load_volume(in_folder("damaged.vdb"), {}, kLimits); });
    }
    void try_stream(const std::string& bytes) {
        write_bytes(in_folder("damaged"), bytes);
        try_volume([&] { return load_volume_with(cat_, test_file("small.vdb"), {}, kLimits); });
    }
    void SetUp() override { cat_ = script("exec cat '" + in_folder("damaged") + "'"); }

    /// More of them for tests/big.
    static int rounds() {
        const char* text = std::getenv("LIGHTSIEVE_DAMAGE_ROUNDS");
        return text == nullptr ? 1 : std::max(1, std::atoi(text));
    }

    static constexpr VolumeLimits kLimits{std::size_t{256} << 20, 10};
    std::string cat_;
    int n_tried_ = 0, n_read_ = 0;
};

TEST_F(Damage, FilesThatEndTooEarlyAreAllRefused) {
    for (const char* name : {"small.vdb", "small_zip.vdb", "small_blosc.vdb"}) {
        const std::string bytes = bytes_of(test_file(name));
        for (const double part : {0.0005, 0.01, 0.3, 0.6, 0.999})
            try_file(bytes.substr(
                0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
        try_file(bytes.substr(0, bytes.size() - 1));
    }
    EXPECT_EQ(n_read_, 0);
}

TEST_F(Damage, FlippedBitsEndInAMessageOrInGrids) {
    std::mt19937 random(7);
    for (const char* name : {"small.vdb", "small_zip.vdb", "small_blosc.vdb"}) {
        const std::string good = bytes_of(test_file(name));
        for (int i = 0; i < 16 * rounds(); ++i) {
            std::string bytes = good;
            // Half of them near the beginning, where names, types and sizes are.
            const std::size_t range = i % 2 == 0 ? 1200 : bytes.size();
            bytes[random() % range] ^= static_cast<char>(1U << (random() % 8));
            try_file(bytes);
        }
    }
    EXPECT_GT(n_read_, 0);
    EXPECT_LT(n_read_, n_tried_);
}

TEST_F(Damage, AStreamThatWasDamagedIsNotTrusted) {
    const std::string good = good_stream();
    try_stream(good);
    ASSERT_EQ(n_read_, 1);
    std::mt19937 random(11);
    // The heads: the stream's, the grid's, the tree's, the root's; then the first node's masks and table.
    for (const std::size_t range :
         {std::size_t{150}, std::size_t{1000}, std::size_t{10000}, good.size()})
        for (int i = 0; i < 100 * rounds(); ++i) {
            std::string bytes = good;
            for (int flips = 0; flips < 4; ++flips)
                bytes[random() % range] ^= static_cast<char>(1U << (random() % 8));
            try_stream(bytes);
        }
    for (int i = 0; i < 20; ++i)
        try_stream(good.substr(0, random() % good.size()));
    EXPECT_GT(n_read_, 1);
    EXPECT_LT(n_read_, n_tried_ - 100);
}

}  // namespace

}  // namespace lightsieve
