#include "lpe/dialects/tuple_reader.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lpe/cursor.h"
#include "lpe/parse.h"

namespace lightsieve::lpe::dialects {
namespace {

/// A choice of letters or labels: one of, none of, or any.
struct Choice {
    bool any = true;
    bool negated = false;
    std::vector<std::string> names{};

    [[nodiscard]] bool holds(bool named, bool fits_any) const {
        return any ? fits_any : negated ? fits_any && !named : named;
    }
};

/// `D` takes D2 as well; `D2` only itself.
bool is_lobe(const std::string& carried, const std::string& wanted) {
    return wanted.size() == 1 ? !carried.empty() && carried[0] == wanted[0] : carried == wanted;
}

bool names_lobe(const Choice& choice, const Hit& hit) {
    return std::ranges::any_of(choice.names,
                               [&](const std::string& name) { return is_lobe(hit.lobe, name); });
}
bool names_event(const Choice& choice, const Hit& hit) {
    return std::ranges::any_of(choice.names,
                               [&](const std::string& name) { return name[0] == hit.event; });
}
bool names_label(const Choice& choice, const std::string& label) {
    return std::ranges::find(choice.names, label) != choice.names.end();
}

/// An event of the dialect: all of its tests must hold.
struct Tuple {
    const TupleOptions* options;
    Choice event{}, lobe{};
    std::vector<Choice> labels{};

    bool operator()(const Hit& hit) const {
        if (!event.holds(names_event(event, hit), options->any_event(hit))) return false;
        if (!lobe.holds(names_lobe(lobe, hit), options->any_lobe(hit) || !lobe.any)) return false;
        for (std::size_t i = 0; i < labels.size(); ++i)
            if (!label_holds(labels[i], i, hit)) return false;
        return true;
    }

  private:
    [[nodiscard]] bool label_holds(const Choice& choice, std::size_t place, const Hit& hit) const {
        bool named = false;
        if (options->label_places > 0)
            named = place < hit.labels.size() && names_label(choice, hit.labels[place]);
        else
            named = std::ranges::any_of(
                hit.labels, [&](const std::string& label) { return names_label(choice, label); });
        return choice.holds(named, true);
    }
};

class TupleParser {
  public:
    TupleParser(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
                const TupleOptions& options)
        : in_(text, base, "", diagnostics), options_(options) {}

    Reading run() {
        if (in_.text().size() > kMaxTextLength) {
            in_.error(Code::LimitLpeLength,
                      "the expression has " + std::to_string(in_.text().size()) + " bytes", 0, 1,
                      "the limit kMaxTextLength is " + std::to_string(kMaxTextLength));
            return std::move(reading_);
        }
        PatternPtr pattern = parse_alternatives();
        while (!in_.at_end() && !give_up()) {
            in_.reject_character();
            in_.skip_blanks();
            if (!in_.at_end() && in_.peek() != ')') (void)parse_alternatives();
        }
        if (in_.n_errors() == 0) reading_.pattern = std::move(pattern);
        return std::move(reading_);
    }

  private:
    [[nodiscard]] bool give_up() const {
        return in_.n_errors() >= kMaxErrorsPerExpression || in_.abandoned();
    }
    [[nodiscard]] std::string who() const { return std::string(options_.renderer); }

    /// Up to `)` or the end. Where `|` binds tightly, items deal with it.
    PatternPtr parse_alternatives() {
        std::vector<PatternPtr> alternatives;
        do {
            const std::size_t begin = in_.position();
            std::vector<PatternPtr> parts;
            for (in_.skip_blanks(); !in_.at_end() && !give_up() && !in_.peek_is_one_of("|)");
                 in_.skip_blanks())
                parts.push_back(parse_item());
            if (parts.empty() && !give_up())
                in_.error(Code::LpeEmpty, "nothing stands here", begin,
                          std::min(begin + 1, in_.text().size()), "all light is C.*");
            alternatives.push_back(make_sequence(std::move(parts)));
        } while (!give_up() && in_.take_if('|'));
        return make_alternation(std::move(alternatives));
    }

