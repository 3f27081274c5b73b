#include "lpe/alphabet.h"

#include <array>

#include "lpe/predicate.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

/// Events of different categories are never in one class, even if no test tells them apart.
enum Category : std::uint32_t { kCameraEvent, kScattering, kLight, kProbe, kCategories };

Category category_of(EventKind kind) {
    if (kind == EventKind::Camera) return kCameraEvent;
    if (kind == EventKind::Albedo) return kProbe;
    return is_terminal(kind) ? kLight : kScattering;
}

void set_bit(std::vector<std::uint32_t>& words, std::size_t bit) {
    words[bit / 32] |= std::uint32_t{1} << (bit % 32);
}

}  // namespace

Alphabet::Alphabet(std::span<const Expr> exprs, std::span<const Event> events) {
    // Equal tests have equal text, wherever they stand.
    std::vector<const Node*> tests;
    std::vector<std::string> texts;
    const auto collect = [&](const Node& test) {
        std::string text = print(test);
        if (!set_of_test_.emplace(text, 0).second) return;
        tests.push_back(&test);
        texts.push_back(std::move(text));
    };
    for (const Expr& expr : exprs)
        if (expr) for_each_event_test(*expr, collect);

    // An event's signature: its category, then one bit for each test's answer.
    const Event camera{};
    const auto event_at = [&](std::size_t i) -> const Event& {
        return i == 0 ? camera : events[i - 1];
    };
    Interner signatures;
    std::vector<std::uint32_t> signature_of(events.size() + 1);
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < signature_of.size(); ++i) {
        words.assign(1 + (tests.size() + 31) / 32, 0);
        words[0] = category_of(event_at(i).kind);
        for (std::size_t t = 0; t < tests.size(); ++t)
            if (takes(*tests[t], event_at(i))) set_bit(words, 32 + t);
        signature_of[i] = signatures.intern(words);
    }

    // Number the signatures by category, within it by first appearance.
    std::vector<EventClass> class_of_signature(signatures.size());
    std::array<EventClass, kCategories + 1> first_class{};
    for (std::uint32_t category = 0; category < kCategories; ++category) {
        EventClass next = first_class[category];
        for (std::uint32_t s = 0; s < signatures.size(); ++s)
            if (signatures[s][0] == category) class_of_signature[s] = next++;
        first_class[category + 1] = next;
    }
    n_scatter_ = first_class[kLight] - first_class[kScattering];
    examples_.resize(signatures.size());
    for (std::size_t i = signature_of.size(); i-- > 0;)
        examples_[class_of_signature[signature_of[i]]] = event_at(i);
    class_of_event_.reserve(events.size());
    for (std::size_t i = 1; i < signature_of.size(); ++i)
        class_of_event_.push_back(class_of_signature[signature_of[i]]);

    // What each test takes, as a set of classes.
    for (std::size_t t = 0; t < tests.size(); ++t) {
        words.assign(n_words(), 0);
        for (EventClass c = 0; c < n_classes(); ++c)
            if (takes(*tests[t], examples_[c])) set_bit(words, c);
        set_of_test_[texts[t]] = sets_.intern(words);
    }
}

std::span<const std::uint32_t> Alphabet::taken_by(const Node& test) const {
    return sets_[set_of_test_.at(print(test))];
}

}  // namespace lightsieve::lpe
