// What a test of a single event means: which events `D`, `.`, `'coat'`, `<RS[^'coat']>` or `[^LO]`
// take.
//
// One rule is easily overlooked: whatever does not name the camera or the probe by its letter
// (`.`, `[^..]`, labels, `<.>`) never takes it. So an expression that takes any path starts with
// C, and light never mixes with probes by `.`.
#pragma once

#include "core/event.h"
#include "lpe/ast.h"

namespace lightsieve::lpe {

/// Does the test take the event? `test` must satisfy `is_event_test`.
[[nodiscard]] bool takes(const Node& test, const Event& event);

/// Can an event of that kind pass the kind test of `<..>`, whatever its lobe and labels?
[[nodiscard]] bool may_be_kind(const LetterTest& test, EventKind kind);

/// Does the event carry the label?
[[nodiscard]] bool carries(const Event& event, const std::string& label);

}  // namespace lightsieve::lpe
