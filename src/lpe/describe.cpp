#include "lpe/describe.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "lpe/predicate.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

using Texts = std::vector<std::string>;

/// Where a path may be, as a bit set.
using Places = unsigned;
constexpr Places kStart = 1, kUnderWay = 2, kEnded = 4, kAll = 7;

/// What of the notation is quoted where words would be too many.
constexpr std::size_t kMaxQuoted = 60;

/// The events that a test, or several of which one must hold, can take.
struct Taken {
    bool camera = false, scattering = false, terminal = false;
    EventSet set{};

    void add(const Node& test, const EventNames& names) {
        const std::vector<Event>& events = names.events();
        camera = camera || takes(test, Event{});
        set.resize(events.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            if (!takes(test, events[i])) continue;
            set[i] = true;
            (is_terminal(events[i].kind) ? terminal : scattering) = true;
        }
    }
};

std::string count_words(std::uint32_t n) {
    if (n == 1) return "once";
    if (n == 2) return "twice";
    return std::to_string(n) + " times";
}

std::string times_words(std::uint32_t min, std::uint32_t max) {
    const bool unbounded = max == Repeat::kUnbounded;
    if (unbounded && min == 0) return "zero or more times";
    if (unbounded && min == 1) return "one or more times";
    if (unbounded) return std::to_string(min) + " or more times";
    if (min == max) return count_words(min);
    if (min == 0) return "at most " + count_words(max);
    return std::to_string(min) + " to " + std::to_string(max) + " times";
}

std::string quoted_notation(const Node& node) {
    std::string text = print(node);
    if (text.size() > kMaxQuoted) text = text.substr(0, kMaxQuoted) + "...";
    return "`" + text + "`";
}

/// The parts of a sequence; the node itself if it is none.
std::vector<Expr> parts_of(const Expr& expr) {
    if (const auto* sequence = std::get_if<Sequence>(&expr->form)) return sequence->parts;
    return {expr};
}

/// `((CVA)|(C<RD>A))` as `C(V|<RD>)A`: alternatives that differ in one event become one sequence.
Expr factored(const Expr& expr) {
    const auto* alternation = std::get_if<Alternation>(&expr->form);
    if (alternation == nullptr) return expr;
    std::vector<std::vector<Expr>> rows;
    for (const Expr& part : alternation->parts)
        rows.push_back(parts_of(part));
    const std::size_t n = rows.front().size();
    std::optional<std::size_t> differs;
    for (const std::vector<Expr>& row : rows) {
        if (row.size() != n) return expr;
        for (std::size_t i = 0; i < n; ++i) {
            if (equal(row[i], rows.front()[i])) continue;
            if (differs && *differs != i) return expr;
            differs = i;
        }
    }
    if (n < 2 || !differs) return expr;
    Alternation choice;
    for (const std::vector<Expr>& row : rows)
        choice.parts.push_back(row[*differs]);
    Sequence out{rows.front()};
    out.parts[*differs] = std::make_shared<const Node>(Node{std::move(choice), {}});
    return std::make_shared<const Node>(Node{std::move(out), {}});
}

class Describer {
  public:
    explicit Describer(const EventNames& names) : names_(names) {}

    /// The expression as a noun, with what its references stand for.
    std::string run(const Expr& expr) {
        std::string out = paths(expr);
        std::set<std::string> told;
        for (std::size_t i = 0; i < references_.size(); ++i) {
            const Reference& reference = *references_[i];
            if (!reference.body || !told.insert(reference.name).second) continue;
            out += "; " + reference.name + " takes " + paths(reference.body);
        }
        return out;
    }

  private:
    struct Visit {
        const Node* node;
        Places places;
        bool forward;
        friend auto operator<=>(const Visit&, const Visit&) = default;
    };

