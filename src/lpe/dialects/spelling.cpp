#include "lpe/dialects/spelling.h"

#include <algorithm>
#include <utility>

namespace lightsieve::lpe::dialects {
namespace {

std::string in_brackets(const std::vector<std::string>& names, const std::string& prefix) {
    std::string all = prefix;
    for (const std::string& name : names)
        all += name;
    return names.size() == 1 && prefix.empty() ? all : "[" + all + "]";
}

/// A test of the label at one place, or of any label where labels are a set.
HitTest label_test(const std::vector<std::string>& names, bool negated, std::size_t place,
                   const LabelPlaces& places) {
    const auto is = places.is;
    const auto is_named = [names, is](const std::string& label) {
        return std::ranges::any_of(names, [&](const std::string& name) {
            return is == nullptr ? label == name : is(label, name);
        });
    };
    if (places.n == 0)
        return [is_named, negated](const Hit& hit) {
            return std::ranges::any_of(hit.labels, is_named) != negated;
        };
    const bool takes_none = places.negation_takes_none;
    return [is_named, negated, place, takes_none](const Hit& hit) {
        const bool there = place < hit.labels.size() && !hit.labels[place].empty();
        if (!there) return negated && takes_none;
        return is_named(hit.labels[place]) != negated;
    };
}

HitTest both(HitTest a, HitTest b) {
    return [a = std::move(a), b = std::move(b)](const Hit& hit) { return a(hit) && b(hit); };
}

/// The tests of one place, `.` apart.
std::vector<LabelText> place_texts(const LabelSets& sets, std::size_t place,
                                   const LabelPlaces& places) {
    std::vector<LabelText> out;
    for (const bool negated : {false, true})
        for (const std::vector<std::string>& set : sets) {
            std::vector<std::string> quoted;
            for (const std::string& label : set)
                quoted.push_back("'" + label + "'");
            out.push_back({in_brackets(quoted, negated ? "^" : ""),
                           label_test(set, negated, place, places)});
        }
    return out;
}

}  // namespace

PlaceText event_place(const std::string& letters) {
    std::vector<std::string> names;
    for (const char letter : letters)
        names.emplace_back(1, letter);
    return {in_brackets(names, ""),
            [letters](const Hit& hit) { return letters.find(hit.event) != std::string::npos; }};
}

PlaceText lobe_place(const std::vector<std::string>& lobes) {
    return {in_brackets(lobes, ""), [lobes](const Hit& hit) {
                return std::ranges::any_of(lobes, [&](const std::string& lobe) {
                    return lobe.size() == 1 ? !hit.lobe.empty() && hit.lobe[0] == lobe[0]
                                            : hit.lobe == lobe;
                });
            }};
}

std::vector<LetterText> tuples_of(const std::vector<PlaceText>& events,
                                  const std::vector<PlaceText>& lobes) {
    std::vector<LetterText> out;
    for (const PlaceText& event : events)
        for (const PlaceText& lobe : lobes) {
            std::string inside = event.text + lobe.text;
            out.push_back({"<" + inside + ">", inside, both(event.test, lobe.test)});
        }
    return out;
}

LetterText bare_event(char letter) {
    return {std::string{letter}, std::string{letter} + ".",
            [letter](const Hit& hit) { return hit.event == letter; }};
}

LetterText bare_lobe(const std::string& lobe, HitTest any_event) {
    PlaceText place = lobe_place({lobe});
    return {lobe, "." + lobe, both(std::move(any_event), std::move(place.test))};
}

std::vector<LabelText> label_texts(const LabelSets& sets, const LabelPlaces& places) {
    std::vector<LabelText> out{{"", [](const Hit&) { return true; }}};
    const std::size_t n_places = std::max<std::size_t>(places.n, 2);
    const std::vector<LabelText> first = place_texts(sets, 0, places);
    out.insert(out.end(), first.begin(), first.end());
    if (places.n == 1 || n_places < 2) return out;
    const std::vector<LabelText> second = place_texts(sets, 1, places);
    if (places.n > 1)
        for (const LabelText& b : second)
            out.push_back({"." + b.text, b.test});
    for (const LabelText& a : first)
        for (const LabelText& b : second)
            out.push_back({a.text + b.text, both(a.test, b.test)});
    return out;
}

}  // namespace lightsieve::lpe::dialects
