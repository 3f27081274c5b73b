#include "core/name.h"

#include <mutex>
#include <unordered_set>

namespace lightsieve {

Name::Name(std::string_view text) {
    if (text.empty()) return;
    static std::mutex mutex;
    static auto* names = new std::unordered_set<std::string>;  // never destroyed: names outlive every static object
    const std::lock_guard lock(mutex);
    text_ = &*names->emplace(text).first;
}

}  // namespace lightsieve
