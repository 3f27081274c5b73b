// Where files are that a scene names: environment variables, search paths, the scene's own folder.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lightsieve {

/// Replaces `[NAME]`, `${NAME}` and `$NAME` by environment variables, and a leading `~` by the home folder.
/// Unknown variables are left as written.
[[nodiscard]] std::string expand_variables(std::string_view path);

/// Looks for files in a list of folders.
class AssetFinder {
  public:
    /// Adds folders separated by `;`, or by `:` where that is no part of a drive's name; variables are expanded.
    void add_search_path(std::string_view folders);
    void add_folder(std::string folder) { folders_.push_back(std::move(folder)); }
    /// The first existing file: the name itself if absolute, else in each folder, else relative to the working folder.
    [[nodiscard]] std::optional<std::string> find(std::string_view name) const;
    /// All that were found, sorted.
    [[nodiscard]] const std::set<std::string>& found() const { return found_; }

  private:
    [[nodiscard]] std::optional<std::string> look_for(std::string_view name) const;
    std::vector<std::string> folders_;
    mutable std::set<std::string> found_;
};

}  // namespace lightsieve
