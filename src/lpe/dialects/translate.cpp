#include "lpe/dialects/translate.h"

#include <algorithm>
#include <bit>
#include <set>
#include <unordered_map>
#include <utility>

#include "lpe/dialects/language.h"
#include "lpe/dialects/speller.h"
#include "lpe/dialects/writer.h"
#include "lpe/parse.h"

namespace lightsieve::lpe::dialects {
namespace {

/// Rewrites tried to make a text shorter.
constexpr std::size_t kMaxRewrites = 64;
/// Automata larger than this are not worth comparing again for each of them.
constexpr std::size_t kMaxRewriteStates = 300;
/// A pattern made from an automaton of more states, or that is longer than this, helps nobody.
constexpr std::size_t kMaxEliminatedStates = 40;
constexpr std::size_t kMaxEliminatedNodes = 400;
constexpr std::uint32_t kUnbounded = Pattern::kUnbounded;

/// Every set of labels that a spelling may need.
LabelSets label_sets_of(const Reading& reading, const Dialect& from) {
    std::set<std::string> labels(reading.labels.begin(), reading.labels.end());
    std::set<std::vector<std::string>> sets;
    for (const std::string_view label : from.lobe_labels)
        labels.emplace(label);
    for (const std::string& label : labels)
        sets.insert({label});
    for (std::vector<std::string> set : reading.label_sets) {
        std::ranges::sort(set);
        set.erase(std::unique(set.begin(), set.end()), set.end());
        std::erase_if(set, [&](const std::string& label) { return !labels.contains(label); });
        if (!set.empty()) sets.insert(std::move(set));
    }
    if (!labels.empty()) sets.emplace(labels.begin(), labels.end());
    if (!from.lobe_labels.empty()) sets.emplace(from.lobe_labels.begin(), from.lobe_labels.end());
    return {sets.begin(), sets.end()};
}

CommonNames names_of(std::span<const Reading* const> readings,
                     std::initializer_list<const Dialect*> all) {
    CommonNames names;
    const auto add = [](std::vector<std::string>& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const Reading* reading : readings) {
        add(names.labels, reading->labels);
        add(names.foreign, reading->foreign);
        add(names.foreign_ends, reading->foreign_ends);
    }
    for (const Dialect* dialect : all)
        for (const std::string_view label : dialect->lobe_labels)
            names.lobes.emplace_back(label);
    std::ranges::sort(names.labels);
    names.labels.erase(std::unique(names.labels.begin(), names.labels.end()), names.labels.end());
    if (names.labels.size() > kMaxLabels)
        throw OverBudget{
            Code::LimitLpeLabels,
            "would have to tell " + std::to_string(names.labels.size()) + " labels apart",
            "kMaxLabels = " + std::to_string(kMaxLabels)};
    return names;
}

/// A copy with every test replaced by the events that it takes.
PatternPtr resolve(const Pattern& pattern, const CommonAlphabet& alphabet, const Sight& sight) {
    return rebuild(pattern, [&](const Pattern& node) {
        SymbolSet events = alphabet.none();
        for (Symbol s = 0; s < alphabet.size(); ++s)
            if (sight.visible.has(s) && node.test(sight.views[s].hit)) events.add(s);
        return make_events(std::move(events));
    });
}

/// A copy in which alternatives that are single events are one event.
PatternPtr with_events_joined(const Pattern& pattern) {
    if (pattern.form == Pattern::Form::Event) return make_events(pattern.events);
    if (pattern.parts.empty()) return std::make_shared<Pattern>(pattern);
    std::vector<PatternPtr> parts;
    PatternPtr joined;
    for (const PatternPtr& part : pattern.parts) {
        PatternPtr copy = with_events_joined(*part);
        const bool is_event = copy->form == Pattern::Form::Event;
        if (pattern.form == Pattern::Form::Alternation && is_event && joined)
            joined->events |= copy->events;
        else
            parts.push_back(copy);
        if (is_event && !joined) joined = copy;
    }
    switch (pattern.form) {
        case Pattern::Form::Sequence: return make_sequence(std::move(parts));
        case Pattern::Form::Alternation: return make_alternation(std::move(parts));
        case Pattern::Form::Repeat:
            return make_repeat(std::move(parts[0]), pattern.min, pattern.max);
        default: return make_boolean(pattern.form, std::move(parts));
    }
}

/// A copy with xx* and x*x as x+, for events x.
PatternPtr with_plus(const Pattern& pattern) {
    if (pattern.form == Pattern::Form::Event) return make_events(pattern.events, pattern.text);
    if (pattern.parts.empty()) return std::make_shared<Pattern>(pattern);
    const auto is_star_of = [](const Pattern& star, const Pattern& event) {
        return star.form == Pattern::Form::Repeat && star.min == 0 && star.max == kUnbounded &&
               event.form == Pattern::Form::Event && star.parts[0]->form == Pattern::Form::Event &&
               star.parts[0]->text == event.text;
    };
    std::vector<PatternPtr> parts;
    for (const PatternPtr& part : pattern.parts) {
        PatternPtr copy = with_plus(*part);
        const bool joins = pattern.form == Pattern::Form::Sequence && !parts.empty() &&
                           (is_star_of(*copy, *parts.back()) || is_star_of(*parts.back(), *copy));
        if (joins) {
            PatternPtr event = copy->form == Pattern::Form::Event ? copy : copy->parts[0];
            parts.back() = make_repeat(std::move(event), 1, kUnbounded);
        } else {
            parts.push_back(std::move(copy));
        }
    }
    switch (pattern.form) {
        case Pattern::Form::Sequence: return make_sequence(std::move(parts));
        case Pattern::Form::Alternation: return make_alternation(std::move(parts));
        default: return make_repeat(std::move(parts[0]), pattern.min, pattern.max);
    }
}

bool has_boolean(const Pattern& pattern) {
    return is_boolean(pattern.form) ||
           std::ranges::any_of(pattern.parts,
                               [](const PatternPtr& part) { return has_boolean(*part); });
}

/// The pattern, its events spelled in a dialect.
class Speaker {
  public:
    /// inserted     events that the pattern passes over and the dialect sees
    /// keeps_tests  write tests that take what the pattern's tests take, even if shorter ones
    ///              would do where they stand
    Speaker(const CommonAlphabet& alphabet, const Sight& sight, const Speller& speller,
            const SymbolSet& inserted, bool keeps_tests, const Limits& limits)
        : alphabet_(alphabet),
          sight_(sight),
          speller_(speller),
          keeps_tests_(keeps_tests),
          limits_(limits) {
        if (!inserted.empty()) inserted_ = speller_.spell(inserted, alphabet.none());
    }