    PatternPtr parse_item() {
        PatternPtr item = parse_repeat();
        in_.skip_blanks();
        while (options_.tight && !give_up() && in_.peek() == '|') {
            const std::size_t begin = in_.position();
            in_.take();
            in_.skip_blanks();
            if (in_.at_end() || in_.peek_is_one_of("|)")) {
                in_.error(Code::LpeEmpty, "nothing on one side of \"|\"", begin, begin + 1,
                          "write ((..)|(..))");
                break;
            }
            item = make_alternation({std::move(item), parse_repeat()});
            in_.skip_blanks();
        }
        return item;
    }

    PatternPtr parse_repeat() {
        PatternPtr item = in_.peek() == '(' ? parse_group() : parse_event();
        in_.skip_blanks();
        for (bool repeated = false; !give_up() && in_.peek_is_one_of("*+?{"); in_.skip_blanks()) {
            const std::size_t begin = in_.position();
            item = parse_quantifier(std::move(item));
            if (std::exchange(repeated, true))
                in_.error(Code::LpeQuantifier, "a second quantifier", begin, in_.position(),
                          "to repeat a repetition use parentheses");
        }
        return item;
    }

    PatternPtr parse_quantifier(PatternPtr item) {
        const std::size_t begin = in_.position();
        const char c = in_.take();
        if (c == '*') return make_repeat(std::move(item), 0, Pattern::kUnbounded);
        if (c == '+') return make_repeat(std::move(item), 1, Pattern::kUnbounded);
        const bool known =
            options_.repeats == Repeats::All || (c == '{' && options_.repeats == Repeats::Counts);
        std::optional<std::uint32_t> min, max;
        if (c == '{') {
            min = parse_number();
            const bool comma = in_.take_if(',');
            max = comma ? parse_number() : min;
            if (!min || !in_.take_if('}') || (max && *max < *min)) {
                in_.error(Code::LpeQuantifier, "a malformed {}", begin, in_.position(),
                          "write {2}, {2,} or {2,5}");
                return item;
            }
            if (*min > kMaxRepeat || (max && *max > kMaxRepeat)) {
                in_.error(Code::LimitLpeRepeat, "a count above the limit", begin, in_.position(),
                          "the limit kMaxRepeat is " + std::to_string(kMaxRepeat));
                return item;
            }
        }
        if (!known)
            in_.error(Code::LpeQuantifier,
                      who() + " has no " + in_quotes(in_.text(begin, in_.position())), begin,
                      in_.position(), "it has * and +; write the alternatives out");
        if (c == '?') return make_repeat(std::move(item), 0, 1);
        return make_repeat(std::move(item), *min, max ? *max : Pattern::kUnbounded);
    }

    std::optional<std::uint32_t> parse_number() {
        std::optional<std::uint32_t> out;
        in_.skip_blanks();
        while (in_.peek_is_one_of("0123456789"))
            out = std::min((out ? *out : 0) * 10 + static_cast<std::uint32_t>(in_.take() - '0'),
                           kMaxRepeat + 1);
        in_.skip_blanks();
        return out;
    }

    PatternPtr parse_group() {
        const std::size_t begin = in_.position();
        in_.take();
        if (++depth_ > kMaxNesting) {
            in_.error(Code::LimitLpeNesting, "parentheses are nested too deep", begin, begin + 1,
                      "the limit kMaxNesting is " + std::to_string(kMaxNesting));
            in_.abandon();
            return make_nothing();
        }
        PatternPtr out = parse_alternatives();
        --depth_;
        if (!in_.take_if(')') && !give_up())
            in_.error(Code::LpeUnclosed, "\"(\" is never closed", begin, begin + 1,
                      "close it with \")\"");
        return out;
    }

    // ---- single events ----

