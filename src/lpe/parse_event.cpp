#include "lpe/parse_event.h"

#include <utility>

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kKindLetters = "CRTVLOBA";
constexpr std::string_view kLobeLetters = "DS";
constexpr std::string_view kQuantifiers = "*+?{";

template <class Form>
Expr make(const Cursor& in, Form form, std::size_t begin) {
    return std::make_shared<const Node>(Node{std::move(form), in.span(begin, in.position())});
}

/// Position of the bracket that closes the one at the cursor, outside labels; npos if there is
/// none.
std::size_t find_close(const Cursor& in, char open, char close) {
    const std::string_view text = in.text();
    std::size_t depth = 0;
    for (std::size_t i = in.position(); i < text.size(); ++i) {
        if (text[i] == '\'') {
            i = text.find('\'', i + 1);
            if (i == std::string_view::npos) return i;
        } else if (text[i] == open) {
            // `<` never nests: a second one means that the first was left open.
            if (open == '<' && depth > 0) return std::string_view::npos;
            ++depth;
        } else if (text[i] == close && --depth == 0) {
            return i;
        }
    }
    return std::string_view::npos;
}

/// Reports what cannot stand between brackets: quantifiers and `|` get a hint of their own.
void reject_inside(Cursor& in, char close) {
    const std::size_t begin = in.position();
    const std::string where = close == '>' ? "<..>" : "[..]";
    if (in.peek_is_one_of(kQuantifiers)) {
        in.take();
        in.error(Code::LpeQuantifier, "a quantifier inside " + where, begin, begin + 1,
                 "put it after the " + in_quotes({&close, 1}));
    } else if (in.peek_is_one_of("&-!")) {
        const std::string c{in.take()};
        in.error(Code::LpeOperator, in_quotes(c) + " inside " + where, begin, begin + 1,
                 "single events only; outside of " + where + " write " +
                     (c == "!" ? "!(a)" : "(a " + c + " b)"));
    } else if (in.peek_is_one_of("|()")) {
        const char c = in.take();
        in.error(Code::LpeCharacter, in_quotes({&c, 1}) + " inside " + where, begin, begin + 1,
                 close == '>' ? "one of several kinds is <[RT]D>"
                              : "single events only; for longer alternatives write ((..)|(..))");
    } else {
        in.reject_character();
    }
}

/// A `>` inside `[..]`: the bracket was left open.
bool is_left_open(Cursor& in, std::size_t begin) {
    if (in.peek() != '>') return false;
    in.error(Code::LpeUnclosed, "\"[\" is never closed", begin, begin + 1,
             "close it before the \">\"");
    return true;
}

/// "[" ["^"] letter { letter } "]", the cursor being at "[". `what` names the letters in messages.
bool parse_letter_set(Cursor& in, std::string_view allowed, const std::string& what,
                      LetterTest& test) {
    const std::size_t begin = in.position();
    in.take();
    in.skip_blanks();
    test.form = in.take_if('^') ? LetterTest::Form::NoneOf : LetterTest::Form::OneOf;
    for (in.skip_blanks(); !in.take_if(']'); in.skip_blanks()) {
        if (is_left_open(in, begin)) return false;
        if (!in.peek_is_one_of(allowed)) {
            if (!in.peek_is_one_of(kEventLetters)) return reject_inside(in, ']'), false;
            const char c = in.take();
            in.error(Code::LpeEvent, in_quotes({&c, 1}) + " is no " + what, in.position() - 1,
                     in.position(), "a " + what + " is one of " + std::string(allowed));
            return false;
        }
        test.letters += in.take();
    }
    if (!test.letters.empty()) return true;
    in.error(Code::LpeEmpty, "an empty choice", begin, in.position(),
             "any " + what + " is written .");
    return false;
}

