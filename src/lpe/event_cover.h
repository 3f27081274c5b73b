// The shortest test for a set of events: `D`, `<RS'coat'>`, `[TVLOB]`, `[^<RD>L]`.
//
// A set is covered by the tests that the language has for single events, the shortest together, or
// all that is not in the set is covered and excluded. It is a set-cover problem with few sets;
// branch and bound solves it, and after a fixed number of steps the best cover found so far is
// taken. Events that do not matter may be taken or not, which is where short answers come from.
//
// Internal to rest.h.
#pragma once

#include <bitset>
#include <cstddef>
#include <span>
#include <vector>

#include "core/event.h"
#include "lpe/algebra.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

class EventCover {
  public:
    static constexpr std::size_t kMaxEvents = 512;
    /// Events by their position in the list.
    using Set = std::bitset<kMaxEvents>;

    /// events  at most kMaxEvents, no camera
    /// labels  the labels that tests may name
    EventCover(std::span<const Event> events, const LabelClasses& labels);

    /// A test that takes all `required` events, maybe some of the `optional` ones, and no other.
    /// `required` is not empty.
    [[nodiscard]] Expr test_for(const Set& required, const Set& optional) const;

  private:
    struct Item {
        Expr test;
        Set takes;
        std::size_t cost;  ///< length of its text
    };
    using Items = std::vector<const Item*>;
    /// What `<..>` can say before the labels.
    struct Head {
        Angle angle;
        bool is_light;  ///< its labels are light groups
    };
    class Search;

    void add_heads();
    void add_labelled(std::size_t n_pairs);
    void add_item(std::vector<Item>& to, Expr test) const;
    void keep_cheapest();
    [[nodiscard]] const std::vector<std::vector<std::string>>& labels_of(const Head& head) const {
        return head.is_light ? labels_.groups : labels_.lobes;
    }
    [[nodiscard]] std::vector<Item> items_for(const Set& required, const Set& allowed) const;
    [[nodiscard]] Expr excluding(const Head& head, const Set& forbidden) const;
    [[nodiscard]] Expr one_of(const Head& head, const Set& forbidden) const;
    [[nodiscard]] Expr exactly(std::size_t event) const;
    [[nodiscard]] std::vector<Item> cover(const Set& required, const Set& optional) const;

    std::span<const Event> events_;
    LabelClasses labels_;
    Set ordinary_;  ///< all but probes
    std::vector<Head> heads_;
    std::vector<Item> items_;  ///< those that do not depend on what is asked
};

}  // namespace lightsieve::lpe
