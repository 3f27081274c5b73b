#include "lpe/predicate.h"

#include <algorithm>

#include "core/error.h"

namespace lightsieve::lpe {
namespace {

/// Neither the camera nor a probe: what tests other than literal letters can take.
bool is_ordinary(const Event& event) {
    return event.kind != EventKind::Camera && event.kind != EventKind::Albedo;
}

bool scatters_at_surface(const Event& event) {
    return event.kind == EventKind::Reflection || event.kind == EventKind::Transmission;
}

/// A letter that stands for an event on its own.
bool letter_takes(char letter, const Event& event) {
    switch (letter) {
        case 'C': return event.kind == EventKind::Camera;
        case 'D': return scatters_at_surface(event) && event.lobe == EventLobe::Diffuse;
        case 'S': return scatters_at_surface(event) && event.lobe == EventLobe::Specular;
        case 'R': return event.kind == EventKind::Reflection;
        case 'T': return event.kind == EventKind::Transmission;
        case 'V': return event.kind == EventKind::Volume;
        case 'L': return event.kind == EventKind::Light;
        case 'O': return event.kind == EventKind::Object;
        case 'B': return event.kind == EventKind::Background;
        case 'A': return event.kind == EventKind::Albedo;
        default: return false;
    }
}

bool lobe_is(char letter, const Event& event) {
    return event.lobe == (letter == 'D' ? EventLobe::Diffuse : EventLobe::Specular);
}

bool kind_holds(const LetterTest& test, const Event& event) {
    const auto is_kind = [&](char letter) { return letter_takes(letter, event); };
    switch (test.form) {
        case LetterTest::Form::Missing:
        case LetterTest::Form::Any: return is_ordinary(event);
        case LetterTest::Form::One:
        case LetterTest::Form::OneOf:
            return std::any_of(test.letters.begin(), test.letters.end(), is_kind);
        case LetterTest::Form::NoneOf:
            return is_ordinary(event) &&
                   std::none_of(test.letters.begin(), test.letters.end(), is_kind);
    }
    return false;
}

bool lobe_holds(const LetterTest& test, const Event& event) {
    const auto is_lobe = [&](char letter) { return lobe_is(letter, event); };
    switch (test.form) {
        case LetterTest::Form::Missing:
        case LetterTest::Form::Any: return true;
        case LetterTest::Form::One:
        case LetterTest::Form::OneOf:
            return std::any_of(test.letters.begin(), test.letters.end(), is_lobe);
        case LetterTest::Form::NoneOf:
            return std::none_of(test.letters.begin(), test.letters.end(), is_lobe);
    }
    return false;
}

bool label_holds(const LabelTest& test, const Event& event) {
    const auto is_carried = [&](const std::string& label) { return carries(event, label); };
    switch (test.form) {
        case LabelTest::Form::Any: return true;
        case LabelTest::Form::One:
        case LabelTest::Form::OneOf:
            return std::any_of(test.labels.begin(), test.labels.end(), is_carried);
        case LabelTest::Form::NoneOf:
            return std::none_of(test.labels.begin(), test.labels.end(), is_carried);
    }
    return false;
}

struct Takes {
    const Event& event;

    bool operator()(const Letter& letter) const { return letter_takes(letter.letter, event); }
    bool operator()(const Dot&) const { return is_ordinary(event); }
    bool operator()(const Label& label) const {
        return is_ordinary(event) && carries(event, label.label);
    }
    bool operator()(const Angle& angle) const {
        const auto holds = [&](const LabelTest& test) { return label_holds(test, event); };
        return kind_holds(angle.kind, event) && lobe_holds(angle.lobe, event) &&
               std::all_of(angle.labels.begin(), angle.labels.end(), holds);
    }
    bool operator()(const Brackets& brackets) const {
        const auto item_takes = [&](const Expr& item) { return takes(*item, event); };
        if (!brackets.negated)
            return std::any_of(brackets.items.begin(), brackets.items.end(), item_takes);
        return is_ordinary(event) &&
               std::none_of(brackets.items.begin(), brackets.items.end(), item_takes);
    }
    template <class Composite>
    bool operator()(const Composite&) const {
        LIGHTSIEVE_ASSERT(false, "not a test of a single event");
        return false;
    }
};

}  // namespace

bool may_be_kind(const LetterTest& test, EventKind kind) {
    return kind_holds(test, {kind, EventLobe::None, {}});
}

bool carries(const Event& event, const std::string& label) {
    return std::find(event.labels.begin(), event.labels.end(), label) != event.labels.end();
}

bool takes(const Node& test, const Event& event) { return std::visit(Takes{event}, test.form); }

}  // namespace lightsieve::lpe
