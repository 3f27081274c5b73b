// Events and paths in words, for people who do not read the notation.
//
// "C RS'coat' L'key'" is "a path that leaves the camera, is reflected by the coat, and ends at a
// light of group key". Every witness of a proof is told in this way, and so are sets of events:
// what may stand at a place in an expression, or on an edge of an automaton. A set is named by what
// is in it, not by how it was written, so `[DS]` and `<[RT].>` read alike. The words for whole
// expressions are in describe.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/event.h"
#include "lpe/ast.h"
#include "lpe/path.h"

namespace lightsieve::lpe {

/// The path as a noun: "a path that leaves the camera, is reflected by the coat, and ends at a
/// light of group key".
///
/// names_groups  say "of no group" of a light in group `default`: where groups matter
[[nodiscard]] std::string path_in_words(std::span<const Event> path, bool names_groups = false);

/// Texts with commas and a last `word` between them: "a, b, and c", "a or b".
[[nodiscard]] std::string join_words(std::span<const std::string> texts, std::string_view word);

/// Labels of lobes, and of lights, that the words for an expression tell apart.
inline constexpr std::size_t kMaxWordLabels = 24;

/// A set of events, as a bit for each event of a list.
using EventSet = std::vector<bool>;

/// Finds words for sets of events of one list.
class EventNames {
  public:
    /// events  what a set may consist of, as a scene's
    explicit EventNames(std::span<const Event> events);
    /// Every event that these expressions could mean: of each kind one with every label that they
    /// name, one with none, and those with two.
    ///
    /// As `abstract_events`, but a label is never left out for being treated like another: people
    /// want to read both. Labels beyond kMaxWordLabels are left out.
    explicit EventNames(std::span<const Expr> exprs);

    /// A short name for an edge: `RD`, `RS except coat`, `any light`, `D V`. Empty for no event.
    [[nodiscard]] std::string label(const EventSet& set) const;
    /// What the scattering events of the set do, after "are" or "is": "reflected diffusely or
    /// refracted". Empty if there are none.
    [[nodiscard]] std::string scatters(const EventSet& set) const;
    /// Where the terminal events of the set are, after "end": "at a light of group key or in the
    /// background". Empty if there are none.
    [[nodiscard]] std::string ends(const EventSet& set) const;
    /// Both: "be reflected diffusely, or end at a light", after "must" or "may".
    [[nodiscard]] std::string doings(const EventSet& set) const;

    [[nodiscard]] const std::vector<Event>& events() const { return events_; }
    /// Has the list lights of more than one group?
    [[nodiscard]] bool tells_groups() const { return of_kind_[kLightKind].size() > 1; }
    /// The light group that stands for all that no expression names; empty if none is needed.
    [[nodiscard]] const std::string& other_group() const { return other_group_; }

  private:
    /// RD RS TD TS V L O B A.
    static constexpr std::size_t kKinds = 9, kLightKind = 5;
    /// A bit for each kind.
    using Kinds = std::uint32_t;

    /// Which of the labels that events of a kind can carry are meant.
    struct Labels {
        enum class Form : std::uint8_t { Any, One, All, Except, None, OneExcept, Listed };
        Form form = Form::Any;
        std::vector<std::string> with{};     ///< One: of them at least one; All: every one
        std::vector<std::string> without{};  ///< Except, OneExcept
        std::vector<std::vector<std::string>> listed{};  ///< the sets themselves
        friend bool operator==(const Labels&, const Labels&) = default;
    };
    /// Kinds that are meant with the same labels.
    struct Group {
        Kinds kinds = 0;
        Labels labels{};
    };
    struct Phrase {
        Kinds kinds;
        std::string_view text;
    };

    void index();
    [[nodiscard]] static std::size_t kind_of(const Event& event);
    [[nodiscard]] std::vector<Group> groups(const EventSet& set) const;
    [[nodiscard]] Labels labels_of(std::size_t kind, const EventSet& set) const;
    [[nodiscard]] std::vector<std::string_view> cover(Kinds kinds,
                                                      std::span<const Phrase> phrases) const;
    [[nodiscard]] std::string label_text(const Group& group) const;
    [[nodiscard]] std::string scatter_text(const Group& group) const;
    [[nodiscard]] static std::string by_text(const Labels& labels);
    [[nodiscard]] std::string end_text(const Group& group) const;
    [[nodiscard]] static std::string emission_text(const Labels& labels);
    [[nodiscard]] std::string of_group_text(const Labels& labels) const;

    std::vector<Event> events_;
    std::array<std::vector<std::size_t>, kKinds> of_kind_;  ///< indices into events_
    Kinds present_ = 0;                                     ///< kinds that the list has
    std::string other_group_{};
};

}  // namespace lightsieve::lpe