    /// A whole expression: it starts at the camera and must end.
    std::string paths(const Expr& written) {
        const Expr expr = keep(factored(written));
        if ((forward(*expr, kStart) & kEnded) == 0) return "no path";
        if (const auto* reference = std::get_if<Reference>(&expr->form)) {
            references_.push_back(reference);
            return "what " + reference->name + " takes";
        }
        if (const auto* all = std::get_if<Intersection>(&expr->form))
            return joined_paths(all->parts, ", if they are also ", ", and also ");
        if (const auto* difference = std::get_if<Difference>(&expr->form))
            return joined_paths(difference->parts, ", but not ", ", nor ");
        if (const auto* complement = std::get_if<Complement>(&expr->form))
            return "all light but " + operand(complement->body);
        if (const auto* alternation = std::get_if<Alternation>(&expr->form)) {
            Texts kinds;
            for (const Expr& part : alternation->parts)
                if ((forward(*part, kStart) & kEnded) != 0) kinds.push_back(paths(part));
            std::string out;
            for (const std::string& kind : kinds)
                out += (out.empty() ? "" : "; and ") + kind;
            return out;
        }
        return "paths that " + join_words(clauses(*expr, kStart, kEnded), "and");
    }

    std::string joined_paths(const std::vector<Expr>& parts, const char* first,
                             const char* further) {
        std::string out;
        for (std::size_t i = 0; i < parts.size(); ++i)
            out += (i == 0 ? "" : i == 1 ? first : further) + operand(parts[i]);
        return out;
    }

    /// In parentheses, unless it is paths that do this and that, or a name.
    std::string operand(const Expr& expr) {
        const Expr form = factored(expr);
        const bool open = std::holds_alternative<Intersection>(form->form) ||
                          std::holds_alternative<Difference>(form->form) ||
                          std::holds_alternative<Complement>(form->form) ||
                          std::holds_alternative<Alternation>(form->form);
        return open ? "(" + paths(expr) + ")" : paths(expr);
    }

    /// What a part of an expression says, one verb a clause.
    ///
    /// from  where a path may be before the part
    /// to    where it may be after it, so that the rest can follow
    Texts clauses(const Node& node, Places from, Places to) {
        if (++n_nodes_ > kMaxWordNodes) return {"go on as " + quoted_notation(node)};
        if (is_event_test(node)) return event_clauses(taken(node), from, to);
        if (const auto* sequence = std::get_if<Sequence>(&node.form))
            return sequence_clauses(*sequence, from, to);
        if (const auto* alternation = std::get_if<Alternation>(&node.form))
            return alternation_clauses(*alternation, from, to);
        if (const auto* repeat = std::get_if<Repeat>(&node.form))
            return repeat_clauses(*repeat, from, to);
        const std::span<const Expr> parts = children(node);
        if (parts.size() > 1) {
            const bool both = std::holds_alternative<Intersection>(node.form);
            std::string out = join_words(clauses(*parts[0], from, to), "and");
            for (std::size_t i = 1; i < parts.size(); ++i)
                out += std::string(both ? " (where they also " : " (but not if they ") +
                       join_words(clauses(*parts[i], from, to), "and") + ")";
            return {out};
        }
        // A whole expression where only the rest of one fits: it can only be all of it.
        return {"fit " + quoted_notation(node)};
    }

    Texts sequence_clauses(const Sequence& sequence, Places from, Places to) {
        std::vector<Places> after(sequence.parts.size() + 1, to);
        for (std::size_t i = sequence.parts.size(); i-- > 0;)
            after[i] = backward(*sequence.parts[i], after[i + 1]);
        Texts out;
        std::string last;
        std::uint32_t n_alike = 0;
        Places here = from & after[0];
        for (std::size_t i = 0; i < sequence.parts.size(); ++i) {
            const Node& part = *sequence.parts[i];
            // What has ended goes on with nothing: no words for that.
            if (here != kEnded)
                for (const std::string& clause : clauses(part, here, after[i + 1])) {
                    // The same event once more is not said once more.
                    n_alike = is_event_test(part) && clause == last ? n_alike + 1 : 1;
                    last = clause;
                    if (n_alike == 1)
                        out.push_back(clause);
                    else
                        out.back() = clause + " " + count_words(n_alike);
                }
            here = forward(part, here) & after[i + 1];
        }
        return out;
    }

    Texts event_clauses(const Taken& taken, Places from, Places to) {
        if ((from & kStart) != 0 && taken.camera) return {"leave the camera"};
        const auto [scattering, terminal] = allowed(taken, to);
        const std::string scattered = names_.scatters(scattering), ended = names_.ends(terminal);
        std::string out = scattered.empty() ? "" : "are " + scattered;
        if (!ended.empty()) out += (out.empty() ? "end " : " or end ") + ended;
        return with_condition(out, from);
    }