    PatternPtr speak(const Pattern& pattern, const SymbolSet& passed_over) {
        uses_ = event_uses(pattern, alphabet_, passed_over, limits_);
        PatternPtr spoken =
            rebuild(pattern, [&](const Pattern& node) { return speak_event(node); });
        if (inserted_) shorten(spoken);
        return spoken;
    }

  private:
    PatternPtr speak_event(const Pattern& node) {
        const EventUse& use = uses_.at(&node);
        const SymbolSet visible = use.taken & sight_.visible;
        const bool may_vanish = use.taken.intersects(sight_.invisible);
        if (visible.empty()) return may_vanish ? make_empty() : make_nothing();
        if (visible.count() == 1 && visible.has(0)) return spelled(visible, alphabet_.none());
        const SymbolSet free = free_of(node, use);
        PatternPtr event = spelled(visible, free);
        // Rather a test that is not alike than one that takes too much.
        if (!(visible | free).contains(event->events)) event = spelled(visible, use.free);
        if (may_vanish) event = make_repeat(event, 0, 1);
        if (!inserted_) return event;
        frees_.emplace(event.get(), free);
        return make_sequence({any_inserted(), event});
    }

    /// What a test may take beside what it must: what the pattern's own test takes where nothing
    /// comes of it.
    [[nodiscard]] SymbolSet free_of(const Pattern& node, const EventUse& use) const {
        if (!keeps_tests_) return use.free & sight_.visible;
        SymbolSet alike = node.events;
        alike.add(0);
        for (Symbol s = 0; s < alphabet_.size(); ++s)
            if (node.events.has(s)) alike.add(alphabet_.twin(s));
        return use.free & sight_.visible & alike;
    }

