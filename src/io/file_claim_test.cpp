// Claims on files and files that survive being removed: two renders, and somebody who tidies up too early.
#include "io/file_claim.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lightsieve {
namespace {

namespace fs = std::filesystem;

class FileClaimTest : public ::testing::Test {
  protected:
    FileClaimTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~FileClaimTest() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string file(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] static bool is_free(const std::string& path) {
        try {
            const FileClaim claim(path);
            return true;
        } catch (const InputError& e) {
            EXPECT_EQ(e.errors()[0].code, Code::FileInUse);
            EXPECT_NE(e.errors()[0].message.find("process "), std::string::npos);
            return false;
        }
    }
    [[nodiscard]] std::size_t n_files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_ = fs::path(::testing::TempDir()) / "file_claims";
};

TEST_F(FileClaimTest, OneAtATimeAndNothingIsLeft) {
    {
        const FileClaim claim(file("a.exr"));
        EXPECT_FALSE(is_free(file("a.exr")));
        EXPECT_TRUE(is_free(file("b.exr")));
        fs::create_directory_symlink(folder_, folder_ / "link");
        EXPECT_FALSE(is_free(file("link/a.exr"))) << "another name of the same file";
        fs::remove(folder_ / "link");
    }
    EXPECT_TRUE(is_free(file("a.exr")));
    EXPECT_EQ(n_files(), 0U);
}

TEST_F(FileClaimTest, MovesWithItsHolder) {
    std::optional<FileClaim> first(file("a.exr"));
    {
        const FileClaim second(std::move(*first));
        first.reset();
        EXPECT_FALSE(is_free(file("a.exr")));
    }
    EXPECT_TRUE(is_free(file("a.exr")));
}

TEST_F(FileClaimTest, AKilledProcessHoldsNothing) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const ::pid_t child = ::fork();
    if (child == 0) {
        const FileClaim claim(file("a.exr"));
        [[maybe_unused]] const ssize_t n = ::write(ready[1], "x", 1);
        for (;;)
            ::pause();
    }
    char x = 0;
    ASSERT_EQ(::read(ready[0], &x, 1), 1);
    EXPECT_FALSE(is_free(file("a.exr")));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(n_files(), 1U) << "what it leaves is in nobody's way:";
    EXPECT_TRUE(is_free(file("a.exr")));
    EXPECT_EQ(n_files(), 0U);
    ::close(ready[0]);
    ::close(ready[1]);
}

TEST_F(FileClaimTest, WhereNothingCanBeWrittenNothingIsClaimed) {
    EXPECT_TRUE(is_free(file("missing/a.exr")));
}

TEST_F(FileClaimTest, WhatAKilledWriterLeftIsRemovedByTheNextOne) {
    for (const char* name :
         {".a.7-0.part.exr", ".a.7-0.part.png", ".a.b.7-0.part.exr", "a.part.exr"})
        std::ofstream(file(name)) << "left";
    const AtomicFile living(file("a.exr"));
    EXPECT_EQ(n_files(), 4U);
    EXPECT_FALSE(fs::exists(file(".a.7-0.part.exr")));
    const AtomicFile another(file("a.exr"));
    EXPECT_TRUE(fs::exists(living.temporary()));
    EXPECT_EQ(n_files(), 5U);
}

TEST_F(FileClaimTest, AFileThatIsRemovedWhileItIsWrittenAppearsAllTheSame) {
    const std::string data(3'000'000, 'x');
    {
        AtomicFile whole(file("sub.exr"));
        std::ofstream out(whole.temporary(), std::ios::binary);
        out << data << std::flush;
        fs::remove_all(folder_);
        out << "end" << std::flush;
        EXPECT_THROW(whole.commit(), InputError) << "the folder is its owner's affair";
        fs::create_directories(folder_);
        whole.commit();
    }
    std::ostringstream found;
    found << std::ifstream(file("sub.exr"), std::ios::binary).rdbuf();
    EXPECT_EQ(found.str(), data + "end");
    EXPECT_EQ(n_files(), 1U);
}

}  // namespace
}  // namespace lightsieve