    Texts alternation_clauses(const Alternation& alternation, Places from, Places to) {
        const bool single = std::ranges::all_of(
            alternation.parts, [](const Expr& part) { return is_event_test(*part); });
        if (single) return event_clauses(taken_by_one_of(alternation.parts), from, to);
        Texts options;
        for (const Expr& part : alternation.parts)
            if ((forward(*part, from) & to) != 0)
                options.push_back(join_words(clauses(*part, from, to), "and then"));
        if (options.size() < 2) return options;
        return {"either " + join_words(options, "or")};
    }

    Texts repeat_clauses(const Repeat& repeat, Places from, Places to) {
        if (repeat.max == 0) return {};
        const Places loop_from = from | forward_often(repeat, from),
                     loop_to = to | backward_often(repeat, to);
        if (!is_single(*repeat.body)) {
            const std::string body =
                join_words(clauses(*repeat.body, loop_from, loop_to), "and then");
            return with_condition(
                "repeat " + times_words(repeat.min, repeat.max) + ": (" + body + ")", from);
        }
        const Taken body = taken(*repeat.body);
        const auto [scattering, terminal] = allowed(body, loop_to);
        const std::string scattered = names_.scatters(scattering), ended = names_.ends(terminal);
        const bool must_end = (to & kUnderWay) == 0;
        if (ended.empty() || !must_end) return plain_repeat(repeat, scattered, ended, from);
        if (scattered.empty()) return with_condition("end " + ended, from);
        const bool any = is_everything(scattering, terminal);
        if (any && repeat.min <= 1 && repeat.max == Repeat::kUnbounded)
            return with_condition("go on in any way", from);
        // The last of the events is where the path ends; the others scatter it.
        const std::uint32_t min = repeat.min == 0 ? 0 : repeat.min - 1;
        const std::uint32_t max = repeat.max == Repeat::kUnbounded ? repeat.max : repeat.max - 1;
        Texts out;
        if (max > 0) out = with_condition("are " + scattered + " " + times_words(min, max), from);
        for (std::string& clause : with_condition("end " + ended, from))
            out.push_back(std::move(clause));
        return out;
    }

    Texts plain_repeat(const Repeat& repeat, const std::string& scattered,
                       const std::string& ended, Places from) {
        const std::string times = times_words(repeat.min, repeat.max);
        if (ended.empty() && scattered.empty()) return {};
        if (ended.empty()) return with_condition("are " + scattered + " " + times, from);
        if (scattered.empty()) return with_condition("may end " + ended, from);
        return with_condition("are " + scattered + " or end " + ended + ", " + times, from);
    }

    static Texts with_condition(std::string clause, Places from) {
        if (clause.empty()) return {};
        if ((from & kEnded) != 0) clause += " (if they have not ended)";
        return {std::move(clause)};
    }

    // ---- events ----

    [[nodiscard]] static bool is_single(const Node& node) {
        if (is_event_test(node)) return true;
        const auto* alternation = std::get_if<Alternation>(&node.form);
        return alternation != nullptr &&
               std::ranges::all_of(alternation->parts,
                                   [](const Expr& part) { return is_event_test(*part); });
    }

    Taken taken(const Node& node) {
        Taken out;
        if (const auto* alternation = std::get_if<Alternation>(&node.form))
            return taken_by_one_of(alternation->parts);
        out.add(node, names_);
        return out;
    }
    Taken taken_by_one_of(const std::vector<Expr>& tests) {
        Taken out;
        for (const Expr& test : tests)
            out.add(*test, names_);
        return out;
    }

    /// The scattering and the terminal events of a test that may stand where `to` follows.
    [[nodiscard]] std::pair<EventSet, EventSet> allowed(const Taken& taken, Places to) const {
        EventSet scattering(taken.set.size()), terminal(taken.set.size());
        for (std::size_t i = 0; i < taken.set.size(); ++i) {
            const bool ends = is_terminal(names_.events()[i].kind);
            if (taken.set[i] && ends && (to & kEnded) != 0) terminal[i] = true;
            if (taken.set[i] && !ends && (to & kUnderWay) != 0) scattering[i] = true;
        }
        return {std::move(scattering), std::move(terminal)};
    }