    PatternPtr parse_event() {
        if (in_.peek_is_one_of("*+?{")) {
            const std::size_t begin = in_.position();
            (void)parse_quantifier(make_empty());
            in_.error(Code::LpeQuantifier, "a quantifier with nothing before it", begin,
                      in_.position(), "any number of any events is .*");
            return make_empty();
        }
        std::optional<HitTest> test = parse_test();
        return test ? make_event(*std::move(test)) : make_nothing();
    }

    /// The test of one event: a letter, `.`, a label, <..> or [..].
    std::optional<HitTest> parse_test() {
        Tuple tuple{&options_};
        switch (in_.peek()) {
            case '.': in_.take(); return tuple;
            case '\'': tuple.labels.push_back(parse_labels()); return tuple;
            case '<': return parse_tuple();
            case '[': return parse_brackets();
            default: break;
        }
        if (std::optional<std::string> lobe = parse_lobe_letter()) {
            tuple.event = foreign_event(*lobe);
            tuple.lobe = {false, false, {*std::move(lobe)}};
            return tuple;
        }
        if (in_.peek_is_one_of(options_.events)) {
            tuple.event = {false, false, {std::string{in_.take()}}};
            return tuple;
        }
        reject();
        return std::nullopt;
    }

    /// A lobe of this dialect alone is an event of its own; any other, of any event.
    [[nodiscard]] Choice foreign_event(const std::string& lobe) const {
        if (options_.foreign.find(lobe[0]) == std::string_view::npos) return {};
        return {false, false, {lobe.substr(0, 1)}};
    }

    std::optional<std::string> parse_lobe_letter() {
        if (!in_.peek_is_one_of(options_.lobes)) return std::nullopt;
        const std::size_t begin = in_.position();
        std::string lobe{in_.take()};
        const bool foreign = options_.foreign.find(lobe[0]) != std::string_view::npos;
        std::string digits;
        if (options_.numbered.find(lobe[0]) != std::string_view::npos)
            while (in_.peek_is_one_of("0123456789"))
                digits += in_.take();
        const bool bad = digits.size() > 2 || (!digits.empty() && std::stoul(digits) < 1) ||
                         (!digits.empty() && std::stoul(digits) > options_.max_number) ||
                         (foreign && digits.empty());
        if (bad)
            in_.error(Code::LpeEvent, "no lobe " + in_quotes(in_.text(begin, in_.position())),
                      begin, in_.position(), "lobes are numbered from 1 up");
        else if (foreign)
            reading_.foreign.push_back(lobe + digits);
        return lobe + digits;
    }

    void reject() {
        const char c = in_.peek();
        const std::string hint = options_.hint == nullptr ? "" : options_.hint(c);
        if (hint.empty()) return in_.reject_character();
        const std::size_t begin = in_.position();
        in_.take();
        in_.error(Code::LpeEvent, who() + " has no event " + in_quotes({&c, 1}), begin, begin + 1,
                  hint);
    }

    /// `'a'`, `['a''b']`, `[^'a']` or `.`, the cursor being there.
    Choice parse_labels() {
        Choice choice{false, false, {}};
        if (in_.take_if('.')) return {};
        const bool set = in_.take_if('[');
        const std::size_t begin = in_.position();
        in_.skip_blanks();
        choice.negated = set && in_.take_if('^');
        for (in_.skip_blanks(); !give_up() && in_.peek() == '\''; in_.skip_blanks()) {
            choice.names.push_back(in_.read_label());
            if (!set) break;
        }
        if (set && !in_.take_if(']') && !give_up())
            in_.error(Code::LpeUnclosed, "\"[\" is never closed", begin - 1, begin,
                      "labels only, then \"]\"");
        reading_.labels.insert(reading_.labels.end(), choice.names.begin(), choice.names.end());
        reading_.label_sets.push_back(choice.names);
        return choice;
    }

