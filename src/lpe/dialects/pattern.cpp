#include "lpe/dialects/pattern.h"

#include <algorithm>
#include <utility>

namespace lightsieve::lpe::dialects {
namespace {

PatternPtr make(Pattern pattern) { return std::make_shared<Pattern>(std::move(pattern)); }

/// The parts with nested nodes of the same form taken apart.
std::vector<PatternPtr> flattened(Pattern::Form form, std::vector<PatternPtr> parts) {
    std::vector<PatternPtr> out;
    for (PatternPtr& part : parts)
        if (part->form == form)
            out.insert(out.end(), part->parts.begin(), part->parts.end());
        else
            out.push_back(std::move(part));
    return out;
}

}  // namespace

PatternPtr make_nothing() { return make({}); }
PatternPtr make_empty() { return make({.form = Pattern::Form::Empty}); }
PatternPtr make_event(HitTest test) {
    return make({.form = Pattern::Form::Event, .test = std::move(test)});
}
PatternPtr make_events(SymbolSet events, std::string text) {
    if (events.empty()) return make_nothing();
    return make(
        {.form = Pattern::Form::Event, .events = std::move(events), .text = std::move(text)});
}

PatternPtr make_sequence(std::vector<PatternPtr> parts) {
    parts = flattened(Pattern::Form::Sequence, std::move(parts));
    const auto is = [](Pattern::Form form) {
        return [form](const PatternPtr& part) { return part->form == form; };
    };
    if (std::ranges::any_of(parts, is(Pattern::Form::Nothing))) return make_nothing();
    std::erase_if(parts, is(Pattern::Form::Empty));
    if (parts.empty()) return make_empty();
    if (parts.size() == 1) return parts[0];
    return make({.form = Pattern::Form::Sequence, .parts = std::move(parts)});
}

PatternPtr make_alternation(std::vector<PatternPtr> parts) {
    parts = flattened(Pattern::Form::Alternation, std::move(parts));
    bool optional = false;
    std::erase_if(parts, [&](const PatternPtr& part) {
        optional = optional || part->form == Pattern::Form::Empty;
        return part->form == Pattern::Form::Nothing || part->form == Pattern::Form::Empty;
    });
    if (parts.empty()) return optional ? make_empty() : make_nothing();
    PatternPtr all = parts.size() == 1
                         ? parts[0]
                         : make({.form = Pattern::Form::Alternation, .parts = std::move(parts)});
    return optional && !is_nullable(*all) ? make_repeat(std::move(all), 0, 1) : all;
}

PatternPtr make_repeat(PatternPtr body, std::uint32_t min, std::uint32_t max) {
    constexpr std::uint32_t kUnbounded = Pattern::kUnbounded;
    if (max == 0 || body->form == Pattern::Form::Empty) return make_empty();
    if (body->form == Pattern::Form::Nothing) return min == 0 ? make_empty() : make_nothing();
    if (min == 1 && max == 1) return body;
    if (body->form == Pattern::Form::Repeat && max == kUnbounded && min <= 1 && body->min <= 1) {
        // (x?)*, (x+)*, (x{0,n})+ are x*; (x+)+ and (x{1,n})+ are x+.
        min = std::min(min, body->min);
        body = body->parts[0];
    }
    return make(
        {.form = Pattern::Form::Repeat, .parts = {std::move(body)}, .min = min, .max = max});
}

PatternPtr make_boolean(Pattern::Form form, std::vector<PatternPtr> parts) {
    return make({.form = form, .parts = std::move(parts)});
}

bool is_nullable(const Pattern& pattern) {
    const auto nullable = [](const PatternPtr& part) { return is_nullable(*part); };
    switch (pattern.form) {
        case Pattern::Form::Nothing:
        case Pattern::Form::Event:
        case Pattern::Form::Complement: return false;
        case Pattern::Form::Empty: return true;
        case Pattern::Form::Repeat: return pattern.min == 0 || nullable(pattern.parts[0]);
        case Pattern::Form::Sequence:
        case Pattern::Form::Intersection: return std::ranges::all_of(pattern.parts, nullable);
        case Pattern::Form::Alternation: return std::ranges::any_of(pattern.parts, nullable);
        case Pattern::Form::Difference:
            return nullable(pattern.parts[0]) &&
                   std::none_of(pattern.parts.begin() + 1, pattern.parts.end(), nullable);
    }
    return false;
}

PatternPtr rebuild(const Pattern& pattern,
                   const std::function<PatternPtr(const Pattern&)>& replace) {
    if (pattern.form == Pattern::Form::Event) return replace(pattern);
    std::vector<PatternPtr> parts;
    for (const PatternPtr& part : pattern.parts)
        parts.push_back(rebuild(*part, replace));
    switch (pattern.form) {
        case Pattern::Form::Sequence: return make_sequence(std::move(parts));
        case Pattern::Form::Alternation: return make_alternation(std::move(parts));
        case Pattern::Form::Repeat:
            return make_repeat(std::move(parts[0]), pattern.min, pattern.max);
        default: return make_boolean(pattern.form, std::move(parts));
    }
}

std::size_t count_nodes(const Pattern& pattern) {
    std::size_t n = 1;
    for (const PatternPtr& part : pattern.parts)
        n += count_nodes(*part);
    return n;
}

}  // namespace lightsieve::lpe::dialects
