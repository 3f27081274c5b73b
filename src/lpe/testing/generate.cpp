#include "lpe/testing/generate.h"

#include <array>
#include <stdexcept>

#include "lpe/parse.h"

namespace lightsieve::lpe::testing {
namespace {

template <class Form>
Expr make(Form form) {
    return std::make_shared<const Node>(Node{std::move(form), {}});
}

std::size_t below(std::mt19937& random, std::size_t n) { return random() % n; }

std::string some_letters(std::mt19937& random, const std::string& from) {
    std::string out;
    for (std::size_t n = 1 + below(random, 2); n > 0; --n)
        out += from[below(random, from.size())];
    return out;
}

std::string some_label(std::mt19937& random) {
    static const std::array<std::string, 4> labels{"a", "b", "key", "coat"};
    return labels[below(random, labels.size())];
}

LetterTest some_letter_test(std::mt19937& random, const std::string& from, bool may_miss) {
    using Form = LetterTest::Form;
    switch (below(random, may_miss ? 6 : 5)) {
        case 0: return {Form::Any, ""};
        case 1: return {Form::OneOf, some_letters(random, from)};
        case 2: return {Form::NoneOf, some_letters(random, from)};
        case 5: return {Form::Missing, ""};
        default: return {Form::One, {from[below(random, from.size())]}};
    }
}

Expr some_angle(std::mt19937& random) {
    Angle angle{
        some_letter_test(random, "CRTVLOBARTV", false), some_letter_test(random, "DS", true), {}};
    for (std::size_t n = below(random, 3); n > 0; --n) {
        LabelTest test;
        // Without a lobe, a first "." would be read as the lobe.
        const bool may_be_any = angle.lobe.form != LetterTest::Form::Missing;
        test.form =
            static_cast<LabelTest::Form>(may_be_any ? below(random, 4) : 1 + below(random, 3));
        if (test.form != LabelTest::Form::Any) test.labels.push_back(some_label(random));
        if (test.form > LabelTest::Form::One) test.labels.push_back(some_label(random));
        angle.labels.push_back(std::move(test));
    }
    return make(std::move(angle));
}

Expr some_event(std::mt19937& random, bool may_be_brackets) {
    static const std::string letters = "CDSRTVLOBADSRTVL";
    switch (below(random, may_be_brackets ? 8 : 6)) {
        case 0: return make(Dot{});
        case 1: return make(Label{some_label(random)});
        case 2:
        case 3: return some_angle(random);
        case 6:
        case 7: {
            Brackets brackets{below(random, 2) == 0, {}};
            for (std::size_t n = 1 + below(random, 3); n > 0; --n)
                brackets.items.push_back(some_event(random, false));
            return make(std::move(brackets));
        }
        default: return make(Letter{letters[below(random, letters.size())]});
    }
}

/// Built-ins of which few paths are taken, most, and none of light.
Expr some_reference(std::mt19937& random) {
    static const std::array<std::string, 3> names{"$indirect", "$coat", "$diffuse_albedo"};
    return must_parse(names[below(random, names.size())]);
}

Expr some_expression(std::mt19937& random, std::size_t n_nodes, bool extended) {
    if (n_nodes <= 1)
        return extended && below(random, 12) == 0 ? some_reference(random)
                                                  : some_event(random, true);
    const std::size_t choice = below(random, extended ? 8 : 5);
    if (choice == 5) return make(Complement{some_expression(random, n_nodes - 1, extended)});
    if (choice < 2) {
        const auto min = static_cast<std::uint32_t>(below(random, 3));
        const auto max = static_cast<std::uint32_t>(min + below(random, 3));
        const bool unbounded = below(random, 2) == 0;
        return make(Repeat{some_expression(random, n_nodes - 1, extended), min,
                           unbounded ? Repeat::kUnbounded : max});
    }
    std::vector<Expr> parts;
    const std::size_t n_parts = 2 + below(random, 2);
    for (std::size_t i = 0; i < n_parts; ++i)
        parts.push_back(some_expression(random, (n_nodes - 1) / n_parts, extended));
    if (choice == 2) return make(Alternation{std::move(parts)});
    if (choice == 6) return make(Intersection{std::move(parts)});
    if (choice == 7) return make(Difference{std::move(parts)});
    return make(Sequence{std::move(parts)});
}

}  // namespace

Expr must_parse(const std::string& text) {
    Diagnostics diagnostics;
    Expr expr = parse(text, diagnostics);
    if (!expr) throw std::logic_error(diagnostics.render());
    return expr;
}

Path must_path(const std::string& text) {
    Diagnostics diagnostics;
    std::optional<Path> path = parse_path(text, diagnostics);
    if (!path) throw std::logic_error(diagnostics.render());
    return *std::move(path);
}

std::vector<Event> must_events(const std::string& text) {
    // Events of all kinds in one text are no path: read them one by one.
    std::vector<Event> events;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const bool terminal = std::string("LOBA").find(word[0]) != std::string::npos;
        events.push_back(must_path("C V " + word + (terminal ? "" : " L"))[2]);
        begin = end + 1;
    }
    return events;
}

