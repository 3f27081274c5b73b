#include "lpe/testing/naive_matcher.h"

#include <cstddef>
#include <set>
#include <string>

namespace lightsieve::lpe::testing {
namespace {

/// An event as the language spells it.
struct Spelling {
    char kind;  ///< C R T V L O B A
    char lobe;  ///< D, S or '-'
};

Spelling spell(const Event& event) {
    const char kind = std::string("CRTVLOBA")[static_cast<std::size_t>(event.kind)];
    const char lobe = std::string("-DS")[static_cast<std::size_t>(event.lobe)];
    return {kind, lobe};
}

bool is_in(char c, const std::string& letters) { return letters.find(c) != std::string::npos; }

bool has_label(const Event& event, const std::string& wanted) {
    for (const std::string& label : event.labels)
        if (label == wanted) return true;
    return false;
}

bool has_one_of(const Event& event, const std::vector<std::string>& labels) {
    for (const std::string& label : labels)
        if (has_label(event, label)) return true;
    return false;
}

bool is_camera_or_probe(const Event& event) { return is_in(spell(event).kind, "CA"); }

bool single_event_matches(const Node& test, const Event& event);

bool angle_matches(const Angle& angle, const Event& event) {
    const Spelling spelling = spell(event);
    using Letters = LetterTest::Form;
    switch (angle.kind.form) {
        case Letters::One:
        case Letters::OneOf:
            if (!is_in(spelling.kind, angle.kind.letters)) return false;
            break;
        case Letters::NoneOf:
            if (is_in(spelling.kind, angle.kind.letters + "CA")) return false;
            break;
        case Letters::Any:
        case Letters::Missing:
            if (is_in(spelling.kind, "CA")) return false;
            break;
    }
    const bool lobe_named = is_in(spelling.lobe, angle.lobe.letters);
    if ((angle.lobe.form == Letters::One || angle.lobe.form == Letters::OneOf) && !lobe_named)
        return false;
    if (angle.lobe.form == Letters::NoneOf && lobe_named) return false;
    for (const LabelTest& labels : angle.labels) {
        if (labels.form == LabelTest::Form::Any) continue;
        const bool wanted = labels.form != LabelTest::Form::NoneOf;
        if (has_one_of(event, labels.labels) != wanted) return false;
    }
    return true;
}

bool single_event_matches(const Node& test, const Event& event) {
    const Spelling spelling = spell(event);
    if (const auto* letter = std::get_if<Letter>(&test.form)) {
        const bool is_lobe = is_in(letter->letter, "DS");
        return is_lobe ? spelling.lobe == letter->letter : spelling.kind == letter->letter;
    }
    if (std::holds_alternative<Dot>(test.form)) return !is_camera_or_probe(event);
    if (const auto* label = std::get_if<Label>(&test.form))
        return !is_camera_or_probe(event) && has_label(event, label->label);
    if (const auto* angle = std::get_if<Angle>(&test.form)) return angle_matches(*angle, event);
    const auto& brackets = std::get<Brackets>(test.form);
    bool one = false;
    for (const Expr& item : brackets.items)
        one = one || single_event_matches(*item, event);
    return brackets.negated ? !is_camera_or_probe(event) && !one : one;
}

std::set<std::size_t> common(const std::set<std::size_t>& a, const std::set<std::size_t>& b) {
    std::set<std::size_t> out;
    for (const std::size_t position : a)
        if (b.contains(position)) out.insert(position);
    return out;
}

/// Every position at which a match of `node` that begins at `begin` can end.
std::set<std::size_t> ends(const Node& node, std::span<const Event> path, std::size_t begin) {
    std::set<std::size_t> out;
    if (const auto* sequence = std::get_if<Sequence>(&node.form)) {
        out.insert(begin);
        for (const Expr& part : sequence->parts) {
            std::set<std::size_t> next;
            for (const std::size_t at : out)
                next.merge(ends(*part, path, at));
            out = next;
        }
    } else if (const auto* alternation = std::get_if<Alternation>(&node.form)) {
        for (const Expr& part : alternation->parts)
            out.merge(ends(*part, path, begin));
    } else if (const auto* repeat = std::get_if<Repeat>(&node.form)) {
        std::set<std::size_t> now{begin};
        // More rounds than the minimum and the path's length can only be empty ones.
        const std::size_t most = std::size_t{repeat->min} + path.size() + 1;
        for (std::size_t round = 0; round <= repeat->max && round <= most; ++round) {
            if (round >= repeat->min) out.insert(now.begin(), now.end());
            std::set<std::size_t> next;
            for (const std::size_t at : now)
                next.merge(ends(*repeat->body, path, at));
            now = next;
        }
    } else if (const auto* all = std::get_if<Intersection>(&node.form)) {
        out = ends(*all->parts[0], path, begin);
        for (const Expr& part : all->parts)
            out = common(out, ends(*part, path, begin));
    } else if (const auto* difference = std::get_if<Difference>(&node.form)) {
        out = ends(*difference->parts[0], path, begin);
        for (std::size_t i = 1; i < difference->parts.size(); ++i)
            for (const std::size_t end : ends(*difference->parts[i], path, begin))
                out.erase(end);
    } else if (const auto* complement = std::get_if<Complement>(&node.form)) {
        // The camera, then anything but a second camera or a probe.
        if (begin < path.size() && spell(path[begin]).kind == 'C') out.insert(begin + 1);
        for (std::size_t end = begin + 1; !out.empty() && end < path.size(); ++end) {
            if (is_camera_or_probe(path[end])) break;
            out.insert(end + 1);
        }
        for (const std::size_t end : ends(*complement->body, path, begin))
            out.erase(end);
    } else if (const auto* reference = std::get_if<Reference>(&node.form)) {
        if (reference->body) out = ends(*reference->body, path, begin);
    } else if (begin < path.size() && single_event_matches(node, path[begin])) {
        out.insert(begin + 1);
    }
    return out;
}

bool is_light_path(std::span<const Event> path) {
    if (path.size() < 2 || spell(path.front()).kind != 'C') return false;
    if (!is_in(spell(path.back()).kind, "LOBA")) return false;
    for (const Event& event : path.subspan(1, path.size() - 2))
        if (!is_in(spell(event).kind, "RTV")) return false;
    return path.size() > 2 || spell(path.back()).kind != 'A';
}

}  // namespace

bool naive_match(const Expr& expr, std::span<const Event> path) {
    return expr && is_light_path(path) && ends(*expr, path, 0).contains(path.size());
}

}  // namespace lightsieve::lpe::testing
