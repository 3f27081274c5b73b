#include "render/assets.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>

namespace lightsieve {
namespace {

bool is_name_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::optional<std::string> variable(std::string_view name) {
    const char* value = name.empty() ? nullptr : std::getenv(std::string(name).c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

std::string expand_variables(std::string_view path) {
    std::string out;
    std::size_t i = 0;
    if (path == "~" || path.substr(0, 2) == "~/") {
        if (const auto home = variable("HOME")) {
            out = *home;
            i = 1;
        }
    }
    while (i < path.size()) {
        std::size_t begin = std::string_view::npos, end = 0, after = 0;
        const auto bracketed = [&](std::size_t open, char close) {
            end = path.find(close, open + 1);
            if (end == std::string_view::npos) return;
            begin = open + 1;
            after = end + 1;
        };
        if (path[i] == '[') bracketed(i, ']');
        if (path[i] == '$' && i + 1 < path.size() && path[i + 1] == '{') bracketed(i + 1, '}');
        if (path[i] == '$' && begin == std::string_view::npos) {
            begin = end = i + 1;
            while (end < path.size() && is_name_char(path[end]))
                ++end;
            after = end;
        }
        const auto value = begin == std::string_view::npos
                               ? std::nullopt
                               : variable(path.substr(begin, end - begin));
        if (value) {
            out += *value;
            i = after;
        } else {
            out += path[i++];
        }
    }
    return out;
}

void AssetFinder::add_search_path(std::string_view folders) {
    const std::string expanded = expand_variables(folders);
    std::string folder;
    const auto flush = [&] {
        if (!folder.empty()) folders_.push_back(folder);
        folder.clear();
    };
    for (std::size_t i = 0; i < expanded.size(); ++i) {
        const char c = expanded[i];
        // "C:/maps": the colon belongs to the drive.
        const bool drive = c == ':' && folder.size() == 1 &&
                           std::isalpha(static_cast<unsigned char>(folder[0])) != 0 &&
                           i + 1 < expanded.size() &&
                           (expanded[i + 1] == '/' || expanded[i + 1] == '\\');
        if (c == ';' || (c == ':' && !drive)) {
            flush();
        } else {
            folder += c;
        }
    }
    flush();
}

std::optional<std::string> AssetFinder::find(std::string_view name) const {
    std::optional<std::string> file = look_for(name);
    if (file) found_.insert(*file);
    return file;
}

std::optional<std::string> AssetFinder::look_for(std::string_view name) const {
    const std::filesystem::path path(expand_variables(name));
    if (path.empty()) return std::nullopt;
    if (path.is_absolute()) return is_file(path) ? std::optional(path.string()) : std::nullopt;
    for (const std::string& folder : folders_)
        if (is_file(std::filesystem::path(folder) / path))
            return (std::filesystem::path(folder) / path).string();
    return is_file(path) ? std::optional(path.string()) : std::nullopt;
}

}  // namespace lightsieve
