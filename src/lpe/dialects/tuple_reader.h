// Reads the kind of light path expression that most renderers document: letters, <event lobe
// labels>, [..], [^..], groups and quantifiers, with blanks allowed.
//
// What differs between them is in `TupleOptions`. Also used to read what somebody who writes OSL
// most likely means (osl.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lpe/dialects/dialect.h"

namespace lightsieve::lpe::dialects {

struct TupleOptions {
    std::string_view renderer;     ///< for messages
    std::string_view events;       ///< letters of events
    std::string_view lobes;        ///< letters of lobes
    std::string_view numbered{};   ///< letters that a number may follow: D2
    std::uint32_t max_number = 0;  ///< largest such number
    std::string_view foreign{};    ///< letters that only this dialect has, always numbered
    bool tight = true;             ///< `|` joins one item on each side
    Repeats repeats = Repeats::StarAndPlus;
    std::size_t label_places = 0;  ///< places for labels in <..>; 0: labels are a set
    bool any_place = false;        ///< <D> and <L'key'> are understood
    bool (*any_event)(const Hit& hit) = nullptr;  ///< what `.` takes for an event
    bool (*any_lobe)(const Hit& hit) = nullptr;   ///< what a missing lobe or `.` takes
    /// What to do about a character that means nothing; "" if nothing special is known.
    std::string (*hint)(char c) = nullptr;
};

[[nodiscard]] Reading read_tuples(std::string_view text, const SourceSpan& base,
                                  Diagnostics& diagnostics, const TupleOptions& options);

/// Takes prefixes (`unoccluded;`) off the front of a text.
///
/// text      what stands after them, on return
/// base      its place, on return
/// tolerant  an unknown prefix is ignored with a lint, not an error
void take_prefixes(std::string_view& text, SourceSpan& base, std::span<const Prefix> known,
                   std::string_view renderer, bool tolerant, Reading& reading,
                   Diagnostics& diagnostics);

}  // namespace lightsieve::lpe::dialects