/// kind = kindletter | "." | letter set
bool parse_kind(Cursor& in, LetterTest& kind) {
    in.skip_blanks();
    const std::size_t begin = in.position();
    if (in.take_if('.')) {
        kind.form = LetterTest::Form::Any;
        return true;
    }
    if (in.peek_is_one_of(kKindLetters)) {
        kind = {LetterTest::Form::One, {in.take()}};
        return true;
    }
    switch (in.peek()) {
        case '[': return parse_letter_set(in, kKindLetters, "kind", kind);
        case '>':
            in.error(Code::LpeEmpty, "nothing between \"<\" and \">\"", begin - 1, begin + 1,
                     "a kind, then maybe a lobe and labels: <RD>");
            return false;
        case 'D':
        case 'S': {
            const std::string lobe{in.peek()};
            in.error(Code::LpeEvent, in_quotes(lobe) + " is a lobe, not a kind", begin, begin + 1,
                     "the kind comes first: <R" + lobe + ">, <T" + lobe + "> or <." + lobe + ">");
            return false;
        }
        case '\'':
            in.error(Code::LpeLabel, "a label or light group before the kind", begin, begin + 1,
                     "it comes last: <L.'key'>");
            return false;
        default: return reject_inside(in, '>'), false;
    }
}

/// [ lobe ]: "D" | "S" | "." | letter set. Whatever else is next is left to the labels.
bool parse_lobe(Cursor& in, LetterTest& lobe) {
    in.skip_blanks();
    const std::size_t begin = in.position();
    if (in.take_if('.')) {
        lobe.form = LetterTest::Form::Any;
        return true;
    }
    if (in.peek_is_one_of(kLobeLetters)) {
        lobe = {LetterTest::Form::One, {in.take()}};
        return true;
    }
    if (in.peek() == '[') {
        in.take();
        in.skip_blanks();
        in.take_if('^');
        in.skip_blanks();
        const bool is_label = in.peek() == '\'';
        in.move_to(begin);
        return is_label || parse_letter_set(in, kLobeLetters, "lobe", lobe);
    }
    if (in.peek_is_one_of(kKindLetters)) {
        const char c = in.peek();
        in.error(Code::LpeEvent, in_quotes({&c, 1}) + " is a kind, not a lobe", begin, begin + 1,
                 "lobes are D and S; one of several kinds is <[RT]D>");
        return false;
    }
    return true;
}

/// "[" ["^"] label { label } "]", the cursor being at "[".
bool parse_label_set(Cursor& in, LabelTest& test) {
    const std::size_t begin = in.position();
    in.take();
    in.skip_blanks();
    test.form = in.take_if('^') ? LabelTest::Form::NoneOf : LabelTest::Form::OneOf;
    for (in.skip_blanks(); !in.take_if(']'); in.skip_blanks()) {
        if (is_left_open(in, begin)) return false;
        if (in.peek() != '\'') return reject_inside(in, ']'), false;
        test.labels.push_back(in.read_label());
    }
    if (!test.labels.empty()) return true;
    in.error(Code::LpeEmpty, "an empty choice", begin, in.position(), "any label is written .");
    return false;
}

/// { labeltest }, up to the ">".
bool parse_label_tests(Cursor& in, std::vector<LabelTest>& tests) {
    for (in.skip_blanks(); in.peek() != '>'; in.skip_blanks()) {
        const std::size_t begin = in.position();
        LabelTest test;
        if (in.peek() == '\'') {
            test = {LabelTest::Form::One, {in.read_label()}, {}};
        } else if (in.peek() == '[') {
            if (!parse_label_set(in, test)) return false;
        } else if (in.peek_is_one_of(kEventLetters)) {
            const char c = in.peek();
            in.error(Code::LpeEvent, in_quotes({&c, 1}) + " after the lobe", begin, begin + 1,
                     "kind, lobe, labels, in this order: <RD'coat'>");
            return false;
        } else if (!in.take_if('.')) {
            return reject_inside(in, '>'), false;
        }
        test.where = in.span(begin, in.position());
        tests.push_back(std::move(test));
    }
    in.take();
    return true;
}