    /// Letters of one place inside <..>: a letter, `.`, [..] or [^..]; nothing if none stand here.
    template <class Letter>
    std::optional<Choice> parse_letters(const Letter& letter) {
        in_.skip_blanks();
        if (in_.take_if('.')) return Choice{};
        if (std::optional<std::string> one = letter()) return Choice{false, false, {*one}};
        if (in_.peek() != '[') return std::nullopt;
        const std::size_t begin = in_.position();
        in_.take();
        in_.skip_blanks();
        Choice choice{false, in_.take_if('^'), {}};
        for (in_.skip_blanks(); !give_up(); in_.skip_blanks()) {
            std::optional<std::string> next = letter();
            if (!next) break;
            choice.names.push_back(*std::move(next));
        }
        if (!choice.names.empty() && in_.take_if(']')) return choice;
        in_.move_to(begin);
        return std::nullopt;
    }

    std::optional<HitTest> parse_tuple() {
        const std::size_t begin = in_.position();
        in_.take();
        Tuple tuple{&options_};
        const auto event_letter = [&]() -> std::optional<std::string> {
            if (!in_.peek_is_one_of(options_.events)) return std::nullopt;
            return std::string{in_.take()};
        };
        const auto lobe_letter = [&] { return parse_lobe_letter(); };
        const std::size_t errors = in_.n_errors();
        if (std::optional<Choice> event = parse_letters(event_letter))
            tuple.event = *std::move(event);
        else if (!options_.any_place)
            report_place(begin, "event");
        if (std::optional<Choice> lobe = parse_letters(lobe_letter)) {
            tuple.lobe = *std::move(lobe);
        } else if (in_.skip_blanks(), in_.peek_is_one_of("'[") && !options_.any_place) {
            in_.lint(Code::LpeMisread, who() + " looks for the lobe in the place of this label",
                     in_.position(), in_.position() + 1, "put a . before it: <L.'key'>");
            tuple.lobe = {false, false, {"?"}};
        }
        const std::size_t n_places = options_.label_places;
        for (in_.skip_blanks(); !give_up() && in_.peek_is_one_of("'[."); in_.skip_blanks()) {
            const std::size_t at = in_.position();
            tuple.labels.push_back(parse_labels());
            if (n_places > 0 && tuple.labels.size() > n_places)
                in_.error(Code::LpeLabel, "more labels than " + who() + " has places for", at,
                          in_.position(), "at most " + std::to_string(n_places));
        }
        if (in_.take_if('>')) {
            if (in_.n_errors() > errors) return std::nullopt;
            return tuple;
        }
        if (!give_up()) recover_tuple(begin);
        return std::nullopt;
    }

    void report_place(std::size_t begin, const std::string& what) {
        if (in_.peek() == '>' || in_.at_end()) return;
        in_.error(Code::LpeEvent, "no " + what + " stands first in <..>", begin,
                  in_.position() + 1,
                  "the order is event, lobe, labels, and . fills a place: <.D>");
    }

    /// Skips to the `>`, with a report of what is in the way.
    void recover_tuple(std::size_t begin) {
        const std::size_t close = in_.text().find('>', in_.position());
        if (close == std::string_view::npos) {
            in_.error(Code::LpeUnclosed, "\"<\" is never closed", begin, begin + 1,
                      "close it with \">\"");
            return;
        }
        if (in_.peek_is_one_of(options_.events) || in_.peek_is_one_of(options_.lobes))
            in_.error(Code::LpeEvent,
                      in_quotes(in_.text(in_.position(), in_.position() + 1)) +
                          " stands in the wrong place",
                      in_.position(), in_.position() + 1, "the order is event, lobe, labels");
        else
            reject();
        in_.move_to(std::max(close + 1, in_.position()));
    }