std::vector<Expr> all_expressions(const std::vector<Expr>& leaves, std::size_t n_nodes,
                                  bool extended) {
    if (n_nodes == 1) return leaves;
    std::vector<Expr> out;
    for (const Expr& body : all_expressions(leaves, n_nodes - 1, extended)) {
        if (extended) out.push_back(make(Complement{body}));
        out.push_back(make(Repeat{body, 0, Repeat::kUnbounded}));
        out.push_back(make(Repeat{body, 1, Repeat::kUnbounded}));
        out.push_back(make(Repeat{body, 0, 1}));
        out.push_back(make(Repeat{body, 2, 2}));
    }
    for (std::size_t n_left = 1; n_left + 1 < n_nodes; ++n_left)
        for (const Expr& left : all_expressions(leaves, n_left, extended))
            for (const Expr& right : all_expressions(leaves, n_nodes - 1 - n_left, extended)) {
                if (extended) {
                    out.push_back(make(Intersection{{left, right}}));
                    out.push_back(make(Difference{{left, right}}));
                }
                out.push_back(make(Sequence{{left, right}}));
                out.push_back(make(Alternation{{left, right}}));
            }
    return out;
}

std::vector<Path> all_paths(std::span<const Event> events, std::size_t n_events) {
    std::vector<Path> out;
    std::vector<Path> open{{Event{}}};
    for (std::size_t length = 2; length <= n_events; ++length) {
        std::vector<Path> longer;
        for (const Path& begin : open)
            for (const Event& event : events) {
                Path path = begin;
                path.push_back(event);
                if (is_path(path))
                    out.push_back(std::move(path));
                else if (!is_terminal(event.kind))
                    longer.push_back(std::move(path));
            }
        open = std::move(longer);
    }
    return out;
}

Expr random_expression(std::mt19937& random, std::size_t n_nodes) {
    return some_expression(random, n_nodes, false);
}

Expr random_extended_expression(std::mt19937& random, std::size_t n_nodes) {
    return some_expression(random, n_nodes, true);
}

Expr random_light_expression(std::mt19937& random, std::size_t n_nodes) {
    return make(Sequence{{make(Letter{'C'}), random_expression(random, n_nodes),
                          make(Repeat{make(Dot{}), 0, Repeat::kUnbounded})}});
}

Path random_path(std::mt19937& random, std::span<const Event> events, std::size_t n_events) {
    while (true) {
        Path path{Event{}};
        while (path.size() < n_events && !is_terminal(path.back().kind))
            path.push_back(events[below(random, events.size())]);
        if (is_path(path)) return path;
    }
}

}  // namespace lightsieve::lpe::testing
