// Reads the test of a single event: a letter, `.`, a label, `<..>` or `[..]`.
//
// Internal to the parser; parse.cpp reads how events are put together.
#pragma once

#include "lpe/ast.h"
#include "lpe/cursor.h"

namespace lightsieve::lpe {

/// Reads one event's test. On an error it reports, skips what is wrong and returns null; it always
/// moves on.
///
/// may_be_camera  a small `c` here may be meant as the camera (accepted with a lint)
[[nodiscard]] Expr parse_event(Cursor& in, bool may_be_camera);

}  // namespace lightsieve::lpe