    std::optional<HitTest> parse_brackets() {
        const std::size_t begin = in_.position();
        in_.take();
        if (++depth_ > kMaxNesting) {
            in_.error(Code::LimitLpeNesting, "brackets are nested too deep", begin, begin + 1,
                      "the limit kMaxNesting is " + std::to_string(kMaxNesting));
            in_.abandon();
            return std::nullopt;
        }
        in_.skip_blanks();
        const bool negated = in_.take_if('^');
        std::vector<HitTest> tests;
        std::vector<std::string> labels;
        bool good = true;
        for (in_.skip_blanks(); !in_.at_end() && !give_up() && in_.peek() != ']';
             in_.skip_blanks()) {
            const std::size_t at = in_.position();
            if (in_.peek_is_one_of("|()*+?{")) {
                in_.error(Code::LpeCharacter, in_quotes(in_.text(at, at + 1)) + " inside [..]", at,
                          at + 1, "single events only; for longer alternatives write ((..)|(..))");
                in_.take();
                good = false;
                continue;
            }
            const bool is_label = in_.peek() == '\'';
            std::optional<HitTest> test = parse_test();
            good = good && test.has_value();
            if (test) tests.push_back(*std::move(test));
            if (is_label && !reading_.labels.empty()) labels.push_back(reading_.labels.back());
        }
        --depth_;
        if (!in_.take_if(']') && !give_up())
            in_.error(Code::LpeUnclosed, "\"[\" is never closed", begin, begin + 1,
                      "close it with \"]\"");
        else if (good && tests.empty() && !give_up())
            in_.error(Code::LpeEmpty, "an empty choice", begin, in_.position(),
                      "any event is written .");
        if (!good || tests.empty()) return std::nullopt;
        if (labels.size() > 1) reading_.label_sets.push_back(std::move(labels));
        return [negated, tests = std::move(tests), any = options_.any_event](const Hit& hit) {
            const bool taken =
                std::ranges::any_of(tests, [&](const HitTest& test) { return test(hit); });
            return negated ? any(hit) && !taken : taken;
        };
    }

    Cursor in_;
    const TupleOptions& options_;
    Reading reading_;
    std::size_t depth_ = 0;
};

}  // namespace

Reading read_tuples(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
                    const TupleOptions& options) {
    return TupleParser(text, base, diagnostics, options).run();
}

void take_prefixes(std::string_view& text, SourceSpan& base, std::span<const Prefix> known,
                   std::string_view renderer, bool tolerant, Reading& reading,
                   Diagnostics& diagnostics) {
    if (!base.known()) base = stand_alone(text);
    const bool exact = base.length == text.size();
    const auto skip = [&](std::size_t n) {
        text.remove_prefix(n);
        if (exact) base = {base.source, base.offset + n, base.length - n};
    };
    while (true) {
        const std::size_t end = text.find_first_of(";'");
        if (end == std::string_view::npos || text[end] == '\'') return;
        const std::size_t first = std::min(text.find_first_not_of(kBlanks), end);
        std::string_view name = text.substr(first, end - first);
        name = name.substr(0, name.find_last_not_of(kBlanks) + 1);
        const auto row = std::ranges::find(known, name, &Prefix::spelled);
        if (row != known.end()) {
            reading.prefixes.emplace_back(row->name);
        } else {
            std::vector<std::string> names;
            for (const Prefix& prefix : known)
                names.emplace_back(prefix.spelled);
            std::string hint = did_you_mean(name, names);
            if (hint.empty())
                for (const std::string& spelled : names)
                    hint += (hint.empty() ? "there is " : ", ") + spelled + ";";
            const SourceSpan where =
                exact ? SourceSpan{base.source, base.offset + first, name.size()} : base;
            const std::string message =
                std::string(renderer) + " has no prefix " + in_quotes(name);
            if (tolerant)
                diagnostics.lint(Code::LpePrefix, message + " and ignores it", where, hint);
            else
                diagnostics.error(Code::LpePrefix, message, where, hint);
        }
        skip(end + 1);
    }
}

}  // namespace lightsieve::lpe::dialects