    PatternPtr spelled(const SymbolSet& wanted, const SymbolSet& free) const {
        Speller::Spelled out = speller_.spell(wanted, free);
        return make_events(std::move(out.events), std::move(out.text));
    }
    /// `<Ts>*`
    PatternPtr any_inserted() const {
        return make_repeat(make_events(inserted_->events, inserted_->text), 0, kUnbounded);
    }

    // ---- shorter without a change of meaning ----

    /// Tries rewrites one by one and keeps those that take the same paths: (<Ts>*D)* as [Ds]*, and
    /// no <Ts>* where it follows from what stands beside it.
    void shorten(PatternPtr& pattern) {
        const Automaton meant = paths_of(*pattern, alphabet_, sight_.invisible, limits_);
        if (meant.n_states() > kMaxRewriteStates) return;
        std::size_t n_left = kMaxRewrites;
        const auto try_as = [&](Pattern& node, const Pattern& replacement) {
            if (n_left == 0) return;
            --n_left;
            const Pattern before = std::exchange(node, replacement);
            if (!same_paths(paths_of(*tidy(*pattern), alphabet_, sight_.invisible, limits_), meant,
                            alphabet_, limits_))
                node = before;
        };
        std::vector<PatternPtr> nodes;
        collect(pattern, nodes);
        for (const PatternPtr& node : nodes)
            if (PatternPtr merged = merged_repeat(*node)) try_as(*node, *merged);
        nodes.clear();
        collect(pattern, nodes);
        for (const PatternPtr& node : nodes)
            if (is_any_inserted(*node)) try_as(*node, *make_empty());
        pattern = tidy(*pattern);
    }

    static void collect(const PatternPtr& node, std::vector<PatternPtr>& out) {
        out.push_back(node);
        for (const PatternPtr& part : node->parts)
            collect(part, out);
    }
    /// Made again by the makers, so that what became empty vanishes.
    static PatternPtr tidy(const Pattern& pattern) {
        return rebuild(pattern,
                       [](const Pattern& node) { return make_events(node.events, node.text); });
    }
    [[nodiscard]] bool is_any_inserted(const Pattern& node) const {
        return node.form == Pattern::Form::Repeat && node.min == 0 && node.max == kUnbounded &&
               node.parts[0]->form == Pattern::Form::Event &&
               node.parts[0]->text == inserted_->text;
    }
    /// (<Ts>*D)* as [Ds]*, (<Ts>*D)+ as <Ts>*D[Ds]*; null for anything else.
    PatternPtr merged_repeat(const Pattern& node) const {
        if (node.form != Pattern::Form::Repeat || node.max != kUnbounded || node.min > 1)
            return nullptr;
        const Pattern& body = *node.parts[0];
        if (body.form != Pattern::Form::Sequence || body.parts.size() != 2 ||
            !is_any_inserted(*body.parts[0]))
            return nullptr;
        const Pattern* event = body.parts[1].get();
        const auto free = frees_.find(event);
        if (event->form == Pattern::Form::Repeat) event = event->parts[0].get();
        if (event->form != Pattern::Form::Event || free == frees_.end()) return nullptr;
        PatternPtr all =
            make_repeat(spelled(event->events | inserted_->events, free->second & sight_.visible),
                        0, kUnbounded);
        if (node.min == 0) return all;
        return make_sequence({body.parts[0], body.parts[1], std::move(all)});
    }

    const CommonAlphabet& alphabet_;
    const Sight& sight_;
    const Speller& speller_;
    bool keeps_tests_;
    const Limits& limits_;
    std::optional<Speller::Spelled> inserted_;
    std::unordered_map<const Pattern*, EventUse> uses_;
    std::unordered_map<const Pattern*, SymbolSet> frees_;
};

/// One translation: what both dialects see, and the paths of the source.
class Translator {
  public:
    Translator(const Reading& source, const Dialect& from, const Dialect& to,
               const TranslateOptions& options)
        : source_(source),
          from_(from),
          to_(to),
          limits_(options.limits),
          alphabet_(names_of(std::vector<const Reading*>{&source}, {&from, &to}), options.without),
          sees_from_(from, alphabet_),
          sees_to_(to, alphabet_),
          speller_(to, alphabet_, sees_to_, label_sets_of(source, from)),
          pattern_(with_events_joined(*resolve(*source.pattern, alphabet_, sees_from_))),
          paths_(
              minimise(paths_of(*pattern_, alphabet_, sees_from_.invisible, limits_), limits_)) {}

