#include "lpe/dialects/speller.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace lightsieve::lpe::dialects {
namespace {

/// Tiles that pairs are tried of.
constexpr std::size_t kMaxPairTiles = 96;

SymbolSet taken_by(const HitTest& test, const CommonAlphabet& alphabet, const Sight& sight) {
    SymbolSet set = alphabet.none();
    for (Symbol s = 0; s < alphabet.size(); ++s)
        if (sight.visible.has(s) && test(sight.views[s].hit)) set.add(s);
    return set;
}

/// What the text costs inside a choice: its brackets fall away there.
std::string_view as_item(std::string_view text) {
    const bool choice = text.size() > 2 && text[0] == '[' && text[1] != '^';
    return choice ? text.substr(1, text.size() - 2) : text;
}

/// Letters come first in a choice, in the order in which people list them.
std::size_t rank(std::string_view text) {
    constexpr std::string_view kOrder = "CDGSsRTVLOBA";
    return std::min(kOrder.find(as_item(text)[0]), kOrder.size());
}

}  // namespace

Sight::Sight(const Dialect& dialect, const CommonAlphabet& alphabet)
    : visible(alphabet.none()), invisible(alphabet.none()), absent(alphabet.none()) {
    for (Symbol s = 0; s < alphabet.size(); ++s) {
        views.push_back(dialect.view(alphabet.event(s)));
        switch (views.back().form) {
            case View::Form::Hit: visible.add(s); break;
            case View::Form::Invisible: invisible.add(s); break;
            case View::Form::Absent: absent.add(s); break;
        }
    }
}

Speller::Speller(const Dialect& dialect, const CommonAlphabet& alphabet, const Sight& sight,
                 const LabelSets& label_sets) {
    std::vector<std::pair<std::string, SymbolSet>> labels;
    for (const LabelText& label : dialect.labels(label_sets))
        labels.emplace_back(label.text, taken_by(label.test, alphabet, sight));
    // Of tests that take the same, the shortest is kept; of those, the one that says most.
    std::map<SymbolSet, std::size_t> known;
    for (const LetterText& letter : dialect.letters(label_sets)) {
        const SymbolSet letters = taken_by(letter.test, alphabet, sight);
        if (letters.empty()) continue;
        for (const auto& [label, taken] : labels) {
            if (!label.empty() && letter.inside.empty()) continue;
            SymbolSet events = letters & taken;
            if (events.empty()) continue;
            std::string text = label.empty() ? letter.alone : "<" + letter.inside + label + ">";
            const auto [entry, is_new] = known.try_emplace(events, tiles_.size());
            if (is_new)
                tiles_.push_back({std::move(text), std::move(events)});
            else if (text.size() <= tiles_[entry->second].text.size())
                tiles_[entry->second].text = std::move(text);
        }
    }
}

Speller::Spelled Speller::spell(const SymbolSet& wanted, const SymbolSet& free) const {
    const SymbolSet allowed = widened(wanted, wanted | free);
    Tiles usable;
    for (const Tile& tile : tiles_)
        if (allowed.contains(tile.events) && tile.events.intersects(wanted))
            usable.push_back(&tile);
    Tiles chosen = best_one_or_two(usable, wanted);
    if (chosen.empty()) chosen = greedy(usable, wanted);
    std::ranges::sort(chosen);
    std::ranges::stable_sort(chosen, {}, [](const Tile* tile) { return rank(tile->text); });
    Spelled out{"", chosen[0]->events};
    for (const Tile* tile : chosen) {
        out.text += chosen.size() > 1 ? as_item(tile->text) : std::string_view(tile->text);
        out.events |= tile->events;
    }
    if (chosen.size() > 1) out.text = "[" + out.text + "]";
    return out;
}

/// What must be allowed so that all that is wanted can be covered.
SymbolSet Speller::widened(const SymbolSet& wanted, SymbolSet allowed) const {
    SymbolSet covered = wanted - wanted;
    for (const Tile& tile : tiles_)
        if (allowed.contains(tile.events)) covered |= tile.events;
    while (true) {
        const SymbolSet left = wanted - covered;
        if (left.empty()) return allowed;
        // The tile with one of them that adds least.
        const Tile* best = nullptr;
        std::size_t least = SIZE_MAX;
        for (const Tile& tile : tiles_) {
            if (!tile.events.intersects(left)) continue;
            const std::size_t added = (tile.events - allowed).count();
            if (added < least || (added == least && tile.text.size() < best->text.size())) {
                best = &tile;
                least = added;
            }
        }
        LIGHTSIEVE_ASSERT(best != nullptr, "no test takes a visible event");
        allowed |= best->events;
        covered |= best->events;
    }
}

Speller::Tiles Speller::best_one_or_two(const Tiles& tiles, const SymbolSet& wanted) {
    Tiles best;
    std::size_t length = SIZE_MAX;
    for (const Tile* tile : tiles)
        if (tile->events.contains(wanted) && tile->text.size() < length) {
            best = {tile};
            length = tile->text.size();
        }
    if (!best.empty()) return best;
    // Pairs of those that cover most.
    std::vector<std::pair<std::size_t, const Tile*>> ranked;
    for (const Tile* tile : tiles)
        ranked.emplace_back((tile->events & wanted).count(), tile);
    std::ranges::stable_sort(ranked, std::greater<>(), &decltype(ranked)::value_type::first);
    if (ranked.size() > kMaxPairTiles) ranked.resize(kMaxPairTiles);
    for (std::size_t i = 0; i < ranked.size(); ++i)
        for (std::size_t j = i + 1; j < ranked.size(); ++j) {
            const Tile *a = ranked[i].second, *b = ranked[j].second;
            const std::size_t both = as_item(a->text).size() + as_item(b->text).size();
            if (both >= length || !(a->events | b->events).contains(wanted)) continue;
            best = {a, b};
            length = both;
        }
    return best;
}

Speller::Tiles Speller::greedy(const Tiles& tiles, const SymbolSet& wanted) {
    Tiles chosen;
    SymbolSet left = wanted;
    while (!left.empty()) {
        const Tile* best = nullptr;
        double most = 0.0;
        for (const Tile* tile : tiles) {
            const double gain = static_cast<double>((tile->events & left).count()) /
                                static_cast<double>(as_item(tile->text).size());
            if (gain > most) {
                best = tile;
                most = gain;
            }
        }
        LIGHTSIEVE_ASSERT(best != nullptr, "tiles do not cover what is wanted");
        chosen.push_back(best);
        left -= best->events;
    }
    // An early choice may have become superfluous.
    for (std::size_t i = 0; i < chosen.size() && chosen.size() > 1;) {
        SymbolSet others = wanted - wanted;
        for (const Tile* tile : chosen)
            if (tile != chosen[i]) others |= tile->events;
        if (others.contains(wanted))
            chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(i));
        else
            ++i;
    }
    return chosen;
}

}  // namespace lightsieve::lpe::dialects