/// Reports the `<` at the cursor, and skips what plainly belongs to it.
void report_unclosed_angle(Cursor& in) {
    const std::size_t begin = in.position();
    in.take();
    if (in.peek_is_one_of(kKindLetters)) in.take();
    if (in.peek_is_one_of(kLobeLetters)) in.take();
    const std::string_view rest = in.text().substr(in.position());
    const std::size_t quote = rest.substr(0, 2) == ".'" ? 1 : 0;
    const std::size_t quote_end = rest.find('\'', quote + 1);
    if (rest.substr(quote, 1) == "'" && quote_end != std::string_view::npos)
        in.move_to(in.position() + quote_end + 1);
    in.error(Code::LpeUnclosed, "\"<\" is never closed", begin, begin + 1,
             "close it: " + std::string(in.text(begin, in.position())) + ">");
}

/// "<" kind [ lobe ] { labeltest } ">"
Expr parse_angle(Cursor& in) {
    const std::size_t begin = in.position();
    const std::size_t close = find_close(in, '<', '>');
    if (close == std::string_view::npos) return report_unclosed_angle(in), nullptr;
    in.take();
    Angle angle;
    bool good = parse_kind(in, angle.kind) && parse_lobe(in, angle.lobe);
    in.skip_blanks();
    const std::size_t labels = in.position();
    good = good && parse_label_tests(in, angle.labels);
    in.move_to(close + 1);
    if (!good) return nullptr;
    if (angle.lobe.form == LetterTest::Form::Missing && !angle.labels.empty())
        in.lint(Code::LpeLobeSlot, "a label where the lobe belongs", labels, close,
                "put a . before it: " + std::string(in.text(begin, labels)) + "." +
                    std::string(in.text(labels, close + 1)));
    return make(in, std::move(angle), begin);
}

/// "[" ["^"] item { item } "]"
Expr parse_brackets(Cursor& in) {
    const std::size_t begin = in.position();
    const bool closed = find_close(in, '[', ']') != std::string_view::npos;
    in.take();
    if (!closed) {
        while (in.peek_is_one_of(kEventLetters))
            in.take();
        in.error(Code::LpeUnclosed, "\"[\" is never closed", begin, begin + 1,
                 "close it: " + std::string(in.text(begin, in.position())) + "]");
        return nullptr;
    }
    in.skip_blanks();
    Brackets brackets;
    brackets.negated = in.take_if('^');
    bool good = true;
    for (in.skip_blanks(); !in.take_if(']'); in.skip_blanks()) {
        if (in.at_end()) return nullptr;  // a broken label swallowed the bracket
        Expr item;
        if (in.peek_is_one_of("|()&-!") || in.peek_is_one_of(kQuantifiers)) {
            reject_inside(in, ']');
        } else if (in.peek() == '[') {
            in.error(Code::LpeCharacter, "\"[\" inside [..]", in.position(), in.position() + 1,
                     "single events only: put all of them into one [..]");
            (void)parse_brackets(in);
        } else {
            item = parse_event(in, false);
        }
        good = good && item != nullptr;
        brackets.items.push_back(std::move(item));
    }
    if (good && brackets.items.empty())
        in.error(Code::LpeEmpty, "an empty choice", begin, in.position(),
                 "any event is written .");
    if (!good || brackets.items.empty()) return nullptr;
    return make(in, std::move(brackets), begin);
}

}  // namespace

Expr parse_event(Cursor& in, bool may_be_camera) {
    const std::size_t begin = in.position();
    if (in.peek_is_one_of(kEventLetters)) {
        const char letter = in.take();
        return make(in, Letter{letter}, begin);
    }
    switch (in.peek()) {
        case '.': in.take(); return make(in, Dot{}, begin);
        case '<': return parse_angle(in);
        case '[': return parse_brackets(in);
        case '\'': {
            std::string label = in.read_label();
            return make(in, Label{std::move(label)}, begin);
        }
        default: break;
    }
    if (may_be_camera && in.take_if('c')) {
        in.lint(Code::LpeLowerCase, "\"c\" is read as the camera \"C\"", begin, begin + 1,
                "write \"C\"");
        return make(in, Letter{'C'}, begin);
    }
    in.reject_character();
    return nullptr;
}

}  // namespace lightsieve::lpe