    Translation run() {
        Translation out;
        Candidate best = choose();
        out.text = best.text;
        out.lost = path_outside(paths_, best.paths, alphabet_, alphabet_.all(), limits_);
        out.added = path_outside(best.paths, paths_, alphabet_, alphabet_.all(), limits_);
        add_prefixes(out);
        out.notes = source_.notes;
        if (!shortest_path(paths_, alphabet_, limits_))
            out.notes.emplace_back("the expression takes no path at all");
        else if (out.text.empty())
            out.notes.emplace_back("no expression of " + std::string(to_.title) +
                                   " takes any of its paths");
        out.exact = !out.text.empty() && !out.lost && !out.added && out.lost_prefixes.empty();
        if (!out.exact && !out.text.empty() && out.lost_prefixes.empty())
            add_assumptions(best.paths, out);
        add_facts(from_, source_text_, out);
        add_facts(to_, out.text, out);
        return out;
    }

    /// The text that was read, for facts that depend on it.
    void set_source_text(std::string_view text) { source_text_ = text; }
    [[nodiscard]] const Automaton& paths() const { return paths_; }

  private:
    struct Candidate {
        std::string text;
        Automaton paths;
        bool exact = false;
    };

    /// Spells a pattern and reads it back.
    Candidate candidate(const Pattern& pattern, const SymbolSet& passed_over, bool keeps_tests) {
        Speaker speaker(alphabet_, sees_to_, speller_, passed_over & sees_to_.visible, keeps_tests,
                        limits_);
        Candidate out;
        out.text = write(*with_plus(*speaker.speak(pattern, passed_over)), to_.repeats);
        Diagnostics diagnostics;
        PatternPtr read = make_nothing();
        if (!out.text.empty()) {
            const Reading again = to_.read(out.text, {}, diagnostics);
            if (diagnostics.has_errors()) throw OverBudget(limit_of(diagnostics));
            LIGHTSIEVE_ASSERT(again.pattern != nullptr, out.text);
            read = resolve(*again.pattern, alphabet_, sees_to_);
        }
        out.paths = paths_of(*read, alphabet_, sees_to_.invisible, limits_);
        out.exact = same_paths(out.paths, paths_, alphabet_, limits_);
        return out;
    }

    /// What the other dialect's reader refused: only a limit can be the reason.
    static OverBudget limit_of(const Diagnostics& diagnostics) {
        const Error& error = diagnostics.items().front();
        LIGHTSIEVE_ASSERT(code_text(error.code).starts_with("limit-"), diagnostics.render());
        // Its hint is "the limit NAME is N".
        const std::size_t name = error.hint.find("kMax");
        return {error.code, "cannot be read back: " + error.message,
                name == std::string::npos ? error.hint : error.hint.substr(name)};
    }

    /// The expression's own shape if that is exact; else the shape of its automaton, which tells
    /// more places apart, if that is nearer.
    Candidate choose() {
        const bool keeps_shape = !has_boolean(*pattern_);
        std::optional<Candidate> own;
        if (keeps_shape) own = candidate(*pattern_, sees_from_.invisible, true);
        if (own && (own->exact || paths_.n_states() > kMaxEliminatedStates))
            return *std::move(own);
        if (paths_.n_states() > kMaxEliminatedStates)
            throw OverBudget{Code::LimitLpeStates,
                             "is too intricate to be written without & and -: it needs " +
                                 std::to_string(paths_.n_states()) + " states",
                             std::to_string(kMaxEliminatedStates) + " states"};
        try {
            const PatternPtr pattern = with_events_joined(*to_pattern(paths_, alphabet_, limits_));
            if (own && count_nodes(*pattern) > kMaxEliminatedNodes) return *std::move(own);
            Candidate other = candidate(*pattern, alphabet_.none(), false);
            const bool nearer =
                !own || other.exact ||
                (path_outside(own->paths, other.paths, alphabet_, alphabet_.all(), limits_) &&
                 !path_outside(other.paths, own->paths, alphabet_, alphabet_.all(), limits_));
            if (nearer) return other;
        } catch (const OverBudget&) {
            if (!own) throw;
        }
        return *std::move(own);
    }

