// Interned names: one pointer per distinct text, alive until the program ends.
//
// Node and parameter names, labels and file names repeat thousands of times in a scene; interned they compare as
// pointers and stay trivially copyable, so that a node's parameter block can be copied byte by byte.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace lightsieve {

class Name {
  public:
    constexpr Name() = default;
    /// Interns `text`. Thread safe. Cost: one hash look-up.
    Name(std::string_view text);  // NOLINT(google-explicit-constructor): a literal reads as a name
    Name(const char* text) : Name(std::string_view(text)) {}
    Name(const std::string& text) : Name(std::string_view(text)) {}

    [[nodiscard]] std::string_view view() const {
        return text_ == nullptr ? std::string_view{} : std::string_view(*text_);
    }
    [[nodiscard]] std::string str() const { return std::string(view()); }
    [[nodiscard]] bool empty() const { return view().empty(); }
    [[nodiscard]] const void* id() const { return text_; }
    friend bool operator==(Name a, Name b) { return a.text_ == b.text_; }
    /// By text, so that orders do not depend on addresses.
    friend bool operator<(Name a, Name b) { return a.view() < b.view(); }

  private:
    const std::string* text_ = nullptr;  ///< null is the empty name
};

}  // namespace lightsieve

template <>
struct std::hash<lightsieve::Name> {
    std::size_t operator()(lightsieve::Name n) const noexcept {
        return std::hash<const void*>{}(n.id());
    }
};
