// A folder of its own for each test, removed afterwards.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace lightsieve {

class FolderTest : public testing::Test {
  protected:
    FolderTest() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("lightsieve-" + std::to_string(::getpid()) + "-" + info->test_suite_name() +
                   "-" + info->name());
        std::filesystem::create_directories(folder_);
    }
    ~FolderTest() override {
        std::error_code ec;
        std::filesystem::remove_all(folder_, ec);
    }
    [[nodiscard]] std::string in_folder(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] std::size_t n_files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                      std::filesystem::directory_iterator()));
    }
    [[nodiscard]] static std::string bytes_of(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write_bytes(const std::string& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    /// A program that takes another one's place: a shell script.
    [[nodiscard]] std::string script(const std::string& body) const {
        const std::string path = in_folder("reader");
        write_bytes(path, "#!/bin/sh\n" + body + "\n");
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }

  private:
    std::filesystem::path folder_;
};

}  // namespace lightsieve
