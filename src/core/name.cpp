#include "core/name.h"

#include <mutex>
#include <unordered_set>

namespace lightsieve {
namespace {

/// Lets a set of strings be searched without making a string: most names are known already.
struct TextHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const {
        return std::hash<std::string_view>{}(text);
    }
};
using NameSet = std::unordered_set<std::string, TextHash, std::equal_to<>>;

}  // namespace

Name::Name(std::string_view text) {
    if (text.empty()) return;
    static std::mutex mutex;
    static auto* names = new NameSet;  // never destroyed: names outlive every static object
    const std::lock_guard lock(mutex);
    const auto found = names->find(text);
    text_ = found != names->end() ? &*found : &*names->emplace(text).first;
}

}  // namespace lightsieve
