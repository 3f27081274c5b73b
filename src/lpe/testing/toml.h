// Reads the part of TOML that our test corpora use, and refuses the rest.
//
// A file is comments, `[[name]]` headers and `key = value` lines. A value is a basic string ("..",
// with \" \\ \n \t and \uXXXX), an integer, true or false, an array (over several lines, with
// comments), or an inline table. Every `[[name]]` opens a new table in the list of that name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace lightsieve::lpe::testing {

struct TomlValue;
using TomlArray = std::vector<TomlValue>;
using TomlTable = std::map<std::string, TomlValue>;

struct TomlValue {
    std::variant<std::string, std::int64_t, bool, TomlArray, TomlTable> value;
};

/// One `[[name]]` with its keys.
struct TomlEntry {
    std::string name;
    std::size_t line = 0;  ///< of the header, for messages
    TomlTable table{};

    [[nodiscard]] bool has(const std::string& key) const { return table.contains(key); }
    /// The string of that key, or "".
    [[nodiscard]] std::string text(const std::string& key) const;
    /// The strings of the array of that key, or none.
    [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;
    /// The tables of the array of that key, or none.
    [[nodiscard]] std::vector<TomlTable> tables(const std::string& key) const;
};

/// All entries of a file, in order. Throws std::runtime_error with file and line on anything it
/// does not know.
[[nodiscard]] std::vector<TomlEntry> read_toml(const std::filesystem::path& file);

}  // namespace lightsieve::lpe::testing
