#include "lpe/event_cover.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "lpe/predicate.h"
#include "lpe/print.h"

namespace lightsieve::lpe {
namespace {

/// Steps of branch and bound before the best cover so far is taken.
constexpr std::size_t kMaxSteps = 2000;
/// What "not without" costs a reader, in characters.
constexpr std::size_t kDoubleNegation = 12;
/// Labels of which tests with two of them are tried.
constexpr std::size_t kMaxPairedLabels = 6;

Expr make(auto form) { return std::make_shared<const Node>(Node{std::move(form), {}}); }

LetterTest letters(const char* text) {
    const std::string written(text);
    if (written.empty()) return {};
    if (written == ".") return {LetterTest::Form::Any, ""};
    return {written.size() == 1 ? LetterTest::Form::One : LetterTest::Form::OneOf, written};
}

LabelTest carries_one_of(std::vector<std::string> labels) {
    const auto form = labels.size() == 1 ? LabelTest::Form::One : LabelTest::Form::OneOf;
    return {form, std::move(labels), {}};
}
LabelTest carries_none_of(std::vector<std::string> labels) {
    return {LabelTest::Form::NoneOf, std::move(labels), {}};
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

bool has_any(const Event& event, const std::vector<std::string>& labels) {
    return std::ranges::any_of(labels, [&](const std::string& l) { return carries(event, l); });
}

}  // namespace

/// Branch and bound: the cheapest items that together take all that is required.
class EventCover::Search {
  public:
    Search(const std::vector<Item>& items, const Set& required)
        : items_(items), required_(required) {}

    std::vector<Item> run() {
        greedy();
        std::vector<std::size_t> chosen;
        branch(required_, chosen, 0);
        std::vector<Item> out;
        for (const std::size_t i : best_)
            out.push_back(items_[i]);
        return out;
    }

  private:
    /// The item that takes most for its length, again and again.
    void greedy() {
        best_cost_ = 0;
        for (Set open = required_; open.any();) {
            std::size_t best = 0;
            double best_gain = -1;
            for (std::size_t i = 0; i < items_.size(); ++i) {
                const double gain = static_cast<double>((items_[i].takes & open).count()) /
                                    static_cast<double>(items_[i].cost);
                if (gain > best_gain) best = i, best_gain = gain;
            }
            open &= ~items_[best].takes;
            best_.push_back(best);
            best_cost_ += items_[best].cost;
        }
    }

    void branch(const Set& open, std::vector<std::size_t>& chosen, std::size_t cost) {
        if (open.none()) {
            best_ = chosen;
            best_cost_ = cost;
            return;
        }
        // The event that the fewest items take must be taken by one of them.
        std::size_t n_fewest = SIZE_MAX, event = 0;
        for (std::size_t e = 0; e < open.size(); ++e) {
            if (!open[e]) continue;
            const auto takes = [&](const Item& item) { return bool{item.takes[e]}; };
            const auto n = static_cast<std::size_t>(std::ranges::count_if(items_, takes));
            if (n < n_fewest) n_fewest = n, event = e;
        }
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (!items_[i].takes[event] || cost + items_[i].cost >= best_cost_) continue;
            if (++n_steps_ > kMaxSteps) return;
            chosen.push_back(i);
            branch(open & ~items_[i].takes, chosen, cost + items_[i].cost);
            chosen.pop_back();
        }
    }