    [[nodiscard]] bool is_everything(const EventSet& scattering, const EventSet& terminal) const {
        for (std::size_t i = 0; i < scattering.size(); ++i)
            if (!scattering[i] && !terminal[i] && names_.events()[i].kind != EventKind::Albedo)
                return false;
        return true;
    }

    // ---- where a path may be ----

    /// Where it may be after the part, from each of these places.
    Places forward(const Node& node, Places from) { return visit(node, from, true); }
    /// From where the part leads to one of these places.
    Places backward(const Node& node, Places to) { return visit(node, to, false); }

    Places visit(const Node& node, Places places, bool is_forward) {
        const auto [entry, is_new] = memo_.try_emplace(Visit{&node, places, is_forward}, 0U);
        if (!is_new) return entry->second;
        return memo_[{&node, places, is_forward}] = visit_now(node, places, is_forward);
    }

    Places visit_now(const Node& node, Places places, bool is_forward) {
        if (is_event_test(node)) return step(node, places, is_forward);
        if (const auto* repeat = std::get_if<Repeat>(&node.form))
            return (repeat->min == 0 ? places : 0U) | often(*repeat, places, is_forward);
        if (std::holds_alternative<Complement>(node.form)) {
            // As C.*: from the camera to anywhere.
            constexpr Places kBegun = kUnderWay | kEnded;
            if (is_forward) return (places & kStart) != 0 ? kBegun : 0U;
            return (places & kBegun) != 0 ? kStart : 0U;
        }
        const std::span<const Expr> parts = children(node);
        if (std::holds_alternative<Difference>(node.form))
            return visit(*parts.front(), places, is_forward);
        if (std::holds_alternative<Sequence>(node.form)) {
            Places here = places;
            for (std::size_t i = 0; i < parts.size(); ++i)
                here = visit(*parts[is_forward ? i : parts.size() - 1 - i], here, is_forward);
            return here;
        }
        const bool all = std::holds_alternative<Intersection>(node.form);
        Places out = all ? kAll : 0U;
        for (const Expr& part : parts) {
            const Places one = visit(*part, places, is_forward);
            out = all ? out & one : out | one;
        }
        return out;
    }

    Places step(const Node& test, Places places, bool is_forward) {
        const Taken taken = this->taken(test);
        Places out = 0;
        const auto connect = [&](bool can, Places from, Places to) {
            if (can && (places & (is_forward ? from : to)) != 0) out |= is_forward ? to : from;
        };
        connect(taken.camera, kStart, kUnderWay);
        connect(taken.scattering, kUnderWay, kUnderWay);
        connect(taken.terminal, kUnderWay, kEnded);
        return out;
    }

    /// After repeating the body as often as is allowed, at least once.
    Places often(const Repeat& repeat, Places places, bool is_forward) {
        // A path is in one of three places and never goes back: after three rounds nothing is new.
        constexpr std::uint32_t kRounds = 4;
        const std::uint32_t min = std::min(repeat.min, kRounds);
        Places out = 0, here = places;
        for (std::uint32_t i = 1; i <= std::min(repeat.max, min + kRounds); ++i) {
            here = visit(*repeat.body, here, is_forward);
            if (i >= min) out |= here;
        }
        return out;
    }
    Places forward_often(const Repeat& repeat, Places from) {
        return often({repeat.body, 1, repeat.max}, from, true);
    }
    Places backward_often(const Repeat& repeat, Places to) {
        return often({repeat.body, 1, repeat.max}, to, false);
    }

    /// Trees that were made here must live as long as what is remembered of them.
    Expr keep(Expr expr) { return kept_.emplace_back(std::move(expr)); }

    const EventNames& names_;
    std::map<Visit, Places> memo_;
    std::vector<Expr> kept_;
    std::vector<const Reference*> references_;
    std::size_t n_nodes_ = 0;
};

}  // namespace

std::string expression_in_words(const Expr& expr, const EventNames& names) {
    if (!expr) return "no path";
    return Describer(names).run(expr);
}

}  // namespace lightsieve::lpe