    void add_prefixes(Translation& out) const {
        std::string before;
        for (const std::string& name : source_.prefixes) {
            const auto row = std::ranges::find(to_.prefixes, name, &Prefix::name);
            if (row == to_.prefixes.end())
                out.lost_prefixes.push_back(name);
            else
                before += std::string(row->spelled) + ";";
        }
        if (!out.text.empty()) out.text = before + out.text;
    }

    /// The fewest things that a scene must do without for the translation to be exact.
    void add_assumptions(const Automaton& paths, Translation& out) const {
        const Automaton none = nothing();
        std::vector<unsigned> choices;
        for (unsigned bits = 1; bits < 1U << kWithouts; ++bits)
            choices.push_back(bits);
        std::ranges::stable_sort(choices, {}, [](unsigned bits) { return std::popcount(bits); });
        for (const unsigned bits : choices) {
            SymbolSet events = alphabet_.all();
            std::vector<Without> without;
            for (std::size_t i = 0; i < kWithouts; ++i) {
                if ((bits >> i & 1U) == 0) continue;
                without.push_back(static_cast<Without>(i));
                events &= alphabet_.all_without(without.back());
            }
            if (path_outside(paths_, paths, alphabet_, events, limits_) ||
                path_outside(paths, paths_, alphabet_, events, limits_))
                continue;
            // Leaving all of its paths out proves nothing.
            if (path_outside(paths_, none, alphabet_, events, limits_))
                out.exact_without = std::move(without);
            if (!out.exact_without.empty()) return;
        }
    }
    [[nodiscard]] Automaton nothing() const {
        Automaton out = paths_;
        out.accepts.assign(out.n_states(), false);
        return out;
    }

    /// Kinds of events that the source's tests take, as bits.
    [[nodiscard]] std::uint32_t kinds_of(const Pattern& node) const {
        std::uint32_t out = 0;
        if (node.form == Pattern::Form::Event)
            for (Symbol s = 0; s < alphabet_.size(); ++s)
                if (node.events.has(s)) out |= Fact::bit(alphabet_.event(s).kind);
        for (const PatternPtr& part : node.parts)
            out |= kinds_of(*part);
        return out;
    }

    void add_facts(const Dialect& dialect, std::string_view text, Translation& out) const {
        std::uint32_t used = kinds_of(*pattern_);
        for (Symbol s = 0; s < alphabet_.size(); ++s)
            if (sees_from_.invisible.has(s)) used |= Fact::bit(alphabet_.event(s).kind);
        for (const Fact& fact : dialect.facts) {
            const bool matters = !fact.verified &&
                                 (fact.mark.empty() || text.find(fact.mark) != text.npos) &&
                                 (fact.kinds == 0 || (fact.kinds & used) != 0);
            if (!matters) continue;
            std::string line = std::string(dialect.name) + ": " + std::string(fact.text);
            if (std::ranges::find(out.unverified, line) == out.unverified.end())
                out.unverified.push_back(std::move(line));
        }
    }

