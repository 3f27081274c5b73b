// Finds the shortest test, in one dialect, of a set of common events.
//
// A dialect's letters and label tests combine to *tiles*, the sets that a single <..> can take.
// What is wanted is covered with few of them. Where that is impossible, because the dialect does
// not tell some events apart, the smallest tile that does is taken: the result is then more than
// was wanted, and the caller can see it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lpe/dialects/common.h"
#include "lpe/dialects/dialect.h"
#include "lpe/dialects/spelling.h"

namespace lightsieve::lpe::dialects {

/// How a dialect sees each event of an alphabet.
struct Sight {
    std::vector<View> views;
    SymbolSet visible, invisible, absent;

    Sight(const Dialect& dialect, const CommonAlphabet& alphabet);
};

class Speller {
  public:
    /// label_sets  labels that stand together in the expression to be written
    Speller(const Dialect& dialect, const CommonAlphabet& alphabet, const Sight& sight,
            const LabelSets& label_sets);

    struct Spelled {
        std::string text;
        SymbolSet events;  ///< what it takes: all that was wanted, and maybe more
    };
    /// wanted  visible events, at least one
    /// free    events that it may take as well
    [[nodiscard]] Spelled spell(const SymbolSet& wanted, const SymbolSet& free) const;

  private:
    struct Tile {
        std::string text;
        SymbolSet events;
    };
    using Tiles = std::vector<const Tile*>;

    [[nodiscard]] SymbolSet widened(const SymbolSet& wanted, SymbolSet allowed) const;
    [[nodiscard]] static Tiles best_one_or_two(const Tiles& tiles, const SymbolSet& wanted);
    [[nodiscard]] static Tiles greedy(const Tiles& tiles, const SymbolSet& wanted);

    std::vector<Tile> tiles_;
};

}  // namespace lightsieve::lpe::dialects
