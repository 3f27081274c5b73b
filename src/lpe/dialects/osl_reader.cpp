#include "lpe/dialects/osl_reader.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "lpe/cursor.h"
#include "lpe/parse.h"

namespace lightsieve::lpe::dialects {
namespace {

constexpr std::string_view kEvents = "CLBVTRO";
constexpr std::string_view kScatterings = "DGSs";
/// With so many label items, the parser adds no "and any further labels".
constexpr std::size_t kExactLabels = 5;

/// The symbols of a hit: event, scattering, labels. The empty one stands where nothing is; in a
/// text it is written x.
std::vector<std::string> symbols_of(const Hit& hit) {
    std::vector<std::string> symbols{std::string{hit.event}, hit.lobe};
    for (const std::string& label : hit.labels)
        if (!label.empty()) symbols.push_back(label);
    return symbols;
}

/// What one item inside <..> is: one symbol, any but some, one of several items, or several in a
/// row.
struct Item {
    enum class Form : std::uint8_t { One, AnyBut, Choice, Row };
    Form form = Form::AnyBut;
    std::vector<std::string> symbols{};
    std::vector<Item> items{};
};

using SymbolTest = std::function<bool(const std::string& carried, const std::string& wanted)>;

bool equal_symbols(const std::string& carried, const std::string& wanted) {
    return carried == wanted;
}

/// Where matching the item can end if it begins at each of these places.
std::vector<std::size_t> match_item(const Item& item, const std::vector<std::string>& hit,
                                    const std::vector<std::size_t>& places, const SymbolTest& is) {
    std::vector<std::size_t> out;
    const auto add_all = [&](const std::vector<std::size_t>& more) {
        out.insert(out.end(), more.begin(), more.end());
    };
    switch (item.form) {
        case Item::Form::One:
        case Item::Form::AnyBut:
            for (const std::size_t place : places) {
                if (place >= hit.size()) continue;
                const bool named = std::ranges::any_of(
                    item.symbols, [&](const std::string& s) { return is(hit[place], s); });
                if (named == (item.form == Item::Form::One)) out.push_back(place + 1);
            }
            break;
        case Item::Form::Choice:
            for (const Item& choice : item.items)
                add_all(match_item(choice, hit, places, is));
            break;
        case Item::Form::Row:
            out = places;
            for (const Item& part : item.items)
                out = match_item(part, hit, out, is);
            break;
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// One hit: its items in a row, then, if there are few labels, any further ones that are no basic
/// letters.
struct HitItems {
    std::vector<Item> items;
    bool open_end = true;
    std::string basic;  ///< letters that "any further labels" leaves out
    SymbolTest is;

    bool operator()(const Hit& hit) const {
        const std::vector<std::string> symbols = symbols_of(hit);
        std::vector<std::size_t> places{0};
        for (const Item& item : items)
            places = match_item(item, symbols, places, is);
        return std::ranges::any_of(places, [&](std::size_t place) {
            if (place == symbols.size()) return true;
            const auto is_further = [&](const std::string& s) {
                return !s.empty() && !(s.size() == 1 && basic.find(s) != std::string::npos);
            };
            return open_end && std::all_of(symbols.begin() + static_cast<std::ptrdiff_t>(place),
                                           symbols.end(), is_further);
        });
    }
};

class OslParser {
  public:
    OslParser(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
              const OslOptions& options)
        : in_(text, base, "", diagnostics),
          options_(options),
          events_(std::string(kEvents) + std::string(options.user_events)) {}

    Reading run() {
        if (in_.text().size() > kMaxTextLength) {
            in_.error(Code::LimitLpeLength,
                      "the expression has " + std::to_string(in_.text().size()) + " bytes", 0, 1,
                      "the limit kMaxTextLength is " + std::to_string(kMaxTextLength));
            return std::move(reading_);
        }
        if (in_.at_end()) {
            in_.error(Code::LpeEmpty, "the expression is empty", 0, 0, "all light is C.*");
            return std::move(reading_);
        }
        const bool group = in_.peek() == '(';
        PatternPtr pattern = parse_sequence();
        if (group && in_.n_errors() == 0 && !in_.at_end()) report_truncation();
        if (in_.n_errors() == 0) reading_.pattern = std::move(pattern);
        return std::move(reading_);
    }

  private:
    void misread(const std::string& message, std::size_t begin, std::string hint) {
        in_.lint(Code::LpeMisread, who() + " " + message, begin, in_.position(), std::move(hint));
    }
    [[nodiscard]] std::string who() const { return std::string(options_.renderer); }
    [[nodiscard]] bool give_up() const {
        return in_.n_errors() >= kMaxErrorsPerExpression || in_.abandoned();
    }

    void report_truncation() {
        const std::size_t begin = in_.position();
        const std::string rest(in_.text(begin, in_.text().size()));
        in_.move_to(in_.text().size());
        misread("ignores everything after a leading parenthesis: " + in_quotes(rest), begin,
                "put the whole expression into one more pair of parentheses");
    }

    /// One level deeper; false, after a report, where that is too deep.
    bool descend(std::size_t begin) {
        if (++depth_ <= kMaxNesting) return true;
        in_.error(Code::LimitLpeNesting, "brackets are nested too deep", begin, begin + 1,
                  "the limit kMaxNesting is " + std::to_string(kMaxNesting));
        in_.abandon();
        return false;
    }

    /// parseCat: a parenthesised sequence, or the whole text.
    PatternPtr parse_sequence() {
        const std::size_t begin = in_.position();
        const bool group = in_.take_if('(');
        if (!descend(begin)) return make_nothing();
        std::vector<PatternPtr> parts;
        while (!in_.at_end() && !give_up() && !(group && in_.peek() == ')')) {
            if (in_.peek() == '|')
                parse_alternative(parts);
            else
                parts.push_back(parse_item());
        }
        --depth_;
        if (group && !in_.take_if(')') && !give_up())
            in_.error(Code::LpeUnclosed, "\"(\" is never closed", begin, begin + 1,
                      "close it with \")\"");
        if (group && parts.empty() && in_.n_errors() == 0)
            in_.error(Code::LpeEmpty, "nothing between the parentheses: " + who() + " crashes",
                      begin, in_.position(), "leave the parentheses out");
        return make_sequence(std::move(parts));
    }

    /// `|` joins the one item before it with the one after it.
    void parse_alternative(std::vector<PatternPtr>& parts) {
        const std::size_t begin = in_.position();
        in_.take();
        if (parts.empty() || in_.at_end() || in_.peek() == '|' || in_.peek() == ')') {
            in_.error(Code::LpeEmpty, "nothing on one side of \"|\"", begin, begin + 1,
                      "write ((..)|(..))");
            return;
        }
        PatternPtr right = parse_item();
        parts.back() = make_alternation({parts.back(), std::move(right)});
    }

    /// _parse: one item and at most one quantifier.
    PatternPtr parse_item() {
        PatternPtr item;
        switch (in_.peek()) {
            case '(': item = parse_sequence(); break;
            case '[': item = parse_choice(); break;
            case '<': item = parse_angle(); break;
            default: item = parse_symbol(); break;
        }
        return parse_quantifier(std::move(item));
    }

    PatternPtr parse_quantifier(PatternPtr item) {
        const std::size_t begin = in_.position();
        if (in_.take_if('*'))
            item = make_repeat(std::move(item), 0, Pattern::kUnbounded);
        else if (in_.take_if('+'))
            item = make_repeat(std::move(item), 1, Pattern::kUnbounded);
        else if (in_.take_if('{'))
            return parse_counts(std::move(item), begin);
        else
            return item;
        return item;
    }

    PatternPtr parse_counts(PatternPtr item, std::size_t begin) {
        const std::optional<std::uint32_t> min = parse_number();
        const bool comma = in_.take_if(',');
        const std::optional<std::uint32_t> max = comma ? parse_number() : min;
        if (!min || !in_.take_if('}')) {
            while (in_.peek_is_one_of(" ,0123456789"))
                in_.take();
            (void)in_.take_if('}');
            in_.error(Code::LpeQuantifier, "a malformed {}", begin, in_.position(),
                      "write {2}, {2,} or {2,5}, without blanks");
            return item;
        }
        if (*min > kMaxRepeat || (max && *max > kMaxRepeat)) {
            in_.error(Code::LimitLpeRepeat, "a count above the limit", begin, in_.position(),
                      "the limit kMaxRepeat is " + std::to_string(kMaxRepeat));
            return item;
        }
        if ((*min == 0 && !comma) || (max && *max == 0) || (*min == 0 && !max)) {
            in_.error(Code::LpeQuantifier, who() + " crashes at a repeat of none", begin,
                      in_.position(), *min == 0 && comma && !max ? "write *" : "leave it out");
            return item;
        }
        if (max && *max < *min) {
            misread("reads this as exactly " + std::to_string(*min), begin,
                    "the smaller number comes first");
            return make_repeat(std::move(item), *min, *min);
        }
        return make_repeat(std::move(item), *min, max ? *max : Pattern::kUnbounded);
    }

    std::optional<std::uint32_t> parse_number() {
        std::optional<std::uint32_t> out;
        while (in_.peek_is_one_of("0123456789"))
            out = std::min((out ? *out : 0) * 10 + static_cast<std::uint32_t>(in_.take() - '0'),
                           kMaxRepeat + 1);
        return out;
    }

    [[nodiscard]] std::string read_label() {
        std::string label = in_.read_label();
        if (options_.trims_labels) {
            const std::size_t begin = label.find_first_not_of(" \t");
            const std::size_t end = label.find_last_not_of(" \t");
            label = begin == std::string::npos ? "" : label.substr(begin, end - begin + 1);
        }
        note_label(label);
        return label;
    }
    void note_label(const std::string& label) {
        if (label.empty()) return;
        if (options_.dotted_labels) {
            // 'skin.coat' is the lobe coat of the material skin.
            const std::size_t dot = label.find('.');
            if (dot != std::string::npos && dot > 0 && dot + 1 < label.size()) {
                reading_.labels.push_back(label.substr(0, dot));
                reading_.labels.push_back(label.substr(dot + 1));
                return;
            }
        }
        reading_.labels.push_back(label);
    }

    [[nodiscard]] PatternPtr hit(std::vector<Item> items) {
        for (const Item& item : items)
            if (item.form != Item::Form::Choice && item.form != Item::Form::Row &&
                item.symbols.size() > 1)
                reading_.label_sets.push_back(item.symbols);
        const bool open_end = items.size() < 2 + kExactLabels;
        while (items.size() < 2)
            items.emplace_back();
        SymbolTest is = equal_symbols;
        if (options_.dotted_labels) is = is_dotted_label;
        return make_event(HitItems{std::move(items), open_end, events_ + std::string(kScatterings),
                                   std::move(is)});
    }

    /// One letter, `.` or label outside of <..>.
    PatternPtr parse_symbol() {
        const std::size_t begin = in_.position();
        if (in_.peek() == '\'') {
            std::string label = read_label();
            return hit({{}, {}, {Item::Form::One, {std::move(label)}, {}}});
        }
        if (in_.take_if('.')) return hit({});
        if (in_.peek_is_one_of(events_)) {
            const std::string letter{in_.take()};
            note_user_event(letter);
            return hit({{Item::Form::One, {letter}, {}}});
        }
        if (in_.peek_is_one_of(kScatterings))
            return hit({{}, {Item::Form::One, {std::string{in_.take()}}, {}}});
        reject(begin);
        return make_nothing();
    }
    void note_user_event(const std::string& letter) {
        if (options_.user_events.find(letter) != std::string_view::npos)
            reading_.foreign_ends.push_back(letter);
    }

    /// What is no letter here. OSL says only that it does not know it.
    void reject(std::size_t begin) {
        const char c = in_.peek();
        if (c == '?') {
            in_.take();
            in_.error(Code::LpeQuantifier, who() + " has no \"?\"", begin, begin + 1,
                      "write {0,1}");
        } else if (c == '*' || c == '+' || c == '{') {
            in_.take();
            in_.error(Code::LpeQuantifier, "a quantifier with nothing before it", begin, begin + 1,
                      "to repeat a repetition use parentheses");
            if (c == '{')
                while (!in_.at_end() && !in_.take_if('}'))
                    in_.take();
        } else if (c == '|') {
            in_.take();
            in_.error(Code::LpeCharacter, "\"|\" inside [..]", begin, begin + 1,
                      "[..] is a choice already");
        } else if (in_.skip_blanks()) {
            in_.error(Code::LpeCharacter, who() + " takes no blanks", begin, in_.position(),
                      "leave them out");
        } else if (c == 'A' || c == 'x' || c == 'c' || c == 'U' || c == 'M') {
            in_.take();
            in_.error(Code::LpeEvent, "no event " + in_quotes({&c, 1}), begin, begin + 1,
                      c == 'c'   ? "events are capital letters: \"C\""
                      : c == 'A' ? "albedo is a user event here; ask the renderer for its letter"
                                 : "events are C D G S s R T V L O B and . (any)");
        } else {
            in_.reject_character();
        }
    }

    PatternPtr parse_choice() {
        const std::size_t begin = in_.position();
        in_.take();
        if (in_.peek() == '^') return hit_of_negation(begin);
        if (!descend(begin)) return make_nothing();
        std::vector<PatternPtr> parts;
        while (!in_.at_end() && !give_up() && in_.peek() != ']') {
            if (in_.peek() == ')' || in_.peek() == '>') {
                in_.reject_character();
                continue;
            }
            parts.push_back(parse_item());
        }
        --depth_;
        close(begin, '[', ']');
        if (parts.empty() && in_.n_errors() == 0)
            misread("takes nothing by an empty choice", begin, "any event is written .");
        return make_alternation(std::move(parts));
    }

    void close(std::size_t begin, char open, char close) {
        if (in_.take_if(close) || give_up()) return;
        in_.error(Code::LpeUnclosed, in_quotes({&open, 1}) + " is never closed", begin, begin + 1,
                  "close it with " + in_quotes({&close, 1}));
    }

    /// `[^..]`: any symbol but these; the last one decides in which place it stands.
    struct Negation {
        Item item;
        std::size_t place = 2;
    };
    Negation parse_negation(std::size_t begin) {
        in_.take();
        Negation out{{Item::Form::AnyBut, {}, {}}, 2};
        bool mixed = false;
        while (!in_.at_end() && !give_up() && in_.peek() != ']') {
            const std::size_t at = in_.position();
            std::size_t place = 2;
            if (in_.peek() == '\'') {
                out.item.symbols.push_back(read_label());
            } else if (in_.peek_is_one_of(events_) || in_.peek_is_one_of(kScatterings)) {
                place = in_.peek_is_one_of(events_) ? 0 : 1;
                out.item.symbols.emplace_back(1, in_.take());
            } else {
                const bool known = in_.peek_is_one_of(".<(x");
                if (known)
                    in_.take();
                else
                    reject(at);
                if (known)
                    in_.error(Code::LpeCharacter, "only letters and labels can stand in [^..]", at,
                              at + 1, "say what may be there instead: [..]");
                continue;
            }
            mixed = mixed || (out.item.symbols.size() > 1 && place != out.place);
            out.place = place;
        }
        if (out.item.symbols.empty() && in_.n_errors() == 0)
            in_.error(Code::LpeEmpty, "an empty choice", begin, in_.position(),
                      "any event is written .");
        close(begin, '[', ']');
        if (mixed)
            misread("looks for all of these in the place of the last one", begin,
                    "event letters, lobe letters and labels need a [^..] each");
        return out;
    }

    PatternPtr hit_of_negation(std::size_t begin) {
        Negation negation = parse_negation(begin);
        if (negation.place == 2) warn_unlabelled(begin);
        std::vector<Item> items(negation.place + 1);
        items[negation.place] = std::move(negation.item);
        return hit(std::move(items));
    }
    void warn_unlabelled(std::size_t begin) {
        if (options_.every_event_is_labelled || in_.n_errors() > 0) return;
        misread("takes no unlabelled event by this", begin,
                "stock OSL cannot say \"not this label or none\"; the renderer must give every "
                "event a label");
    }

    /// parseGroup: two places for letters, then labels in order.
    PatternPtr parse_angle() {
        const std::size_t begin = in_.position();
        in_.take();
        std::vector<Item> items;
        while (!in_.at_end() && !give_up() && in_.peek() != '>')
            items.push_back(parse_inner_item(items.size()));
        close(begin, '<', '>');
        if (items.empty() && in_.n_errors() == 0)
            misread("takes any event by <>", begin, "any event is written .");
        if (in_.n_errors() == 0) warn_dead(items, begin);
        return hit(std::move(items));
    }

    /// A letter or label that can never be where it stands.
    void warn_dead(const std::vector<Item>& items, std::size_t begin) {
        for (std::size_t place = 0; place < items.size() && place < 2; ++place) {
            const Item& item = items[place];
            if (item.form != Item::Form::One) continue;
            const std::string& symbol = item.symbols[0];
            const bool fits =
                place == 0 ? symbol.size() == 1 && events_.find(symbol) != std::string::npos
                           : symbol.empty() || (symbol.size() == 1 &&
                                                kScatterings.find(symbol) != std::string::npos);
            if (fits) continue;
            misread("never finds " + in_quotes(symbol) + " in the place of the " +
                        (place == 0 ? "event" : "lobe") + ": takes nothing",
                    begin,
                    "the order is event, lobe, labels, and . fills a place: <.D>, <L.'key'>");
            return;
        }
    }

    /// An item inside <..>; `place` is its index there.
    Item parse_inner_item(std::size_t place) {
        const std::size_t begin = in_.position();
        Item item;
        if (!descend(begin)) return item;
        item = parse_inner_symbol(begin, place);
        --depth_;
        if (in_.peek_is_one_of("*+{")) {
            const std::size_t at = in_.position();
            in_.take();
            in_.error(Code::LpeQuantifier, "a quantifier inside <..>", at, at + 1,
                      "put it after the \">\"");
        }
        return item;
    }
    Item parse_inner_symbol(std::size_t begin, std::size_t place) {
        Item item;
        if (in_.peek() == '[') {
            in_.take();
            item = in_.peek() == '^' ? parse_inner_negation(begin, place)
                                     : parse_inner_choice(begin, place);
        } else if (in_.take_if('(')) {
            item.form = Item::Form::Row;
            while (!in_.at_end() && !give_up() && !in_.peek_is_one_of(")>"))
                item.items.push_back(parse_inner_item(place));
            close(begin, '(', ')');
        } else if (in_.peek() == '<') {
            in_.take();
            in_.error(Code::LpeCharacter, "\"<\" inside <..>", begin, begin + 1,
                      "one event at a time: close the first");
        } else if (in_.peek() == '\'') {
            item = {Item::Form::One, {read_label()}, {}};
        } else if (in_.take_if('.')) {
            return item;
        } else {
            const char c = in_.take();
            item = {Item::Form::One, {c == 'x' ? "" : std::string{c}}, {}};
            if (c != 'x') warn_dead_character(item.symbols[0], begin);
        }
        return item;
    }
    void warn_dead_character(const std::string& symbol, std::size_t begin) {
        const char c = symbol[0];
        if (events_.find(c) != std::string::npos) return note_user_event(symbol);
        if (kScatterings.find(c) != std::string_view::npos) return;
        misread("reads " + in_quotes(symbol) + " inside <..> as a letter that no event has", begin,
                c == ' ' ? "leave the blank out" : "leave it out");
    }
    Item parse_inner_negation(std::size_t begin, std::size_t place) {
        Item item = parse_negation(begin).item;
        if (place >= 2) warn_unlabelled(begin);
        return item;
    }
    Item parse_inner_choice(std::size_t begin, std::size_t place) {
        Item item{Item::Form::Choice, {}, {}};
        std::vector<std::string> labels;
        while (!in_.at_end() && !give_up() && !in_.peek_is_one_of("]>")) {
            item.items.push_back(parse_inner_item(place));
            if (item.items.back().form == Item::Form::One)
                labels.push_back(item.items.back().symbols[0]);
        }
        close(begin, '[', ']');
        if (place >= 2 && labels.size() > 1) reading_.label_sets.push_back(std::move(labels));
        return item;
    }

    Cursor in_;
    const OslOptions& options_;
    std::string events_;
    Reading reading_;
    std::size_t depth_ = 0;
};

}  // namespace

bool is_dotted_label(std::string_view carried, std::string_view wanted) {
    if (carried == wanted) return true;
    const std::size_t dot = carried.find('.');
    if (dot == std::string_view::npos || wanted.find('.') != std::string_view::npos) return false;
    return carried.substr(0, dot) == wanted || carried.substr(dot + 1) == wanted;
}

Reading read_osl(std::string_view text, const SourceSpan& base, Diagnostics& diagnostics,
                 const OslOptions& options) {
    return OslParser(text, base, diagnostics, options).run();
}

}  // namespace lightsieve::lpe::dialects