    const Reading& source_;
    const Dialect &from_, &to_;
    Limits limits_;
    CommonAlphabet alphabet_;
    Sight sees_from_, sees_to_;
    Speller speller_;
    PatternPtr pattern_;  ///< the source, resolved
    Automaton paths_;     ///< the source's paths
    std::string_view source_text_;
};

/// Compares two readings of one text.
void compare_readings(const Reading& read, const Reading& meant, const Dialect& dialect,
                      const Limits& limits, AsRead& out) {
    const std::vector<const Reading*> both{&read, &meant};
    const CommonAlphabet alphabet(names_of(both, {&dialect}), {});
    const Sight sight(dialect, alphabet);
    const auto paths = [&](const Reading& reading) {
        return paths_of(*resolve(*reading.pattern, alphabet, sight), alphabet, sight.invisible,
                        limits);
    };
    const Automaton as_read = paths(read), as_meant = paths(meant);
    out.missed = path_outside(as_meant, as_read, alphabet, alphabet.all(), limits);
    out.extra = path_outside(as_read, as_meant, alphabet, alphabet.all(), limits);
    out.differs = out.missed || out.extra;
}

Reading read_text(std::string_view text, const SourceSpan& base, const Dialect& dialect,
                  Diagnostics& diagnostics) {
    const std::size_t before = diagnostics.n_errors();
    Reading reading = dialect.read(text, base, diagnostics);
    if (diagnostics.n_errors() > before) reading.pattern = nullptr;
    return reading;
}

/// Says so where `|` binds tightly and that makes a difference.
void lint_binding(std::string_view text, const SourceSpan& where, const Dialect& dialect,
                  const Reading& reading, const Limits& limits, Diagnostics& diagnostics) {
    if (dialect.read_as_meant == nullptr || text.find('|') == std::string_view::npos) return;
    Diagnostics ignored;
    const Reading meant = dialect.read_as_meant(text, where, ignored);
    if (!meant.pattern || ignored.has_errors()) return;
    AsRead both;
    compare_readings(reading, meant, dialect, limits, both);
    if (!both.differs) return;
    diagnostics.lint(Code::LpeMisread,
                     std::string(dialect.title) + " reads this otherwise than it looks: it " +
                         (both.missed ? "leaves out \"" + print_path(*both.missed)
                                      : "takes \"" + print_path(*both.extra)) +
                         "\"",
                     where, "alternatives are written ((..)|(..))");
}

}  // namespace

std::optional<Translation> translate(std::string_view text, const SourceSpan& base,
                                     const Dialect& from, const Dialect& to,
                                     Diagnostics& diagnostics, const TranslateOptions& options) {
    const SourceSpan where = base.known() ? base : stand_alone(text);
    const Reading reading = read_text(text, where, from, diagnostics);
    if (!reading.pattern) return std::nullopt;
    try {
        Translator translator(reading, from, to, options);
        translator.set_source_text(text);
        Translation out = translator.run();
        lint_binding(text, where, from, reading, options.limits, diagnostics);
        if (!out.exact && to.variant != nullptr) {
            const Dialect& variant = to.variant();
            Translator other(reading, from, variant, options);
            const Translation better = other.run();
            if (better.exact)
                out.notes.push_back("exact for " + std::string(variant.name) + ": " + better.text);
        }
        return out;
    } catch (const OverBudget& over) {
        diagnostics.add(over.error("the translation", where));
        return std::nullopt;
    }
}

std::optional<AsRead> read_as(std::string_view text, const SourceSpan& base,
                              const Dialect& dialect, Diagnostics& diagnostics,
                              const Limits& limits) {
    const SourceSpan where = base.known() ? base : stand_alone(text);
    const Reading reading = read_text(text, where, dialect, diagnostics);
    if (!reading.pattern) return std::nullopt;
    const auto respelled = [&](const Reading& source, const Dialect& to) {
        Translator translator(source, dialect, to, {{}, limits});
        return translator.run();
    };
    try {
        AsRead out;
        Translation as_read = respelled(reading, dialect);
        out.text = as_read.text;
        out.notes = std::move(as_read.notes);
        if (dialect.read_as_meant == nullptr) {
            out.meant = out.text;
            return out;
        }
        Diagnostics ignored;
        const Reading meant = dialect.read_as_meant(text, where, ignored);
        if (!meant.pattern || ignored.has_errors()) return out;
        compare_readings(reading, meant, dialect, limits, out);
        if (!out.differs) {
            out.meant = out.text;
            return out;
        }
        const Translation other = respelled(meant, dialect);
        if (other.exact) {
            out.meant = other.text;
            return out;
        }
        out.notes.push_back("what is meant cannot be written for " + std::string(dialect.title));
        if (dialect.variant == nullptr) return out;
        const Translation better = respelled(meant, dialect.variant());
        if (better.exact)
            out.notes.push_back("for " + std::string(dialect.variant().name) + " it is " +
                                better.text);
        return out;
    } catch (const OverBudget& over) {
        diagnostics.add(over.error("the translation", where));
        return std::nullopt;
    }
}

}  // namespace lightsieve::lpe::dialects