    const std::vector<Item>& items_;
    const Set& required_;
    std::vector<std::size_t> best_;
    std::size_t best_cost_ = 0, n_steps_ = 0;
};

EventCover::EventCover(std::span<const Event> events, const LabelClasses& labels)
    : events_(events), labels_(labels) {
    for (std::size_t e = 0; e < events.size(); ++e)
        ordinary_[e] = events[e].kind != EventKind::Albedo;
    for (const char letter : {'D', 'S', 'R', 'T', 'V', 'L', 'O', 'B', 'A'})
        add_item(items_, make(Letter{letter}));
    add_item(items_, make(Dot{}));
    add_heads();
    add_labelled(kMaxPairedLabels);
    keep_cheapest();
}

void EventCover::add_item(std::vector<Item>& to, Expr test) const {
    Item item{std::move(test), {}, 0};
    for (std::size_t e = 0; e < events_.size(); ++e)
        item.takes[e] = takes(*item.test, events_[e]);
    item.cost = print(item.test).size();
    if (item.takes.any()) to.push_back(std::move(item));
}

void EventCover::add_heads() {
    const auto head = [&](const char* kind, const char* lobe, bool is_light) {
        heads_.push_back({{letters(kind), letters(lobe), {}}, is_light});
        add_item(items_, make(heads_.back().angle));
    };
    for (const char* kind : {"R", "T", "."})
        for (const char* lobe : {"D", "S"})
            head(kind, lobe, false);
    for (const char* kind : {"R", "T", "V", "O", "RT", "RTV"})
        head(kind, ".", false);
    for (const char* kind : {"L", "B", "LB"})
        head(kind, ".", true);
}

/// Tests of one label, and of two if there are few.
void EventCover::add_labelled(std::size_t max_paired) {
    for (const Head& head : heads_) {
        const auto& labels = labels_of(head);
        const auto add = [&](std::vector<LabelTest> tests) {
            Angle angle = head.angle;
            angle.labels = std::move(tests);
            add_item(items_, make(std::move(angle)));
        };
        for (const auto& a : labels) {
            add({carries_one_of(a)});
            add({carries_none_of(a)});
            if (labels.size() > max_paired) continue;
            for (const auto& b : labels) {
                if (a == b) continue;
                add({carries_one_of(a), carries_none_of(b)});
                if (a > b) continue;
                add({carries_one_of(a), carries_one_of(b)});
                add({carries_one_of(joined(a, b))});
                add({carries_none_of(joined(a, b))});
            }
        }
    }
    // A label on its own also takes lights of that group: it must mean the same there.
    for (const auto& same : labels_.lobes)
        if (same.size() == 1 && std::ranges::find(labels_.groups, same) != labels_.groups.end())
            add_item(items_, make(Label{same[0]}));
}

/// Of items that take the same, the shortest.
void EventCover::keep_cheapest() {
    std::unordered_map<Set, std::size_t> best;
    std::vector<Item> kept;
    for (Item& item : items_) {
        const auto [entry, is_new] = best.emplace(item.takes, kept.size());
        if (is_new)
            kept.push_back(std::move(item));
        else if (item.cost < kept[entry->second].cost)
            kept[entry->second] = std::move(item);
    }
    items_ = std::move(kept);
}

/// `<RS[^'a''b']>` with few labels, such that nothing forbidden is taken; null if there is none.
Expr EventCover::excluding(const Head& head, const Set& forbidden) const {
    Angle angle = head.angle;
    const Node bare{angle, {}};
    std::vector<const Event*> left;
    for (std::size_t e = 0; e < events_.size(); ++e)
        if (forbidden[e] && takes(bare, events_[e])) left.push_back(&events_[e]);
    std::vector<std::string> excluded;
    while (!left.empty()) {
        const std::vector<std::string>* best = nullptr;
        std::size_t n_best = 0;
        for (const auto& same : labels_of(head)) {
            const auto hit = [&](const Event* event) { return has_any(*event, same); };
            const auto n = static_cast<std::size_t>(std::ranges::count_if(left, hit));
            if (n > n_best) best = &same, n_best = n;
        }
        if (best == nullptr) return nullptr;
        std::erase_if(left, [&](const Event* event) { return has_any(*event, *best); });
        excluded = joined(std::move(excluded), *best);
    }
    if (excluded.empty()) return nullptr;
    angle.labels.push_back(carries_none_of(std::move(excluded)));
    return make(std::move(angle));
}

/// `<RS['a''b']>` with every label that nothing forbidden carries; null if there is none.
Expr EventCover::one_of(const Head& head, const Set& forbidden) const {
    Angle angle = head.angle;
    const Node bare{angle, {}};
    std::vector<std::string> labels;
    for (const auto& same : labels_of(head)) {
        bool good = true;
        for (std::size_t e = 0; good && e < events_.size(); ++e)
            good = !forbidden[e] || !has_any(events_[e], same) || !takes(bare, events_[e]);
        if (good) labels = joined(std::move(labels), same);
    }
    if (labels.empty()) return nullptr;
    angle.labels.push_back(carries_one_of(std::move(labels)));
    return make(std::move(angle));
}

/// A test that takes no other event of the list (but those that differ in labels without a name).
Expr EventCover::exactly(std::size_t e) const {
    const Event& event = events_[e];
    const auto letter_of = [&](EventKind kind) {
        return std::string{"CRTVLOBA"[static_cast<std::size_t>(kind)]};
    };
    const char* lobe = event.lobe == EventLobe::Diffuse    ? "D"
                       : event.lobe == EventLobe::Specular ? "S"
                                                           : ".";
    Angle angle{letters(letter_of(event.kind).c_str()), letters(lobe), {}};
    const bool is_light = event.kind == EventKind::Light || event.kind == EventKind::Background;
    std::vector<std::string> others;
    for (const auto& same : is_light ? labels_.groups : labels_.lobes) {
        if (has_any(event, same))
            angle.labels.push_back(carries_one_of(same));
        else
            others = joined(std::move(others), same);
    }
    if (!others.empty()) angle.labels.push_back(carries_none_of(std::move(others)));
    return make(std::move(angle));
}

/// Items that take something required and nothing forbidden, without those that a better one
/// replaces.
std::vector<EventCover::Item> EventCover::items_for(const Set& required,
                                                    const Set& allowed) const {
    std::vector<Item> found;
    const auto add_if_good = [&](Item item) {
        if ((item.takes & ~allowed).any()) return;
        item.takes &= required;
        if (item.takes.any()) found.push_back(std::move(item));
    };
    for (const Item& item : items_)
        add_if_good(item);
    std::vector<Item> made;
    const Set forbidden = ~allowed;
    for (const Head& head : heads_)
        for (Expr& test : std::array{excluding(head, forbidden), one_of(head, forbidden)})
            if (test) add_item(made, std::move(test));
    Set reached;
    for (const Item& item : found)
        reached |= item.takes;
    for (std::size_t e = 0; e < events_.size(); ++e)
        if (required[e] && !reached[e]) add_item(made, exactly(e));
    for (Item& item : made)
        add_if_good(std::move(item));

    std::ranges::stable_sort(found, {}, &Item::cost);
    std::vector<Item> kept;
    for (Item& item : found) {
        const auto replaces = [&](const Item& other) {
            return (item.takes & ~other.takes).none();
        };
        if (std::ranges::none_of(kept, replaces)) kept.push_back(std::move(item));
    }
    return kept;
}

std::vector<EventCover::Item> EventCover::cover(const Set& required, const Set& optional) const {
    const std::vector<Item> items = items_for(required, required | optional);
    return Search(items, required).run();
}

Expr EventCover::test_for(const Set& required, const Set& optional) const {
    const auto cost_of = [](const std::vector<Item>& items) {
        std::size_t cost = 0;
        for (const Item& item : items)
            cost += item.cost;
        return cost;
    };
    const auto bracketed = [&](std::vector<Item> items, bool negated) {
        // In the order of the events.
        const auto first = [&](const Item& item) {
            std::size_t e = 0;
            while (e + 1 < events_.size() && !item.takes[e])
                ++e;
            return e;
        };
        std::ranges::stable_sort(items, {}, first);
        Brackets brackets{negated, {}};
        for (const Item& item : items)
            brackets.items.push_back(item.test);
        return make(std::move(brackets));
    };
    const std::vector<Item> inside = cover(required, optional);
    const std::size_t cost = cost_of(inside) + (inside.size() > 1 ? 2 : 0);
    // Exclusion never takes a probe.
    const Set outside_set = ordinary_ & ~required & ~optional;
    if ((required & ~ordinary_).none() && outside_set.any()) {
        const std::vector<Item> outside = cover(outside_set, ordinary_ & optional);
        const auto twice_negated =
            static_cast<std::size_t>(std::ranges::count_if(outside, [](const Item& item) {
                return print(item.test).find('^') != std::string::npos;
            }));
        if (cost_of(outside) + 3 + kDoubleNegation * twice_negated < cost)
            return bracketed(outside, true);
    }
    return inside.size() == 1 ? inside[0].test : bracketed(inside, false);
}

}  // namespace lightsieve::lpe
